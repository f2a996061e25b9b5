/* From a flat mesh to a plane with an outline, step by step: the sheet of triangles, its surface coordinates, its
 * outline. Inside contact/ only. A step that finds that the mesh is no plane sets *why and returns KNURL_OK.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_PLANE_MESH_H
#define KNURL_SRC_PLANE_MESH_H

#include "contact/plane.h"

/* The triangles that a flat, one-sided sheet is made of, and the frame they are looked at in. */
typedef struct knurl_sheet {
    const knurl_mesh_desc *desc;
    uint32_t *welds;   /* of each vertex: the first that stands at the same place; not set where no triangle uses it */
    uint32_t *kept;    /* by their numbers in the description */
    uint32_t count;    /* of those kept */
    uint32_t dropped;  /* for want of area, or as duplicates */
    uint32_t twins;    /* left out, because another has the same corners and faces the front */
    double origin[3];  /* a point on the plane, in the mesh's frame */
    double axes[3][3]; /* x, y and the normal, unit, right-handed, in the mesh's frame */
    double limit;      /* m: how far anything may be off */
    double flatness;   /* m: how far the vertices are off the plane */
} knurl_sheet;

/* Directed edges between welded vertices, each with the one that runs back. */
typedef struct knurl_edge_table {
    uint64_t *slots;
    uint64_t capacity; /* a power of two */
    uint64_t mask;     /* of the part in use */
} knurl_edge_table;

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

/* Where a vertex stands in the sheet's x and y. */
void knurl_sheet_place(const knurl_sheet *sheet, uint32_t vertex, double out[2]);

/* Decides whether the mesh is flat and faces one way, and which triangles make it. Errors: KNURL_ERROR_MEMORY. */
knurl_result knurl_sheet_make(knurl_heap *heap, const knurl_mesh_desc *desc, knurl_sheet *sheet, const char **why);
void knurl_sheet_release(knurl_heap *heap, knurl_sheet *sheet);

/* Turns the sheet's x along the grating's; fills in the plane's x, map, stretch and has_coordinates, from the sheet's
 * origin. */
void knurl_sheet_coordinates(knurl_sheet *sheet, const double axis[3], knurl_plane *plane, const char **why);

/* Fills in the plane's outline, in the sheet's x and y and counter-clockwise. *error: m, how far the vertices that were
 * left out of it lie off it. Errors: KNURL_ERROR_MEMORY. */
knurl_result knurl_sheet_outline(knurl_heap *heap, const knurl_sheet *sheet, knurl_plane *plane, double *error,
                                 const char **why);

/* 1 where no two edges cross by more than the limit (m) and none has sheet on both sides or twice on one. */
int knurl_outline_is_simple(const knurl_plane *plane, double limit);

/* Room for so many different edges. Errors: KNURL_ERROR_MEMORY. */
knurl_result knurl_edges_make(knurl_heap *heap, uint64_t edges, knurl_edge_table *table);

/* Empties it, for at most so many edges. */
void knurl_edges_clear(knurl_edge_table *table, uint64_t edges);

/* 0 where this edge is there already. */
int knurl_edges_add(knurl_edge_table *table, uint32_t from, uint32_t to);

/* The next edge at or after slot *at that no other runs back along; 0 when there is none left. */
int knurl_edges_next(const knurl_edge_table *table, uint64_t *at, uint32_t edge[2]);

#endif
