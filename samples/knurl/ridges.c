/* Finds regular ridges: one or two fundamentals whose multiples and sums are the spectrum's peaks.
 * SPDX-License-Identifier: MIT */
#include "ridges.h"

#include "peaks.h"

#include <math.h>
#include <string.h>

#define HARMONIC_MAX 12
#define ABSENT_MAX   6     /* the same for a fundamental that has no peak of its own */
#define ABSENT_GAIN  1.25  /* and it must explain so many times the power that any peak explains */
#define SUPPORT      0.9   /* of the power that the best fundamental explains: enough for a larger one to be taken */
#define SECOND_MIN   0.05  /* of the first axis's power, in the second's */
#define PARALLEL     0.26  /* sine of 15 degrees */
#define EVEN_NONE    0.5   /* evenness without confidence: in half of the picture */
#define EVEN_ALL     0.8   /* evenness of full confidence: ridges in noise are no evener */
#define RIGHT_ANGLE  0.05  /* cosine of 87 degrees */
#define FLAT         1e-4  /* less variation, of black to white or of a slope of 1, is rounding */
#define SHARE_HALF   0.004 /* of the variation: half of the confidence */
#define VECTORS_MAX  (PEAKS_MAX * (PEAKS_MAX + 1))

/* Peaks, and the fundamentals that could have made them. */
typedef struct lattice {
    const peak *peaks;
    int peak_count;
    double bin[2];
    double vectors[VECTORS_MAX][2];
    int vector_count;
} lattice;

static double cross(const double a[2], const double b[2]) {
    return a[0] * b[1] - a[1] * b[0];
}

static double dot(const double a[2], const double b[2]) {
    return a[0] * b[0] + a[1] * b[1];
}

/* The whole multiple of a fundamental that is nearest to a frequency; 0 if it is not near. */
static double find_multiple(const lattice *l, const double fundamental[2], const double f[2]) {
    const double times = round(dot(f, fundamental) / dot(fundamental, fundamental));
    const double off_x = f[0] - times * fundamental[0], off_y = f[1] - times * fundamental[1];
    const double spacing = hypot(fundamental[0] / l->bin[0], fundamental[1] / l->bin[1]);
    const double room = fmin(0.3 + 0.1 * fabs(times), 0.2 * spacing); /* bins: the fundamental's error is multiplied */
    return fabs(times) <= HARMONIC_MAX && hypot(off_x / l->bin[0], off_y / l->bin[1]) <= room ? times : 0.0;
}

/* The peaks' power that a fundamental explains. One without a peak of its own needs two low harmonics. */
static double explain(const lattice *l, int vector) {
    int low = 0;
    double power = 0.0;
    for (int i = 0; i < l->peak_count; i++) {
        const double times = find_multiple(l, l->vectors[vector], l->peaks[i].frequency);
        power += times != 0.0 ? l->peaks[i].power : 0.0;
        low += times != 0.0 && fabs(times) <= ABSENT_MAX;
    }
    return vector < l->peak_count ? power : low >= 2 ? power / ABSENT_GAIN : 0.0;
}

/* Peaks, and the differences between two, which hold a fundamental that has no peak of its own. */
static void collect_vectors(lattice *l) {
    for (int i = 0; i < l->peak_count; i++) {
        memcpy(l->vectors[l->vector_count++], l->peaks[i].frequency, sizeof l->vectors[0]);
    }
    for (int i = 0; i < l->peak_count; i++) {
        for (int k = 0; k < i; k++) {
            const double *f = l->peaks[i].frequency, *g = l->peaks[k].frequency;
            double *v = l->vectors[l->vector_count];
            v[0] = f[0] - g[0];
            v[1] = f[1] - g[1];
            l->vector_count += hypot(v[0] / l->bin[0], v[1] / l->bin[1]) >= PEAKS_PERIODS_MIN - 0.5;
        }
    }
}

static int is_parallel(const double a[2], const double b[2]) {
    return fabs(cross(a, b)) < PARALLEL * sqrt(dot(a, a) * dot(b, b));
}

/* The longest vector that explains nearly as much as the best, and more than `least`; -1: no such vector. first: the
 * axis that it must not be along, or null. */
static int find_axis(const lattice *l, const double *first, double least) {
    double best = least, longest = 0.0;
    int found = -1;
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < l->vector_count; i++) {
            const double *v = l->vectors[i];
            const double power = first && is_parallel(first, v) ? 0.0 : explain(l, i);
            const double length = dot(v, v) * (i < l->peak_count ? 1.02 : 1.0); /* its own is exact */
            if (pass == 0) {
                best = fmax(best, power);
            } else if (power > least && power >= SUPPORT * best && length > longest) {
                longest = length;
                found = i;
            }
        }
    }
    return found;
}

static double cosine(const double a[2], const double b[2]) {
    return fabs(dot(a, b)) / sqrt(dot(a, a) * dot(b, b));
}

/* The sum of both axes can be stronger than the second itself. If the difference is at right angles to the first, it is
 * the grid's other axis. */
static void straighten(const double first[2], double second[2]) {
    const double times = round(dot(first, second) / dot(first, first));
    const double other[2] = {second[0] - times * first[0], second[1] - times * first[1]};
    if (times != 0.0 && cosine(first, other) < RIGHT_ANGLE) {
        second[0] = other[0];
        second[1] = other[1];
    }
}

/* The fundamental from all its harmonics, by least squares: a harmonic's place is as many times as exact. */
static void refine(const lattice *l, double fundamental[2]) {
    double sum[2] = {0.0, 0.0}, weight = 0.0;
    for (int i = 0; i < l->peak_count; i++) {
        const double *f = l->peaks[i].frequency;
        const double times = find_multiple(l, fundamental, f), w = fmin(l->peaks[i].height, 1e4);
        sum[0] += w * times * f[0];
        sum[1] += w * times * f[1];
        weight += w * times * times;
    }
    if (weight > 0.0) {
        fundamental[0] = sum[0] / weight;
        fundamental[1] = sum[1] / weight;
    }
}

/* Power within two bins of a frequency, without the noise around it. */
static double power_at(const spectrum *s, const double f[2]) {
    int place[2];
    spectrum_climb(s, f, 1.0, place);
    const double noise = spectrum_floor(s, place[0], place[1]);
    const int reach[2] = {(int)lround(2.0 * s->bin[0] * s->width), (int)lround(2.0 * s->bin[1] * s->height)};
    double power = 0.0;
    for (int dy = -reach[1]; dy <= reach[1]; dy++) {
        for (int dx = -reach[0]; dx <= reach[0]; dx++) {
            power += spectrum_at(s, place[0] + dx, place[1] + dy) - 1.44 * noise; /* mean over median */
        }
    }
    return fmax(0.0, power);
}

/* Share of the variation in a fundamental and its harmonics. */
static double find_share(const spectrum *s, const double fundamental[2]) {
    double all = 0.0, comb = 0.0;
    for (size_t i = 0; i < (size_t)s->width * (size_t)s->height; i++) {
        all += (double)s->power[i];
    }
    for (int times = 1; times <= HARMONIC_MAX; times++) {
        const double f[2] = {times * fundamental[0], times * fundamental[1]};
        if (fabs(f[0]) < 0.48 && fabs(f[1]) < 0.48) {
            comb += 2.0 * power_at(s, f);
        }
    }
    return all > 0.0 ? fmin(1.0, comb / all) : 0.0;
}

static double evenness_of(const lattice *l, const double fundamental[2]) {
    double most = 0.0;
    for (int i = 0; i < l->peak_count; i++) {
        if (find_multiple(l, fundamental, l->peaks[i].frequency) != 0.0) {
            most = fmax(most, l->peaks[i].evenness);
        }
    }
    return most;
}

static void take_axis(const lattice *l, const spectrum *s, int vector, int axis, ridges *found) {
    double *f = found->frequency[axis];
    memcpy(f, l->vectors[vector], sizeof found->frequency[0]);
    refine(l, f);
    if (axis > 0) {
        straighten(found->frequency[0], f);
    }
    if (f[0] < 0.0 || (f[0] == 0.0 && f[1] < 0.0)) {
        f[0] = -f[0];
        f[1] = -f[1];
    }
    found->share[axis] = find_share(s, f);
    found->evenness[axis] = evenness_of(l, f);
    found->count = axis + 1;
}

int ridges_find(const field *from, ridges *found) {
    spectrum whole;
    peak peaks[PEAKS_MAX];
    lattice l;
    memset(found, 0, sizeof *found);
    memset(&l, 0, sizeof l);
    if (!spectrum_make(from, &whole)) {
        return 0;
    }
    l.peaks = peaks;
    l.peak_count = whole.variance > FLAT * FLAT ? peaks_find(from, &whole, peaks) : 0;
    memcpy(l.bin, whole.bin, sizeof l.bin);
    if (l.peak_count > 0) {
        collect_vectors(&l);
    }
    const int first = find_axis(&l, NULL, 0.0);
    if (first >= 0) {
        take_axis(&l, &whole, first, 0, found);
        const int second = find_axis(&l, found->frequency[0], SECOND_MIN * explain(&l, first));
        if (second >= 0) {
            take_axis(&l, &whole, second, 1, found);
        }
        found->confidence = fmax(0.0, fmin(1.0, (found->evenness[0] - EVEN_NONE) / (EVEN_ALL - EVEN_NONE))) *
                            found->share[0] / (found->share[0] + SHARE_HALF);
    }
    spectrum_free(&whole);
    return l.peak_count >= 0;
}
