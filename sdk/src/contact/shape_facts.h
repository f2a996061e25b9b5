/* Facts about a shape, for reports. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_SHAPE_FACTS_H
#define KNURL_SRC_SHAPE_FACTS_H

#include "base/finite.h"

#include <stdint.h>

/* What a shape came to be. */
typedef struct knurl_shape_facts {
    const char *model;       /* static */
    uint64_t bytes;          /* of the heap */
    uint32_t triangle_count; /* of the mesh it was given as, without those left out; 0: it was given as a plane */
    uint32_t dropped;        /* triangles left out for want of area, or as duplicates */
    uint32_t reversed_twins; /* triangles left out because another has the same corners, facing the other way */
    uint32_t turned;         /* triangles turned over to face as the rest of their connected component */
    uint32_t mixed;          /* triangles that still face another way than that rest */
    double seam;             /* m: edges that run side by side within this touch */
    uint32_t touching;       /* pairs of triangles that touch other than along an edge that they share */
    double error;            /* m: how far the model is off what was given */
    double stretch[2][3];    /* min, mean, max of d(surface coordinate)/d(metre along x), and along y */
} knurl_shape_facts;

#endif
