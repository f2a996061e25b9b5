/* Builds adjacency: the triangle beyond each edge, and the vertices whose triangles are not all reached by swinging
 * from edge to edge. Linear in the number of triangles for any mesh.
 * SPDX-License-Identifier: MIT */
#include "contact/mesh_adjacency.h"

#include "contact/corner.h"

#include <string.h>

typedef struct adjacency {
    knurl_heap *heap;
    knurl_mesh *mesh;
    const uint32_t *welded;
    uint32_t welded_count;
    uint32_t *starts; /* one per welded vertex, plus two */
} adjacency;

static uint32_t vertex_of(const adjacency *adj, uint32_t corner) {
    return adj->welded[corner_slot(corner)];
}

/* The edge opposite a corner, by its ends. */
typedef struct edge {
    uint32_t low, high;
} edge;

static inline edge edge_of(const adjacency *adj, uint32_t corner) {
    const uint32_t a = vertex_of(adj, corner_next(corner));
    const uint32_t b = vertex_of(adj, corner_last(corner));
    return a < b ? (edge){a, b} : (edge){b, a};
}

static uint32_t lower_end(const adjacency *adj, uint32_t corner) {
    return edge_of(adj, corner).low;
}

static uint32_t upper_end(const adjacency *adj, uint32_t corner) {
    return edge_of(adj, corner).high;
}

/* One pass of a counting sort of corners by `key`. from: null for all corners in order. */
static void sort_by(const adjacency *adj, uint32_t (*key)(const adjacency *, uint32_t), const uint32_t *from,
                    uint32_t *to) {
    const size_t count = 3 * (size_t)adj->mesh->triangle_count;
    memset(adj->starts, 0, ((size_t)adj->welded_count + 2) * sizeof *adj->starts);
    for (uint32_t t = 0; t < adj->mesh->triangle_count; t++) {
        for (uint32_t k = 0; k < 3; k++) {
            adj->starts[key(adj, 4 * t + k) + 2]++;
        }
    }
    for (uint32_t p = 0; p < adj->welded_count; p++) {
        adj->starts[p + 2] += adj->starts[p + 1];
    }
    for (size_t i = 0; i < count; i++) {
        const uint32_t corner = from ? from[i] : (uint32_t)(4 * (i / 3) + i % 3);
        to[adj->starts[key(adj, corner) + 1]++] = corner;
    }
}

/* Links the corners opposite one edge. */
static void link_edge(const adjacency *adj, const uint32_t *corners, size_t count) {
    if (count == 2) {
        const uint32_t a = corners[0];
        const uint32_t b = corners[1];
        const uint32_t flipped = vertex_of(adj, corner_next(a)) == vertex_of(adj, corner_next(b)) ? KNURL_FLIPPED : 0;
        adj->mesh->opposite[corner_slot(a)] = b | flipped;
        adj->mesh->opposite[corner_slot(b)] = a | flipped;
        return;
    }
    for (size_t i = 0; i < count; i++) {
        adj->mesh->opposite[corner_slot(corners[i])] = count == 1 ? KNURL_BOUNDARY : KNURL_NON_MANIFOLD_EDGE;
    }
}

static void link_edges(const adjacency *adj, const uint32_t *sorted) {
    const size_t count = 3 * (size_t)adj->mesh->triangle_count;
    size_t first = 0;
    edge now = edge_of(adj, sorted[0]);
    for (size_t i = 1; i <= count; i++) {
        const edge next = edge_of(adj, sorted[i < count ? i : first]);
        if (i == count || next.low != now.low || next.high != now.high) {
            link_edge(adj, &sorted[first], i - first);
            first = i;
            now = next;
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
    adjacency adj = {heap, mesh, welded, welded_count, NULL};
    adj.starts = knurl_heap_alloc(heap, (uint64_t)welded_count + 2, sizeof *adj.starts);
    uint32_t *half_sorted = knurl_heap_alloc(heap, corners, sizeof *half_sorted);
    uint32_t *sorted = knurl_heap_alloc(heap, corners, sizeof *sorted);
    mesh->opposite = knurl_heap_alloc(heap, corners, sizeof *mesh->opposite);
    knurl_result result = adj.starts && half_sorted && sorted && mesh->opposite ? KNURL_OK : KNURL_ERROR_MEMORY;
    if (!result) {
        sort_by(&adj, upper_end, NULL, half_sorted);
        sort_by(&adj, lower_end, half_sorted, sorted);
        link_edges(&adj, sorted);
        sort_by(&adj, vertex_of, NULL, sorted);
        const size_t marked = mark_non_manifold(&adj, sorted);
        if (marked > 0) {
            result = make_lists(&adj, marked);
        }
        if (!result && marked > 0) {
            fill_lists(&adj, sorted);
        }
    }
    knurl_heap_free(heap, adj.starts);
    knurl_heap_free(heap, half_sorted);
    knurl_heap_free(heap, sorted);
    return result;
}
