/* Decides which triangles of a mesh are felt curved, from the normals at their corners. Normals are packed into four
 * bytes: two coordinates of the octahedron that they point to, off by 0.003 degrees at most (Meyer, Suessmuth,
 * Sussner, Stamminger and Greiner 2010). SPDX-License-Identifier: MIT */
#include "contact/mesh_normals.h"

#include "contact/patch.h"

/* A given normal's length may be off by this: normals stored as bytes are off by 0.01. */
#define LENGTH_TOLERANCE 0.1

/* A triangle is felt flat if its normals are within 0.1 degrees of its face's and its patch within 1 um of it: less
 * than the steps in force and direction that a hand feels, or that an encoder resolves. */
#define FLAT_COSINE 0.99999848
#define FLAT_HEIGHT 1e-6

/* A normal more than 60 degrees off its face does not describe the surface. */
#define BAD_COSINE 0.5

/* A patch folds if it, or its normal, turns away from the triangle: if the area of a piece of it, seen along the
 * face's normal, is below this share of the triangle's. Tested at ten points. */
#define FOLD_SHARE 0.1

/* Within 10 degrees of the face, normals move a patch sideways by 1 % of its edges at most: not tested. */
#define FOLD_COSINE 0.985

static uint32_t pack_number(double x) {
    return (uint32_t)(uint16_t)(int16_t)lrint(x * 32767.0);
}

uint32_t knurl_mesh_pack_normal(const double n[3]) {
    const double size = fabs(n[0]) + fabs(n[1]) + fabs(n[2]);
    double x = n[0] / size, y = n[1] / size;
    if (n[2] < 0.0) {
        const double folded = (1.0 - fabs(y)) * (x < 0.0 ? -1.0 : 1.0);
        y = (1.0 - fabs(x)) * (y < 0.0 ? -1.0 : 1.0);
        x = folded;
    }
    return pack_number(x) << 16 | pack_number(y);
}

static void unpack(uint32_t packed, double n[3]) {
    n[0] = (double)(int16_t)(uint16_t)(packed >> 16) / 32767.0;
    n[1] = (double)(int16_t)(uint16_t)packed / 32767.0;
    n[2] = 1.0 - fabs(n[0]) - fabs(n[1]);
    if (n[2] < 0.0) {
        const double x = n[0];
        n[0] = (1.0 - fabs(n[1])) * (x < 0.0 ? -1.0 : 1.0);
        n[1] = (1.0 - fabs(x)) * (n[1] < 0.0 ? -1.0 : 1.0);
    }
    (void)vec3_normalise(n);
}

void knurl_mesh_normals(const knurl_mesh *mesh, uint32_t triangle, const double corners[3][3], double normals[3][3]) {
    const uint32_t *packed = &mesh->normals[3 * (size_t)triangle];
    for (int k = 0; k < 3; k++) {
        if (packed[k] == KNURL_NORMAL_OF_FACE) {
            double ab[3], ac[3];
            vec3_sub(corners[1], corners[0], ab);
            vec3_sub(corners[2], corners[0], ac);
            vec3_cross(ab, ac, normals[k]);
            (void)vec3_normalise(normals[k]);
        } else {
            unpack(packed[k], normals[k]);
        }
    }
}

/* The caller's normal of a vertex, packed; the face's if it is not a unit vector. */
static uint32_t pack_given(const float *given) {
    const double n[3] = {(double)given[0], (double)given[1], (double)given[2]};
    const double length = vec3_length(n);
    return fabs(length - 1.0) <= LENGTH_TOLERANCE ? knurl_mesh_pack_normal(n) : KNURL_NORMAL_OF_FACE;
}

knurl_result knurl_mesh_pack_normals(knurl_heap *heap, const knurl_mesh_desc *desc, const uint32_t *corners,
                                     knurl_mesh *mesh) {
    const size_t count = 3 * (size_t)mesh->triangle_count;
    mesh->normals = knurl_heap_alloc(heap, count, sizeof *mesh->normals);
    for (size_t i = 0; mesh->normals && i < count; i++) {
        mesh->normals[i] = pack_given(&desc->normals[3 * (size_t)corners[i]]);
    }
    return mesh->normals ? KNURL_OK : KNURL_ERROR_MEMORY;
}

/* How a triangle is felt; BAD: flat, because its normals do not describe a surface. */
enum { FLAT, CURVED, BAD };

static int folds(const knurl_patch *patch, const double face[3], double area_twice) {
    for (int i = 0; i <= 3; i++) {
        for (int k = 0; k <= 3 - i; k++) {
            const double w[3] = {i / 3.0, k / 3.0, (3 - i - k) / 3.0};
            knurl_patch_point at;
            double point[3], across[3];
            knurl_patch_at(patch, w, patch->corners[0], &at);
            vec3_copy(at.point, point);
            knurl_patch_at(patch, w, point, &at); /* its tangents at height 0 */
            vec3_cross(at.tangents[0], at.tangents[1], across);
            if (!(vec3_dot(across, face) > FOLD_SHARE * area_twice)) {
                return 1;
            }
        }
    }
    return 0;
}

/* normals: unit. height: m, of the highest control point. */
static int judge(const double corners[3][3], const double normals[3][3], double *height) {
    double face[3], ab[3], ac[3], least = 1.0;
    knurl_patch patch;
    vec3_sub(corners[1], corners[0], ab);
    vec3_sub(corners[2], corners[0], ac);
    vec3_cross(ab, ac, face);
    const double area_twice = vec3_normalise(face);
    knurl_patch_set(corners, normals, &patch);
    *height = 0.0;
    for (int i = 0; i < 3; i++) {
        least = knurl_min(least, vec3_dot(face, normals[i]));
        for (int k = 0; k < 3; k++) {
            *height = knurl_max(*height, fabs(patch.heights[i][k]));
        }
    }
    if (least >= FLAT_COSINE && *height <= FLAT_HEIGHT) {
        return FLAT;
    }
    return least >= FOLD_COSINE || (least >= BAD_COSINE && !folds(&patch, face, area_twice)) ? CURVED : BAD;
}

void knurl_mesh_settle_normals(knurl_heap *heap, knurl_mesh *mesh) {
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        uint32_t *packed = &mesh->normals[3 * (size_t)t];
        const int is_bad =
            packed[0] == KNURL_NORMAL_OF_FACE || packed[1] == KNURL_NORMAL_OF_FACE || packed[2] == KNURL_NORMAL_OF_FACE;
        double corners[3][3], normals[3][3], height;
        knurl_mesh_corners(mesh, t, corners);
        knurl_mesh_normals(mesh, t, (const double (*)[3])corners, normals);
        const int kind = is_bad ? BAD : judge((const double (*)[3])corners, (const double (*)[3])normals, &height);
        if (kind == CURVED) {
            mesh->facts.curved++;
            mesh->facts.bulge = knurl_max(mesh->facts.bulge, height);
        } else {
            mesh->facts.bad_normals += kind == BAD;
            packed[0] = packed[1] = packed[2] = KNURL_NORMAL_OF_FACE;
        }
    }
    if (mesh->facts.curved == 0) {
        knurl_heap_free(heap, mesh->normals);
        mesh->normals = NULL;
    }
}

int knurl_mesh_curves(const knurl_mesh_desc *desc) {
    const uint64_t count = desc->indices ? desc->index_count : desc->vertex_count;
    for (uint64_t i = 0; desc->normals && i < count; i += 3) {
        double corners[3][3], normals[3][3], height;
        int is_unit = 1;
        for (int k = 0; k < 3; k++) {
            const size_t vertex = 3 * (size_t)(desc->indices ? desc->indices[i + (uint64_t)k] : i + (uint64_t)k);
            const uint32_t packed = pack_given(&desc->normals[vertex]);
            is_unit &= packed != KNURL_NORMAL_OF_FACE;
            unpack(packed, normals[k]);
            for (size_t axis = 0; axis < 3; axis++) {
                corners[k][axis] = (double)desc->positions[vertex + axis];
            }
        }
        if (is_unit && judge((const double (*)[3])corners, (const double (*)[3])normals, &height) == CURVED) {
            return 1;
        }
    }
    return 0;
}
