/* Rank correlations. SPDX-License-Identifier: MIT */
#include "rank.h"

#include <math.h>

/* Two values a rounding apart are tied. */
static int order(double a, double b) {
    const double near = 1e-9 * fmax(1.0, fmax(fabs(a), fabs(b)));
    return a > b + near ? 1 : a < b - near ? -1 : 0;
}

static void mid_ranks(const double *x, size_t count, double *ranks) {
    for (size_t i = 0; i < count; i++) {
        ranks[i] = 0.0;
        for (size_t k = 0; k < count; k++) {
            ranks[i] += 0.5 * (order(x[i], x[k]) + 1);
        }
    }
}

double rank_spearman(const double *x, const double *y, size_t count) {
    double a[RANK_MAX];
    double b[RANK_MAX];
    double ab = 0.0;
    double aa = 0.0;
    double bb = 0.0;
    mid_ranks(x, count, a);
    mid_ranks(y, count, b);
    for (size_t i = 0; i < count; i++) { /* mid-ranks counted so have the mean count/2 */
        const double u = a[i] - 0.5 * (double)count;
        const double v = b[i] - 0.5 * (double)count;
        ab += u * v;
        aa += u * u;
        bb += v * v;
    }
    return aa > 0.0 && bb > 0.0 ? ab / sqrt(aa * bb) : NAN;
}

double rank_kendall(const double *x, const double *y, size_t count) {
    double both = 0.0;
    double in_x = 0.0;
    double in_y = 0.0;
    for (size_t i = 0; i < count; i++) {
        for (size_t k = i + 1; k < count; k++) {
            const int a = order(x[i], x[k]);
            const int b = order(y[i], y[k]);
            both += a * b;
            in_x += a != 0;
            in_y += b != 0;
        }
    }
    return in_x > 0.0 && in_y > 0.0 ? both / sqrt(in_x * in_y) : NAN;
}

double rank_separation(const double *x, const double *y, size_t count) {
    double above = 0.0;
    double pairs = 0.0;
    for (size_t i = 0; i < count; i++) {
        for (size_t k = 0; k < count; k++) {
            if (y[i] > 0.5 && !(y[k] > 0.5)) {
                above += 0.5 * (order(x[i], x[k]) + 1);
                pairs += 1.0;
            }
        }
    }
    return pairs > 0.0 ? above / pairs : NAN;
}
