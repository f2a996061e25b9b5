/* Corners of a mesh, and from edge to edge round a vertex. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_CORNER_H
#define KNURL_SRC_CORNER_H

#include "contact/mesh.h"

static inline uint32_t corner_next(uint32_t corner) {
    return (corner & 3) == 2 ? corner - 2 : corner + 1;
}

static inline uint32_t corner_last(uint32_t corner) {
    return (corner & 3) == 0 ? corner + 2 : corner - 1;
}

/* Where a corner's entries stand in arrays of three a triangle. */
static inline size_t corner_slot(uint32_t corner) {
    return 3 * (size_t)(corner >> 2) + (corner & 3);
}

/* A place in a swing round a vertex: the vertex's corner in one triangle, and the corner that faces the edge that the
 * swing goes over next. */
typedef struct knurl_swing {
    uint32_t corner;
    uint32_t over;
} knurl_swing;

/* Into the next triangle; the corner of it that faces back, or KNURL_RIM or KNURL_SEVERAL where the swing ends. */
static inline uint32_t corner_swing(const knurl_mesh *mesh, knurl_swing *s) {
    const uint32_t across = mesh->across[corner_slot(s->over)];
    const uint32_t apex = across & KNURL_CORNER;
    if ((apex & 3) == 3) {
        return apex;
    }
    const int ahead = (corner_next(s->over) == s->corner) == ((across & KNURL_TURNED) != 0);
    s->corner = ahead ? corner_next(apex) : corner_last(apex);
    s->over = ahead ? corner_last(apex) : corner_next(apex);
    return apex;
}

/* Where a vertex stands among the knots, of which it has to be one. */
static inline uint32_t corner_knot_place(const knurl_mesh *mesh, uint32_t vertex) {
    uint32_t low = 0;
    uint32_t high = mesh->knot_count;
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        if (mesh->knots[middle].vertex <= vertex) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

#endif
