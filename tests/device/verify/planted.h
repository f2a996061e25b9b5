/* Defects of a device, planted between its positions and forces and those that knurl verify sees.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_PLANTED_H
#define KNURL_TEST_PLANTED_H

#include "verify.h"

#include "support/double.h"

typedef enum planted_defect {
    CLEAN,
    SWAPPED_AXIS,  /**< x and z of positions */
    HALF_GAIN,     /**< of the force */
    THREE_LATE,    /**< ticks more than Knurl knows, of the force */
    STICKY_JOINT,  /**< dry friction of 0.6 N more along each axis */
    NOISY_ENCODER, /**< 0.17 mm rms */
    WRONG_SIGN,    /**< of the force along y */
    DEFECTS
} planted_defect;

extern const char *const planted_names[DEFECTS];

/** Runs `only` (null: all) but `skip` (or null) with a simulated person on a fake device (its URI with a '?') or on a
 * double (uri null). mass: kg that hangs from the grip, NAN: no mass. Fails the test if it cannot run. */
void planted_run(verify *v, const char *uri, const device_double *device, planted_defect defect, const char *only,
                 const char *skip, double mass);

/** The tick at which the next runs are interrupted; 0: they are not. */
extern uint64_t planted_interrupts_at;

/** 1: the person of the next runs forgets to hang the mass. */
extern int planted_without_mass;

/** N: the strongest force that the last run sent to a fake device, in a hand, or (1) let go to be weighed. */
double planted_strongest(int is_weighing);

#endif
