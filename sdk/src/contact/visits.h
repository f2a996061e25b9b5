/* How much one tick may look at, so that its time is bounded whatever the scene. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_VISITS_H
#define KNURL_SRC_VISITS_H

#include <stdint.h>

/* A visit is a triangle, a plane or a node of a hierarchy that a query looks into: 40 to 70 instructions. */
typedef struct knurl_visits {
    uint32_t left;     /* 0: queries give no answer any more */
    int32_t exhausted; /* 1: some query was cut short, by this budget or by its own share of it */
} knurl_visits;

/* Visits that finding the closest point of one triangle costs, beside the visit of the triangle. */
#define KNURL_VISITS_CLOSEST 4

/* The same for a triangle that a walk comes to: in a large mesh each waits for memory that the last one named. */
#define KNURL_VISITS_STEP 9

/* Takes `count` visits. 0 where they are not left: the query is to end. visits: null: no limit. */
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

/* Half of the visits that are left, for a query that must leave some for others. visits: null: no limit. */
static inline knurl_visits knurl_visits_halve(const knurl_visits *visits) {
    const knurl_visits half = {visits ? visits->left / 2 : UINT32_MAX, 0};
    return half;
}

/* Takes what a query has used of `half`. */
static inline void knurl_visits_settle(knurl_visits *visits, const knurl_visits *half) {
    if (visits) {
        visits->left -= visits->left / 2 - half->left;
        visits->exhausted |= half->exhausted;
    }
}

#endif
