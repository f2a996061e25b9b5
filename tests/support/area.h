/* Gratings of the method AREA, a tick at a time. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_AREA_H
#define KNURL_TEST_AREA_H

#include "support/close.h"

#include <knurl/grating.h>

#define A 0.001 /* m: amplitude */

/** A scan that goes on. */
typedef struct area_walk {
    knurl_grating grating;
    knurl_grating_state state;
    knurl_grating_output out;
    double height;     /* of the latest tick */
    double before;     /* of the tick before it */
    double last_point; /* for callers */
} area_walk;

static inline area_walk area_on(double fsx, double fsy, double rate) {
    area_walk w;
    memset(&w, 0, sizeof w);
    w.grating.spatial_frequency[0] = fsx;
    w.grating.spatial_frequency[1] = fsy;
    w.grating.amplitude = A;
    w.grating.update_rate_hz = rate;
    w.grating.method = KNURL_METHOD_AREA;
    assert_int_equal(knurl_grating_check(&w.grating), KNURL_OK);
    return w;
}

/** One tick. What holds of every one: a height that is finite and within pi/2 A. position may be null. */
static inline double area(area_walk *w, const double *position, const double velocity[2]) {
    knurl_grating_step(&w->grating, &w->state, position, velocity, &w->out);
    w->before = w->height;
    w->height = w->out.height;
    assert_true(isfinite(w->height) && fabs(w->height) <= 1.5707963267948966 * A * (1.0 + 1e-9));
    return w->height;
}

/** The same along x. */
static inline double area_x(area_walk *w, double x, double speed) {
    const double position[2] = {x, 0.0};
    const double velocity[2] = {speed, 0.0};
    return area(w, position, velocity);
}

#endif
