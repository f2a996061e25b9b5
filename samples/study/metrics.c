/* Metrics of held periodic signals. SPDX-License-Identifier: MIT */
#include "metrics.h"

#include <kiss_fft.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.141592653589793

static size_t gcd(size_t a, size_t b) {
    while (b > 0) {
        const size_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

size_t study_whole_ticks(double period_ticks) {
    for (size_t cycles = 1; (double)cycles * period_ticks <= STUDY_MAX_PERIOD; cycles++) {
        const double ticks = (double)cycles * period_ticks;
        const double whole = floor(ticks + 0.5);
        if (fabs(ticks - whole) <= 1e-9 * ticks) {
            return (size_t)whole;
        }
    }
    return 0;
}

static size_t actual_period(const knurl_wave *wave) {
    if (wave->method == KNURL_WAVE_T1) {
        return study_whole_ticks(wave->period_ticks);
    }
    size_t period = 1;
    for (int32_t i = 0; i < wave->part_count; i++) {
        const size_t part = (size_t)wave->parts[i].length;
        period = period / gcd(period, part) * part;
    }
    return period <= STUDY_MAX_PERIOD ? period : 0;
}

int study_signal_of_wave(const knurl_wave *wave, double update_rate_hz, study_signal *signal) {
    memset(signal, 0, sizeof *signal);
    signal->update_rate_hz = update_rate_hz;
    signal->length = actual_period(wave);
    signal->values = signal->length > 0 ? malloc(signal->length * sizeof *signal->values) : NULL;
    for (size_t i = 0; signal->values && i < signal->length; i++) {
        signal->values[i] = knurl_wave_value(wave, i);
    }
    return signal->values != NULL;
}

int study_signal_of_values(const double *values, size_t length, double update_rate_hz, study_signal *signal) {
    memset(signal, 0, sizeof *signal);
    signal->update_rate_hz = update_rate_hz;
    signal->length = length;
    signal->values = length > 0 ? malloc(length * sizeof *signal->values) : NULL;
    if (signal->values) {
        memcpy(signal->values, values, length * sizeof *signal->values);
    }
    return signal->values != NULL;
}

void study_signal_free(study_signal *signal) {
    free(signal->values);
    memset(signal, 0, sizeof *signal);
}

double study_net(const study_signal *signal) {
    double sum = 0.0;
    for (size_t i = 0; i < signal->length; i++) {
        sum += signal->values[i];
    }
    return sum / (double)signal->length;
}

double study_rms(const study_signal *signal) {
    double sum = 0.0;
    for (size_t i = 0; i < signal->length; i++) {
        sum += signal->values[i] * signal->values[i];
    }
    return sqrt(sum / (double)signal->length);
}

/* sin(pi x)/(pi x) */
static double sinc(double x) {
    return x == 0.0 ? 1.0 : sin(PI * x) / (PI * x);
}

double study_line_amplitude(const study_signal *signal, size_t line) {
    const size_t n = signal->length;
    double re = 0.0;
    double im = 0.0;
    for (size_t i = 0; i < n; i++) {
        const double angle = 2.0 * PI * (double)(line % n * i % n) / (double)n;
        re += signal->values[i] * cos(angle);
        im -= signal->values[i] * sin(angle);
    }
    return 2.0 * hypot(re, im) / (double)n * fabs(sinc((double)line / (double)n));
}

double *study_magnitudes(const study_signal *signal) {
    const size_t n = signal->length;
    kiss_fft_cfg plan = kiss_fft_alloc((int)n, 0, NULL, NULL);
    kiss_fft_cpx *in = malloc(n * sizeof *in);
    kiss_fft_cpx *out = malloc(n * sizeof *out);
    double *bins = malloc(n * sizeof *bins);
    if (plan && in && out && bins) {
        for (size_t i = 0; i < n; i++) {
            in[i].r = (kiss_fft_scalar)signal->values[i];
            in[i].i = 0;
        }
        kiss_fft(plan, in, out);
        for (size_t k = 0; k < n; k++) {
            bins[k] = hypot((double)out[k].r, (double)out[k].i) / (double)n;
        }
    } else {
        free(bins);
        bins = NULL;
    }
    free(out);
    free(in);
    kiss_fft_free(plan);
    return bins;
}

int study_dominant(const study_signal *signal, study_line *line) {
    double *bins = study_magnitudes(signal);
    size_t best_line = 1;
    double best = 0.0;
    for (size_t k = 1; bins && k <= signal->length / 2; k++) {
        const double held = bins[k] * sinc((double)k / (double)signal->length);
        if (held > best * (1.0 + 1e-5)) {
            best = held;
            best_line = k;
        }
    }
    line->amplitude = study_line_amplitude(signal, best_line);
    line->frequency = (double)best_line * signal->update_rate_hz / (double)signal->length;
    const int done = bins != NULL;
    free(bins);
    return done;
}

double study_pcc(const study_signal *a, const study_signal *b) {
    const size_t common = gcd(a->length, b->length);
    const double mean_a = study_net(a);
    const double mean_b = study_net(b);
    double ab = 0.0;
    double aa = 0.0;
    double bb = 0.0;
    if (a->length / common > STUDY_MAX_PERIOD * (size_t)1000 / b->length) {
        return NAN;
    }
    for (size_t i = 0; i < a->length / common * b->length; i++) {
        const double x = a->values[i % a->length] - mean_a;
        const double y = b->values[i % b->length] - mean_b;
        ab += x * y;
        aa += x * x;
        bb += y * y;
    }
    return aa > 0.0 && bb > 0.0 ? ab / sqrt(aa * bb) : NAN;
}

double study_spurious(const study_signal *signal, double frequency) {
    const double net = study_net(signal);
    const double rms = study_rms(signal);
    const double power = rms * rms - net * net;
    const double cycles = frequency / signal->update_rate_hz * (double)signal->length; /* in the actual period */
    const double fundamental = floor(cycles + 0.5);
    if (!(power > 0.0)) {
        return NAN;
    }
    if (fundamental < 1.0 || fabs(cycles - fundamental) > 1e-6 * cycles) {
        return 1.0; /* the period is not a whole number of true cycles: no line is at the true frequency */
    }
    double *bins = study_magnitudes(signal);
    double true_power = 0.0;
    for (size_t q = 1; bins && q <= 20001; q += 2) { /* above f_h/2: the hold's images at a square wave's harmonics */
        const size_t line = q * (size_t)fundamental;
        const double held = 2.0 * bins[line % signal->length] * sinc((double)line / (double)signal->length);
        true_power += 0.5 * held * held;
    }
    const double spurious = bins ? fmax(0.0, 1.0 - true_power / power) : NAN;
    free(bins);
    return spurious;
}
