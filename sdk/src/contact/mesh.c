/* Checks descriptions of meshes, frees meshes and counts their bytes. SPDX-License-Identifier: MIT */
#include "contact/mesh.h"

#include "base/vec3.h"

static knurl_result check_floats(const float *values, uint64_t count, const char *what, uint32_t width) {
    for (uint64_t i = 0; i < count; i++) {
        if (!(fabs((double)values[i]) <= KNURL_COORDINATE_MAX)) {
            return knurl_fail(KNURL_ERROR_ARGUMENT, "mesh.%s: expected numbers from %g to %g, found %g at vertex %llu",
                              what, -KNURL_COORDINATE_MAX, KNURL_COORDINATE_MAX, (double)values[i],
                              (unsigned long long)(i / width));
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

void knurl_mesh_triangle(const knurl_mesh *mesh, uint32_t triangle, knurl_triangle *out) {
    double edge1[3];
    double edge2[3];
    knurl_mesh_corners(mesh, triangle, out->corners);
    vec3_sub(out->corners[1], out->corners[0], edge1);
    vec3_sub(out->corners[2], out->corners[0], edge2);
    vec3_cross(edge1, edge2, out->normal);
    out->area_twice = vec3_normalise(out->normal);
}

void knurl_mesh_destroy(knurl_heap *heap, knurl_mesh *mesh) {
    if (mesh) {
        void *const parts[] = {mesh->positions,  mesh->tangents, mesh->uvs,          mesh->triangles,
                               mesh->attributes, mesh->opposite, mesh->non_manifold, mesh->non_manifold_corners,
                               mesh->nodes,      mesh->normals};
        for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
            knurl_heap_free(heap, parts[i]);
        }
        knurl_heap_free(heap, mesh);
    }
}

uint64_t knurl_mesh_bytes(const knurl_mesh *mesh) {
    const void *const parts[] = {mesh,           mesh->positions,    mesh->tangents,
                                 mesh->uvs,      mesh->triangles,    mesh->attributes,
                                 mesh->opposite, mesh->non_manifold, mesh->non_manifold_corners,
                                 mesh->nodes,    mesh->normals};
    uint64_t bytes = 0;
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        bytes += knurl_heap_size(parts[i]);
    }
    return bytes;
}
