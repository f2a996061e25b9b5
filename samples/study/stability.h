/* Checks of the laboratory against closed forms, and its maps. SPDX-License-Identifier: MIT */
#ifndef KNURL_STUDY_STABILITY_H
#define KNURL_STUDY_STABILITY_H

#include "lab.h"

#include <stdio.h>

/** A mass and a damper (the device without a hand) against the law F = -K x - B dx/dt, sampled, delayed. */
typedef struct stability_loop {
    double mass;    /**< kg */
    double viscous; /**< b: N s/m */
    double damping; /**< B: N s/m, of a backward difference */
    double delay;   /**< ticks */
    double rate;    /**< Hz */
} stability_loop;

/** N/m: (b + B)/(T/2 + td). */
double stability_bound(const stability_loop *loop);

/** N/m: the stiffness at which the loop's exact discretisation has a pole on the unit circle. */
double stability_exact(const stability_loop *loop);

/** N/m: the stiffness at which a release from 5 mm neither grows nor decays in the laboratory. Negative: an error, with
 * the library's message. */
double stability_found(const stability_loop *loop, lab_signals *signals);

/** N/m: the stiffness at which a sampled wall gives a hand that moves it to and fro at `hz` exactly the energy that the
 * damper b absorbs: in the laboratory, by the work of motor and hand. Negative: an error, with the library's message.
 */
double stability_passive_found(const stability_loop *loop, double hz);

/** One point of the regions of a quantised wall on a device with dry friction (Diolaiti et al. 2006): beta = b/(K T),
 * sigma = fc/(K Delta), pushed by a force midway between two of the wall's force levels, after a fall of 5 mm. 0, or 1
 * with the library's message. */
int stability_region_run(double beta, double sigma, lab_signals *signals, lab_result *result);

/** The theory's outcome at that point: LAB_UNSTABLE if beta < 1/2 and the fall is too large for dry friction; otherwise
 * LAB_LIMIT_CYCLE if sigma < 1/2, because it cannot rest between two force levels; otherwise LAB_REST. */
int stability_region_expected(double beta, double sigma);

/** N/m: (b + fc/v + hand's b)/(T/2 + td): dry friction of a device that slides at v acts like a damper across its path.
 */
double stability_sliding_bound(const knurl_device_info *device, const lab_grip *grip, double speed, double rate);

/** N/m: the largest stiffness at which a device stays clean (no limit cycle, not unstable), scanned in steps of 5 %. */
double stability_clean_found(const lab_case *c, lab_signals *signals);

/** One line of the table of checks. */
typedef struct stability_check {
    char what[96];
    const char *unit;       /**< "N/m", "J" or "outcome": LAB_ */
    double expected, found; /**< by theory; by the laboratory */
    double tolerance;       /**< of `found` against `expected`, a share of it; INFINITY: `found` is no less */
} stability_check;

#define STABILITY_CHECKS 80

/** Runs all checks. Returns their number, or 0 with the library's message. */
size_t stability_checks(stability_check checks[STABILITY_CHECKS]);

/** 1: found is within the tolerance of what was expected. */
int stability_holds(const stability_check *check);

/** A rendering method, a row of every map of methods. To add a method, add a row. */
typedef struct stability_method {
    const char *name;
    int32_t method;  /**< KNURL_ */
    int32_t texture; /**< 0: a flat wall */
} stability_method;

extern const stability_method stability_methods[]; /**< ended by a null name */

/** One map: outcomes over an axis and stiffness or amplitude, for one device in one hand. */
typedef struct stability_map {
    const char *figure; /**< its picture, and its pair of files */
    const char *name;   /**< the quantity along x: "damping", "wall damping", "delay", "rate" or "speed" */
    const char *device; /**< as lab_case.device; "%s": replaced by damping or delay */
    const char *label;  /**< for display */
    const char *grip;
    int32_t method; /**< of stability_methods */
    uint32_t without;
    int32_t effect; /**< KNURL_EFFECT_ in place of a wall, or 0 */
    int32_t wall;   /**< LAB_PLANE, ... */
} stability_map;

typedef struct stability_cell {
    double x, y; /**< x by the map's name: N s/m, ticks, Hz, m/s; y: N/m, or m in the figure of amplitudes */
    lab_result result;
} stability_cell;

#define STABILITY_COLUMNS 12
#define STABILITY_ROWS    18

/** A figure's maps, one after the other; `index` counts from 0. 0: there are no more. */
int stability_map_at(const char *figure, size_t index, stability_map *map);

/** Runs a map. Returns the number of cells, or 0 with the library's message. */
size_t stability_map_run(const stability_map *map, lab_signals *signals,
                         stability_cell cells[STABILITY_COLUMNS * STABILITY_ROWS]);

#endif
