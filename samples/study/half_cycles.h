/* The impulse of every half cycle of a grating, at constant speed, for any tessellation.
 *
 * The impulse of a half cycle is the force along the normal minus the wall's K d, summed over the half's ticks, times
 * the update period. d comes from this file's own geometry, which holds the HIP d below the surface, and not from the
 * tick; so a tick's error in depth shows in the impulse. A cycle is an event of S2, N ticks long; its halves are the
 * first ceil(N/2) ticks and the rest (Algorithms 2, 4).
 *
 * By Eqs. 5 and 7 both halves of an event have the impulse K A T_h sqrt(Tp Tn) (Tp and Tn in ticks), which is K A T_h
 * N/2 for even N. Where two lengths alternate, impulses differ by design: `cv` is of impulses divided by this
 * expectation, `raw_cv` of the impulses themselves.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_STUDY_HALF_CYCLES_H
#define KNURL_STUDY_HALF_CYCLES_H

#include "sheet.h"

#include <knurl/hip.h>
#include <knurl/query.h>

#define HALF_CYCLES_RATE      1000.0 /* Hz */
#define HALF_CYCLES_STIFFNESS 800.0  /* N/m */
#define HALF_CYCLES_AMPLITUDE 0.0002 /* m */
#define HALF_CYCLES_DEPTH     0.001  /* m: below the lowest trough, so that contact is never lost (Eq. 9) */
#define HALF_CYCLES_STROKE    0.04   /* m per start phase */
#define HALF_CYCLES_PHASES    16

/** The scanned surface, and the meaning of "1 mm below" on facets. */
enum {
    HALF_CYCLES_PLANE,  /**< flat */
    HALF_CYCLES_FACETS, /**< the sheet, the HIP at d from its facets: the grating alone is in the impulse */
    HALF_CYCLES_CURVE   /**< the sheet, the HIP at d from the smooth sheet: the facets are felt, too */
};

typedef struct half_cycles {
    double events;             /**< whole events, over all start phases */
    double ticks_min;          /**< of an event */
    double ticks_max;          /**< of an event */
    double lost;               /**< share of events with a half below 10 % of the median half, or of the wrong sign */
    double cv;                 /**< spread of the impulse per event over its expectation */
    double raw_cv;             /**< spread of the impulse per event */
    double worst_half;         /**< largest |impulse of a half over its expectation - 1| */
    double played_per_crossed; /**< events over cycles crossed: 1: in step */
} half_cycles;

/** Scans along x at `speed` (m/s) over a grating of `period` (m). sheet: null for HALF_CYCLES_PLANE. 0, or 1 with the
 * library's message. */
int half_cycles_measure(int surface, const wavy_sheet *sheet, double period, double speed, half_cycles *out);

#endif
