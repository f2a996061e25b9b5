/* PN triangles. SPDX-License-Identifier: MIT */
#include "contact/patch.h"

#include "base/base.h"
#include "base/vec3.h"

/* Below a convex surface, near its centre of curvature, the felt point is undefined. Steps are then computed for a
 * smaller height, at which the patch's area is this share of what it is at height 0. They get shorter, and no longer
 * lead to the point at once, but do not diverge. */
#define SHARE_MIN 0.5

void knurl_patch_set(const double corners[3][3], const double normals[3][3], knurl_patch *p) {
    for (int i = 0; i < 3; i++) {
        vec3_copy(corners[i], p->corners[i]);
        vec3_copy(normals[i], p->normals[i]);
        for (int k = 0; k < 3; k++) {
            double edge[3];
            vec3_sub(corners[i], corners[k], edge);
            p->heights[i][k] = vec3_dot(edge, normals[i]) / 3.0;
        }
    }
}

/* The point, and its change with each weight. */
static void find_point(const knurl_patch *p, const double w[3], double point[3], double changes[3][3]) {
    point[0] = point[1] = point[2] = 0.0;
    for (int i = 0; i < 3; i++) {
        vec3_copy(p->corners[i], changes[i]);
    }
    for (int i = 0; i < 3; i++) {
        const int j = i == 2 ? 0 : i + 1, k = 3 - i - j;
        const double hj = p->heights[i][j], hk = p->heights[i][k], both = 1.5 * (hj + hk);
        const double along = 3.0 * (hj * w[j] + hk * w[k]);
        vec3_madd(point, w[i], p->corners[i], point);
        vec3_madd(point, w[i] * (w[i] * along + both * w[j] * w[k]), p->normals[i], point);
        vec3_madd(changes[i], 2.0 * w[i] * along + both * w[j] * w[k], p->normals[i], changes[i]);
        vec3_madd(changes[j], w[i] * (3.0 * hj * w[i] + both * w[k]), p->normals[i], changes[j]);
        vec3_madd(changes[k], w[i] * (3.0 * hk * w[i] + both * w[j]), p->normals[i], changes[k]);
    }
}

/* The tangents at height z. Returns twice the patch's area there per change of both weights. */
static double find_tangents(const double changes[3][3], const double turns[2][3], double z, knurl_patch_point *at) {
    double across[3];
    vec3_madd(changes[1], z, turns[0], at->tangents[0]);
    vec3_madd(changes[2], z, turns[1], at->tangents[1]);
    vec3_cross(at->tangents[0], at->tangents[1], across);
    return vec3_dot(across, at->normal);
}

void knurl_patch_at(const knurl_patch *p, const double w[3], const double hip[3], knurl_patch_point *at) {
    double changes[3][3], turns[2][3], off[3];
    find_point(p, w, at->point, changes);
    for (int axis = 0; axis < 3; axis++) {
        at->normal[axis] = w[0] * p->normals[0][axis] + w[1] * p->normals[1][axis] + w[2] * p->normals[2][axis];
    }
    const double inverse = 1.0 / vec3_normalise(at->normal);
    for (int i = 0; i < 2; i++) {
        vec3_sub(changes[i + 1], changes[0], changes[i + 1]);
        vec3_sub(p->normals[i + 1], p->normals[0], turns[i]);
        vec3_scale(inverse, turns[i], turns[i]);
    }
    vec3_sub(hip, at->point, off);
    at->z = vec3_dot(off, at->normal);
    vec3_madd(off, -at->z, at->normal, at->beside);
    double across[3];
    vec3_cross(changes[1], changes[2], across);
    const double share = find_tangents((const double (*)[3])changes, (const double (*)[3])turns, at->z, at) /
                         vec3_dot(across, at->normal);
    if (KNURL_UNLIKELY(share < SHARE_MIN)) {
        const double less = (1.0 - SHARE_MIN) / (1.0 - share);
        (void)find_tangents((const double (*)[3])changes, (const double (*)[3])turns, less * at->z, at);
    }
    vec3_make_tangent(at->normal, at->tangents[0]);
    vec3_make_tangent(at->normal, at->tangents[1]);
}
