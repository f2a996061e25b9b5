/* A position between the counts of an encoder. SPDX-License-Identifier: MIT */
#include "motion/velocity.h"

#include "base/base.h"
#include "base/rule.h"
#include "motion/pair.h"

#include <string.h>

/* Of the most that a mean is off: slower is rest, before it becomes a denormal number, which takes ten times as long.
 */
#define REST 1e-4

/* Moves two axes on by a tick: p, v: measured position and velocity. Returns the tracked position. */
static inline pair move(knurl_velocity_state *s, int axis, pair p, pair v) {
    pair mean, tracked;
    memcpy(&mean, &s->mean[axis], sizeof mean);
    memcpy(&tracked, &s->tracked[axis], sizeof tracked);
    const pair next = lesser(greater(mean + s->mean_share * (v - mean), v - s->mean_off), v + s->mean_off);
    const pair now = (pair)((greater(next, -next) > REST * s->mean_off) & (pair_mask)next); /* else 0 */
    const pair at = lesser(greater(tracked + now * s->period, p - s->half_count), p + s->half_count);
    memcpy(&s->mean[axis], &now, sizeof now);
    memcpy(&s->tracked[axis], &at, sizeof at);
    return at;
}

void knurl_velocity_track(knurl_velocity *estimator, const double position[3], const double velocity[3],
                          double tracked[3]) {
    KNURL_RULE(HAPTIC, estimator);
    if (KNURL_UNLIKELY(!estimator || !position || !velocity || !tracked)) {
        return;
    }
    knurl_velocity_state *s = knurl_velocity_get_state(estimator);
    if (KNURL_UNLIKELY(!s->tracking)) {
        for (int axis = 0; axis < 3; axis++) {
            s->tracked[axis] = position[axis];
            s->mean[axis] = velocity[axis];
        }
        s->tracking = 1;
    }
    const pair xy = move(s, 0, (pair){position[0], position[1]}, (pair){velocity[0], velocity[1]});
    const pair z = move(s, 2, (pair){position[2], 0.0}, (pair){velocity[2], 0.0});
    tracked[0] = xy[0];
    tracked[1] = xy[1];
    tracked[2] = z[0];
}
