/* Measuring and drawing, shared by the catalogue's rows. SPDX-License-Identifier: MIT */
#include "failures.h"
#include "gratings.h"
#include "out.h"

#include <math.h>

void failure_point(const failure_sink *sink, const char *series, double t, double value) {
    if (sink->csv) {
        fprintf(sink->csv, "%s,\"%s\",", sink->id, series);
        out_number(sink->csv, t);
        fputc(',', sink->csv);
        out_number(sink->csv, value);
        fputc('\n', sink->csv);
    }
}

void failure_draw_heights(const failure_sink *sink, const study_scan *scan, double cycle, size_t ticks) {
    for (size_t k = 0; k < ticks && k < scan->ticks; k++) {
        const double t = 1e3 * (double)k / scan->update_rate_hz;
        failure_point(sink, "height", t, scan->height[k]);
        if (!isnan(cycle)) {
            failure_point(sink, "cycle", t, cycle + scan->crossed[k]);
        }
    }
}

void failure_draw_cycles(const failure_sink *sink, const study_scan *scan, size_t step) {
    for (size_t k = 0; k <= scan->ticks; k += step) {
        failure_point(sink, "cycles crossed", (double)k / scan->update_rate_hz, scan->crossed[k]);
        failure_point(sink, "cycles played", (double)k / scan->update_rate_hz, scan->played[k]);
    }
}

int failure_across(int32_t method, double f, size_t ticks, study_scan *scan) {
    static const double start[2] = {FAILURE_START, 0.0};
    const knurl_grating grating = gratings_make(method, 1000.0, 0.0);
    const double velocity[2] = {f / 1000.0, 0.0};
    return gratings_scan_line(&grating, start, velocity, ticks, scan);
}
