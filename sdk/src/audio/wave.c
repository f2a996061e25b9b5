/* The height map as a signal. Means of eighths of a sample alias little: the harmonics of a 1 kHz square wave within 20
 * kHz of 384 kHz, which would fold back, are 70 dB below its fundamental. SPDX-License-Identifier: MIT */
#include "audio/wave.h"

#include "base/finite.h"

#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846

/* The low pass's edges: 16 and 28 kHz at 48 kHz, relative to the eight times higher rate. Frequencies passed above 24
 * kHz fold back above 20 kHz. */
#define PASSED  (16.0 / 384.0)
#define STOPPED (28.0 / 384.0)
#define STOP_DB 70.0

#define HIGH_PASS_HZ 20.0
#define SILENCE      1e-6 /* 120 dB below full scale */

/* The fraction of the distance, 0 to 1, at which the sign of cos(2 pi p) changes; 1 if it does not. */
static double crossing(double from, double to) {
    const double half = floor(2.0 * from + 0.5);
    const double next = floor(2.0 * to + 0.5);
    if (half == next) {
        return 1.0;
    }
    const double edge = 0.5 * (half > next ? half : next) - 0.25;
    return (edge - from) / (to - from);
}

static int is_first_half(double phase) {
    return phase - floor(phase) < 0.5;
}

double knurl_wave_mean(const double from[2], const double to[2]) {
    if (!(fabs(to[0] - from[0]) < 0.5 && fabs(to[1] - from[1]) < 0.5)) {
        return 0.0;
    }
    const double sign = is_first_half(from[0] + 0.25) == is_first_half(from[1] + 0.25) ? 1.0 : -1.0;
    return sign * (1.0 - 2.0 * fabs(crossing(from[0], to[0]) - crossing(from[1], to[1])));
}

/* By its series. */
double knurl_wave_bessel(double x) {
    double term = 1.0;
    double sum = 1.0;
    for (int k = 1; k < 40; k++) {
        term *= 0.25 * x * x / (k * k);
        sum += term;
    }
    return sum;
}

/* A sinc with a Kaiser window. */
void knurl_wave_filter_init(knurl_wave_filter *filter, double sample_rate_hz) {
    const double beta = 0.1102 * (STOP_DB - 8.7);
    const double middle = 0.5 * (KNURL_WAVE_TAPS - 1);
    double sum = 0.0;
    memset(filter, 0, sizeof *filter);
    for (int i = 0; i < KNURL_WAVE_TAPS; i++) {
        const double t = i - middle; /* never 0: the number of taps is even */
        const double edge = t / (middle + 0.5);
        filter->taps[i] = sin(PI * (PASSED + STOPPED) * t) / t * knurl_wave_bessel(beta * sqrt(1.0 - edge * edge));
        sum += filter->taps[i];
    }
    for (int i = 0; i < KNURL_WAVE_TAPS; i++) {
        filter->taps[i] /= sum;
    }
    filter->decay = exp(-2.0 * PI * HIGH_PASS_HZ / sample_rate_hz);
}

void knurl_wave_filter_push(knurl_wave_filter *filter, double mean) {
    filter->history[filter->next] = mean;
    filter->next = filter->next + 1 < KNURL_WAVE_TAPS ? filter->next + 1 : 0;
    filter->equal = mean != filter->latest ? 0 : filter->equal + (filter->equal < KNURL_WAVE_TAPS);
    filter->latest = mean;
}

static double low_pass(const knurl_wave_filter *filter) {
    double sum = 0.0;
    uint32_t at = filter->next; /* the oldest; the taps are symmetric */
    for (uint32_t i = 0; i < KNURL_WAVE_TAPS; i++) {
        sum += filter->taps[i] * filter->history[at];
        at = at + 1 < KNURL_WAVE_TAPS ? at + 1 : 0;
    }
    return sum;
}

double knurl_wave_filter_pull(knurl_wave_filter *filter) {
    const double input = filter->equal < KNURL_WAVE_TAPS ? low_pass(filter) : filter->latest;
    filter->output = filter->decay * filter->output + input - filter->before;
    filter->before = input;
    if (fabs(filter->output) < SILENCE) {
        filter->output = 0.0;
    }
    return filter->output;
}
