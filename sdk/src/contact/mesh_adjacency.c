/* Which triangles hang together: for each edge what lies beyond it, and the vertices that swinging from edge to edge
 * does not get round. Linear in the number of triangles, whatever the mesh. SPDX-License-Identifier: MIT */
#include "contact/mesh_adjacency.h"

#include "contact/corner.h"

#include <string.h>

typedef struct join {
    knurl_heap *heap;
    knurl_mesh *mesh;
    const uint32_t *places;
    uint32_t place_count;
    uint32_t *starts; /* one a place, and two */
} join;

static uint32_t place_of(const join *j, uint32_t corner) {
    return j->places[corner_slot(corner)];
}

static uint32_t lower_end(const join *j, uint32_t corner) {
    const uint32_t a = place_of(j, corner_next(corner));
    const uint32_t b = place_of(j, corner_last(corner));
    return a < b ? a : b;
}

static uint32_t upper_end(const join *j, uint32_t corner) {
    const uint32_t a = place_of(j, corner_next(corner));
    const uint32_t b = place_of(j, corner_last(corner));
    return a < b ? b : a;
}

/* One pass of a counting sort of corners by a key; from: null for the corners in order. */
static void sort_by(const join *j, uint32_t (*key)(const join *, uint32_t), const uint32_t *from, uint32_t *to) {
    const size_t count = 3 * (size_t)j->mesh->triangle_count;
    memset(j->starts, 0, ((size_t)j->place_count + 2) * sizeof *j->starts);
    for (uint32_t t = 0; t < j->mesh->triangle_count; t++) {
        for (uint32_t k = 0; k < 3; k++) {
            j->starts[key(j, 4 * t + k) + 2]++;
        }
    }
    for (uint32_t p = 0; p < j->place_count; p++) {
        j->starts[p + 2] += j->starts[p + 1];
    }
    for (size_t i = 0; i < count; i++) {
        const uint32_t corner = from ? from[i] : (uint32_t)(4 * (i / 3) + i % 3);
        to[j->starts[key(j, corner) + 1]++] = corner;
    }
}

/* A run of corners that face one edge. */
static void join_edge(const join *j, const uint32_t *corners, size_t count) {
    if (count == 2) {
        const uint32_t a = corners[0];
        const uint32_t b = corners[1];
        const uint32_t turned = place_of(j, corner_next(a)) == place_of(j, corner_next(b)) ? KNURL_TURNED : 0;
        j->mesh->across[corner_slot(a)] = b | turned;
        j->mesh->across[corner_slot(b)] = a | turned;
        return;
    }
    for (size_t i = 0; i < count; i++) {
        j->mesh->across[corner_slot(corners[i])] = count == 1 ? KNURL_RIM : KNURL_SEVERAL;
    }
}

static void join_edges(const join *j, const uint32_t *sorted) {
    const size_t count = 3 * (size_t)j->mesh->triangle_count;
    size_t first = 0;
    for (size_t i = 1; i <= count; i++) {
        if (i == count || lower_end(j, sorted[i]) != lower_end(j, sorted[first]) ||
            upper_end(j, sorted[i]) != upper_end(j, sorted[first])) {
            join_edge(j, &sorted[first], i - first);
            first = i;
        }
    }
}

/* Whether swinging from a corner round its vertex gets to `count` triangles: all of the vertex's. */
static int swing_reaches(const knurl_mesh *mesh, uint32_t start, uint32_t count) {
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

/* Marks the corners of knots; returns how many there are. */
static size_t mark_knots(const join *j, const uint32_t *by_place) {
    size_t marked = 0;
    for (uint32_t p = 0; p < j->place_count; p++) {
        const uint32_t count = j->starts[p + 1] - j->starts[p];
        if (!swing_reaches(j->mesh, by_place[j->starts[p]], count)) {
            for (uint32_t i = j->starts[p]; i < j->starts[p + 1]; i++) {
                j->mesh->across[corner_slot(by_place[i])] |= KNURL_KNOT;
            }
            marked += count;
        }
    }
    return marked;
}

/* One knot for each vertex that a marked corner has (in one place there may be several). */
static knurl_result make_knots(const join *j, size_t marked) {
    knurl_mesh *mesh = j->mesh;
    uint8_t *is_knot = knurl_heap_alloc(j->heap, mesh->vertex_count, 1);
    if (!is_knot) {
        return KNURL_ERROR_MEMORY;
    }
    for (size_t i = 0; i < 3 * (size_t)mesh->triangle_count; i++) {
        if (mesh->across[i] & KNURL_KNOT) {
            mesh->knot_count += !is_knot[mesh->triangles[i]];
            is_knot[mesh->triangles[i]] = 1;
        }
    }
    mesh->knots = knurl_heap_alloc(j->heap, mesh->knot_count, sizeof *mesh->knots);
    mesh->knot_corners = knurl_heap_alloc(j->heap, marked, sizeof *mesh->knot_corners);
    uint32_t made = 0;
    for (uint32_t v = 0; mesh->knots && v < mesh->vertex_count; v++) {
        if (is_knot[v]) {
            mesh->knots[made++].vertex = v;
        }
    }
    knurl_heap_free(j->heap, is_knot);
    return mesh->knots && mesh->knot_corners ? KNURL_OK : KNURL_ERROR_MEMORY;
}

/* Lists the corners of each marked place, for all of its vertices. */
static void fill_knots(const join *j, const uint32_t *by_place) {
    knurl_mesh *mesh = j->mesh;
    uint32_t first = 0;
    for (uint32_t p = 0; p < j->place_count; p++) {
        const uint32_t *run = &by_place[j->starts[p]];
        const uint32_t count = j->starts[p + 1] - j->starts[p];
        if (!(mesh->across[corner_slot(run[0])] & KNURL_KNOT)) {
            continue;
        }
        memcpy(&mesh->knot_corners[first], run, count * sizeof *run);
        for (uint32_t i = 0; i < count; i++) {
            knurl_knot *knot = &mesh->knots[corner_knot_place(mesh, mesh->triangles[corner_slot(run[i])])];
            knot->first = first;
            knot->count = count;
        }
        first += count;
    }
}

knurl_result knurl_mesh_join(knurl_heap *heap, knurl_mesh *mesh, const uint32_t *places, uint32_t place_count) {
    const size_t corners = 3 * (size_t)mesh->triangle_count;
    join j = {heap, mesh, places, place_count, NULL};
    j.starts = knurl_heap_alloc(heap, (uint64_t)place_count + 2, sizeof *j.starts);
    uint32_t *half_sorted = knurl_heap_alloc(heap, corners, sizeof *half_sorted);
    uint32_t *sorted = knurl_heap_alloc(heap, corners, sizeof *sorted);
    mesh->across = knurl_heap_alloc(heap, corners, sizeof *mesh->across);
    knurl_result result = j.starts && half_sorted && sorted && mesh->across ? KNURL_OK : KNURL_ERROR_MEMORY;
    if (!result) {
        sort_by(&j, upper_end, NULL, half_sorted);
        sort_by(&j, lower_end, half_sorted, sorted);
        join_edges(&j, sorted);
        sort_by(&j, place_of, NULL, sorted);
        const size_t marked = mark_knots(&j, sorted);
        if (marked > 0) {
            result = make_knots(&j, marked);
        }
        if (!result && marked > 0) {
            fill_knots(&j, sorted);
        }
    }
    knurl_heap_free(heap, j.starts);
    knurl_heap_free(heap, half_sorted);
    knurl_heap_free(heap, sorted);
    return result;
}
