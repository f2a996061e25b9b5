/* Gratings of the method LOCKED, a tick at a time. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_LOCKED_H
#define KNURL_TEST_LOCKED_H

#include "support/close.h"

#include <knurl/grating.h>

#define A 0.001 /* m: amplitude */

/** m: the highest step between two ticks, from a 3-tick event's trough (-sqrt(2) A, Eq. 7) to a crest of A. */
#define HIGHEST_STEP ((1.0 + 1.4142135623730951) * A * (1.0 + 1e-12))

/** A scan that goes on, and the event that plays in it. */
typedef struct locked_walk {
    knurl_grating grating;
    knurl_grating_state state;
    knurl_grating_output out;
    double last;   /* height of the tick before */
    double sum;    /* of the event's heights so far */
    int64_t event; /* of the tick before */
    int ticks;     /* of the event so far */
    int walked;    /* a tick is behind us */
} locked_walk;

static inline locked_walk walk_on(int32_t method, double fsx, double fsy, double rate) {
    locked_walk w;
    memset(&w, 0, sizeof w);
    w.grating.spatial_frequency[0] = fsx;
    w.grating.spatial_frequency[1] = fsy;
    w.grating.amplitude = A;
    w.grating.update_rate_hz = rate;
    w.grating.method = method;
    w.event = KNURL_NO_EVENT;
    assert_int_equal(knurl_grating_check(&w.grating), KNURL_OK);
    return w;
}

/** One tick. What holds of every one: a finite height within T3's, no higher step than HIGHEST_STEP, an event that has
 * played to its end sums to nothing. position may be null. */
static inline double walk(locked_walk *w, const double *position, const double velocity[2]) {
    knurl_grating_step(&w->grating, &w->state, position, velocity, &w->out);
    const double height = w->out.height;
    assert_true(isfinite(height) && fabs(height) <= 1.4142135623730951 * A * (1.0 + 1e-12));
    assert_true(!w->walked || fabs(height - w->last) <= HIGHEST_STEP);
    if (w->out.event != w->event) {
        CHECK_CLOSE(w->sum, 0.0, 1e-12L * A);
        w->sum = 0.0;
        w->ticks = 0;
    }
    if (w->out.event != KNURL_NO_EVENT) {
        w->sum += height;
        w->ticks++;
    }
    w->event = w->out.event;
    w->last = height;
    w->walked = 1;
    return height;
}

/** The same along x. */
static inline double walk_x(locked_walk *w, double x, double speed) {
    const double position[2] = {x, 0.0};
    const double velocity[2] = {speed, 0.0};
    return walk(w, position, velocity);
}

#endif
