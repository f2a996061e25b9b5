/* Checks of the laboratory against closed forms, and its maps. SPDX-License-Identifier: MIT */
#ifndef KNURL_STUDY_STABILITY_H
#define KNURL_STUDY_STABILITY_H

#include "lab.h"

#include <stdio.h>

/** A mass and a damper (the device, held by no hand) against the law F = -K x - B dx/dt, sampled, delayed. */
typedef struct stability_loop {
    double mass;    /**< kg */
    double viscous; /**< b: N s/m */
    double damping; /**< B: N s/m, of a backward difference */
    double delay;   /**< ticks */
    double rate;    /**< Hz */
} stability_loop;

/** N/m: (b + B)/(T/2 + td). */
double stability_bound(const stability_loop *loop);

/** N/m: where the loop's exact discretisation has a pole on the unit circle. */
double stability_exact(const stability_loop *loop);

/** N/m: where a release from 5 mm neither grows nor dies in the laboratory. Negative: with the library's message. */
double stability_found(const stability_loop *loop, lab_signals *signals);

/** N/m: where a sampled wall on a damper b gives a hand that moves it to and fro at `hz` just as much as b takes: in the
 * laboratory, by the works of motor and hand. Negative: with the library's message. */
double stability_passive_found(const stability_loop *loop, double hz);

/** One point of the regions of a quantised wall on a device with dry friction (Diolaiti et al. 2006): beta = b/(K T),
 * sigma = fc/(K Delta), pushed by a force midway between two of the wall's force levels, after a fall of 5 mm. 0, or 1
 * with the library's message. */
int stability_region_run(double beta, double sigma, lab_signals *signals, lab_result *result);

/** What theory says of that point: beta < 1/2: unstable, where the fall is larger than what dry friction can hold
 * (LAB_UNSTABLE); else sigma < 1/2: the force between two levels leaves it no place to rest (LAB_LIMIT_CYCLE); else
 * LAB_REST. */
int stability_region_expected(double beta, double sigma);

/** N/m: up to where a device stays clean (no limit cycle, nothing unstable): scanned in steps of 5 %. */
double stability_clean_found(const lab_case *c, lab_signals *signals);

/** One line of the table of checks. */
typedef struct stability_check {
    char what[96];
    double expected, found; /**< N/m, or LAB_ outcomes */
    double tolerance;       /**< of `found` against `expected`, a share */
} stability_check;

#define STABILITY_CHECKS 64

/** All of them; how many, or 0 with the library's message. */
size_t stability_checks(stability_check checks[STABILITY_CHECKS]);

#endif
