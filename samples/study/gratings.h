/* The parts of the study `gratings`: each writes one member of its JSON object (and rows of CSV), and puts its facts
 * into the summary. 1 done, 0: no memory. SPDX-License-Identifier: MIT */
#ifndef KNURL_STUDY_GRATINGS_H
#define KNURL_STUDY_GRATINGS_H

#include "grating_metrics.h"
#include "json.h"

#include <stdio.h>

#define GRATINGS_RATE 1000.0 /* Hz: f_h */

/** Results that the study prints at its end. */
typedef struct gratings_summary {
    double silent_diagonal; /**< S1 through the cells' centres on 1000 x 1000: cycles/m felt along the diagonal */
    double map_over_path;   /**< the greatest Eq. 11 / Eq. 12 over direction, 1000 x 1000 */
    double angle_of_ratio;  /**< degrees, of map_over_path */
    double grid_lost;       /**< the greatest share of Eq. 11's cycles that S1 loses at 100 mm/s on 1000 x 1000 */
    double s1_silent;       /**< S1's dropout at f_t = f_h */
    double drift_before;    /**< S2's drift just below T = 3.5 ticks */
    double drift_at;        /**< and at T = 3.5 ticks */
    double drift_worst[2];  /**< S2's least and greatest drift from 20 Hz to f_h/2 */
    double frozen_seconds;  /**< duration of the first event of the stroke from rest */
    double frozen_cycles;   /**< cycles crossed meanwhile */
    double depth_needed[2]; /**< in A: at 3 ticks, and in the mix */
} gratings_summary;

/** A grating of amplitude 1 m at GRATINGS_RATE. */
knurl_grating gratings_make(int32_t method, double fsx, double fsy);

/** Plays a straight scan of `ticks` from `start`; STUDY_CROSSED_MAP for S1, _PATH for S2. 1, or 0 if memory runs out.
 */
int gratings_scan_line(const knurl_grating *grating, const double start[2], const double velocity[2], size_t ticks,
                       study_scan *scan);

int gratings_directions(json_writer *json,
                        gratings_summary *summary);                 /* Eq. 11, Eq. 12 and S1's cycles, over direction */
int gratings_map(FILE *csv, json_writer *json);                     /* S1's dropout and S2's drift, direction x speed */
int gratings_speeds(json_writer *json, gratings_summary *summary);  /* the same over speed, straight across */
int gratings_strokes(json_writer *json, gratings_summary *summary); /* from rest: S2 freezes; strokes twice a second */
int gratings_depths(json_writer *json, gratings_summary *summary);  /* net force against penetration */

#endif
