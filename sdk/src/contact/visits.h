/* How much one tick may look at, so that its time is bounded whatever the scene. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_VISITS_H
#define KNURL_SRC_VISITS_H

#include <stdint.h>

/* A visit is a triangle, a plane or a node of a hierarchy that a query looks into. */
typedef struct knurl_visits {
    uint32_t left;     /* 0: queries give no answer any more */
    int32_t exhausted; /* 1: some query was cut short, by this budget or by its own share of it */
} knurl_visits;

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

#endif
