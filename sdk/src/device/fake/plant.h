/* The simulated device and hand: a moving mass with friction, quantised, delayed and limited, held by a spring and a
 * damper. Pure computation, deterministic. Device frame, SI.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_PLANT_H
#define KNURL_SRC_PLANT_H

#include <stdint.h>

#define KNURL_PLANT_MAX_DELAY 16 /* ticks */

typedef struct knurl_plant_config {
    double mass;              /* kg: the device's apparent mass and what of the hand moves with it, > 0 */
    double viscous;           /* N s/m */
    double coulomb;           /* N */
    double hand_stiffness;    /* N/m */
    double hand_damping;      /* N s/m */
    double resolution;        /* m; 0: not quantised */
    double max_force;         /* N */
    double half_workspace[3]; /* m: stops either side of the origin */
    int32_t delay;            /* ticks from a force written to a force felt, 0 to KNURL_PLANT_MAX_DELAY */
    int32_t exact;            /* 1: exactly integrated; 0: so only where the steps would be too coarse */
} knurl_plant_config;

/* How a spring, a damper and a mass that were left alone go on over a step, and what a constant push adds. */
typedef struct knurl_plant_motion {
    double step;          /* s; 0: not made yet */
    double free[2][2];    /* (deflection, velocity) at the end from those at the beginning */
    double push[2];       /* (deflection, velocity) at the end, of an acceleration of 1 m/s2 */
    int32_t steps_coarse; /* 1: plain steps of this length would not be stable and smooth */
} knurl_plant_motion;

typedef struct knurl_plant {
    knurl_plant_config config;
    double position[3];
    double velocity[3];
    double commanded[3];                         /* the latest command, which holds until the next one */
    double forces[KNURL_PLANT_MAX_DELAY + 1][3]; /* a ring, one a tick: the newest, and those still under way */
    uint32_t newest;
    knurl_plant_motion motion;
} knurl_plant;

/* At rest at `position`, no force under way. */
void knurl_plant_init(knurl_plant *plant, const knurl_plant_config *config, const double position[3]);

/* Commands a force, which holds until the next one. */
void knurl_plant_write(knurl_plant *plant, const double force[3]);

/* Cuts the motors off: no force, and none under way. */
void knurl_plant_zero_force(knurl_plant *plant);

/* Moves on by dt (s), the hand pulling towards a target (m) that moves at target_velocity (m/s). */
void knurl_plant_step(knurl_plant *plant, double dt, const double target[3], const double target_velocity[3]);

/* What acted over the latest step: the motors, and (now) the hand whose target is there and so fast. */
void knurl_plant_forces(const knurl_plant *plant, const double target[3], const double target_velocity[3],
                        double motor[3], double hand[3]);

/* The position as the encoders measure it. */
void knurl_plant_measure(const knurl_plant *plant, double position[3]);

#endif
