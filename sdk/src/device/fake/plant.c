/* The simulated device and hand. SPDX-License-Identifier: MIT */
#include "device/fake/plant.h"

#include "base/vec3.h"

#include <string.h>

/* Steps a tick. The stiffest pole (hand damping 5 N s/m on 0.05 kg: 100 /s) is slow against a quarter millisecond. */
#define SUBSTEPS 4

void knurl_plant_init(knurl_plant *plant, const knurl_plant_config *config, const double position[3]) {
    memset(plant, 0, sizeof *plant);
    plant->config = *config;
    vec3_copy(position, plant->position);
}

void knurl_plant_write(knurl_plant *plant, const double force[3]) {
    const double length = vec3_length(force);
    vec3_scale(length > plant->config.max_force ? plant->config.max_force / length : 1.0, force, plant->told);
}

void knurl_plant_let_go(knurl_plant *plant) {
    memset(plant->told, 0, sizeof plant->told);
    memset(plant->forces, 0, sizeof plant->forces);
}

/* Dry friction stops what it can within the step and slows what it cannot. */
static void apply_coulomb(knurl_plant *plant, double dt) {
    const double speed = vec3_length(plant->velocity);
    const double loss = plant->config.coulomb * dt / plant->config.mass;
    vec3_scale(speed > loss ? 1.0 - loss / speed : 0.0, plant->velocity, plant->velocity);
}

void knurl_plant_step(knurl_plant *plant, double dt, const double target[3], const double target_velocity[3]) {
    const knurl_plant_config *c = &plant->config;
    const uint32_t ring = KNURL_PLANT_MAX_DELAY + 1;
    plant->newest = (plant->newest + 1) % ring;
    vec3_copy(plant->told, plant->forces[plant->newest]); /* under way from this tick on */
    const double *motor = plant->forces[(plant->newest + ring - (uint32_t)c->delay) % ring];
    const double h = dt / SUBSTEPS;
    for (int step = 0; step < SUBSTEPS; step++) {
        for (int axis = 0; axis < 3; axis++) {
            const double reached =
                target[axis] - (dt - h * (step + 1)) * target_velocity[axis]; /* target is at the end */
            const double hand = c->hand_stiffness * (reached - plant->position[axis]) +
                                c->hand_damping * (target_velocity[axis] - plant->velocity[axis]);
            const double force = motor[axis] + hand - c->viscous * plant->velocity[axis];
            plant->velocity[axis] += h * force / c->mass;
        }
        apply_coulomb(plant, h);
        for (int axis = 0; axis < 3;
             axis++) { /* the new velocity moves it: symplectic Euler keeps the energy bounded */
            const double stop = c->half_workspace[axis];
            plant->position[axis] += h * plant->velocity[axis];
            if (fabs(plant->position[axis]) > stop) {
                plant->position[axis] = plant->position[axis] > 0.0 ? stop : -stop;
                plant->velocity[axis] = 0.0;
            }
        }
    }
}

void knurl_plant_measure(const knurl_plant *plant, double position[3]) {
    const double quantum = plant->config.resolution;
    for (int axis = 0; axis < 3; axis++) {
        position[axis] = quantum > 0.0 ? floor(plant->position[axis] / quantum + 0.5) * quantum : plant->position[axis];
    }
}
