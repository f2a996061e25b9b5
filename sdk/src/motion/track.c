/* A position between the counts of an encoder. SPDX-License-Identifier: MIT */
#include "motion/velocity.h"

#include "base/base.h"

#include <math.h>

/* Of the most that a mean is off: slower is rest, before it becomes a denormal number, which takes ten times as long.
 */
#define REST 1e-4

/* x within [low, high]; low if x is not a number. */
static inline double within(double x, double low, double high) {
    const double above = x > low ? x : low; /* each is one instruction on x86 */
    return above < high ? above : high;
}

void knurl_velocity_track(knurl_velocity *estimator, const double position[3], const double velocity[3],
                          double tracked[3]) {
    if (KNURL_UNLIKELY(!estimator || !position || !velocity || !tracked)) {
        return;
    }
    knurl_velocity_state *s = knurl_velocity_get_state(estimator);
    const double share = s->mean_share, off = s->mean_off, half = s->half_count, period = s->period;
    if (KNURL_UNLIKELY(!s->tracking)) {
        for (int axis = 0; axis < 3; axis++) {
            s->tracked[axis] = position[axis];
            s->mean[axis] = velocity[axis];
        }
        s->tracking = 1;
    }
    for (int axis = 0; axis < 3; axis++) {
        const double v = velocity[axis], p = position[axis], mean = s->mean[axis];
        const double next = within(mean + share * (v - mean), v - off, v + off);
        const double now = fabs(next) > REST * off ? next : 0.0;
        const double at = within(s->tracked[axis] + now * period, p - half, p + half);
        s->mean[axis] = now;
        tracked[axis] = s->tracked[axis] = at;
    }
}
