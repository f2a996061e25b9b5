/* The mean profile across regular ridges. SPDX-License-Identifier: MIT */
#include "ridges.h"

#include <math.h>
#include <string.h>

#define HARMONICS 8
#define PLACES    256
#define TURN      6.283185307179586

/* Fourier coefficients at the multiples of the ridges' frequency, of a field in a Hann window. */
static void find_coefficients(const field *f, const float *samples, const double frequency[2],
                              double found[HARMONICS][2]) {
    double weights = 0.0, mean = 0.0, window[HARMONICS][2];
    memset(found, 0, HARMONICS * sizeof *found);
    memset(window, 0, sizeof window);
    for (uint32_t y = 0; y < f->height; y++) {
        const double weight_y = 1.0 - cos(TURN * (y + 0.5) / f->height);
        for (uint32_t x = 0; x < f->width; x++) {
            const double weight = weight_y * (1.0 - cos(TURN * (x + 0.5) / f->width));
            const double at = (double)samples[(size_t)y * f->stride + x];
            const double phase = TURN * (frequency[0] * x + frequency[1] * y);
            const double c = cos(phase), s = sin(phase);
            double power[2] = {c, s}; /* of the harmonic */
            weights += weight;
            mean += weight * at;
            for (int h = 0; h < HARMONICS; h++) {
                found[h][0] += weight * at * power[0];
                found[h][1] += weight * at * power[1];
                window[h][0] += weight * power[0];
                window[h][1] += weight * power[1];
                const double next = power[0] * c - power[1] * s;
                power[1] = power[0] * s + power[1] * c;
                power[0] = next;
            }
        }
    }
    for (int h = 0; h < HARMONICS; h++) {
        for (int i = 0; i < 2; i++) {
            found[h][i] = 2.0 * (found[h][i] - mean / weights * window[h][i]) / weights;
        }
    }
}

/* Height = the integral of the slope along the frequency's direction, of `per_unit` cycles per unit of length. */
static void integrate(double slope[HARMONICS][2], double per_unit) {
    for (int h = 0; h < HARMONICS; h++) {
        const double scale = 1.0 / (TURN * (h + 1) * per_unit);
        const double cosine = -slope[h][1] * scale;
        slope[h][1] = slope[h][0] * scale;
        slope[h][0] = cosine;
    }
}

static void combine(double right[HARMONICS][2], double down[HARMONICS][2], const double across[2],
                    double found[HARMONICS][2]) {
    const double length = hypot(across[0], across[1]);
    for (int h = 0; h < HARMONICS; h++) {
        for (int i = 0; i < 2; i++) {
            found[h][i] = (right[h][i] * across[0] + down[h][i] * across[1]) / length;
        }
    }
}

/* The slope across the ridges, integrated. Files whose green runs down instead of up are told by their ridges: a
 * surface slopes across them only. */
static void find_heights(const field *f, const double frequency[2], const double sample[2],
                         double found[HARMONICS][2]) {
    const double across[2] = {frequency[0] / sample[0], frequency[1] / sample[1]};
    const double mirrored[2] = {across[0], -across[1]};
    double right[HARMONICS][2], down[HARMONICS][2], other[HARMONICS][2];
    find_coefficients(f, f->right, frequency, right);
    find_coefficients(f, f->down, frequency, down);
    combine(right, down, across, found);
    combine(right, down, mirrored, other);
    if (hypot(other[0][0], other[0][1]) > 1.01 * hypot(found[0][0], found[0][1])) {
        memcpy(found, other, sizeof other);
    }
    integrate(found, hypot(across[0], across[1]));
}

/* A sample that is a mean over its square has sinc(f) of the amplitude. */
static double box_of(double frequency) {
    const double half = 0.5 * TURN * fabs(frequency);
    return half > 1e-6 ? sin(half) / half : 1.0;
}

void ridges_profile(const field *from, const double frequency[2], const double sample[2], int is_averaged,
                    profile *found) {
    double harmonics[HARMONICS][2];
    if (from->down) {
        find_heights(from, frequency, sample, harmonics);
    } else {
        find_coefficients(from, from->right, frequency, harmonics);
    }
    double low = 0.0, high = 0.0;
    found->crest = 0.0;
    for (int i = 0; i < PLACES; i++) {
        double height = 0.0;
        for (int h = 0; h < HARMONICS; h++) {
            const double f[2] = {(h + 1) * frequency[0], (h + 1) * frequency[1]};
            if (fabs(f[0]) < 0.45 && fabs(f[1]) < 0.45) { /* above that, it would be counted twice */
                const double phase = TURN * (h + 1) * i / PLACES;
                const double box = is_averaged ? box_of(f[0]) * box_of(f[1]) : 1.0;
                height += (harmonics[h][0] * cos(phase) + harmonics[h][1] * sin(phase)) / box;
            }
        }
        if (i == 0 || height > high) {
            high = height;
            found->crest = (double)i / PLACES;
        }
        low = i == 0 || height < low ? height : low;
    }
    found->amplitude = 0.5 * (high - low);
}
