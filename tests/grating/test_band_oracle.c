/* Bandlimited against another kind of computation: an ideal square wave along a random path, simulated finely and
 * resampled at the ticks by a linear filter that passes to 0.38 f_h and nothing from f_h/2 on. KNURL_LONG: 1e5 paths.
 * SPDX-License-Identifier: MIT */
#include "support/bandlimited.h"

#include <stdlib.h>

#define FINE   24 /* steps a tick */
#define REACH  40 /* ticks of the filter to either side */
#define TAPS   (2 * REACH * FINE)
#define PI     3.141592653589793
#define RATE   1000.0
#define WITHIN 0.006L /* A: the filter is truncated at its REACH, and a path's speed changes within it */

static double taps[TAPS];

/* The filter's response in time, from its response in frequency: 2 times the integral of W(f) cos(2 pi f t). */
static void make_taps(void) {
    double sum = 0.0;
    for (int i = 0; i < TAPS; i++) {
        const double t = (i + 0.5) / FINE - REACH;
        double value = 0.0;
        for (int k = 0; k < 1000; k++) {
            const double f = (k + 0.5) * 0.5 / 1000.0;
            value += (1.0 - band_fade(f, 0.38, 0.5)) * cos(2.0 * PI * f * t);
        }
        taps[i] = value * (0.5 + 0.5 * cos(PI * t / REACH));
        sum += taps[i];
    }
    for (int i = 0; i < TAPS; i++) {
        taps[i] /= sum;
    }
}

/* The integral of the square wave of cos(2 pi p), by p. */
static double area(double p) {
    const double q = p + 0.25;
    return fabs(q - floor(q + 0.5));
}

/* A path in cycles along the axis that crosses the most: start, cycles per tick, and their change per tick. */
typedef struct way {
    double start, d, change;
} way;

static double cycles_at(const way *w, double tick) {
    return w->start + w->d * tick + 0.5 * w->change * tick * tick;
}

static double resample(const way *w) {
    double height = 0.0;
    double before = cycles_at(w, -(double)REACH);
    for (int i = 0; i < TAPS; i++) {
        const double next = cycles_at(w, (i + 1.0) / FINE - REACH);
        height += taps[i] * (area(next) - area(before)) / (next - before);
        before = next;
    }
    return height;
}

/* Lines along x or y, and grids that are crossed more often along one axis; in either direction, from the tick at -3 to
 * 0. */
static void check_way(uint64_t *seed) {
    const int axis = random_bits(seed) >> 20 & 1, grid = random_bits(seed) >> 20 & 1;
    const double sign = random_bits(seed) >> 20 & 1 ? 1.0 : -1.0;
    const way w = {random_between(seed, -5.0, 5.0), random_between(seed, 0.0875, 0.37),
                   random_between(seed, -2e-5, 2e-5)};
    const double fs = random_between(seed, 200.0, 3000.0), other = grid ? random_between(seed, 200.0, 3000.0) : 0.0;
    const double slant = grid ? random_between(seed, -0.85, 0.85) * fs / other : random_between(seed, -2.0, 2.0);
    band_scan s = axis ? band_on(other, fs, RATE, 0.0) : band_on(fs, other, RATE, 0.0);
    for (int k = -3; k <= 0; k++) {
        const double x = sign * cycles_at(&w, k) / fs, v = sign * (w.d + w.change * k) * RATE / fs;
        const double place[2] = {axis ? slant * x : x, axis ? x : slant * x};
        (void)band_step(&s, place, axis ? slant * v : v, axis ? v : slant * v);
    }
    CHECK_CLOSE(s.out.height, resample(&w), WITHIN);
}

TEST(along_random_ways_it_is_the_square_wave_resampled) {
    uint64_t seed = 12;
    const int ways = getenv("KNURL_LONG") ? 100000 : 2000;
    make_taps();
    for (int i = 0; i < ways; i++) {
        check_way(&seed);
    }
}
