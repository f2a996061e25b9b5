/* Corners of a mesh, and swinging from triangle to triangle around a vertex. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_CORNER_H
#define KNURL_SRC_CORNER_H

#include "contact/mesh.h"

static inline uint32_t corner_next(uint32_t corner) {
    return (corner & 3) == 2 ? corner - 2 : corner + 1;
}

static inline uint32_t corner_last(uint32_t corner) {
    return (corner & 3) == 0 ? corner + 2 : corner - 1;
}

/* Index of a corner's entry in arrays with three entries per triangle. */
static inline size_t corner_slot(uint32_t corner) {
    return 3 * (size_t)(corner >> 2) + (corner & 3);
}

/* State of a swing round a vertex (Rossignac 2001): the vertex's corner in one triangle, and the corner opposite the
 * next edge to cross. */
typedef struct knurl_swing {
    uint32_t corner;
    uint32_t over;
} knurl_swing;

/* Swings into the next triangle. Returns its corner opposite the crossed edge, or KNURL_BOUNDARY or
 * KNURL_NON_MANIFOLD_EDGE if the swing ends. */
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

/* Index of a non-manifold vertex in the sorted list of them. */
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
