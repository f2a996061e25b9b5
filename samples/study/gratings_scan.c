/* Straight scans over gratings. SPDX-License-Identifier: MIT */
#include "gratings.h"

#include <stdlib.h>
#include <string.h>

knurl_grating gratings_make(int32_t method, double fsx, double fsy) {
    knurl_grating grating;
    memset(&grating, 0, sizeof grating);
    grating.spatial_frequency[0] = fsx;
    grating.spatial_frequency[1] = fsy;
    grating.amplitude = 1.0;
    grating.update_rate_hz = GRATINGS_RATE;
    grating.method = method;
    return grating;
}

int gratings_scan_line(const knurl_grating *grating, const double start[2], const double velocity[2], size_t ticks,
                       study_scan *scan) {
    study_motion *motion = malloc(ticks * sizeof *motion);
    int done = 0;
    if (motion) {
        study_motion_line(start, velocity, grating->update_rate_hz, motion, ticks);
        done = study_scan_run(grating, motion, ticks,
                              grating->method == KNURL_METHOD_S1 ? STUDY_CROSSED_MAP : STUDY_CROSSED_PATH, scan);
    }
    free(motion);
    return done;
}
