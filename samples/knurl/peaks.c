/* Peaks of a picture's spectrum that stand out everywhere in the picture. SPDX-License-Identifier: MIT */
#include "peaks.h"

#include <math.h>
#include <stdlib.h>

#define CANDIDATES 64
#define RINGS      32 /* 2 for each octave: the smallest have some ten places */
#define TURN       6.283185307179586

/* In noise, power over its median is exponential: of 2^19 places, one exceeds 19 as a rule, and one in 10^6 pictures
 * exceeds 40. */
#define HEIGHT_MIN 40.0

#define EVENNESS_MIN 0.4  /* of the picture, at least, has the ridges */
#define WINDOW_FLOOR 1e-6 /* of the highest power: less is the window's, or rounding */
#define SIDELOBE     1e-3 /* of the highest peak's power: the window's own peaks are below */

typedef struct candidate {
    int place[2];
    double height;
} candidate;

/* Cycles across the picture. */
static double radius_of(const spectrum *s, int x, int y) {
    const double across = x / (s->bin[0] * s->width), down = y / (s->bin[1] * s->height);
    return sqrt(across * across + down * down);
}

static int ring_of(double radius) {
    const int ring = (int)(2.0 * log2(radius));
    return ring < RINGS ? ring : RINGS - 1;
}

static int is_in_range(const spectrum *s, int x, int y) {
    const double fx = (double)x / s->width, fy = (double)y / s->height;
    return radius_of(s, x, y) >= PEAKS_PERIODS_MIN - 0.5 &&
           fx * fx + fy * fy <= 1.0 / (PEAKS_SHORTEST * PEAKS_SHORTEST);
}

static int compare(const void *a, const void *b) {
    const float left = *(const float *)a;
    const float right = *(const float *)b;
    return (left > right) - (left < right);
}

/* The median power of each ring. 0 if there is no memory. */
static int find_medians(const spectrum *s, double medians[RINGS]) {
    size_t ends[RINGS + 1] = {0};
    float *sorted = malloc((size_t)s->width * (size_t)s->height * sizeof *sorted);
    for (int pass = 0; pass < 2 && sorted; pass++) { /* count, then place */
        for (int y = 0; y < s->height / 2; y++) {
            for (int x = -s->width / 2; x < s->width / 2; x++) {
                const double radius = radius_of(s, x, y);
                if (radius < 1.0) {
                    continue;
                }
                const int ring = ring_of(radius);
                if (pass == 0) {
                    ends[ring + 1]++;
                } else {
                    sorted[ends[ring]++] = (float)spectrum_at(s, x, y);
                }
            }
        }
        for (int i = 0; i < RINGS && pass == 0; i++) {
            ends[i + 1] += ends[i];
        }
    }
    for (int i = 0; i < RINGS && sorted; i++) { /* the second pass has moved each start to the next ring's */
        const size_t begin = i ? ends[i - 1] : 0;
        qsort(sorted + begin, ends[i] - begin, sizeof *sorted, compare);
        medians[i] = ends[i] > begin ? (double)sorted[begin + (ends[i] - begin) / 2] : 0.0;
    }
    free(sorted);
    return sorted != NULL;
}

static int is_summit(const spectrum *s, int x, int y) {
    const double at = spectrum_at(s, x, y);
    for (int dy = -1; dy <= 1; dy++) {
        for (int dx = -1; dx <= 1; dx++) {
            if (spectrum_at(s, x + dx, y + dy) > at) {
                return 0;
            }
        }
    }
    return 1;
}

/* Inserts into the list of the highest. */
static int keep(candidate list[CANDIDATES], int count, const candidate *made) {
    if (count == CANDIDATES && made->height <= list[count - 1].height) {
        return count;
    }
    int at = count < CANDIDATES ? count++ : count - 1;
    for (; at > 0 && list[at - 1].height < made->height; at--) {
        list[at] = list[at - 1];
    }
    list[at] = *made;
    return count;
}

static double highest(const spectrum *s) {
    double most = 0.0;
    for (int y = 0; y < s->height / 2; y++) {
        for (int x = 1 - s->width / 2; x < s->width / 2; x++) {
            most = is_in_range(s, x, y) ? fmax(most, spectrum_at(s, x, y)) : most;
        }
    }
    return most;
}

/* The summits of half of the plane that are highest over their ring. */
static int find_candidates(const spectrum *s, const double medians[RINGS], candidate list[CANDIDATES]) {
    const double least = WINDOW_FLOOR * highest(s);
    int count = 0;
    for (int y = 0; y < s->height / 2; y++) {
        for (int x = y == 0 ? 1 : 1 - s->width / 2; x < s->width / 2; x++) {
            if (!is_in_range(s, x, y)) {
                continue;
            }
            const double median = medians[ring_of(radius_of(s, x, y))] + least;
            const double at = spectrum_at(s, x, y);
            if (at > 0.25 * HEIGHT_MIN * median && is_summit(s, x, y)) {
                const candidate made = {{x, y}, at / (median + 1e-30)};
                count = keep(list, count, &made);
            }
        }
    }
    return count;
}

/* Power of a frequency in one block of the picture, without the block's mean, in a Hann window. */
static double block_power(const field *from, const float *samples, const double f[2], const uint32_t size[2]) {
    double re = 0.0, im = 0.0, sum = 0.0, window_re = 0.0, window_im = 0.0, weights = 0.0;
    const double turn[2] = {cos(TURN * f[0]), sin(TURN * f[0])};
    for (uint32_t y = 0; y < size[1]; y++) {
        const double weight_y = 1.0 - cos(TURN * (y + 0.5) / size[1]);
        double c = cos(TURN * f[1] * y), s = sin(TURN * f[1] * y);
        for (uint32_t x = 0; x < size[0]; x++) {
            const double weight = weight_y * (1.0 - cos(TURN * (x + 0.5) / size[0]));
            const double at = weight * (double)samples[(size_t)y * from->stride + x];
            re += at * c;
            im += at * s;
            sum += at;
            window_re += weight * c;
            window_im += weight * s;
            weights += weight;
            const double next = c * turn[0] - s * turn[1];
            s = s * turn[0] + c * turn[1];
            c = next;
        }
    }
    re -= sum / weights * window_re;
    im -= sum / weights * window_im;
    return re * re + im * im;
}

/* As many blocks along a side as have a period and a half of the ridges, 2 to 8. */
static uint32_t count_blocks(uint32_t size, const double f[2]) {
    const double fit = size * hypot(f[0], f[1]) / 1.5;
    return fit < 2.0 ? 2 : fit > 8.0 ? 8 : (uint32_t)fit;
}

/* Mean squared over mean of squares of the amplitudes in the picture's blocks. 1: the same everywhere; 0.79: noise; 0.2
 * or less: an edge, or one object. */
static double find_evenness(const field *from, const double f[2]) {
    const uint32_t columns = count_blocks(from->width, f), rows = count_blocks(from->height, f);
    const uint32_t size[2] = {from->width / columns, from->height / rows};
    double sum = 0.0, squares = 0.0;
    for (uint32_t y = 0; y < rows; y++) {
        for (uint32_t x = 0; x < columns; x++) {
            const size_t corner = (size_t)(y * size[1]) * from->stride + (size_t)x * size[0];
            double power = block_power(from, from->right + corner, f, size);
            power += from->down ? block_power(from, from->down + corner, f, size) : 0.0;
            sum += sqrt(power);
            squares += power;
        }
    }
    return squares > 0.0 ? sum * sum / (squares * columns * rows) : 0.0;
}

static int by_power(const void *a, const void *b) {
    const double left = ((const peak *)a)->power;
    const double right = ((const peak *)b)->power;
    return (left < right) - (left > right);
}

/* The candidates that stand out from their neighbourhood. */
static int find_high(const spectrum *s, const candidate *list, int count, peak high[CANDIDATES]) {
    int kept = 0;
    for (int i = 0; i < count; i++) {
        const int *at = list[i].place;
        peak *p = &high[kept];
        p->power = spectrum_at(s, at[0], at[1]);
        p->height = p->power / (spectrum_floor(s, at[0], at[1]) + 1e-30);
        spectrum_refine(s, at, p->frequency);
        kept += p->height >= HEIGHT_MIN;
    }
    qsort(high, (size_t)kept, sizeof *high, by_power);
    return kept;
}

int peaks_find(const field *from, const spectrum *s, peak peaks[PEAKS_MAX]) {
    double medians[RINGS];
    candidate list[CANDIDATES];
    peak high[CANDIDATES];
    if (!find_medians(s, medians)) {
        return -1;
    }
    const int found = find_high(s, list, find_candidates(s, medians, list), high);
    int count = 0;
    for (int i = 0; i < found && count < PEAKS_MAX; i++) {
        if (count > 0 && high[i].power < SIDELOBE * peaks[0].power) {
            break;
        }
        high[i].evenness = find_evenness(from, high[i].frequency);
        if (high[i].evenness >= EVENNESS_MIN) {
            peaks[count++] = high[i];
        }
    }
    return count;
}
