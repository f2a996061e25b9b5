/* Random numbers, directions, turns and times of a trial. SPDX-License-Identifier: MIT */
#include "trial.h"

#include <math.h>

/* xorshift64* (Vigna 2016). */
double trial_uniform(trial *t) {
    t->random ^= t->random >> 12;
    t->random ^= t->random << 25;
    t->random ^= t->random >> 27;
    return (double)((t->random * 0x2545f4914f6cdd1du) >> 11) / 9007199254740992.0;
}

double trial_between(trial *t, double low, double high) {
    return low + (high - low) * trial_uniform(t);
}

double trial_scale(trial *t, double low, double high) {
    return low * pow(high / low, trial_uniform(t));
}

int trial_below(trial *t, int count) {
    return (int)(trial_uniform(t) * count);
}

void trial_direction(trial *t, double out[3]) {
    double square = 0.0;
    while (square < 1e-4 || square > 1.0) {
        for (int axis = 0; axis < 3; axis++) {
            out[axis] = trial_between(t, -1.0, 1.0);
        }
        square = out[0] * out[0] + out[1] * out[1] + out[2] * out[2];
    }
    for (int axis = 0; axis < 3; axis++) {
        out[axis] /= sqrt(square);
    }
}

/* A rotation by `angle` (rad) about a random axis. */
void trial_rotation(trial *t, double angle, double quaternion[4]) {
    trial_direction(t, quaternion);
    for (int axis = 0; axis < 3; axis++) {
        quaternion[axis] *= sin(0.5 * angle);
    }
    quaternion[3] = cos(0.5 * angle);
}

/* s: at once, within a frame, or slowly. */
double trial_duration(trial *t) {
    const double kind = trial_uniform(t);
    return kind < 0.3 ? 0.0 : kind < 0.8 ? trial_between(t, 0.0, 0.008) : trial_between(t, 0.008, 0.3);
}

double trial_rate(trial *t) {
    static const double rates[] = {250.0, 500.0, 2000.0, 4000.0};
    return trial_uniform(t) < 0.7 ? 1000.0 : rates[trial_below(t, 4)];
}

/* s: 0, shorter than the slew limit's 5 ms, or longer. */
double trial_ramp(trial *t) {
    const double kind = trial_uniform(t);
    return kind < 0.2 ? 0.0 : kind < 0.4 ? trial_between(t, 0.0, 0.005) : trial_between(t, 0.01, 0.05);
}
