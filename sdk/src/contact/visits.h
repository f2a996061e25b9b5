/* Budget of the queries of a tick, which bounds its time in any scene. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_VISITS_H
#define KNURL_SRC_VISITS_H

#include <stdint.h>

/* A visit is a triangle, a plane or a node of a hierarchy that a query tests: 40 to 70 instructions. */
typedef struct knurl_visits {
    uint32_t left;     /* one more than may be taken; 0: a query was refused, and all are from now on */
    int32_t exhausted; /* 1: a query was cut short, by this budget or by its own share of it */
} knurl_visits;

/* Visits to find the closest point of one triangle, in addition to that of the triangle. */
#define KNURL_VISITS_CLOSEST 4

/* The same for a triangle reached by a walk: in a large mesh each waits for memory whose address the last one held. */
#define KNURL_VISITS_STEP 9

/* A budget of `count` visits, below UINT32_MAX. */
static inline knurl_visits knurl_visits_of(uint32_t count) {
    const knurl_visits visits = {count + 1, 0};
    return visits;
}

/* Takes `count` visits. Returns 0 if fewer are left; the query must then end. visits: null: unlimited. */
static inline int knurl_visits_take(knurl_visits *visits, uint32_t count) {
    if (!visits) {
        return 1;
    }
    if (visits->left <= count) {
        visits->left = 0;
        visits->exhausted = 1;
        return 0;
    }
    visits->left -= count;
    return 1;
}

/* Half of the visits left, for a query that must leave some for others. visits: null: unlimited. */
static inline knurl_visits knurl_visits_halve(const knurl_visits *visits) {
    const knurl_visits half = {visits ? visits->left / 2 : UINT32_MAX, 0};
    return half;
}

/* Takes the visits that a query has used of `half`. */
static inline void knurl_visits_settle(knurl_visits *visits, const knurl_visits *half) {
    if (visits) {
        visits->left -= visits->left / 2 - half->left;
        visits->exhausted |= half->exhausted;
    }
}

#endif
