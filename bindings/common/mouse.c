/* The device "mouse". SPDX-License-Identifier: MIT */
#include "mouse.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* s: the delay of a steady motion. A critically damped filter of 2/LAG rad/s leaves 9 % (peak, by its transfer
 * function) of ripple in the velocity of steps at 60 Hz: below the just noticeable difference. */
#define LAG    0.025
#define OMEGA  (2.0 / LAG)
#define SPEED  5.0 /* m/s: the fastest motion; the loop rejects positions that move at over 10 m/s */
#define BOUNDS 1e3 /* m: it has no workspace */

static void get_info(void *user, knurl_device_info *info) {
    (void)user;
    (void)snprintf(info->name, sizeof info->name, "mouse (moved by the game)");
    for (int axis = 0; axis < 3; axis++) {
        info->workspace_min[axis] = -BOUNDS;
        info->workspace_max[axis] = BOUNDS;
    }
    info->max_force = 3.3; /* N, a Touch's: no motor plays the force, but games show it */
}

static knurl_result start(void *user, double update_rate_hz) {
    knurl_mouse *m = user;
    m->period = 1.0 / update_rate_hz;
    m->decay = exp(-OMEGA * m->period);
    m->is_there = 0;
    return KNURL_OK;
}

/* Reads the latest target. Returns 0 if there is none, or the game is writing it now. */
static int read_target(const knurl_mouse *m, double target[3]) {
    const uint64_t before = __atomic_load_n(&m->sequence, __ATOMIC_ACQUIRE);
    for (int i = 0; i < 3; i++) {
        __atomic_load(&m->target[i], &target[i], __ATOMIC_ACQUIRE);
    }
    return before != 0 && before % 2 == 0 && __atomic_load_n(&m->sequence, __ATOMIC_RELAXED) == before;
}

/* Exact for a target that stands still over the tick. */
static void follow(knurl_mouse *m, const double target[3]) {
    double step[3];
    double length = 0.0;
    for (int i = 0; i < 3; i++) {
        const double error = m->position[i] - target[i];
        const double pull = (m->velocity[i] + OMEGA * error) * m->period;
        step[i] = target[i] + (error + pull) * m->decay - m->position[i];
        m->velocity[i] = (m->velocity[i] - OMEGA * pull) * m->decay;
        length += step[i] * step[i];
    }
    length = sqrt(length);
    const double most = SPEED * m->period;
    const double share = length > most ? most / length : 1.0;
    for (int i = 0; i < 3; i++) {
        m->position[i] += share * step[i];
        m->velocity[i] = share < 1.0 ? share * step[i] / m->period : m->velocity[i];
    }
}

static knurl_result read(void *user, knurl_device_sample *sample) {
    knurl_mouse *m = user;
    double target[3];
    const int is_fresh = read_target(m, target);
    if (!m->is_there) {
        if (!is_fresh) {
            return KNURL_ERROR_DEVICE_NOT_READY;
        }
        memcpy(m->position, target, sizeof target);
        memset(m->velocity, 0, sizeof m->velocity);
        m->is_there = 1;
    } else if (is_fresh) {
        follow(m, target);
    } else {
        for (int i = 0; i < 3; i++) {
            m->position[i] += m->velocity[i] * m->period;
        }
    }
    memset(sample, 0, sizeof *sample);
    memcpy(sample->position, m->position, sizeof sample->position);
    return KNURL_OK;
}

static knurl_result write(void *user, const double force[3]) {
    (void)user;
    (void)force;
    return KNURL_OK;
}

knurl_result knurl_mouse_open(knurl_mouse **mouse, knurl_device **device) {
    knurl_mouse *m = calloc(1, sizeof *m);
    if (!m) {
        return knurl_fail(KNURL_ERROR_MEMORY, "mouse: could not get %u bytes", (unsigned)sizeof *m);
    }
    knurl_device_functions functions;
    knurl_device_functions_init(&functions, sizeof functions);
    functions.user = m;
    functions.motors_known = 1; /* it has no motors */
    functions.get_info = get_info;
    functions.start = start;
    functions.read = read;
    functions.write = write;
    functions.close = free;
    const knurl_result result = knurl_device_open_functions(&functions, device);
    if (result) {
        free(m);
    } else {
        *mouse = m;
    }
    return result;
}

void knurl_mouse_move(knurl_mouse *m, const double position[3]) {
    const uint64_t sequence = __atomic_load_n(&m->sequence, __ATOMIC_RELAXED);
    __atomic_store_n(&m->sequence, sequence + 1, __ATOMIC_RELAXED);
    for (int i = 0; i < 3; i++) {
        double copy = position[i];
        __atomic_store(&m->target[i], &copy, __ATOMIC_RELEASE);
    }
    __atomic_store_n(&m->sequence, sequence + 2, __ATOMIC_RELEASE);
}
