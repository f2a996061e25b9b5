/* Metrics of steady scans. SPDX-License-Identifier: MIT */
#include "steady.h"

#include "grating_metrics.h"
#include "lab.h"
#include "metrics.h"

#include <math.h>
#include <stdlib.h>

#define PI      3.141592653589793
#define PUSH_S  0.05
#define SHORT_S 0.012
#define LONG_S  0.05
#define LEAST   8.0 /* Hz: lower frequencies are a press, not a vibration */

void steady_line(const double *heights, size_t ticks, double rate, double frequency, double line[2]) {
    line[0] = 0.0;
    line[1] = 0.0;
    for (size_t k = 0; k < ticks; k++) {
        const double angle = 2.0 * PI * fmod(frequency * (double)k / rate, 1.0);
        line[0] += 2.0 * heights[k] * cos(angle) / (double)ticks;
        line[1] += 2.0 * heights[k] * sin(angle) / (double)ticks;
    }
}

/* m of motion per N. */
static double motion(double hz) {
    const double w = 2.0 * PI * hz;
    return 1.0 / hypot(700.0 - 0.045 * w * w, 5.5 * w);
}

double steady_felt_weight(double hz) {
    const double over = hz / 250.0;
    const double threshold = hz < 40.0 ? 250.0 / 40.0 * (250.0 / 40.0) : fmax(1.0 / (over * over), over * over);
    return hz > LEAST ? motion(hz) / threshold : 0.0;
}

/* Wavering of the rms in windows that advance by one tick. */
static double find_wavering(const double *heights, size_t ticks, double window_ticks) {
    const size_t window = (size_t)fmax(1.0, floor(window_ticks + 0.5));
    double power = 0.0;
    double sum = 0.0;
    double squares = 0.0;
    double count = 0.0;
    for (size_t k = 0; k < ticks; k++) {
        power += heights[k] * heights[k];
        power -= k >= window ? heights[k - window] * heights[k - window] : 0.0;
        if (k + 1 >= window) {
            const double square = fmax(0.0, power / (double)window);
            sum += sqrt(square);
            squares += square;
            count += 1.0;
        }
    }
    return count > 0.0 && sum > 0.0 ? sqrt(fmax(0.0, squares / count - sum / count * (sum / count))) / (sum / count)
                                    : 0.0;
}

/* Lines 0 to ticks - 1 of the heights less their mean, through Hann's window, so that a line between two bins stays
 * near them. Null: out of memory. */
static double *find_spectrum(const double *heights, size_t ticks, double rate, double *mean) {
    double *windowed = malloc(ticks * sizeof *windowed);
    study_signal signal;
    double *bins = NULL;
    double sum = 0.0;
    double weights = 0.0;
    for (size_t k = 0; windowed && k < ticks; k++) {
        windowed[k] = 0.5 - 0.5 * cos(2.0 * PI * ((double)k + 0.5) / (double)ticks);
        sum += windowed[k] * heights[k];
        weights += windowed[k];
    }
    *mean = sum / weights;
    for (size_t k = 0; windowed && k < ticks; k++) {
        windowed[k] *= heights[k] - *mean;
    }
    if (windowed && study_signal_of_values(windowed, ticks, rate, &signal)) {
        bins = study_magnitudes(&signal);
        study_signal_free(&signal);
    }
    free(windowed);
    return bins;
}

/* sin(pi x)/(pi x): attenuation of a line of x cycles per tick by the hold over a tick. */
static double sinc(double x) {
    return sin(PI * x) / (PI * x);
}

/* Between two bins Hann's window gives a line in the ratio (1 + d)/(2 - d), d from the larger to the other. */
static double find_dominant(const double *bins, size_t ticks, double rate) {
    size_t best = 1;
    for (size_t line = 1; line <= ticks / 2; line++) {
        const double step = 1.0 / (double)ticks;
        best = bins[line] * sinc((double)line * step) > bins[best] * sinc((double)best * step) * (1.0 + 1e-5) ? line
                                                                                                              : best;
    }
    const size_t beside = bins[best - 1] > bins[best + 1] ? best - 1 : best + 1;
    const double ratio = bins[best] > 0.0 ? bins[beside] / bins[best] : 0.0;
    const double away = fmax(0.0, (2.0 * ratio - 1.0) / (1.0 + ratio));
    return ((double)best + (beside > best ? away : -away)) * rate / (double)ticks;
}

static int is_ridges(double hz, double frequency) {
    const double order = hz / frequency;
    const double odd = fmax(1.0, 2.0 * floor(0.5 * order) + 1.0);
    return fabs(order - odd) * frequency <= fmax(STEADY_TOLERANCE * frequency, STEADY_TOLERANCE_HZ);
}

/* A constant signal is not a vibration. */
static double share(double far, double all) {
    return all > 0.0 ? far / all : 1.0;
}

static void find_false(const double *bins, size_t ticks, double rate, double frequency, steady_metrics *found) {
    double all[3] = {0.0, 0.0, 0.0};
    double far[3] = {0.0, 0.0, 0.0};
    for (size_t line = 1; line < ticks; line++) {
        const double hz = (double)line * rate / (double)ticks;
        const double height = bins[line];
        const double held = height * sinc((double)line / (double)ticks);
        const double felt = held * steady_felt_weight(hz);
        const double stylus = hz > LEAST ? 1e-6 * held * motion(hz) / lab_threshold(hz) : 0.0;
        const double powers[3] = {line <= ticks / 2 ? height * height : 0.0, felt * felt, stylus * stylus};
        const int own = is_ridges(hz, frequency);
        for (int i = 0; i < 3; i++) {
            all[i] += powers[i];
            far[i] += own ? 0.0 : powers[i];
        }
    }
    found->false_tones = share(far[0], all[0]);
    found->felt_false = share(far[1], all[1]);
    found->felt_stylus = share(far[2], all[2]);
    found->felt_level = sqrt(all[1]);
}

int steady_measure(const double *heights, size_t ticks, double rate, double frequency, steady_metrics *found) {
    double line[2];
    study_scan scan = {.ticks = ticks, .update_rate_hz = rate};
    scan.height = malloc(ticks * sizeof *scan.height);
    found->crest = 0.0;
    for (size_t k = 0; scan.height && k < ticks; k++) {
        scan.height[k] = heights[k];
        found->crest = fmax(found->crest, fabs(heights[k]));
    }
    found->push = scan.height ? study_scan_push(&scan, frequency, PUSH_S) : NAN;
    free(scan.height);
    steady_line(heights, ticks, rate, frequency, line);
    found->level = hypot(line[0], line[1]);
    found->wavering = find_wavering(heights, ticks, SHORT_S * rate);
    found->wavering_50 = find_wavering(heights, ticks, LONG_S * rate);
    double *bins = isnan(found->push) ? NULL : find_spectrum(heights, ticks, rate, &found->mean);
    if (!bins) {
        return 0;
    }
    found->mean = fabs(found->mean);
    found->dominant = find_dominant(bins, ticks, rate);
    find_false(bins, ticks, rate, frequency, found);
    free(bins);
    return 1;
}
