/* Dry cycles: at 1 kHz a loop finds its code and data where a millisecond of other programs has left them, mostly not
 * in the cache. Before the device is read, a dry cycle does what the real one will do, on a scratch loop with a scratch
 * device and a scratch HIP, and loads what these stand for. SPDX-License-Identifier: MIT */
#include "loop/loop_internal.h"

#include "scene/scene.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* A force callback and a clock are the caller's, and are called for real cycles only. */
static int is_wanted(const knurl_loop_desc *desc) {
    return desc->dry_ticks && desc->scene && !desc->clock;
}

knurl_result knurl_loop_make_dry(knurl_loop *loop, const knurl_hip_facts *facts) {
    if (!is_wanted(&loop->desc)) {
        return KNURL_OK;
    }
    knurl_device *device = knurl_port_make_dry(loop->desc.device);
    knurl_dry *dry = calloc(1, sizeof *dry);
    if (!dry || !device) {
        knurl_port_free_dry(device);
        free(dry);
        return knurl_fail(KNURL_ERROR_MEMORY, "loop: could not get %u bytes", (unsigned)sizeof *dry);
    }
    knurl_hip_init_dry(loop->hip, &dry->hip);
    dry->loop.desc = loop->desc;
    dry->loop.desc.device = device;
    dry->loop.desc.tick_callback = NULL;
    dry->loop.desc.heartbeat_s = 0.0;
    dry->loop.clock = loop->clock;
    dry->loop.hip = &dry->hip;
    knurl_loop_init(&dry->loop, facts);
    loop->dry = dry;
    return KNURL_OK;
}

void knurl_loop_free_dry(knurl_loop *loop) {
    if (loop->dry) {
        knurl_system_unlock_memory(loop->dry, sizeof *loop->dry);
        knurl_port_free_dry(loop->dry->loop.desc.device);
        free(loop->dry);
    }
}

/* What a tick uses of the loop itself. */
static void fetch(const knurl_loop *loop) {
    knurl_fetch(loop, offsetof(knurl_loop, desc), offsetof(knurl_loop, thread));
    knurl_fetch(loop, offsetof(knurl_loop, force), offsetof(knurl_loop, tick_ns));
}

void knurl_loop_run_dry(knurl_loop *loop) {
    knurl_dry *dry = loop->dry;
    const int64_t before = loop->clock.now_ns(loop->clock.user);
    fetch(loop);
    knurl_port_begin_dry(dry->loop.desc.device, loop->desc.device, loop->position);
    knurl_hip_begin_dry(loop->desc.scene, loop->hip, &dry->hip);
    (void)knurl_loop_tick(&dry->loop);
    knurl_hip_end_dry(loop->hip);
    knurl_histogram_add(&loop->dry_tick_ns, loop->clock.now_ns(loop->clock.user) - before);
}
