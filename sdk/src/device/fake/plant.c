/* The simulated device and hand. SPDX-License-Identifier: MIT */
#include "device/fake/plant.h"

#include "base/vec3.h"

#include <string.h>

/* Steps per tick: 0.25 ms is short against the poles of the default device and hand (c/m 122 /s, w 125 /s). */
#define SUBSTEPS 4

void knurl_plant_init(knurl_plant *plant, const knurl_plant_config *config, const double position[3]) {
    memset(plant, 0, sizeof *plant);
    plant->config = *config;
    vec3_copy(position, plant->position);
}

void knurl_plant_write(knurl_plant *plant, const double force[3]) {
    const double length = vec3_length(force);
    vec3_scale(length > plant->config.max_force ? plant->config.max_force / length : 1.0, force, plant->commanded);
}

void knurl_plant_zero_force(knurl_plant *plant) {
    memset(plant->commanded, 0, sizeof plant->commanded);
    memset(plant->forces, 0, sizeof plant->forces);
}

/* Dry friction stops the mass if it can within the step, otherwise slows it. */
static void apply_coulomb(knurl_plant *plant, double dt) {
    const double speed = vec3_length(plant->velocity);
    const double loss = plant->config.coulomb * dt / plant->config.mass;
    vec3_scale(speed > loss ? 1.0 - loss / speed : 0.0, plant->velocity, plant->velocity);
}

/* exp(A step) of A = [0 1 0; -k/m -c/m 1; 0 0 0] by scaling and squaring; its third column belongs to the push. */
static void make_motion(const knurl_plant_config *c, double step, knurl_plant_motion *motion) {
    const double stiff = c->hand_stiffness / c->mass;
    const double damped = (c->viscous + c->hand_damping) / c->mass;
    const double pace = step * (sqrt(stiff) + damped);
    const int squarings = pace > 0.25 ? (int)ceil(log2(pace / 0.25)) : 0;
    const double h = ldexp(step, -squarings);
    double f[2][2] = {{1.0, 0.0}, {0.0, 1.0}}; /* sums of the two series */
    double p[2] = {0.0, 0.0};
    double term[2][2] = {{1.0, 0.0}, {0.0, 1.0}};
    for (int n = 1; n <= 12; n++) { /* 0.25^12/12! is below the precision of a double */
        for (int row = 0; row < 2; row++) {
            p[row] += h / n * term[row][1];
            const double first = term[row][0];
            term[row][0] = h / n * (-stiff * term[row][1]);
            term[row][1] = h / n * (first - damped * term[row][1]);
            f[row][0] += term[row][0];
            f[row][1] += term[row][1];
        }
    }
    for (int i = 0; i < squarings; i++) {
        const double q[2] = {p[0] + f[0][0] * p[0] + f[0][1] * p[1], p[1] + f[1][0] * p[0] + f[1][1] * p[1]};
        const double g[2][2] = {
            {f[0][0] * f[0][0] + f[0][1] * f[1][0], f[0][0] * f[0][1] + f[0][1] * f[1][1]},
            {f[1][0] * f[0][0] + f[1][1] * f[1][0], f[1][0] * f[0][1] + f[1][1] * f[1][1]},
        };
        memcpy(p, q, sizeof p);
        memcpy(f, g, sizeof f);
    }
    memcpy(motion->free, f, sizeof f);
    memcpy(motion->push, p, sizeof p);
    motion->step = step;
    motion->steps_coarse = pace > 1.0;
}

/* A symplectic Euler step, which keeps the energy bounded. `target` at its end. */
static void step_plainly(knurl_plant *plant, double h, const double motor[3], const double target[3],
                         const double target_velocity[3]) {
    const knurl_plant_config *c = &plant->config;
    for (int axis = 0; axis < 3; axis++) {
        const double hand = c->hand_stiffness * (target[axis] - plant->position[axis]) +
                            c->hand_damping * (target_velocity[axis] - plant->velocity[axis]);
        const double force = motor[axis] + hand - c->viscous * plant->velocity[axis];
        plant->velocity[axis] += h * force / c->mass;
    }
    apply_coulomb(plant, h);
    for (int axis = 0; axis < 3; axis++) {
        plant->position[axis] += h * plant->velocity[axis];
    }
}

/* Dry friction during an exact step: against the motion, or at rest against the force. Returns 0 if it sticks. */
static int coulomb_force(const knurl_plant *plant, const double motor[3], const double target[3],
                         const double target_velocity[3], double along[3], double friction[3]) {
    const knurl_plant_config *c = &plant->config;
    memset(friction, 0, 3 * sizeof *friction);
    vec3_copy(plant->velocity, along);
    if (c->coulomb == 0.0) {
        return 1;
    }
    if (!(vec3_normalise(along) > 0.0)) {
        for (int axis = 0; axis < 3; axis++) {
            along[axis] = motor[axis] + c->hand_stiffness * (target[axis] - plant->position[axis]) +
                          c->hand_damping * target_velocity[axis];
        }
        if (vec3_normalise(along) <= c->coulomb) {
            return 0;
        }
    }
    vec3_scale(-c->coulomb, along, friction);
    return 1;
}

/* The exact motion under constant forces, `target` at its beginning. If dry friction reverses the motion within the
 * step, the step ends there, at a time and place interpolated linearly between both speeds. */
static void step_exactly(knurl_plant *plant, double h, const double motor[3], const double target[3],
                         const double target_velocity[3]) {
    const knurl_plant_config *c = &plant->config;
    const knurl_plant_motion *m = &plant->motion;
    double along[3];
    double friction[3];
    double before[3];
    double position[3];
    vec3_copy(plant->velocity, before);
    vec3_copy(plant->position, position);
    if (!coulomb_force(plant, motor, target, target_velocity, along, friction)) {
        return;
    }
    for (int axis = 0; axis < 3; axis++) { /* relative to the moving target */
        const double push = (motor[axis] + friction[axis] - c->viscous * target_velocity[axis]) / c->mass;
        const double u = position[axis] - target[axis];
        const double w = before[axis] - target_velocity[axis];
        plant->position[axis] =
            target[axis] + h * target_velocity[axis] + m->free[0][0] * u + m->free[0][1] * w + m->push[0] * push;
        plant->velocity[axis] = target_velocity[axis] + m->free[1][0] * u + m->free[1][1] * w + m->push[1] * push;
    }
    const double speed = vec3_dot(before, along);
    const double after = vec3_dot(plant->velocity, along);
    if (c->coulomb > 0.0 && speed > 0.0 && after < 0.0) {
        const double part = speed / (speed - after);
        for (int axis = 0; axis < 3; axis++) {
            const double there = before[axis] + part * (plant->velocity[axis] - before[axis]);
            plant->position[axis] = position[axis] + 0.5 * part * h * (before[axis] + there);
            plant->velocity[axis] = fabs(there) > 1e-9 * (speed - after) ? there : 0.0;
        }
    }
}

static void stop_at_ends(knurl_plant *plant) {
    for (int axis = 0; axis < 3; axis++) {
        const double stop = plant->config.half_workspace[axis];
        if (fabs(plant->position[axis]) > stop) {
            plant->position[axis] = plant->position[axis] > 0.0 ? stop : -stop;
            plant->velocity[axis] = 0.0;
        }
    }
}

static const double *acting(const knurl_plant *plant) {
    const uint32_t ring = KNURL_PLANT_MAX_DELAY + 1;
    return plant->forces[(plant->newest + ring - (uint32_t)plant->config.delay) % ring];
}

void knurl_plant_step(knurl_plant *plant, double dt, const double target[3], const double target_velocity[3]) {
    const double h = dt / SUBSTEPS;
    plant->newest = (plant->newest + 1) % (KNURL_PLANT_MAX_DELAY + 1);
    vec3_copy(plant->commanded, plant->forces[plant->newest]); /* enters the delay with this tick */
    if (plant->motion.step != h) {
        make_motion(&plant->config, h, &plant->motion);
    }
    const int exact = plant->config.exact || plant->motion.steps_coarse;
    for (int step = 0; step < SUBSTEPS; step++) {
        double reached[3]; /* `target` is given for the tick's end */
        for (int axis = 0; axis < 3; axis++) {
            reached[axis] = target[axis] - (dt - h * (exact ? step : step + 1)) * target_velocity[axis];
        }
        if (exact) {
            step_exactly(plant, h, acting(plant), reached, target_velocity);
        } else {
            step_plainly(plant, h, acting(plant), reached, target_velocity);
        }
        stop_at_ends(plant);
    }
}

void knurl_plant_forces(const knurl_plant *plant, const double target[3], const double target_velocity[3],
                        double motor[3], double hand[3]) {
    const knurl_plant_config *c = &plant->config;
    vec3_copy(acting(plant), motor);
    for (int axis = 0; axis < 3; axis++) {
        hand[axis] = c->hand_stiffness * (target[axis] - plant->position[axis]) +
                     c->hand_damping * (target_velocity[axis] - plant->velocity[axis]);
    }
}

void knurl_plant_measure(const knurl_plant *plant, double position[3]) {
    const double quantum = plant->config.resolution;
    for (int axis = 0; axis < 3; axis++) {
        position[axis] = quantum > 0.0 ? floor(plant->position[axis] / quantum + 0.5) * quantum : plant->position[axis];
    }
}
