/* Builds adjacency: the triangle beyond each edge, and the vertices whose triangles are not all reached by swinging
 * from edge to edge. Linear in the number of triangles for any mesh.
 * SPDX-License-Identifier: MIT */
#include "contact/mesh_adjacency.h"

#include "contact/corner.h"

#include <string.h>

/* The last edge that was found to end at a vertex, and the first corner opposite it. */
typedef struct edge_end {
    uint32_t from; /* 1 + its other vertex; 0: no edge yet */
    uint32_t corner;
} edge_end;

typedef struct adjacency {
    knurl_heap *heap;
    knurl_mesh *mesh;
    const uint32_t *welded;
    uint32_t welded_count;
    uint32_t *starts; /* one per welded vertex, plus two */
    edge_end *ends;   /* one per welded vertex */
} adjacency;

static uint32_t vertex_of(const adjacency *adj, uint32_t corner) {
    return adj->welded[corner_slot(corner)];
}

/* Sorts corners by vertex (a counting sort): afterwards those of vertex v are from starts[v] to starts[v + 1]. */
static void sort_by_vertex(const adjacency *adj, uint32_t *to) {
    for (size_t i = 0; i < 3 * (size_t)adj->mesh->triangle_count; i++) {
        adj->starts[adj->welded[i] + 2]++;
    }
    for (uint32_t p = 0; p < adj->welded_count; p++) {
        adj->starts[p + 2] += adj->starts[p + 1];
    }
    for (uint32_t t = 0; t < adj->mesh->triangle_count; t++) {
        for (uint32_t k = 0; k < 3; k++) {
            to[adj->starts[adj->welded[3 * (size_t)t + k] + 1]++] = 4 * t + k;
        }
    }
}

/* Links a corner with the others opposite the same edge, which begins at vertex `from`. last: of its end. */
static void link_corner(const adjacency *adj, uint32_t from, edge_end *last, uint32_t corner) {
    uint32_t *opposite = adj->mesh->opposite;
    uint32_t *across = &opposite[corner_slot(corner)];
    if (last->from != from + 1) {
        *last = (edge_end){from + 1, corner};
        *across = KNURL_BOUNDARY;
        return;
    }
    const uint32_t first = last->corner;
    uint32_t *back = &opposite[corner_slot(first)];
    if (*back == KNURL_BOUNDARY) {
        const int is_flipped = vertex_of(adj, corner_next(first)) == vertex_of(adj, corner_next(corner));
        *across = first | (is_flipped ? KNURL_FLIPPED : 0);
        *back = corner | (is_flipped ? KNURL_FLIPPED : 0);
        return;
    }
    if (*back != KNURL_NON_MANIFOLD_EDGE) {
        opposite[corner_slot(*back & KNURL_CORNER_MASK)] = KNURL_NON_MANIFOLD_EDGE;
        *back = KNURL_NON_MANIFOLD_EDGE;
    }
    *across = KNURL_NON_MANIFOLD_EDGE;
}

/* Links the corners opposite each edge. An edge is met at its vertex with the lower number. */
static void link_edges(const adjacency *adj, const uint32_t *by_vertex) {
    for (uint32_t p = 0; p < adj->welded_count; p++) {
        for (uint32_t i = adj->starts[p]; i < adj->starts[p + 1]; i++) {
            const uint32_t next = corner_next(by_vertex[i]), last = corner_last(by_vertex[i]);
            const uint32_t v = vertex_of(adj, next), w = vertex_of(adj, last);
            if (v > p) {
                link_corner(adj, p, &adj->ends[v], last);
            }
            if (w > p) {
                link_corner(adj, p, &adj->ends[w], next);
            }
        }
    }
}

/* 1 if swinging from a corner round its vertex reaches `count` triangles, the number that the vertex has. */
static int is_one_fan(const knurl_mesh *mesh, uint32_t start, uint32_t count) {
    const knurl_swing ways[2] = {{start, corner_next(start)}, {start, corner_last(start)}};
    uint32_t reached = 1;
    for (int way = 0; way < 2; way++) {
        knurl_swing s = ways[way];
        while ((corner_swing(mesh, &s) & 3) != 3) {
            if (s.corner == start) {
                return reached == count;
            }
            reached++;
        }
    }
    return reached == count;
}

/* Marks the corners of non-manifold vertices; returns their number. */
static size_t mark_non_manifold(const adjacency *adj, const uint32_t *by_vertex) {
    size_t marked = 0;
    for (uint32_t p = 0; p < adj->welded_count; p++) {
        const uint32_t count = adj->starts[p + 1] - adj->starts[p];
        if (!is_one_fan(adj->mesh, by_vertex[adj->starts[p]], count)) {
            for (uint32_t i = adj->starts[p]; i < adj->starts[p + 1]; i++) {
                adj->mesh->opposite[corner_slot(by_vertex[i])] |= KNURL_NON_MANIFOLD;
            }
            marked += count;
        }
    }
    return marked;
}

/* Allocates an entry for each vertex with a marked corner (several vertices may be welded to one). */
static knurl_result make_lists(const adjacency *adj, size_t marked) {
    knurl_mesh *mesh = adj->mesh;
    uint8_t *is_listed = knurl_heap_alloc(adj->heap, mesh->vertex_count, 1);
    if (!is_listed) {
        return KNURL_ERROR_MEMORY;
    }
    for (size_t i = 0; i < 3 * (size_t)mesh->triangle_count; i++) {
        if (mesh->opposite[i] & KNURL_NON_MANIFOLD) {
            mesh->non_manifold_count += !is_listed[mesh->triangles[i]];
            is_listed[mesh->triangles[i]] = 1;
        }
    }
    mesh->non_manifold = knurl_heap_alloc(adj->heap, mesh->non_manifold_count, sizeof *mesh->non_manifold);
    mesh->non_manifold_corners = knurl_heap_alloc(adj->heap, marked, sizeof *mesh->non_manifold_corners);
    uint32_t made = 0;
    for (uint32_t v = 0; mesh->non_manifold && v < mesh->vertex_count; v++) {
        if (is_listed[v]) {
            mesh->non_manifold[made++].vertex = v;
        }
    }
    knurl_heap_free(adj->heap, is_listed);
    return mesh->non_manifold && mesh->non_manifold_corners ? KNURL_OK : KNURL_ERROR_MEMORY;
}

/* Lists the corners of each marked position, for all vertices welded there. */
static void fill_lists(const adjacency *adj, const uint32_t *by_vertex) {
    knurl_mesh *mesh = adj->mesh;
    uint32_t first = 0;
    for (uint32_t p = 0; p < adj->welded_count; p++) {
        const uint32_t *run = &by_vertex[adj->starts[p]];
        const uint32_t count = adj->starts[p + 1] - adj->starts[p];
        if (!(mesh->opposite[corner_slot(run[0])] & KNURL_NON_MANIFOLD)) {
            continue;
        }
        memcpy(&mesh->non_manifold_corners[first], run, count * sizeof *run);
        for (uint32_t i = 0; i < count; i++) {
            knurl_vertex_corners *list =
                &mesh->non_manifold[corner_find_non_manifold(mesh, mesh->triangles[corner_slot(run[i])])];
            list->first = first;
            list->count = count;
        }
        first += count;
    }
}

knurl_result knurl_mesh_link(knurl_heap *heap, knurl_mesh *mesh, const uint32_t *welded, uint32_t welded_count) {
    const size_t corners = 3 * (size_t)mesh->triangle_count;
    adjacency adj = {heap, mesh, welded, welded_count, NULL, NULL};
    adj.starts = knurl_heap_alloc(heap, (uint64_t)welded_count + 2, sizeof *adj.starts);
    adj.ends = knurl_heap_alloc(heap, welded_count, sizeof *adj.ends);
    uint32_t *by_vertex = knurl_heap_alloc(heap, corners, sizeof *by_vertex);
    mesh->opposite = knurl_heap_alloc(heap, corners, sizeof *mesh->opposite);
    knurl_result result = adj.starts && adj.ends && by_vertex && mesh->opposite ? KNURL_OK : KNURL_ERROR_MEMORY;
    if (!result) {
        sort_by_vertex(&adj, by_vertex);
        link_edges(&adj, by_vertex);
        const size_t marked = mark_non_manifold(&adj, by_vertex);
        if (marked > 0) {
            result = make_lists(&adj, marked);
        }
        if (!result && marked > 0) {
            fill_lists(&adj, by_vertex);
        }
    }
    knurl_heap_free(heap, adj.starts);
    knurl_heap_free(heap, adj.ends);
    knurl_heap_free(heap, by_vertex);
    return result;
}
