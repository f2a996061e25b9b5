/* Weighing with a device. SPDX-License-Identifier: MIT */
#include "weigh.h"

#include <knurl/loop.h>

#include <math.h>
#include <string.h>

#define RATE      1000.0 /* Hz */
#define TURN      4.0    /* s up and down again */
#define REACH     0.006  /* m each way */
#define STIFFNESS 400.0  /* N/m: soft, so that a hand can always stop it */
#define INTEGRAL  300.0  /* N/m/s */
#define DAMPING   8.0    /* N s/m */
#define GRAVITY   9.80665

static double clamp(const weighing *w, double value) {
    return fmin(w->most, fmax(-w->most, value));
}

/* Up and down at a steady speed. */
static double target(const weighing *w, double t) {
    const double phase = fmod(t / TURN, 1.0);
    return w->height + REACH * (phase < 0.25 ? 4.0 * phase : phase < 0.75 ? 2.0 - 4.0 * phase : 4.0 * phase - 4.0);
}

void weigh_hold(uint64_t tick, const knurl_device_sample *sample, double force[3], void *user) {
    weighing *w = user;
    const double t = (double)tick / RATE;
    if (tick == 0) {
        memcpy(w->latest, sample->position, sizeof w->latest);
        w->height = isfinite(w->height) ? w->height : sample->position[1];
    }
    for (int axis = 0; axis < 3; axis++) {
        const double speed = (sample->position[axis] - w->latest[axis]) * RATE;
        w->speed[axis] += 0.1 * (speed - w->speed[axis]);
        w->latest[axis] = sample->position[axis];
        const double miss = (axis == 1 ? target(w, t) : 0.0) - sample->position[axis];
        w->lag += axis == 1 && fabs(INTEGRAL * w->lag) < w->most ? miss / RATE : 0.0;
        force[axis] = clamp(w, STIFFNESS * miss - DAMPING * w->speed[axis] + (axis == 1 ? INTEGRAL * w->lag : 0.0));
    }
    if (t >= WEIGH_SECONDS - 2.0 * TURN) { /* it has settled by then */
        w->sum += force[1];
        w->count++;
        w->cut += fabs(force[1]) >= w->most;
    }
}

knurl_result weigh(knurl_device *device, double *height, double *newtons) {
    weighing w;
    knurl_loop_desc desc;
    knurl_loop_stats stats;
    knurl_loop *loop = NULL;
    memset(&w, 0, sizeof w);
    w.height = *height;
    w.most = WEIGH_FORCE_MAX;
    knurl_loop_desc_init(&desc, sizeof desc);
    desc.device = device;
    desc.force_callback = weigh_hold;
    desc.protections |= KNURL_PROTECT_SLEW;
    desc.user = &w;
    desc.update_rate_hz = RATE;
    desc.tick_limit = (uint64_t)(WEIGH_SECONDS * RATE);
    knurl_result result = knurl_loop_create(&desc, &loop);
    result = result ? result : knurl_loop_start(loop);
    const int is_over = !result && knurl_loop_wait(loop, 2.0 * WEIGH_SECONDS);
    if (!result) {
        knurl_loop_stats_init(&stats, sizeof stats);
        (void)knurl_loop_get_stats(loop, &stats);
        result = is_over && stats.state == KNURL_LOOP_DONE && w.count > 0 ? KNURL_OK : KNURL_ERROR_DEVICE_NOT_READY;
    }
    knurl_loop_destroy(loop);
    if (!result) {
        *height = w.height;
        *newtons = w.sum / (double)w.count;
    }
    return result;
}

double weigh_gain(double gain, double kilograms, double heavier) {
    return gain * heavier / (GRAVITY * kilograms);
}
