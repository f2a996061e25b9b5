/* The simulated device and hand: a moving mass with friction, quantised, delayed and limited, held by a spring and a
 * damper. Pure computation, deterministic. Device frame, SI.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_PLANT_H
#define KNURL_SRC_PLANT_H

#include <stdint.h>

#define KNURL_PLANT_MAX_DELAY 16 /* ticks */

typedef struct knurl_plant_config {
    double mass;              /* kg: apparent mass of the device and of the part of the hand that moves with it, > 0 */
    double viscous;           /* N s/m */
    double coulomb;           /* N */
    double hand_stiffness;    /* N/m */
    double hand_damping;      /* N s/m */
    double resolution;        /* m; 0: not quantised */
    double max_force;         /* N */
    double half_workspace[3]; /* m: stops on either side of the origin */
    int32_t delay;            /* ticks from a force written to a force felt, 0 to KNURL_PLANT_MAX_DELAY */
    int32_t exact;            /* 1: exact integration; 0: only if the steps would be too coarse */
} knurl_plant_config;

/* Motion of a free spring, damper and mass over a step, and the contribution of a constant push. */
typedef struct knurl_plant_motion {
    double step;          /* s; 0 if not computed yet */
    double free[2][2];    /* (deflection, velocity) at the end from those at the beginning */
    double push[2];       /* (deflection, velocity) at the end, of an acceleration of 1 m/s2 */
    int32_t steps_coarse; /* 1: plain steps of this length would not be stable and smooth */
} knurl_plant_motion;

typedef struct knurl_plant {
    knurl_plant_config config;
    double position[3];
    double velocity[3];
    double commanded[3];                         /* the last command, held until the next one */
    double forces[KNURL_PLANT_MAX_DELAY + 1][3]; /* a ring, one per tick: the newest, and those still delayed */
    uint32_t newest;
    knurl_plant_motion motion;
} knurl_plant;

/* Starts at rest at `position`, without delayed forces. */
void knurl_plant_init(knurl_plant *plant, const knurl_plant_config *config, const double position[3]);

/* Commands a force, which is held until the next one. */
void knurl_plant_write(knurl_plant *plant, const double force[3]);

/* Switches the motors off and discards delayed forces. */
void knurl_plant_zero_force(knurl_plant *plant);

/* Advances by dt (s); the hand pulls towards a target (m) that moves at target_velocity (m/s). */
void knurl_plant_step(knurl_plant *plant, double dt, const double target[3], const double target_velocity[3]);

/* The motors' force during the last step, and the hand's present force if its target is as given. */
void knurl_plant_forces(const knurl_plant *plant, const double target[3], const double target_velocity[3],
                        double motor[3], double hand[3]);

/* The position as measured by the encoders. */
void knurl_plant_measure(const knurl_plant *plant, double position[3]);

#endif
