/* The device that conform tests if no URI is given: a mass that a simulated hand moves by a spring. To test your own
 * device, build conform with your file instead of this one (cmake -DKNURL_CONFORM_DEVICE=FILE).
 * SPDX-License-Identifier: MIT */
#include "device.h"

#include <math.h>
#include <string.h>

#define REACH 0.06 /* m: the workspace is a cube of twice that */

typedef struct hand {
    uint64_t random;
    double period; /* s */
    double max_force, continuous, heat_time, resolution;
    double mass, stiffness, damping; /* of grip and hand: kg, N/m, N s/m */
    double position[3], velocity[3], force[3];
    double target[3], speed[3]; /* of the hand: m, m/s */
    double left;                /* s until the next target */
} hand;

/* xorshift64* (Vigna 2016): 0 to 1. */
static double uniform(hand *h) {
    h->random ^= h->random >> 12;
    h->random ^= h->random << 25;
    h->random ^= h->random >> 27;
    return (double)((h->random * 0x2545f4914f6cdd1du) >> 11) / 9007199254740992.0;
}

/* Uniform in the logarithm. */
static double between(hand *h, double low, double high) {
    return low * pow(high / low, uniform(h));
}

static void get_info(void *user, knurl_device_info *info) {
    const hand *h = user;
    (void)strcpy(info->name, "a mass in a hand");
    for (int axis = 0; axis < 3; axis++) {
        info->workspace_min[axis] = -REACH;
        info->workspace_max[axis] = REACH;
    }
    info->max_force = h->max_force;
    info->continuous_force = h->continuous;
    info->heat_time = h->heat_time;
    info->resolution = h->resolution;
    info->mass = 0.1;
    info->viscous = 0.5;
}

static knurl_result start(void *user, double update_rate_hz) {
    ((hand *)user)->period = 1.0 / update_rate_hz;
    return KNURL_OK;
}

/* The hand rests, or moves to a random point at up to 0.5 m/s; a third of the time straight down. */
static void choose(hand *h) {
    const double fast = uniform(h) < 0.3 ? 0.0 : between(h, 0.005, 0.5);
    const int down = uniform(h) < 0.33;
    h->left = between(h, 0.005, 0.5);
    for (int axis = 0; axis < 3; axis++) {
        h->speed[axis] = down ? (axis == 1 ? -fast : 0.0) : fast * (2.0 * uniform(h) - 1.0);
    }
}

static knurl_result read(void *user, knurl_device_sample *sample) {
    hand *h = user;
    const double dt = h->period;
    h->left -= dt;
    if (h->left <= 0.0) {
        choose(h);
    }
    for (int axis = 0; axis < 3; axis++) {
        h->target[axis] = fmin(REACH, fmax(-REACH, h->target[axis] + dt * h->speed[axis]));
        const double pull = h->stiffness * (h->target[axis] - h->position[axis]) - h->damping * h->velocity[axis];
        h->velocity[axis] += dt * (pull + h->force[axis]) / h->mass;
        h->velocity[axis] = fmin(1.0, fmax(-1.0, h->velocity[axis]));
        h->position[axis] += dt * h->velocity[axis];
        sample->position[axis] =
            h->resolution > 0.0 ? h->resolution * floor(h->position[axis] / h->resolution + 0.5) : h->position[axis];
    }
    return KNURL_OK;
}

static knurl_result write(void *user, const double force[3]) {
    memcpy(((hand *)user)->force, force, sizeof((hand *)user)->force);
    return KNURL_OK;
}

static knurl_result reopen(void *user) {
    (void)user;
    return KNURL_OK;
}

void conform_device(knurl_device_functions *functions, uint64_t seed) {
    static hand only; /* conform opens one at a time */
    hand *h = &only;
    memset(h, 0, sizeof *h);
    h->random = seed * 0x9e3779b97f4a7c15u + 1u;
    (void)uniform(h);
    h->max_force = between(h, 1.0, 20.0);
    h->continuous = h->max_force * between(h, 0.2, 1.0);
    h->heat_time = between(h, 2.0, 60.0);
    h->resolution = uniform(h) < 0.5 ? 0.0 : between(h, 1e-6, 1e-4);
    h->mass = between(h, 0.1, 1.0);
    h->stiffness = between(h, 100.0, 4000.0);
    h->damping = 0.5 * sqrt(h->stiffness * h->mass);
    functions->user = h;
    functions->get_info = get_info;
    functions->start = start;
    functions->read = read;
    functions->write = write;
    functions->reopen = reopen;
    functions->motors_known = 1;
}
