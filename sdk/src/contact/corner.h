/* Corners of a mesh, and stepping from edge to edge around a vertex. SPDX-License-Identifier: MIT */
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

/* A step of a swing round a vertex (Rossignac 2001): the vertex's corner in one triangle, and the corner opposite the
 * edge that the swing crosses next. */
typedef struct knurl_swing {
    uint32_t corner;
    uint32_t over;
} knurl_swing;

/* Into the next triangle; its corner opposite the edge that was crossed, or KNURL_BOUNDARY or KNURL_NON_MANIFOLD_EDGE
 * where the swing ends. */
static inline uint32_t corner_swing(const knurl_mesh *mesh, knurl_swing *s) {
    const uint32_t across = mesh->opposite[corner_slot(s->over)];
    const uint32_t apex = across & KNURL_CORNER_MASK;
    if ((apex & 3) == 3) {
        return apex;
    }
    const int ahead = (corner_next(s->over) == s->corner) == ((across & KNURL_FLIPPED) != 0);
    s->corner = ahead ? corner_next(apex) : corner_last(apex);
    s->over = ahead ? corner_last(apex) : corner_next(apex);
    return apex;
}

/* Where a non-manifold vertex stands in the list of them. */
static inline uint32_t corner_find_non_manifold(const knurl_mesh *mesh, uint32_t vertex) {
    uint32_t low = 0;
    uint32_t high = mesh->non_manifold_count;
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        if (mesh->non_manifold[middle].vertex <= vertex) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

#endif
