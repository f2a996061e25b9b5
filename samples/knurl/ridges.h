/* Finds regular ridges in a picture's samples. SPDX-License-Identifier: MIT */
#ifndef KNURL_RIDGES_H
#define KNURL_RIDGES_H

#include "spectrum.h"

#define RIDGES_AXES      2
#define RIDGES_CONFIDENT 0.5 /* below: no regular pattern */
#define RIDGES_SIZE_MIN  64  /* samples */

typedef struct ridges {
    int count;                        /* of axes: 0 to 2, the stronger one first */
    double frequency[RIDGES_AXES][2]; /* cycles per sample to the right and down; ridges run across it */
    double share[RIDGES_AXES];        /* of the picture's variation, 0 to 1, in the axis and its harmonics */
    double evenness[RIDGES_AXES];     /* of their strength over the picture, 0 to 1 */
    double confidence;                /* 0 to 1, of the first axis */
} ridges;

/* 1, or 0 if there is no memory. The field is at least RIDGES_SIZE_MIN in both directions. */
int ridges_find(const field *from, ridges *found);

/* The mean profile across the ridges of one axis, from its harmonics. */
typedef struct profile {
    double amplitude; /* half of peak to peak */
    double crest;     /* cycles: the phase frequency . (x, y) of the highest place, 0 to 1 */
} profile;

/* Heights: the amplitude in their unit. Slopes (`down` is not null): in the unit of `sample`, a sample's width and
 * height. is_averaged: 1: samples are means over squares of pixels, which flattens fine ridges. */
void ridges_profile(const field *from, const double frequency[2], const double sample[2], int is_averaged,
                    profile *found);

#endif
