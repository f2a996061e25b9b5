/* Quantiles, rank correlations and the binomial distribution. SPDX-License-Identifier: MIT */
#include "statistics.h"

#include <math.h>
#include <stdlib.h>

static int by_value(const void *a, const void *b) {
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

double quantile(double *values, size_t count, double share) {
    qsort(values, count, sizeof *values, by_value);
    return values[(size_t)(share * (double)count)];
}

/* Values that differ only by rounding are tied. */
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
    for (size_t i = 0; i < count; i++) { /* the mean of these mid-ranks is count/2 */
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

/* n! / (m! (n - m)!) / 2^n; the halvings are interleaved to avoid overflow. */
static double point(uint32_t n, uint32_t m) {
    double p = 1.0;
    uint32_t halvings = 0;
    if (m > n) {
        return 0.0;
    }
    for (uint32_t i = 1; i <= m; i++) {
        p *= (double)(n - m + i) / (double)i;
        while (p > 1.0 && halvings < n) {
            p *= 0.5;
            halvings++;
        }
    }
    return ldexp(p, -(int)(n - halvings));
}

double binomial_probability(int32_t rule, uint32_t n, uint32_t m) {
    double tail = 0.0;
    if (rule == BINOMIAL_POINT) {
        return point(n, m);
    }
    for (uint32_t i = n + 1; i-- > m;) { /* the smallest first */
        tail += point(n, i);
    }
    return fmin(1.0, rule == BINOMIAL_TWO_SIDED ? 2.0 * tail : tail);
}

uint32_t binomial_threshold(int32_t rule, uint32_t n, double significance) {
    uint32_t m = n + 1;
    while (m - 1 > n / 2 && binomial_probability(rule, n, m - 1) <= significance) {
        m--;
    }
    return m;
}
