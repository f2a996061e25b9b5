/* Heat of the motors. It belongs to the device: a loop starts with the last loop's, cooled by the loop's clock.
 * SPDX-License-Identifier: MIT */
#include "loop/loop_internal.h"

#include "base/atomic.h"
#include "base/vec3.h"

#include <math.h>

void knurl_loop_tell_heat(knurl_loop *loop) {
    knurl_store_double(&loop->shared.theta, loop->haptic.last->heat.square * loop->haptic.per_force);
}

void knurl_loop_begin_heat(knurl_loop *loop) {
    const knurl_motor_heat *motors = knurl_port_motors(loop->shared.desc.device);
    knurl_motor_heat_recall(loop->shared.desc.device);
    loop->haptic.last->heat.square = motors->square;
    if (motors->now == loop->shared.clock.now_ns && motors->user == loop->shared.clock.user) { /* the same clock */
        const double since = 1e-9 * (double)(loop->shared.clock.now_ns(loop->shared.clock.user) - motors->at);
        knurl_heat_hold(&loop->haptic.last->heat, 0.0, fmax(0.0, since) * loop->shared.desc.update_rate_hz);
    }
    knurl_loop_tell_heat(loop);
}

void knurl_loop_end_heat(knurl_loop *loop) {
    knurl_motor_heat *motors = knurl_port_motors(loop->shared.desc.device);
    motors->square = loop->haptic.last->heat.square;
    motors->at = loop->shared.clock.now_ns(loop->shared.clock.user);
    motors->now = loop->shared.clock.now_ns;
    motors->user = loop->shared.clock.user;
}

void knurl_loop_pass_time(knurl_loop *loop, int64_t now) {
    const double periods = 1e-9 * (double)(now - loop->haptic.cycle_at) * loop->shared.desc.update_rate_hz;
    const double missed = loop->haptic.cycle_at ? periods - 1.0 : 0.0;
    loop->haptic.cycle_at = now;
    if (missed < 1.0) {
        return;
    }
    const int halted = knurl_port_is_halted(loop->shared.desc.device) != 0;
    const double force2 = halted ? 0.0 : vec3_dot(loop->haptic.force, loop->haptic.force);
    knurl_heat_hold(&loop->haptic.last->heat, force2, missed);
    knurl_loop_tell_heat(loop);
}
