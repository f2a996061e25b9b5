/* The power spectrum of a field in the plane. SPDX-License-Identifier: MIT */
#include "spectrum.h"

#include <kiss_fftnd.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define TERMS 6 /* of a quadratic in x and y */

static void powers_of(double x, double y, double terms[TERMS]) {
    terms[0] = 1.0;
    terms[1] = x;
    terms[2] = y;
    terms[3] = x * x;
    terms[4] = x * y;
    terms[5] = y * y;
}

/* Solves the normal equations, which are positive definite, by elimination. */
static void solve(double matrix[TERMS][TERMS + 1], double out[TERMS]) {
    for (int i = 0; i < TERMS; i++) {
        for (int row = i + 1; row < TERMS; row++) {
            const double times = matrix[row][i] / matrix[i][i];
            for (int k = i; k <= TERMS; k++) {
                matrix[row][k] -= times * matrix[i][k];
            }
        }
    }
    for (int i = TERMS - 1; i >= 0; i--) {
        out[i] = matrix[i][TERMS];
        for (int k = i + 1; k < TERMS; k++) {
            out[i] -= matrix[i][k] * out[k];
        }
        out[i] /= matrix[i][i];
    }
}

/* The quadratic that fits the samples best: light that falls off, a bent page. x and y run from -1 to 1. */
static void fit_trend(const field *f, const float *samples, double trend[TERMS]) {
    double matrix[TERMS][TERMS + 1];
    memset(matrix, 0, sizeof matrix);
    for (uint32_t y = 0; y < f->height; y++) { /* all of them: every tenth would alias the ridges */
        for (uint32_t x = 0; x < f->width; x++) {
            double terms[TERMS];
            powers_of(2.0 * x / f->width - 1.0, 2.0 * y / f->height - 1.0, terms);
            for (int i = 0; i < TERMS; i++) {
                for (int k = 0; k < TERMS; k++) {
                    matrix[i][k] += terms[i] * terms[k];
                }
                matrix[i][TERMS] += terms[i] * (double)samples[(size_t)y * f->stride + x];
            }
        }
    }
    solve(matrix, trend);
}

/* Puts the samples less the trend, in the window, into the real or the imaginary parts. */
static void put_samples(const field *f, const float *samples, kiss_fft_cpx *table, int width, int imaginary) {
    double trend[TERMS];
    fit_trend(f, samples, trend);
    for (uint32_t y = 0; y < f->height; y++) {
        const double window_y = 0.5 - 0.5 * cos(6.283185307179586 * (y + 0.5) / f->height);
        for (uint32_t x = 0; x < f->width; x++) {
            double terms[TERMS];
            double rest = (double)samples[(size_t)y * f->stride + x];
            powers_of(2.0 * x / f->width - 1.0, 2.0 * y / f->height - 1.0, terms);
            for (int i = 0; i < TERMS; i++) {
                rest -= trend[i] * terms[i];
            }
            const double window_x = 0.5 - 0.5 * cos(6.283185307179586 * (x + 0.5) / f->width);
            kiss_fft_cpx *at = &table[(size_t)y * (size_t)width + x];
            *(imaginary ? &at->i : &at->r) = (kiss_fft_scalar)(rest * window_x * window_y);
        }
    }
}

static int power_of_two(uint32_t least) {
    int size = 64;
    while ((uint32_t)size < least) {
        size *= 2;
    }
    return size;
}

/* The sum of both fields' powers: with z = right + i down, |Right|^2 + |Down|^2 = (|Z(k)|^2 + |Z(-k)|^2) / 2. */
static void add_powers(const kiss_fft_cpx *z, spectrum *made) {
    for (int y = 0; y < made->height; y++) {
        for (int x = 0; x < made->width; x++) {
            const kiss_fft_cpx one = z[(size_t)y * (size_t)made->width + (size_t)x];
            const int opposite_y = (made->height - y) % made->height, opposite_x = (made->width - x) % made->width;
            const kiss_fft_cpx other = z[(size_t)opposite_y * (size_t)made->width + (size_t)opposite_x];
            made->power[(size_t)y * (size_t)made->width + (size_t)x] =
                0.5F * (one.r * one.r + one.i * one.i + other.r * other.r + other.i * other.i);
        }
    }
}

/* Before the transform. The mean square of the window is (3/8)^2. */
static double variance_of(const field *f, const kiss_fft_cpx *table, size_t places) {
    double sum = 0.0;
    for (size_t i = 0; i < places; i++) {
        sum += (double)(table[i].r * table[i].r + table[i].i * table[i].i);
    }
    return sum / (0.140625 * f->width * f->height);
}

int spectrum_make(const field *from, spectrum *made) {
    const int size[2] = {power_of_two(from->height), power_of_two(from->width)};
    const size_t places = (size_t)size[0] * (size_t)size[1];
    kiss_fft_cpx *in = calloc(places, sizeof *in);
    kiss_fft_cpx *out = malloc(places * sizeof *out);
    kiss_fftnd_cfg plan = kiss_fftnd_alloc(size, 2, 0, NULL, NULL);
    made->width = size[1];
    made->height = size[0];
    made->bin[0] = 1.0 / from->width;
    made->bin[1] = 1.0 / from->height;
    made->power = malloc(places * sizeof *made->power);
    const int ok = in && out && plan && made->power;
    if (ok) {
        put_samples(from, from->right, in, made->width, 0);
        if (from->down) {
            put_samples(from, from->down, in, made->width, 1);
        }
        made->variance = variance_of(from, in, places);
        kiss_fftnd(plan, in, out);
        add_powers(out, made);
    } else {
        spectrum_free(made);
    }
    kiss_fft_free(plan);
    free(in);
    free(out);
    return ok;
}

void spectrum_free(spectrum *s) {
    free(s->power);
    s->power = NULL;
}

double spectrum_at(const spectrum *s, int x, int y) {
    x = (x % s->width + s->width) % s->width;
    y = (y % s->height + s->height) % s->height;
    return (double)s->power[(size_t)y * (size_t)s->width + (size_t)x];
}

static int compare(const void *a, const void *b) {
    const double left = *(const double *)a;
    const double right = *(const double *)b;
    return (left > right) - (left < right);
}

#define HALF 12 /* places to either side */

/* Of the frequency. */
static double square_of(const spectrum *s, int x, int y) {
    const double fx = (double)x / s->width, fy = (double)y / s->height;
    return fx * fx + fy * fy;
}

double spectrum_floor(const spectrum *s, int x, int y) {
    double around[(2 * HALF + 1) * (2 * HALF + 1)];
    size_t count = 0;
    const int half_x = abs(x) / 2 < 4 ? 4 : abs(x) / 2 < HALF ? abs(x) / 2 : HALF;
    const int half_y = abs(y) / 2 < 4 ? 4 : abs(y) / 2 < HALF ? abs(y) / 2 : HALF;
    const int half = half_x > half_y ? half_x : half_y; /* smaller near 0: the power falls fast there */
    const double middle = square_of(s, x, y) + 1e-30;   /* pictures without a pattern have power as 1 / frequency^2 */
    const double lobe[2] = {2.5 * s->bin[0] * s->width, 2.5 * s->bin[1] * s->height};
    for (int dy = -half; dy <= half; dy++) {
        for (int dx = -half; dx <= half; dx++) {
            const int in_peak = abs(dx) <= lobe[0] && abs(dy) <= lobe[1];
            const int in_trend = abs(x + dx) <= lobe[0] && abs(y + dy) <= lobe[1];
            if (!in_peak && !in_trend) {
                around[count++] = spectrum_at(s, x + dx, y + dy) * (square_of(s, x + dx, y + dy) / middle);
            }
        }
    }
    qsort(around, count, sizeof *around, compare);
    return count ? around[count / 2] : 0.0;
}

void spectrum_climb(const spectrum *s, const double frequency[2], double reach, int place[2]) {
    const double x = frequency[0] * s->width, y = frequency[1] * s->height;
    const int reach_x = (int)ceil(reach * s->bin[0] * s->width), reach_y = (int)ceil(reach * s->bin[1] * s->height);
    const int middle[2] = {(int)lround(x), (int)lround(y)};
    place[0] = middle[0];
    place[1] = middle[1];
    for (int dy = -reach_y; dy <= reach_y; dy++) {
        for (int dx = -reach_x; dx <= reach_x; dx++) {
            if (spectrum_at(s, middle[0] + dx, middle[1] + dy) > spectrum_at(s, place[0], place[1])) {
                place[0] = middle[0] + dx;
                place[1] = middle[1] + dy;
            }
        }
    }
}

static double vertex(double before, double at, double after) {
    const double tiny = 1e-30;
    const double left = log(before + tiny), middle = log(at + tiny), right = log(after + tiny);
    const double bend = left - 2.0 * middle + right;
    return bend < 0.0 ? fmax(-0.5, fmin(0.5, 0.5 * (left - right) / bend)) : 0.0;
}

void spectrum_refine(const spectrum *s, const int place[2], double frequency[2]) {
    const int x = place[0], y = place[1];
    const double at = spectrum_at(s, x, y);
    frequency[0] = (x + vertex(spectrum_at(s, x - 1, y), at, spectrum_at(s, x + 1, y))) / s->width;
    frequency[1] = (y + vertex(spectrum_at(s, x, y - 1), at, spectrum_at(s, x, y + 1))) / s->height;
}
