/* Projects a point onto up to three half-spaces by trying all subsets of them: at most eight cases, each solved
 * exactly. SPDX-License-Identifier: MIT */
#include "proxy/active_faces.h"

/* Squared sine below which two faces count as parallel: 1e-6 rad. */
#define PARALLEL 1e-12

/* m: rounding of heights over faces. */
#define ROUNDING 1e-12

/* Bit masks of the faces that hold, fewest first. */
static const unsigned subsets[8] = {0, 1, 2, 4, 3, 5, 6, 7};

/* Solves for the push of each listed face (Gram's matrix, Cramer's rule). Returns 0 if two are parallel, or all three
 * normals lie in one plane. */
static int solve(const knurl_active_face *const *faces, uint32_t count, const double *heights, double *press) {
    double g[3];
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t k = (i + 1) % 3;
        g[i] = k < count ? vec3_dot(faces[i]->normal, faces[k]->normal) : 0.0; /* 01, 12, 20 */
    }
    if (count == 1) {
        press[0] = -heights[0];
        return 1;
    }
    if (count == 2) {
        const double det = 1.0 - g[0] * g[0];
        press[0] = (g[0] * heights[1] - heights[0]) / det;
        press[1] = (g[0] * heights[0] - heights[1]) / det;
        return det > PARALLEL;
    }
    const double det = 1.0 + 2.0 * g[0] * g[1] * g[2] - g[0] * g[0] - g[1] * g[1] - g[2] * g[2];
    for (uint32_t i = 0; i < 3; i++) {
        const uint32_t j = (i + 1) % 3, k = (i + 2) % 3;
        const double ij = g[i], jk = g[j], ki = g[k];
        press[i] = -(heights[i] * (1.0 - jk * jk) + heights[j] * (jk * ki - ij) + heights[k] * (ij * jk - ki)) / det;
    }
    return det > PARALLEL;
}

/* Finds the point where the faces of a subset hold the target. Returns 0 if one of them would have to pull, or if the
 * point lies behind another face. */
static int project_on(knurl_active_faces *faces, unsigned subset, const double target[3], double point[3]) {
    const knurl_active_face *held[3];
    double heights[3], press[3] = {0.0, 0.0, 0.0};
    uint32_t count = 0;
    vec3_copy(target, point);
    for (uint32_t i = 0; i < faces->count; i++) {
        if (subset >> i & 1) {
            held[count] = &faces->list[i];
            heights[count] = vec3_dot(target, held[count]->normal) - held[count]->offset;
            count++;
        }
    }
    if (count > 0 && !solve(held, count, heights, press)) {
        return 0;
    }
    for (uint32_t i = 0; i < count; i++) {
        if (!(press[i] >= -ROUNDING)) {
            return 0;
        }
        vec3_madd(point, press[i], held[i]->normal, point);
    }
    for (uint32_t i = 0, k = 0; i < faces->count; i++) {
        knurl_active_face *face = &faces->list[i];
        const int holds = subset >> i & 1;
        if (!holds && vec3_dot(point, face->normal) < face->offset - ROUNDING) {
            return 0;
        }
        face->press = holds && press[k] > 0.0 ? press[k] : 0.0;
        k += (uint32_t)holds;
    }
    return 1;
}

int knurl_active_faces_project(knurl_active_faces *faces, const double target[3], double nearest[3]) {
    for (int i = 0; i < 8; i++) {
        if (subsets[i] >> faces->count == 0 && project_on(faces, subsets[i], target, nearest)) {
            return 1;
        }
    }
    return 0;
}

void knurl_active_faces_add(knurl_active_faces *faces, const knurl_active_face *face) {
    uint32_t at = faces->count;
    for (uint32_t i = 0; i < faces->count; i++) {
        double across[3];
        vec3_cross(face->normal, faces->list[i].normal, across);
        if (vec3_dot(across, across) <= PARALLEL && vec3_dot(face->normal, faces->list[i].normal) > 0.0) {
            at = i;
        }
    }
    if (at == KNURL_ACTIVE_FACES_MAX) {
        at = 0;
        for (uint32_t i = 1; i < faces->count; i++) {
            at = faces->list[i].press < faces->list[at].press ? i : at;
        }
    }
    faces->list[at] = *face;
    faces->count += at == faces->count;
}
