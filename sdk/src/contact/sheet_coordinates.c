/* Surface coordinates of a flat sheet if they are affine: the grating's x, and the map. The same rules as in
 * mesh_frame.c and surface/surface_frame.h.
 * SPDX-License-Identifier: MIT */
#include "contact/sheet_coordinates.h"

#include "base/vec3.h"
#include "contact/projection.h"

#include <string.h>

/* rad: an axis or tangent closer to the normal has a direction that turns with the last digits of the positions: 1e-6
 * of slope over it must stay within SAME_DIRECTION. */
#define NEAR_NORMAL 1e-2

/* rad: largest deviation of the tangents' directions from their mean. 1e-4 of a 1 m/s stroke is 0.1 mm/s. */
#define SAME_DIRECTION 1e-4

static const char *const along_normal = "mesh: its x direction is perpendicular to it";

/* Rotates the sheet's x to a direction in its present x and y; the map rotates with it. */
static void align_x(knurl_sheet *sheet, const double direction[2], knurl_plane *plane) {
    const double length = sqrt(direction[0] * direction[0] + direction[1] * direction[1]);
    const double c = direction[0] / length;
    const double s = direction[1] / length;
    double x[3];
    vec3_scale(c, sheet->axes[0], x);
    vec3_madd(x, s, sheet->axes[1], x);
    vec3_make_tangent(sheet->axes[2], x);
    vec3_normalise(x);
    vec3_copy(x, sheet->axes[0]);
    vec3_cross(sheet->axes[2], x, sheet->axes[1]);
    for (int i = 0; i < 2; i++) {
        const double before[2] = {plane->map[i][0], plane->map[i][1]};
        plane->map[i][0] = c * before[0] + s * before[1];
        plane->map[i][1] = c * before[1] - s * before[0];
    }
}

static void map_by_axis(knurl_sheet *sheet, const double axis[3], knurl_plane *plane, const char **why) {
    const double tangent[2] = {vec3_dot(axis, sheet->axes[0]), vec3_dot(axis, sheet->axes[1])};
    const double length = sqrt(tangent[0] * tangent[0] + tangent[1] * tangent[1]);
    if (!(length > NEAR_NORMAL)) {
        *why = along_normal;
        return;
    }
    align_x(sheet, tangent, plane);
    plane->map[0][0] = length;
    plane->map[0][2] = vec3_dot(sheet->origin, axis);
    plane->map[1][1] = 1.0;
    plane->map[1][2] = vec3_dot(sheet->origin, sheet->axes[1]);
    knurl_plane_set_stretch(plane, length);
    plane->has_coordinates = 1;
}

/* Positions, projected as on a mesh. */
static void map_by_projection(knurl_sheet *sheet, knurl_plane *plane) {
    const int side = knurl_projection_side(sheet->axes[2]);
    double origin[2], columns[2][2];
    knurl_projection_place(side, sheet->origin, origin);
    knurl_projection_place(side, sheet->axes[0], columns[0]);
    knurl_projection_place(side, sheet->axes[1], columns[1]);
    for (int i = 0; i < 2; i++) {
        plane->map[i][0] = columns[0][i];
        plane->map[i][1] = columns[1][i];
        plane->map[i][2] = origin[i];
    }
    const double det = columns[0][0] * columns[1][1] - columns[1][0] * columns[0][1];
    for (int i = 0; i < 2; i++) { /* 1 / |dP/du| = det / |grad v| */
        const double *other = plane->map[1 - i];
        const double stretch = det / sqrt(other[0] * other[0] + other[1] * other[1]);
        plane->facts.stretch[i][0] = plane->facts.stretch[i][1] = plane->facts.stretch[i][2] = stretch;
    }
    plane->has_coordinates = 1;
}

static void align_by_tangents(knurl_sheet *sheet, knurl_plane *plane, const char **why) {
    double mean[2] = {0.0, 0.0};
    for (int pass = 0; pass < 2; pass++) { /* their mean, then the deviation of each */
        for (uint64_t i = 0; i < 3 * (uint64_t)sheet->count; i++) {
            const uint32_t v = knurl_sheet_vertex(sheet->desc, sheet->kept[i / 3], (uint32_t)(i % 3));
            const float *t = &sheet->desc->tangents[4 * (size_t)v];
            const double tangent[3] = {(double)t[0], (double)t[1], (double)t[2]};
            double flat[2] = {vec3_dot(tangent, sheet->axes[0]), vec3_dot(tangent, sheet->axes[1])};
            const double part = sqrt(flat[0] * flat[0] + flat[1] * flat[1]);
            if (!(part > NEAR_NORMAL * vec3_length(tangent))) {
                *why = along_normal;
                return;
            }
            const double across = mean[0] * flat[1] - mean[1] * flat[0];
            const double along = mean[0] * flat[0] + mean[1] * flat[1];
            if (pass == 1 && !(fabs(across) <= SAME_DIRECTION * along && along > 0.0)) {
                *why = "mesh: its tangents do not all point in one direction";
                return;
            }
            mean[0] += pass == 0 ? flat[0] / part : 0.0;
            mean[1] += pass == 0 ? flat[1] / part : 0.0;
        }
    }
    align_x(sheet, mean, plane);
}

/* Sums over the triangles so far. */
typedef struct uv_sums {
    double area;
    double lengths[2];   /* of |dP/du|, |dP/dv| */
    double slopes[2][2]; /* of the gradients of u and v, in the sheet's x and y */
    int mirrored;        /* 1: v runs against n x x; the same for all triangles */
} uv_sums;

static void uv_of(const knurl_sheet *sheet, uint32_t vertex, double uv[2]) {
    uv[0] = (double)sheet->desc->uvs[2 * (size_t)vertex];
    uv[1] = (double)sheet->desc->uvs[2 * (size_t)vertex + 1];
}

/* Adds one triangle; 0 if its uvs have no area or are mirrored unlike the others. */
static int add_uvs(const knurl_sheet *sheet, uint32_t triangle, uv_sums *sums) {
    double p[3][2];
    double uv[3][2];
    for (uint32_t k = 0; k < 3; k++) {
        const uint32_t v = knurl_sheet_vertex(sheet->desc, triangle, k);
        knurl_sheet_place(sheet, v, p[k]);
        uv_of(sheet, v, uv[k]);
    }
    const double x1 = p[1][0] - p[0][0], y1 = p[1][1] - p[0][1];
    const double x2 = p[2][0] - p[0][0], y2 = p[2][1] - p[0][1];
    const double u1 = uv[1][0] - uv[0][0], v1 = uv[1][1] - uv[0][1];
    const double u2 = uv[2][0] - uv[0][0], v2 = uv[2][1] - uv[0][1];
    const double det = u1 * v2 - u2 * v1;
    const double largest = fmax(fmax(fabs(u1), fabs(u2)), fmax(fabs(v1), fabs(v2)));
    const double area = x1 * y2 - x2 * y1;
    const int mirrored = det < 0.0;
    if (!(fabs(det) > 1e-9 * largest * largest) || (sums->area > 0.0 && mirrored != sums->mirrored)) {
        return 0;
    }
    const double along = sqrt((v2 * x1 - v1 * x2) * (v2 * x1 - v1 * x2) + (v2 * y1 - v1 * y2) * (v2 * y1 - v1 * y2));
    const double across = sqrt((u1 * x2 - u2 * x1) * (u1 * x2 - u2 * x1) + (u1 * y2 - u2 * y1) * (u1 * y2 - u2 * y1));
    sums->mirrored = mirrored;
    sums->area += area;
    sums->lengths[0] += area * (along / fabs(det));
    sums->lengths[1] += area * across / fabs(det); /* in this order: traces are compared bit by bit */
    sums->slopes[0][0] += u1 * y2 - u2 * y1;
    sums->slopes[0][1] += u2 * x1 - u1 * x2;
    sums->slopes[1][0] += v1 * y2 - v2 * y1;
    sums->slopes[1][1] += v2 * x1 - v1 * x2;
    return area > 0.0;
}

/* Sets the map's offsets to the middle of the corners' deviations; 0 if a deviation exceeds the limit. */
static int fit_map(const knurl_sheet *sheet, const double scale[2], knurl_plane *plane) {
    double low[2] = {HUGE_VAL, HUGE_VAL};
    double high[2] = {-HUGE_VAL, -HUGE_VAL};
    for (uint64_t corner = 0; corner < 3 * (uint64_t)sheet->count; corner++) {
        const uint32_t v = knurl_sheet_vertex(sheet->desc, sheet->kept[corner / 3], (uint32_t)(corner % 3));
        double p[2];
        double uv[2];
        knurl_sheet_place(sheet, v, p);
        uv_of(sheet, v, uv);
        for (int i = 0; i < 2; i++) {
            const double rest = scale[i] * uv[i] - plane->map[i][0] * p[0] - plane->map[i][1] * p[1];
            low[i] = fmin(low[i], rest);
            high[i] = fmax(high[i], rest);
        }
    }
    plane->map[0][2] = 0.5 * (low[0] + high[0]);
    plane->map[1][2] = 0.5 * (low[1] + high[1]);
    return 0.5 * (high[0] - low[0]) <= sheet->limit && 0.5 * (high[1] - low[1]) <= sheet->limit;
}

/* uvs that are affine to the limit over the whole sheet have one direction: there is no test of each triangle's dP/du,
 * which on a fine mesh is as rough as its floats. */
static void map_by_uvs(knurl_sheet *sheet, knurl_plane *plane, const char **why) {
    uv_sums sums;
    memset(&sums, 0, sizeof sums);
    for (uint32_t i = 0; i < sheet->count; i++) {
        if (!add_uvs(sheet, sheet->kept[i], &sums)) {
            *why = "mesh: some of its uvs have no area, or are mirrored against the rest";
            return;
        }
    }
    const double scale[2] = {sums.lengths[0] / sums.area, (sums.mirrored ? -1.0 : 1.0) * sums.lengths[1] / sums.area};
    for (int i = 0; i < 2; i++) {
        plane->map[i][0] = scale[i] * sums.slopes[i][0] / sums.area;
        plane->map[i][1] = scale[i] * sums.slopes[i][1] / sums.area;
    }
    if (!fit_map(sheet, scale, plane)) {
        *why = "mesh: its uvs are not affine";
        return;
    }
    plane->uv_scale[0] = scale[0];
    plane->uv_scale[1] = fabs(scale[1]);
    plane->has_coordinates = 1; /* metres in both directions: no stretch */
}

void knurl_sheet_coordinates(knurl_sheet *sheet, const double axis[3], knurl_plane *plane, const char **why) {
    const knurl_mesh_desc *d = sheet->desc;
    plane->x[0] = 1.0;
    knurl_plane_set_stretch(plane, 1.0);
    if (axis) {
        map_by_axis(sheet, axis, plane, why);
        return;
    }
    if (d->uvs) {
        map_by_uvs(sheet, plane, why);
    } else if (!d->tangents) {
        map_by_projection(sheet, plane);
    }
    if (*why) {
        return;
    }
    if (d->tangents) {
        align_by_tangents(sheet, plane, why);
    } else { /* along dP/du: coordinate 1 is constant there */
        const double along[2] = {plane->map[1][1], -plane->map[1][0]};
        align_x(sheet, along, plane);
    }
}
