/* A flat sheet of triangles that faces one way: the first step from a mesh to a plane. If the mesh cannot become a
 * plane, a step sets *why (a static sentence) and returns KNURL_OK.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_SHEET_H
#define KNURL_SRC_SHEET_H

#include "base/heap.h"

#include <knurl/contact.h>

/* Triangles of a flat, one-sided sheet, and its frame. */
typedef struct knurl_sheet {
    const knurl_mesh_desc *desc;
    uint32_t *welds;   /* per vertex: the first at the same position; not set if no triangle uses it */
    uint32_t *kept;    /* by their numbers in the description */
    uint32_t count;    /* triangles kept */
    uint32_t dropped;  /* triangles dropped because they have no area or are duplicates */
    uint32_t twins;    /* triangles dropped because another has the same corners and faces the front */
    double origin[3];  /* a point on the plane, in the mesh's frame */
    double axes[3][3]; /* x, y and the normal, unit, right-handed, in the mesh's frame */
    double limit;      /* m: largest deviation allowed */
    double flatness;   /* m: largest distance of a vertex from the plane */
} knurl_sheet;

static inline uint64_t knurl_sheet_triangles(const knurl_mesh_desc *desc) {
    return (desc->indices ? desc->index_count : desc->vertex_count) / 3;
}

static inline uint32_t knurl_sheet_vertex(const knurl_mesh_desc *desc, uint64_t triangle, uint32_t corner) {
    return desc->indices ? desc->indices[3 * triangle + corner] : (uint32_t)(3 * triangle + corner);
}

static inline void knurl_sheet_position(const knurl_mesh_desc *desc, uint32_t vertex, double out[3]) {
    for (size_t axis = 0; axis < 3; axis++) {
        out[axis] = (double)desc->positions[3 * (size_t)vertex + axis];
    }
}

/* Position of a vertex in the sheet's x and y. */
void knurl_sheet_place(const knurl_sheet *sheet, uint32_t vertex, double out[2]);

/* Decides if the mesh is flat and faces one way, and collects its triangles. Errors: KNURL_ERROR_MEMORY. */
knurl_result knurl_sheet_make(knurl_heap *heap, const knurl_mesh_desc *desc, knurl_sheet *sheet, const char **why);
void knurl_sheet_release(knurl_heap *heap, knurl_sheet *sheet);

#endif
