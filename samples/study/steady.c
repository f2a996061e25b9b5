/* Metrics of steady scans. SPDX-License-Identifier: MIT */
#include "steady.h"

#include "grating_metrics.h"
#include "metrics.h"

#include <math.h>
#include <stdlib.h>

#define PI        3.141592653589793
#define PUSH_S    0.05
#define WINDOW_S  0.0125
#define TOLERANCE 0.25

void steady_line(const double *heights, size_t ticks, double rate, double frequency, double line[2]) {
    line[0] = 0.0;
    line[1] = 0.0;
    for (size_t k = 0; k < ticks; k++) {
        const double angle = 2.0 * PI * fmod(frequency * (double)k / rate, 1.0);
        line[0] += 2.0 * heights[k] * cos(angle) / (double)ticks;
        line[1] += 2.0 * heights[k] * sin(angle) / (double)ticks;
    }
}

static double find_unevenness(const double *heights, size_t ticks, double rate) {
    const size_t window = (size_t)fmax(1.0, floor(WINDOW_S * rate + 0.5));
    double sum = 0.0;
    double squares = 0.0;
    double count = 0.0;
    for (size_t begin = 0; begin + window <= ticks; begin += window) {
        double power = 0.0;
        for (size_t k = begin; k < begin + window; k++) {
            power += heights[k] * heights[k];
        }
        const double rms = sqrt(power / (double)window);
        sum += rms;
        squares += rms * rms;
        count += 1.0;
    }
    return count > 0.0 && sum > 0.0 ? sqrt(fmax(0.0, squares / count - sum / count * (sum / count))) / (sum / count)
                                    : 0.0;
}

/* Hann's window, so that a line that is between two bins stays near them. 0: no memory. */
static int find_spurious(const double *heights, size_t ticks, double rate, double frequency, double *share) {
    double *windowed = malloc(ticks * sizeof *windowed);
    study_signal signal;
    double sum = 0.0;
    double weights = 0.0;
    for (size_t k = 0; windowed && k < ticks; k++) {
        windowed[k] = 0.5 - 0.5 * cos(2.0 * PI * ((double)k + 0.5) / (double)ticks);
        sum += windowed[k] * heights[k];
        weights += windowed[k];
    }
    for (size_t k = 0; windowed && k < ticks; k++) {
        windowed[k] *= heights[k] - sum / weights;
    }
    double *bins =
        windowed && study_signal_of_values(windowed, ticks, rate, &signal) ? study_magnitudes(&signal) : NULL;
    double all = 0.0;
    double far = 0.0;
    for (size_t line = 1; bins && line <= ticks / 2; line++) {
        const double order = (double)line * rate / (double)ticks / frequency;
        const double odd = fmax(1.0, 2.0 * floor(0.5 * order) + 1.0);
        all += bins[line] * bins[line];
        far += fabs(order - odd) > TOLERANCE ? bins[line] * bins[line] : 0.0;
    }
    *share = all > 0.0 ? far / all : 1.0; /* what does not vary is no vibration at all */
    const int done = bins != NULL;
    free(bins);
    if (windowed) {
        study_signal_free(&signal);
    }
    free(windowed);
    return done;
}

int steady_measure(const double *heights, size_t ticks, double rate, double frequency, steady_metrics *found) {
    double line[2];
    study_scan scan = {.ticks = ticks, .update_rate_hz = rate};
    scan.height = malloc(ticks * sizeof *scan.height);
    for (size_t k = 0; scan.height && k < ticks; k++) {
        scan.height[k] = heights[k];
    }
    found->push = scan.height ? study_scan_push(&scan, frequency, PUSH_S) : NAN;
    free(scan.height);
    steady_line(heights, ticks, rate, frequency, line);
    found->level = hypot(line[0], line[1]);
    found->unevenness = find_unevenness(heights, ticks, rate);
    return !isnan(found->push) && find_spurious(heights, ticks, rate, frequency, &found->spurious);
}
