/* A position between the counts of an encoder. SPDX-License-Identifier: MIT */
#include "motion/velocity.h"

#include "base/base.h"

/* x within [low, high]; low if x is not a number. */
static inline double within(double x, double low, double high) {
    return x > low ? x < high ? x : high : low;
}

void knurl_velocity_track(knurl_velocity *estimator, const double position[3], const double velocity[3],
                          double tracked[3]) {
    if (KNURL_UNLIKELY(!estimator || !position || !velocity || !tracked)) {
        return;
    }
    knurl_velocity_state *s = knurl_velocity_get_state(estimator);
    for (int axis = 0; axis < 3; axis++) {
        const double last = s->tracking ? s->tracked[axis] : position[axis];
        const double before = s->tracking ? s->mean[axis] : velocity[axis];
        s->mean[axis] = within(before + s->mean_share * (velocity[axis] - before), velocity[axis] - s->mean_off,
                               velocity[axis] + s->mean_off);
        tracked[axis] = s->tracked[axis] =
            within(last + s->mean[axis] * s->period, position[axis] - s->half_count, position[axis] + s->half_count);
    }
    s->tracking = 1;
}
