/* Eq. 14, its tails, and the counts that they ask for. SPDX-License-Identifier: MIT */
#include "experiment.h"

#include <math.h>

/* n! / (m! (n - m)!) / 2^n; the halvings are dealt out so that nothing overflows. */
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

double exp_probability(int32_t rule, uint32_t n, uint32_t m) {
    double tail = 0.0;
    if (rule == EXP_POINT) {
        return point(n, m);
    }
    for (uint32_t i = n + 1; i-- > m;) { /* the smallest first */
        tail += point(n, i);
    }
    return fmin(1.0, rule == EXP_TWO_SIDED ? 2.0 * tail : tail);
}

uint32_t exp_threshold(int32_t rule, uint32_t n, double significance) {
    uint32_t m = n + 1;
    while (m - 1 > n / 2 && exp_probability(rule, n, m - 1) <= significance) {
        m--;
    }
    return m;
}
