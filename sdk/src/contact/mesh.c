/* From a caller's arrays to a mesh that can be touched. SPDX-License-Identifier: MIT */
#include "contact/mesh.h"

#include "base/vec3.h"

#include <string.h>

/* Triangles in a leaf, at most. */
#define LEAF_SIZE 4

static knurl_result check_floats(const float *values, uint64_t count, const char *what, uint32_t width) {
    for (uint64_t i = 0; i < count; i++) {
        if (!isfinite(values[i])) {
            return knurl_fail(KNURL_ERROR_ARGUMENT, "mesh.%s: expected finite numbers, found %g at vertex %llu", what,
                              (double)values[i], (unsigned long long)(i / width));
        }
    }
    return KNURL_OK;
}

knurl_result knurl_mesh_check(const knurl_mesh_desc *d) {
    if (d->vertex_count < 3 || d->vertex_count > 1u << 28) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "mesh.vertex_count: expected 3 to 2^28, found %u",
                          (unsigned)d->vertex_count);
    }
    if (!d->positions) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "mesh.positions: expected an array, found null");
    }
    const uint64_t corners = d->indices ? d->index_count : d->vertex_count;
    if (corners < 3 || corners % 3 != 0 || corners > (uint64_t)3 << 26) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "mesh: expected a multiple of 3 corners, 3 to 3 x 2^26, found %llu",
                          (unsigned long long)corners);
    }
    for (uint64_t i = 0; d->indices && i < corners; i++) {
        if (d->indices[i] >= d->vertex_count) {
            return knurl_fail(KNURL_ERROR_ARGUMENT, "mesh.indices[%llu]: expected below %u vertices, found %u",
                              (unsigned long long)i, (unsigned)d->vertex_count, (unsigned)d->indices[i]);
        }
    }
    knurl_result result = check_floats(d->positions, 3 * (uint64_t)d->vertex_count, "positions", 3);
    if (!result && d->uvs) {
        result = check_floats(d->uvs, 2 * (uint64_t)d->vertex_count, "uvs", 2);
    }
    if (!result && d->tangents) {
        result = check_floats(d->tangents, 4 * (uint64_t)d->vertex_count, "tangents", 4);
    }
    return result;
}

static void corner(const knurl_mesh *mesh, uint32_t vertex, double out[3]) {
    for (int axis = 0; axis < 3; axis++) {
        out[axis] = (double)mesh->positions[3 * (size_t)vertex + (size_t)axis];
    }
}

void knurl_mesh_triangle(const knurl_mesh *mesh, uint32_t triangle, knurl_triangle *out) {
    double edge1[3];
    double edge2[3];
    for (uint32_t i = 0; i < 3; i++) {
        corner(mesh, mesh->triangles[3 * (size_t)triangle + i], out->corners[i]);
    }
    vec3_sub(out->corners[1], out->corners[0], edge1);
    vec3_sub(out->corners[2], out->corners[0], edge2);
    vec3_cross(edge1, edge2, out->normal);
    out->area2 = vec3_normalise(out->normal);
}

int knurl_mesh_uv_frame(const knurl_mesh *mesh, uint32_t triangle, double du[3], double dv[3]) {
    if (!mesh->uvs) {
        return 0;
    }
    knurl_triangle t;
    double uv[3][2];
    double edge1[3];
    double edge2[3];
    knurl_mesh_triangle(mesh, triangle, &t);
    for (uint32_t i = 0; i < 3; i++) {
        const uint32_t vertex = mesh->triangles[3 * (size_t)triangle + i];
        uv[i][0] = (double)mesh->uvs[2 * (size_t)vertex];
        uv[i][1] = (double)mesh->uvs[2 * (size_t)vertex + 1];
    }
    vec3_sub(t.corners[1], t.corners[0], edge1);
    vec3_sub(t.corners[2], t.corners[0], edge2);
    const double u1 = uv[1][0] - uv[0][0], v1 = uv[1][1] - uv[0][1];
    const double u2 = uv[2][0] - uv[0][0], v2 = uv[2][1] - uv[0][1];
    const double det = u1 * v2 - u2 * v1;
    const double largest = fmax(fmax(fabs(u1), fabs(u2)), fmax(fabs(v1), fabs(v2)));
    if (!(fabs(det) > 1e-9 * largest * largest)) { /* the uvs are floats: below that they lie on a line */
        return 0;
    }
    for (int axis = 0; axis < 3; axis++) {
        du[axis] = (v2 * edge1[axis] - v1 * edge2[axis]) / det;
        dv[axis] = (u1 * edge2[axis] - u2 * edge1[axis]) / det;
    }
    return vec3_length(du) > 0.0 && vec3_length(dv) > 0.0;
}

/* Area-weighted means of |dP/du|, |dP/dv|, and how far the uvs stretch from them. */
static void measure_uvs(knurl_mesh *mesh) {
    double area = 0.0;
    double sums[2] = {0.0, 0.0};
    double inverse_sum = 0.0;
    double shortest = HUGE_VAL;
    double longest = 0.0;
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        double du[3];
        double dv[3];
        knurl_triangle t;
        if (knurl_mesh_uv_frame(mesh, i, du, dv)) {
            knurl_mesh_triangle(mesh, i, &t);
            const double length = vec3_length(du);
            area += t.area2;
            sums[0] += t.area2 * length;
            sums[1] += t.area2 * vec3_length(dv);
            inverse_sum += t.area2 / length;
            shortest = length < shortest ? length : shortest;
            longest = length > longest ? length : longest;
        }
    }
    mesh->stretch_u[0] = mesh->stretch_u[1] = mesh->stretch_u[2] = 1.0;
    if (area > 0.0) {
        mesh->uv_scale[0] = sums[0] / area;
        mesh->uv_scale[1] = sums[1] / area;
        mesh->stretch_u[0] = mesh->uv_scale[0] / longest;
        mesh->stretch_u[1] = mesh->uv_scale[0] * inverse_sum / area;
        mesh->stretch_u[2] = mesh->uv_scale[0] / shortest;
    }
}

static uint64_t hash_position(const float *p) {
    uint64_t hash = 0xcbf29ce484222325u;
    for (int axis = 0; axis < 3; axis++) {
        const float value = p[axis] + 0.0f; /* -0 and 0 are one place */
        uint32_t bits;
        memcpy(&bits, &value, sizeof bits);
        hash = (hash ^ bits) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 29;
    }
    return hash;
}

/* Vertices at exactly the same place become one for the walk over the surface (uv seams and hard edges double them). */
static knurl_result weld(knurl_heap *heap, knurl_mesh *mesh) {
    uint64_t slots = 16;
    while (slots < 2 * (uint64_t)mesh->vertex_count) {
        slots *= 2;
    }
    uint32_t *table = knurl_heap_alloc(heap, slots, sizeof *table); /* vertex + 1, or 0 */
    if (!table) {
        return KNURL_ERROR_MEMORY;
    }
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        const float *p = &mesh->positions[3 * (size_t)v];
        uint64_t slot = hash_position(p) & (slots - 1);
        while (table[slot] != 0) {
            const float *q = &mesh->positions[3 * (size_t)(table[slot] - 1)];
            if (p[0] == q[0] && p[1] == q[1] && p[2] == q[2]) {
                break;
            }
            slot = (slot + 1) & (slots - 1);
        }
        if (table[slot] == 0) {
            table[slot] = v + 1;
        }
        mesh->welds[v] = table[slot] - 1;
    }
    knurl_heap_free(heap, table);
    return KNURL_OK;
}

/* Copies the triangles that have an area; the others hold nothing up and would have no normal. */
static knurl_result copy_triangles(const knurl_mesh_desc *d, knurl_mesh *mesh) {
    const uint64_t corners = d->indices ? d->index_count : d->vertex_count;
    for (uint64_t i = 0; i < corners; i += 3) {
        uint32_t *to = &mesh->triangles[3 * (size_t)mesh->triangle_count];
        knurl_triangle t;
        double longest = 0.0;
        for (uint32_t k = 0; k < 3; k++) {
            to[k] = d->indices ? d->indices[i + k] : (uint32_t)(i + k);
        }
        knurl_mesh_triangle(mesh, mesh->triangle_count, &t);
        for (int k = 0; k < 3; k++) {
            double edge[3];
            vec3_sub(t.corners[(k + 1) % 3], t.corners[k], edge);
            longest = fmax(longest, vec3_dot(edge, edge));
        }
        /* Thinner than float's own resolution, the normal would be noise. */
        if (t.area2 > 1e-6 * longest) {
            mesh->triangle_count++;
        } else {
            mesh->dropped++;
        }
    }
    if (mesh->triangle_count == 0) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "mesh: expected a triangle with an area, found %u without",
                          (unsigned)mesh->dropped);
    }
    return KNURL_OK;
}

static knurl_result make_fans(knurl_heap *heap, knurl_mesh *mesh) {
    const size_t corners = 3 * (size_t)mesh->triangle_count;
    mesh->fan_starts = knurl_heap_alloc(heap, (uint64_t)mesh->vertex_count + 1, sizeof *mesh->fan_starts);
    mesh->fans = knurl_heap_alloc(heap, corners, sizeof *mesh->fans);
    if (!mesh->fan_starts || !mesh->fans) {
        return KNURL_ERROR_MEMORY;
    }
    for (size_t i = 0; i < corners; i++) {
        mesh->fan_starts[mesh->welds[mesh->triangles[i]] + 1]++;
    }
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        mesh->fan_starts[v + 1] += mesh->fan_starts[v];
    }
    for (size_t i = corners; i-- > 0;) { /* backwards: each start moves down its own run, and ends one run too low */
        const uint32_t v = mesh->welds[mesh->triangles[i]];
        mesh->fans[--mesh->fan_starts[v + 1]] = (uint32_t)(i / 3);
    }
    memmove(mesh->fan_starts, mesh->fan_starts + 1, mesh->vertex_count * sizeof *mesh->fan_starts);
    mesh->fan_starts[mesh->vertex_count] = (uint32_t)corners;
    return KNURL_OK;
}

static knurl_result copy_vertices(knurl_heap *heap, const knurl_mesh_desc *d, knurl_mesh *mesh) {
    const uint64_t n = d->vertex_count;
    mesh->vertex_count = d->vertex_count;
    mesh->positions = knurl_heap_alloc(heap, n, 3 * sizeof(float));
    mesh->uvs = d->uvs ? knurl_heap_alloc(heap, n, 2 * sizeof(float)) : NULL;
    mesh->tangents = d->tangents ? knurl_heap_alloc(heap, n, 3 * sizeof(float)) : NULL;
    mesh->welds = knurl_heap_alloc(heap, n, sizeof *mesh->welds);
    mesh->triangles = knurl_heap_alloc(heap, d->indices ? d->index_count : n, sizeof *mesh->triangles);
    if (!mesh->positions || (d->uvs && !mesh->uvs) || (d->tangents && !mesh->tangents) || !mesh->welds ||
        !mesh->triangles) {
        return KNURL_ERROR_MEMORY;
    }
    memcpy(mesh->positions, d->positions, (size_t)n * 3 * sizeof(float));
    if (d->uvs) {
        memcpy(mesh->uvs, d->uvs, (size_t)n * 2 * sizeof(float));
    }
    for (size_t v = 0; d->tangents && v < n; v++) {
        memcpy(&mesh->tangents[3 * v], &d->tangents[4 * v], 3 * sizeof(float));
    }
    return weld(heap, mesh);
}

/* Builds the hierarchy and puts the triangles into its leaf order. */
static knurl_result build_hierarchy(knurl_heap *heap, knurl_mesh *mesh) {
    const uint32_t count = mesh->triangle_count;
    knurl_box *boxes = knurl_heap_alloc(heap, count, sizeof *boxes);
    uint32_t *order = knurl_heap_alloc(heap, count, sizeof *order);
    uint32_t *sorted = knurl_heap_alloc(heap, count, 3 * sizeof *sorted);
    knurl_result result = boxes && order && sorted ? KNURL_OK : KNURL_ERROR_MEMORY;
    for (uint32_t i = 0; !result && i < count; i++) {
        for (int axis = 0; axis < 3; axis++) {
            const uint32_t *v = &mesh->triangles[3 * (size_t)i];
            const float a = mesh->positions[3 * (size_t)v[0] + (size_t)axis];
            const float b = mesh->positions[3 * (size_t)v[1] + (size_t)axis];
            const float c = mesh->positions[3 * (size_t)v[2] + (size_t)axis];
            boxes[i].min[axis] = fminf(a, fminf(b, c));
            boxes[i].max[axis] = fmaxf(a, fmaxf(b, c));
        }
    }
    result = result ? result : knurl_bvh_build(heap, boxes, count, LEAF_SIZE, order, &mesh->nodes, &mesh->node_count);
    for (uint32_t i = 0; !result && i < count; i++) {
        memcpy(&sorted[3 * (size_t)i], &mesh->triangles[3 * (size_t)order[i]], 3 * sizeof *sorted);
    }
    knurl_heap_free(heap, boxes);
    knurl_heap_free(heap, order);
    if (!result) {
        uint32_t *unsorted = mesh->triangles;
        mesh->triangles = sorted;
        sorted = unsorted;
    }
    knurl_heap_free(heap, sorted);
    return result;
}

knurl_result knurl_mesh_create(knurl_heap *heap, const knurl_mesh_desc *desc, knurl_mesh **mesh) {
    knurl_mesh *made = knurl_heap_alloc(heap, 1, sizeof *made);
    if (!made) {
        return KNURL_ERROR_MEMORY;
    }
    knurl_result result = copy_vertices(heap, desc, made);
    result = result ? result : copy_triangles(desc, made);
    result = result ? result : build_hierarchy(heap, made);
    result = result ? result : make_fans(heap, made);
    if (result) {
        knurl_mesh_destroy(heap, made);
        return result;
    }
    measure_uvs(made);
    *mesh = made;
    return KNURL_OK;
}

void knurl_mesh_destroy(knurl_heap *heap, knurl_mesh *mesh) {
    if (mesh) {
        void *const parts[] = {mesh->positions, mesh->tangents,   mesh->uvs,  mesh->triangles,
                               mesh->welds,     mesh->fan_starts, mesh->fans, mesh->nodes};
        for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
            knurl_heap_free(heap, parts[i]);
        }
        knurl_heap_free(heap, mesh);
    }
}

uint64_t knurl_mesh_bytes(const knurl_mesh *mesh) {
    const void *const parts[] = {mesh,        mesh->positions,  mesh->tangents, mesh->uvs,  mesh->triangles,
                                 mesh->welds, mesh->fan_starts, mesh->fans,     mesh->nodes};
    uint64_t bytes = 0;
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        bytes += knurl_heap_size(parts[i]);
    }
    return bytes;
}
