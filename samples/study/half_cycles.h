/* What every half cycle of a grating gives the hand: its impulse, at constant speed, whatever the tessellation.
 *
 * Impulse of a half cycle: the force along the normal less the wall's K d, summed over the half's ticks, times the
 * update period. d is not read from the tick: the HIP is held d below the surface by this file's own geometry, so that
 * what a tick gets wrong about depth is in the impulse. A cycle is an event that S2 plays, N ticks from its first; its
 * halves are the first ceil(N/2) ticks and the rest (Algorithms 2, 4).
 *
 * By Eqs. 5 and 7 both halves of an event of N ticks give K A T_h sqrt(Tp Tn) (Tp and Tn in ticks), which is K A T_h
 * N/2 for even N. Where two lengths alternate, the impulses differ by design, so that `cv` is taken of impulses over
 * this expectation; `raw_cv` is of the impulses as they are. SPDX-License-Identifier: MIT */
#ifndef KNURL_STUDY_HALF_CYCLES_H
#define KNURL_STUDY_HALF_CYCLES_H

#include "sheet.h"

#include <knurl/scene.h>

#define HALF_CYCLES_RATE      1000.0 /* Hz */
#define HALF_CYCLES_STIFFNESS 800.0  /* N/m */
#define HALF_CYCLES_AMPLITUDE 0.0002 /* m */
#define HALF_CYCLES_DEPTH     0.001  /* m: below the lowest trough, so that contact is never lost (Eq. 9) */
#define HALF_CYCLES_STROKE    0.04   /* m a start phase */
#define HALF_CYCLES_PHASES    16

/** What is scanned, and what "1 mm below" means on facets. */
enum {
    HALF_CYCLES_PLANE,  /**< flat */
    HALF_CYCLES_FACETS, /**< the sheet, the HIP at d from its facets: the grating alone is in the impulse */
    HALF_CYCLES_CURVE   /**< the sheet, the HIP at d from the smooth sheet: the facets are felt as well */
};

typedef struct half_cycles {
    double events;             /**< whole ones, over all start phases */
    double ticks_min;          /**< of an event */
    double ticks_max;          /**< of an event */
    double lost;               /**< share of events with a half below 10 % of the median half, or of the wrong sign */
    double cv;                 /**< spread of the impulse per event over its expectation */
    double raw_cv;             /**< spread of the impulse per event */
    double worst_half;         /**< largest |impulse of a half over its expectation - 1| */
    double played_per_crossed; /**< events over cycles crossed: 1 in step */
} half_cycles;

/** Scans along x at `speed` (m/s) over a grating of `period` (m). sheet: null for HALF_CYCLES_PLANE. 0, or 1 with the
 * library's message. */
int half_cycles_measure(int surface, const wavy_sheet *sheet, double period, double speed, half_cycles *out);

#endif
