/* Builds a mesh from a caller's arrays: welds vertices, drops degenerate triangles, sorts triangles into the leaves of
 * the hierarchy, and renumbers vertices in order of use.
 * SPDX-License-Identifier: MIT */
#include "contact/mesh_build.h"

#include "base/vec3.h"
#include "contact/contact.h"
#include "contact/mesh_adjacency.h"
#include "contact/mesh_normals.h"
#include "contact/mesh_touch.h"
#include "contact/mesh_winding.h"
#include "contact/seeded_hash.h"
#include "contact/uv_scale.h"
#include "contact/weld.h"

#include <string.h>

/* Working data of a build. Arrays hold three entries per triangle, except `welds`. */
typedef struct draft {
    knurl_heap *heap;
    const knurl_mesh_desc *desc;
    knurl_mesh *mesh;
    uint32_t *welds;    /* per vertex of the caller: the first at the same position */
    uint32_t *corners;  /* the caller's vertices */
    uint32_t *vertices; /* the same, renumbered in order of use */
    uint32_t *welded;   /* their welds, renumbered likewise */
    uint32_t vertex_count;
    uint32_t welded_count;
} draft;

static knurl_result weld(draft *d) {
    d->welds = knurl_heap_alloc(d->heap, d->desc->vertex_count, sizeof *d->welds);
    return d->welds ? knurl_mesh_weld(d->heap, d->desc, 0, d->welds) : KNURL_ERROR_MEMORY;
}

/* Twice a triangle's area; 0 if it is shorter than KNURL_EXTENT_MIN or thinner than a float's resolution: the normal of
 * such a one would be noise. */
static double area_of(const draft *d, const uint32_t corners[3]) {
    double p[3][3];
    double edges[3][3];
    double normal[3];
    for (int k = 0; k < 3; k++) {
        for (size_t axis = 0; axis < 3; axis++) {
            p[k][axis] = (double)d->desc->positions[3 * (size_t)corners[k] + axis];
        }
    }
    vec3_sub(p[1], p[0], edges[0]);
    vec3_sub(p[2], p[0], edges[1]);
    vec3_sub(p[2], p[1], edges[2]);
    vec3_cross(edges[0], edges[1], normal);
    const double longest =
        knurl_max(knurl_max(vec3_dot(edges[0], edges[0]), vec3_dot(edges[1], edges[1])), vec3_dot(edges[2], edges[2]));
    const int is_felt =
        longest >= KNURL_EXTENT_MIN * KNURL_EXTENT_MIN && vec3_dot(normal, normal) > 1e-12 * longest * longest;
    return is_felt ? vec3_length(normal) : 0.0;
}

/* Welded corners of a triangle, rotated so that the lowest is first; the winding is kept. */
static void rotate_lowest_first(const draft *d, const uint32_t corners[3], uint32_t out[3]) {
    const uint32_t w[3] = {d->welds[corners[0]], d->welds[corners[1]], d->welds[corners[2]]};
    const int first = w[0] < w[1] ? (w[0] < w[2] ? 0 : 2) : (w[1] < w[2] ? 1 : 2);
    out[0] = w[first];
    out[1] = w[(first + 1) % 3];
    out[2] = w[(first + 2) % 3];
}

/* Corners of the caller's triangle that begins at index i. */
static void read_corners(const knurl_mesh_desc *desc, uint64_t i, uint32_t out[3]) {
    for (uint32_t k = 0; k < 3; k++) {
        out[k] = desc->indices ? desc->indices[i + k] : (uint32_t)(i + k);
    }
}

/* A triangle's first slot in the table of duplicates, the same for both windings. own: receives its corners, welded. */
static uint64_t slot_of(const draft *d, const knurl_seeded_hash *hash, const uint32_t corners[3], uint64_t mask,
                        uint32_t own[3]) {
    rotate_lowest_first(d, corners, own);
    const int ascending = own[1] < own[2];
    return knurl_seeded_hash_of(hash, own[0], own[ascending ? 1 : 2], own[ascending ? 2 : 1]) & mask;
}

/* Compares the triangle after the last with those kept; adds it to the table if its corners are new. Returns 0 if they
 * are new, 1 for a duplicate, -1 for a duplicate with opposite winding. */
static int find_duplicate(const draft *d, const knurl_seeded_hash *hash, uint32_t *table, uint64_t mask) {
    const uint32_t triangle = d->mesh->triangle_count;
    uint32_t own[3];
    uint64_t slot = slot_of(d, hash, &d->corners[3 * (size_t)triangle], mask, own);
    for (; table[slot] != 0; slot = (slot + 1) & mask) {
        uint32_t other[3];
        rotate_lowest_first(d, &d->corners[3 * (size_t)(table[slot] - 1)], other);
        if (other[0] == own[0] && other[1] == own[1] && other[2] == own[2]) {
            return 1;
        }
        if (other[0] == own[0] && other[1] == own[2] && other[2] == own[1]) {
            return -1;
        }
    }
    table[slot] = triangle + 1;
    return 0;
}

/* If triangles with a reversed twin are at most this share of a mesh's area, the twins are mistakes; sheets that are
 * meant to be felt from both sides have a twin nearly everywhere. A common test head has 1 twin in 968 triangles. */
#define FEW_TWINS 0.1

/* Corners: the table's slots are anywhere in memory, and are fetched so far ahead. */
#define AHEAD 24

/* Keeps the triangles that can be felt: those with an area (others have no normal and hold nothing up), and the first
 * of several with the same corners. */
static knurl_result keep_triangles(draft *d) {
    const knurl_mesh_desc *desc = d->desc;
    knurl_mesh *mesh = d->mesh;
    const uint64_t corners = desc->indices ? desc->index_count : desc->vertex_count;
    const uint64_t slots = knurl_table_slots(corners / 3);
    d->corners = knurl_heap_alloc(d->heap, corners, sizeof *d->corners);
    uint32_t *table = knurl_heap_alloc(d->heap, slots, sizeof *table); /* triangle + 1, or 0 */
    double area = 0.0, doubled = 0.0;
    knurl_seeded_hash hash;
    if (!d->corners || !table) {
        knurl_heap_free(d->heap, table);
        return KNURL_ERROR_MEMORY;
    }
    knurl_seeded_hash_init(&hash, d->heap->seed);
    for (uint64_t i = 0; i < corners; i += 3) {
        uint32_t *to = &d->corners[3 * (size_t)mesh->triangle_count];
        read_corners(desc, i, to);
        if (i + AHEAD < corners) {
            uint32_t next[3], own[3];
            read_corners(desc, i + AHEAD, next);
            __builtin_prefetch(&table[slot_of(d, &hash, next, slots - 1, own)]);
        }
        const double size = area_of(d, to);
        const int duplicate = size > 0.0 ? find_duplicate(d, &hash, table, slots - 1) : 1;
        area += duplicate == 0 ? size : 0.0;
        doubled += duplicate < 0 ? size : 0.0;
        mesh->triangle_count += duplicate == 0;
        mesh->facts.dropped += duplicate > 0;
        mesh->facts.reversed_twins += duplicate < 0;
    }
    mesh->double_sided = doubled > FEW_TWINS * area;
    knurl_heap_free(d->heap, table);
    if (mesh->triangle_count == 0) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "mesh: expected a triangle with an area, found %u without",
                          (unsigned)mesh->facts.dropped);
    }
    return KNURL_OK;
}

static knurl_float4 place_of(const draft *d, uint32_t vertex) {
    const float *p = &d->desc->positions[3 * (size_t)vertex];
    return (knurl_float4){p[0], p[1], p[2], 0.0f};
}

static void bound(const draft *d, knurl_box *boxes) {
    for (uint32_t i = 0; i < d->mesh->triangle_count; i++) {
        const uint32_t *v = &d->corners[3 * (size_t)i];
        const knurl_float4 a = place_of(d, v[0]), b = place_of(d, v[1]), c = place_of(d, v[2]);
        boxes[i].min = knurl_float4_min(c, knurl_float4_min(a, b));
        boxes[i].max = knurl_float4_max(c, knurl_float4_max(b, a));
    }
}

/* Builds the hierarchy and sorts the triangles into its leaf order. */
static knurl_result build_hierarchy(draft *d) {
    knurl_mesh *mesh = d->mesh;
    const uint32_t count = mesh->triangle_count;
    knurl_box *boxes = knurl_heap_alloc(d->heap, count, sizeof *boxes);
    uint32_t *order = knurl_heap_alloc(d->heap, count, sizeof *order);
    uint32_t *sorted = knurl_heap_alloc(d->heap, count, 3 * sizeof *sorted);
    knurl_result result = boxes && order && sorted ? KNURL_OK : KNURL_ERROR_MEMORY;
    if (!result) {
        bound(d, boxes);
        result = knurl_bvh_build(d->heap, boxes, count, KNURL_MESH_LEAF, order, &mesh->nodes, &mesh->node_count);
    }
    for (uint32_t i = 0; !result && i < count; i++) {
        memcpy(&sorted[3 * (size_t)i], &d->corners[3 * (size_t)order[i]], 3 * sizeof *sorted);
    }
    knurl_heap_free(d->heap, boxes);
    knurl_heap_free(d->heap, order);
    knurl_heap_free(d->heap, result ? sorted : d->corners);
    d->corners = result ? d->corners : sorted;
    return result;
}

/* Numbers names[corner], or the corners themselves if names is null, in order of first use. Returns the count. */
static uint32_t number_by_use(const draft *d, const uint32_t *names, uint32_t *numbers, uint32_t *out) {
    uint32_t count = 0;
    memset(numbers, 0, d->desc->vertex_count * sizeof *numbers);
    for (size_t i = 0; i < 3 * (size_t)d->mesh->triangle_count; i++) {
        const uint32_t name = names ? names[d->corners[i]] : d->corners[i];
        if (numbers[name] == 0) {
            numbers[name] = ++count;
        }
        out[i] = numbers[name] - 1;
    }
    return count;
}

static knurl_result number_corners(draft *d) {
    const uint64_t corners = 3 * (uint64_t)d->mesh->triangle_count;
    uint32_t *numbers = knurl_heap_alloc(d->heap, d->desc->vertex_count, sizeof *numbers);
    d->vertices = knurl_heap_alloc(d->heap, corners, sizeof *d->vertices);
    d->welded = knurl_heap_alloc(d->heap, corners, sizeof *d->welded);
    const int failed = !numbers || !d->vertices || !d->welded;
    if (!failed) {
        d->vertex_count = number_by_use(d, NULL, numbers, d->vertices);
        d->welded_count = number_by_use(d, d->welds, numbers, d->welded);
    }
    knurl_heap_free(d->heap, numbers);
    return failed ? KNURL_ERROR_MEMORY : KNURL_OK;
}

/* Gathers `width` floats per number from the caller's array of `stride` floats per vertex; null if out of memory. */
static float *gather(const draft *d, const float *values, const uint32_t *numbers, uint32_t count, size_t width,
                     size_t stride) {
    float *out = knurl_heap_alloc(d->heap, count, width * sizeof *out);
    for (size_t i = 0; out && i < 3 * (size_t)d->mesh->triangle_count; i++) {
        memcpy(&out[width * numbers[i]], &values[stride * d->corners[i]], width * sizeof *out);
    }
    return out;
}

/* Welded vertices share a position, but not their uvs and tangents. If there are few such vertices, their positions are
 * duplicated; if there are many (unshared triangles), corners get separate indices for attributes. */
static knurl_result copy_vertices(draft *d) {
    const knurl_mesh_desc *desc = d->desc;
    knurl_mesh *mesh = d->mesh;
    const int has_attributes = desc->uvs || desc->tangents;
    const int apart = has_attributes && d->vertex_count - d->welded_count > mesh->triangle_count;
    const uint32_t *vertices = has_attributes && !apart ? d->vertices : d->welded;
    const size_t bytes = 3 * (size_t)mesh->triangle_count * sizeof *vertices;
    mesh->vertex_count = has_attributes && !apart ? d->vertex_count : d->welded_count;
    mesh->positions = gather(d, desc->positions, vertices, mesh->vertex_count, 3, 3);
    mesh->uvs = desc->uvs ? gather(d, desc->uvs, d->vertices, d->vertex_count, 2, 2) : NULL;
    mesh->tangents = desc->tangents ? gather(d, desc->tangents, d->vertices, d->vertex_count, 3, 4) : NULL;
    mesh->triangles = knurl_heap_alloc(d->heap, bytes, 1);
    mesh->attributes = apart ? knurl_heap_alloc(d->heap, bytes, 1) : NULL;
    if (!mesh->positions || (desc->uvs && !mesh->uvs) || (desc->tangents && !mesh->tangents) || !mesh->triangles ||
        (apart && !mesh->attributes)) {
        return KNURL_ERROR_MEMORY;
    }
    memcpy(mesh->triangles, vertices, bytes);
    if (apart) {
        memcpy(mesh->attributes, d->vertices, bytes);
    }
    return KNURL_OK;
}

/* Largest gap between edges that were meant to meet, from the mesh's size and from the rounding of positions far from
 * the origin. */
static double seam_of(const knurl_mesh *mesh) {
    double size2 = 0.0;
    double farthest = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        const double low = (double)mesh->nodes[0].min[axis], high = (double)mesh->nodes[0].max[axis];
        size2 += (high - low) * (high - low);
        farthest = fmax(farthest, fmax(fabs(low), fabs(high)));
    }
    return fmax(KNURL_SEAM, KNURL_SEAM_SHARE * sqrt(size2)) + ldexp(farthest, -22);
}

static knurl_result build_mesh(draft *d) {
    knurl_result result = weld(d);
    result = result ? result : keep_triangles(d);
    result = result ? result : build_hierarchy(d);
    result = result ? result : number_corners(d);
    result = result ? result : copy_vertices(d);
    result = result ? result : knurl_mesh_link(d->heap, d->mesh, d->welded, d->welded_count);
    if (!result && d->desc->normals) {
        result = knurl_mesh_pack_normals(d->heap, d->desc, d->corners, d->mesh);
    }
    if (!result) {
        d->mesh->facts.seam = seam_of(d->mesh);
        d->mesh->facts.touching = knurl_mesh_count_touching(d->mesh);
        result = knurl_mesh_unify_winding(d->heap, d->mesh);
    }
    if (!result) {
        result = knurl_mesh_measure_uvs(d->heap, d->mesh);
    }
    if (!result && d->mesh->normals) {
        knurl_mesh_settle_normals(d->heap, d->mesh);
    }
    knurl_heap_free(d->heap, d->welds);
    knurl_heap_free(d->heap, d->corners);
    knurl_heap_free(d->heap, d->vertices);
    knurl_heap_free(d->heap, d->welded);
    return result;
}

knurl_result knurl_mesh_create(knurl_heap *heap, const knurl_mesh_desc *desc, knurl_mesh **mesh) {
    draft d = {heap, desc, knurl_heap_alloc(heap, 1, sizeof *d.mesh), NULL, NULL, NULL, NULL, 0, 0};
    if (!d.mesh) {
        return KNURL_ERROR_MEMORY;
    }
    const knurl_result result = build_mesh(&d);
    if (result) {
        knurl_mesh_destroy(heap, d.mesh);
        return result;
    }
    *mesh = d.mesh;
    return KNURL_OK;
}
