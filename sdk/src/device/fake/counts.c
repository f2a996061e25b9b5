/* Finds an encoder's counts in recorded positions: on each axis the coarsest lattice on which all its values lie,
 * within the last digit that was written. A lattice alone is no proof, because a steady speed makes one too. So there
 * must be single steps that are one count longer or shorter than the equal steps before and after, as rounding makes
 * them.
 * SPDX-License-Identifier: MIT */
#include "device/fake/counts.h"

#include "base/error.h"

#include <math.h>
#include <stdlib.h>

/* m: a finer quantum is taken as exact: its false speed is 0.2 mm/s at 1 kHz. */
#define FINEST 2e-7

/* Decimals of a metre; text with more is taken as exact. */
#define DIGITS_MAX 9

/* Different values of an axis. With fewer, they may lie on a lattice by chance: three in five integers lie within a
 * lattice of 2.5. */
#define VALUES_LEAST 12

/* Steps of one count more or less than both neighbours. No smooth trace that was tried has any. */
#define SINGLES_LEAST 8

/* Counts in the shortest gap between two values. */
#define GAP_MOST 40

/* One axis: its values less the first, in order of time, and sorted without duplicates. */
typedef struct axis_values {
    const double *rows;
    double *sorted;
    uint64_t row_count, count;
    int axis;
    double digit; /* m: the last decimal that was written; 0: more than DIGITS_MAX */
} axis_values;

static double value_of(const axis_values *a, uint64_t row) {
    return a->rows[4 * row + (uint64_t)a->axis] - a->rows[a->axis];
}

static int by_size(const void *a, const void *b) {
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

static double last_digit(const axis_values *a) {
    double digit = 1.0;
    uint64_t i = 0;
    for (int decimals = 0; decimals <= DIGITS_MAX; decimals++, digit *= 0.1) {
        while (i < a->count && fabs(a->sorted[i] - digit * floor(a->sorted[i] / digit + 0.5)) < 1e-12) {
            i++;
        }
        if (i == a->count) {
            return digit;
        }
    }
    return 0.0;
}

static void sort_values(axis_values *a) {
    for (uint64_t i = 0; i < a->row_count; i++) {
        a->sorted[i] = value_of(a, i);
    }
    qsort(a->sorted, (size_t)a->row_count, sizeof *a->sorted, by_size);
    a->count = 1;
    for (uint64_t i = 1; i < a->row_count; i++) {
        if (a->sorted[i] - a->sorted[a->count - 1] > 1e-12) {
            a->sorted[a->count++] = a->sorted[i];
        }
    }
    a->digit = last_digit(a);
}

/* How far the values' distances from the lattice may spread: over the digits that were not written. */
static double spread_most(const axis_values *a, double quantum) {
    return 1.05 * a->digit + 1e-11 + 1e-6 * quantum;
}

/* The mean of the shortest gaps between neighbouring values, which differ by the digits that were not written. */
static double shortest_gap(const axis_values *a) {
    double least = INFINITY;
    double sum = 0.0;
    uint64_t gaps = 0;
    for (uint64_t i = 1; i < a->count; i++) {
        least = fmin(least, a->sorted[i] - a->sorted[i - 1]);
    }
    for (uint64_t i = 1; i < a->count; i++) {
        const double gap = a->sorted[i] - a->sorted[i - 1];
        if (gap < least + 1.01 * a->digit + 1e-11) {
            sum += gap;
            gaps++;
        }
    }
    return sum / (double)gaps;
}

static double counts_between(double from, double to, double quantum) {
    return floor((to - from) / quantum + 0.5);
}

/* 1 if all values lie on a lattice of about *quantum, which becomes the slope of the least squares' line. */
static int fits(const axis_values *a, double *quantum) {
    const double n = (double)a->count;
    double k = 0.0; /* counts from the least value */
    double sum_k = 0.0;
    double sum_x = 0.0;
    double sum_kk = 0.0;
    double sum_kx = 0.0;
    for (uint64_t i = 0; i < a->count; i++) {
        const double x = a->sorted[i] - a->sorted[0];
        k += i > 0 ? counts_between(a->sorted[i - 1], a->sorted[i], *quantum) : 0.0;
        sum_k += k;
        sum_x += x;
        sum_kk += k * k;
        sum_kx += k * x;
    }
    const double slope = (sum_kx - sum_k * sum_x / n) / (sum_kk - sum_k * sum_k / n);
    double least = INFINITY;
    double most = -INFINITY;
    k = 0.0;
    for (uint64_t i = 0; i < a->count; i++) {
        k += i > 0 ? counts_between(a->sorted[i - 1], a->sorted[i], *quantum) : 0.0;
        least = fmin(least, a->sorted[i] - slope * k);
        most = fmax(most, a->sorted[i] - slope * k);
    }
    if (!(most - least <= spread_most(a, slope))) {
        return 0;
    }
    *quantum = slope;
    return 1;
}

/* Steps that are one count longer or shorter than the equal steps before and after. */
static uint64_t count_singles(const axis_values *a, double quantum) {
    uint64_t singles = 0;
    for (uint64_t i = 3; i < a->row_count; i++) {
        const double before = counts_between(value_of(a, i - 3), value_of(a, i - 2), quantum);
        const double step = counts_between(value_of(a, i - 2), value_of(a, i - 1), quantum);
        const double after = counts_between(value_of(a, i - 1), value_of(a, i), quantum);
        singles += before == after && fabs(step - before) == 1.0;
    }
    return singles;
}

/* The axis' own quantum, if it is certain; else 0. All gaps may be of several counts. If there is no coarser lattice,
 * text of few digits has the last one as its quantum. */
static double find_quantum(const axis_values *a) {
    if (a->count < VALUES_LEAST) {
        return 0.0;
    }
    const double gap = shortest_gap(a);
    const double finest = fmax(FINEST, 2.0 * a->digit);
    for (int counts = 1; counts <= GAP_MOST && gap / counts >= finest; counts++) {
        double quantum = gap / counts;
        if (fits(a, &quantum)) {
            return count_singles(a, quantum) >= SINGLES_LEAST ? quantum : 0.0;
        }
    }
    return a->digit >= FINEST && count_singles(a, a->digit) >= SINGLES_LEAST ? a->digit : 0.0;
}

/* 1 if an axis with too little motion to tell agrees with the quantum of another. */
static int agrees(const axis_values *a, double quantum) {
    for (uint64_t i = 0; i < a->count; i++) {
        const double k = counts_between(0.0, a->sorted[i], quantum);
        if (fabs(a->sorted[i] - k * quantum) > spread_most(a, quantum) + 1e-6 * fabs(a->sorted[i])) {
            return 0;
        }
    }
    return 1;
}

knurl_result knurl_counts_find(const double *rows, uint64_t row_count, double *quantum) {
    double *room = malloc((size_t)row_count * 3 * sizeof *room);
    axis_values axes[3];
    double found[3];
    double most = 0.0;
    if (!room) {
        return knurl_fail(KNURL_ERROR_MEMORY, "trace: could not get memory for %llu rows",
                          (unsigned long long)row_count);
    }
    for (int axis = 0; axis < 3; axis++) {
        const axis_values values = {rows, room + (uint64_t)axis * row_count, row_count, 0, axis + 1, 0.0};
        axes[axis] = values;
        sort_values(&axes[axis]);
        found[axis] = find_quantum(&axes[axis]);
        most = fmax(most, found[axis]);
    }
    for (int axis = 0; axis < 3 && most > 0.0; axis++) {
        most = found[axis] > 0.0 || agrees(&axes[axis], most) ? most : 0.0;
    }
    free(room);
    *quantum = most;
    return KNURL_OK;
}
