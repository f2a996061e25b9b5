/* A simulated device of 50 g without obstacles, for the tests of the plant. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_FREE_MASS_H
#define KNURL_TEST_FREE_MASS_H

#include "support/close.h"

#include "device/fake/plant.h"

static const double nowhere[3] = {0.0, 0.0, 0.0};

/** 50 g on nothing: no friction, no hand, no limit in sight. exact: as in knurl_plant_config. */
static inline knurl_plant_config free_mass(int32_t exact) {
    const knurl_plant_config config = {
        .mass = 0.05, .max_force = 1000.0, .half_workspace = {10.0, 10.0, 10.0}, .exact = exact};
    return config;
}

static inline knurl_plant make_plant(const knurl_plant_config *config, double x, double velocity) {
    const double position[3] = {x, 0.0, 0.0};
    knurl_plant plant;
    knurl_plant_init(&plant, config, position);
    plant.velocity[0] = velocity;
    return plant;
}

#endif
