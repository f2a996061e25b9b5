/* Reads meshes. SPDX-License-Identifier: MIT */
#include "mesh.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ARRAY_VERTEX = 0, ARRAY_NORMAL = 1, ARRAY_TANGENT = 2, ARRAY_TEX_UV = 4, ARRAY_INDEX = 12, ARRAY_MAX = 13 };
enum { PRIMITIVE_TRIANGLES = 3 };

/* A packed array from an Array of arrays; empty if it is of another type. */
typedef struct packed {
    GDExtensionVariantType type; /* NIL: empty */
    uint64_t opaque[2];
    int64_t size;
} packed;

static packed take(const void *arrays, int index, GDExtensionVariantType type, GDExtensionPtrBuiltInMethod size) {
    packed p = {GDEXTENSION_VARIANT_TYPE_NIL, {0, 0}, 0};
    GDExtensionVariantPtr found = gd.array_operator_index_const(arrays, index);
    if (found && gd.variant_get_type(found) == type) {
        p.type = type;
        gd_types[type].from_variant(p.opaque, found);
        size(p.opaque, NULL, &p.size, 0);
    }
    return p;
}

static void end(packed *p) {
    if (p->type != GDEXTENSION_VARIANT_TYPE_NIL) {
        gd_types[p->type].end(p->opaque);
    }
}

static int grow(void *array, uint64_t count, size_t size) {
    void *old;
    memcpy(&old, array, sizeof old);
    void *made = realloc(old, (size_t)count * size);
    if (!made) {
        return 0;
    }
    memcpy(array, &made, sizeof made);
    return 1;
}

static void transform(const double m[9], const float from[3], float to[3]) {
    for (int i = 0; i < 3; i++) {
        to[i] = (float)(m[3 * i] * (double)from[0] + m[3 * i + 1] * (double)from[1] + m[3 * i + 2] * (double)from[2]);
    }
}

/* The matrix by which normals turn: the inverse's transpose, times a positive number. */
static void normals_by(const double m[9], double out[9]) {
    for (int i = 0; i < 9; i++) {
        const int row = 3 * ((i / 3 + 1) % 3), last_row = 3 * ((i / 3 + 2) % 3);
        const int column = (i % 3 + 1) % 3, last = (i % 3 + 2) % 3;
        out[i] = m[row + column] * m[last_row + last] - m[row + last] * m[last_row + column];
    }
    const double side = m[0] * out[0] + m[1] * out[1] + m[2] * out[2] < 0.0 ? -1.0 : 1.0; /* < 0: a mirror */
    for (int i = 0; i < 9; i++) {
        out[i] *= side;
    }
}

static double determinant(const double m[9]) {
    return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) + m[2] * (m[3] * m[7] - m[4] * m[6]);
}

/* Copied unchanged if no matrix is baked in: Knurl gets the same floats that the engine draws. */
static void add_positions(const float *from, uint32_t count, const mesh_place *place, mesh_data *data) {
    static const mesh_place identity = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0}};
    float *to = data->positions + 3 * (size_t)data->vertex_count;
    int is_identity = 1;
    for (int i = 0; i < 9; i++) {
        is_identity = is_identity && place->matrix[i] == identity.matrix[i] && place->offset[i % 3] == 0.0;
    }
    if (is_identity) {
        memcpy(to, from, 3 * (size_t)count * sizeof *to);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        transform(place->matrix, from + 3 * i, to + 3 * i);
        for (int k = 0; k < 3; k++) {
            to[3 * i + (size_t)k] += (float)place->offset[k];
        }
    }
}

/* Four floats per vertex; doubles in some meshes. */
static void add_tangents(const void *arrays, uint32_t count, const double baked[9], mesh_data *data) {
    packed singles = take(arrays, ARRAY_TANGENT, GDEXTENSION_VARIANT_TYPE_PACKED_FLOAT32_ARRAY,
                          gd_builtin.PACKED_FLOAT32_ARRAY_size);
    packed doubles = take(arrays, ARRAY_TANGENT, GDEXTENSION_VARIANT_TYPE_PACKED_FLOAT64_ARRAY,
                          gd_builtin.PACKED_FLOAT64_ARRAY_size);
    const int64_t wanted = 4 * (int64_t)count;
    float *to = data->tangents + 4 * (size_t)data->vertex_count;
    if (singles.size == wanted) {
        memcpy(to, gd.packed_float32_array_operator_index_const(singles.opaque, 0), (size_t)wanted * sizeof *to);
    } else if (doubles.size == wanted) {
        const double *from = gd.packed_float64_array_operator_index_const(doubles.opaque, 0);
        for (int64_t i = 0; i < wanted; i++) {
            to[i] = (float)from[i];
        }
    } else {
        data->has_tangents = 0;
    }
    for (uint32_t i = 0; i < count && data->has_tangents; i++) {
        const float from[3] = {to[4 * i], to[4 * i + 1], to[4 * i + 2]};
        transform(baked, from, to + 4 * (size_t)i);
    }
    end(&singles);
    end(&doubles);
}

static void add_normals(const void *arrays, uint32_t count, const double baked[9], mesh_data *data) {
    packed normals =
        take(arrays, ARRAY_NORMAL, GDEXTENSION_VARIANT_TYPE_PACKED_VECTOR3_ARRAY, gd_builtin.PACKED_VECTOR3_ARRAY_size);
    float *to = data->normals + 3 * (size_t)data->vertex_count;
    double turn[9];
    data->has_normals = data->has_normals && normals.size == (int64_t)count;
    normals_by(baked, turn);
    const float *from = data->has_normals ? gd.packed_vector3_array_operator_index_const(normals.opaque, 0) : NULL;
    for (size_t i = 0; from && i < 3 * (size_t)count; i += 3) {
        const double n[3] = {(double)from[i], (double)from[i + 1], (double)from[i + 2]};
        double turned[3];
        for (int k = 0; k < 3; k++) {
            turned[k] = turn[3 * k] * n[0] + turn[3 * k + 1] * n[1] + turn[3 * k + 2] * n[2];
        }
        const double length = sqrt(turned[0] * turned[0] + turned[1] * turned[1] + turned[2] * turned[2]);
        for (size_t k = 0; k < 3; k++) {
            to[i + k] = (float)(length > 0.0 ? turned[k] / length : 0.0);
        }
    }
    end(&normals);
}

/* UVs grow with a mesh's size, so that instances of different sizes have as many metres per u: Knurl knows one mean. */
static void add_uvs(const void *arrays, uint32_t count, const double matrix[9], mesh_data *data) {
    const double size = cbrt(fabs(determinant(matrix)));
    packed uvs =
        take(arrays, ARRAY_TEX_UV, GDEXTENSION_VARIANT_TYPE_PACKED_VECTOR2_ARRAY, gd_builtin.PACKED_VECTOR2_ARRAY_size);
    if (uvs.size == (int64_t)count) {
        const float *from = gd.packed_vector2_array_operator_index_const(uvs.opaque, 0);
        float *to = data->uvs + 2 * (size_t)data->vertex_count;
        for (size_t i = 0; i < 2 * (size_t)count; i++) {
            to[i] = (float)(size * (double)from[i]);
        }
    } else {
        data->has_uvs = 0;
    }
    end(&uvs);
}

/* The index of corner `i` after the winding is reversed: the engine's front faces are clockwise, unless a mirror is
 * baked in. */
static uint64_t turned(uint64_t i, int is_mirrored) {
    const uint64_t corner = i % 3;
    return is_mirrored || corner == 0 ? i : corner == 1 ? i + 1 : i - 1;
}

static int add_indices(const void *arrays, uint32_t count, int is_mirrored, mesh_data *data) {
    packed given =
        take(arrays, ARRAY_INDEX, GDEXTENSION_VARIANT_TYPE_PACKED_INT32_ARRAY, gd_builtin.PACKED_INT32_ARRAY_size);
    const int64_t all = given.size > 0 ? given.size : (int64_t)count;
    const uint64_t added = (uint64_t)(all - all % 3);
    const int fits = grow(&data->indices, data->index_count + added, sizeof *data->indices);
    if (fits) {
        const int32_t *from = given.size > 0 ? gd.packed_int32_array_operator_index_const(given.opaque, 0) : NULL;
        uint32_t *to = data->indices + data->index_count;
        for (uint64_t i = 0; i < added; i++) {
            to[turned(i, is_mirrored)] = data->vertex_count + (from ? (uint32_t)from[i] : (uint32_t)i);
        }
        data->index_count += added;
    }
    end(&given);
    return fits;
}

static int add_surface(const void *arrays, const mesh_place *place, mesh_data *data) {
    int64_t array_count = 0;
    gd_builtin.ARRAY_size(gd_unconst(arrays), NULL, &array_count, 0);
    if (array_count < ARRAY_MAX) {
        return 1;
    }
    packed positions =
        take(arrays, ARRAY_VERTEX, GDEXTENSION_VARIANT_TYPE_PACKED_VECTOR3_ARRAY, gd_builtin.PACKED_VECTOR3_ARRAY_size);
    const uint32_t count = positions.size < 3 || positions.size > 1 << 28 ? 0 : (uint32_t)positions.size;
    const uint64_t total = (uint64_t)data->vertex_count + count;
    int fits = 1;
    if (count > 0) {
        fits = grow(&data->positions, total, 3 * sizeof(float)) && grow(&data->normals, total, 3 * sizeof(float)) &&
               grow(&data->tangents, total, 4 * sizeof(float)) && grow(&data->uvs, total, 2 * sizeof(float)) &&
               add_indices(arrays, count, determinant(place->matrix) < 0.0, data);
    }
    if (count > 0 && fits) {
        add_positions(gd.packed_vector3_array_operator_index_const(positions.opaque, 0), count, place, data);
        add_normals(arrays, count, place->matrix, data);
        add_tangents(arrays, count, place->matrix, data);
        add_uvs(arrays, count, place->matrix, data);
        data->vertex_count = (uint32_t)total;
    }
    end(&positions);
    return fits;
}

/* Lines, points and strips have no triangles of their own; meshes other than ArrayMesh consist of triangles. */
static int has_triangles(GDExtensionObjectPtr array_mesh, int64_t index) {
    int64_t primitive = PRIMITIVE_TRIANGLES;
    if (array_mesh) {
        gd_call(gd_method.ArrayMesh_surface_get_primitive_type, array_mesh, &index, &primitive);
    }
    return primitive == PRIMITIVE_TRIANGLES;
}

void mesh_begin(mesh_data *data) {
    memset(data, 0, sizeof *data);
    data->has_normals = data->has_tangents = data->has_uvs = 1;
}

/* Like a surface's arrays with positions only. */
int mesh_add_faces(const void *corners, const mesh_place *place, mesh_data *data) {
    const int is_mirrored = determinant(place->matrix) < 0.0;
    int64_t size = 0;
    gd_builtin.PACKED_VECTOR3_ARRAY_size(gd_unconst(corners), NULL, &size, 0);
    const uint32_t count = size < 3 || size > 1 << 28 ? 0 : (uint32_t)(size - size % 3);
    const uint64_t total = (uint64_t)data->vertex_count + count;
    if (count == 0) {
        return 1;
    }
    if (!grow(&data->positions, total, 3 * sizeof(float)) ||
        !grow(&data->indices, data->index_count + count, sizeof *data->indices)) {
        return 0;
    }
    add_positions(gd.packed_vector3_array_operator_index_const(corners, 0), count, place, data);
    for (uint32_t i = 0; i < count; i++) {
        data->indices[data->index_count++] = data->vertex_count + (uint32_t)turned(i, is_mirrored);
    }
    data->vertex_count = (uint32_t)total;
    data->has_normals = data->has_tangents = data->has_uvs = 0;
    return 1;
}

int mesh_add(GDExtensionObjectPtr mesh, const mesh_place *place, mesh_data *data) {
    const GDExtensionObjectPtr array_mesh = gd_cast(mesh, "ArrayMesh");
    int64_t count = 0;
    int fits = 1;
    gd_call(gd_method.Mesh_get_surface_count, mesh, NULL, &count);
    for (int64_t i = 0; i < count && fits; i++) {
        if (has_triangles(array_mesh, i)) {
            uint64_t arrays;
            gd_variant held = gd_call_variant(gd_method.Mesh_surface_get_arrays, mesh, i);
            gd_types[GDEXTENSION_VARIANT_TYPE_ARRAY].from_variant(&arrays, &held);
            fits = add_surface(&arrays, place, data);
            gd_types[GDEXTENSION_VARIANT_TYPE_ARRAY].end(&arrays);
            gd.variant_destroy(&held);
        }
    }
    return fits;
}

void mesh_end(mesh_data *data) {
    free(data->positions);
    free(data->normals);
    free(data->tangents);
    free(data->uvs);
    free(data->indices);
    memset(data, 0, sizeof *data);
}

void mesh_describe(const mesh_data *data, knurl_mesh_desc *desc) {
    knurl_mesh_desc_init(desc, sizeof *desc);
    desc->vertex_count = data->vertex_count;
    desc->positions = data->positions;
    desc->normals = data->has_normals ? data->normals : NULL;
    desc->tangents = data->has_tangents ? data->tangents : NULL;
    desc->uvs = data->has_uvs ? data->uvs : NULL;
    desc->indices = data->indices;
    desc->index_count = data->index_count;
}
