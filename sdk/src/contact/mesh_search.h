/* Finds the triangles of a mesh that overlap a box. Most nodes and triangles do not, and rejecting them takes most of a
 * search's time: boxes are compared in single precision, four numbers at a time. Everything here is allowed in a tick.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_MESH_SEARCH_H
#define KNURL_SRC_MESH_SEARCH_H

#include "base/vec3.h"
#include "contact/bvh_search.h"
#include "contact/contact.h"
#include "contact/mesh.h"

#include <string.h>

static inline knurl_float4 knurl_float4_vertex(const knurl_mesh *mesh, uint32_t vertex) {
    const float *p = &mesh->positions[3 * (size_t)vertex];
    return (knurl_float4){p[0], p[1], p[2], 0.0f};
}

static inline int knurl_search_box_meets_triangle(const knurl_search_box *box, const knurl_mesh *mesh,
                                                  uint32_t triangle) {
    const uint32_t *vertices = &mesh->triangles[3 * (size_t)triangle];
    const knurl_float4 a = knurl_float4_vertex(mesh, vertices[0]);
    const knurl_float4 b = knurl_float4_vertex(mesh, vertices[1]);
    const knurl_float4 c = knurl_float4_vertex(mesh, vertices[2]);
    return !knurl_mask4_any(((a < box->low) & (b < box->low) & (c < box->low)) |
                            ((a > box->high) & (b > box->high) & (c > box->high)));
}

/* A search for the triangles that overlap a box. The box may shrink during the search. */
typedef struct knurl_mesh_search {
    const knurl_mesh *mesh;
    knurl_visits *visits;   /* null: unlimited */
    const uint32_t *listed; /* if set, `next` and `end` are indices in this list; if null, they are triangles */
    uint32_t next, end;
    uint32_t count; /* nodes still to visit */
    uint32_t nodes[KNURL_BVH_DEPTH_MAX];
} knurl_mesh_search;

/* Returns the part of a mesh that a search of a box visits: `part`, which is found again if the box is outside of it.
 * If the box is too large, or part is null, it is the whole mesh. visits: null: unlimited. */
const knurl_part *knurl_mesh_find_part(const knurl_mesh *mesh, const double low[3], const double high[3],
                                       knurl_visits *visits, knurl_part *part) KNURL_NONBLOCKING;

/* Begins a search of the box from low to high. part, visits: as for knurl_mesh_find_part(). */
void knurl_mesh_search_begin(knurl_mesh_search *search, const knurl_mesh *mesh, const double low[3],
                             const double high[3], knurl_visits *visits, knurl_part *part) KNURL_NONBLOCKING;

/* Finds the next triangle that overlaps the box, in ascending order; 0 at the end, or if the visits are used up. */
static inline int knurl_mesh_search_next(knurl_mesh_search *s, const knurl_search_box *box, uint32_t *triangle) {
    for (;;) {
        while (s->next < s->end) {
            *triangle = s->listed ? s->listed[s->next] : s->next;
            s->next++;
            if (knurl_search_box_meets_triangle(box, s->mesh, *triangle)) {
                return 1;
            }
        }
        if (s->count == 0) {
            return 0;
        }
        const uint32_t index = s->nodes[--s->count];
        const knurl_bvh_node *node = &s->mesh->nodes[index];
        if (!knurl_search_box_meets_node(box, node)) {
            continue;
        }
        if (!knurl_visits_take(s->visits, 1 + node->count)) {
            return 0;
        }
        if (node->count == 0) {
            s->nodes[s->count++] = node->first;
            s->nodes[s->count++] = index + 1;
        } else {
            s->next = node->first;
            s->end = node->first + node->count;
        }
    }
}

#endif
