/* What a surface came to be, and where on it a stroke can start. SPDX-License-Identifier: MIT */
#include "scene/scene_internal.h"

#include "base/base.h"
#include "base/vec3.h"

#include <string.h>

void knurl_surface_info_init(knurl_surface_info *info, uint32_t size) {
    const knurl_surface_info defaults = {0};
    knurl_desc_write(&defaults, sizeof defaults, info, size);
}

/* The first front face below (then beside, then under) the middle of the bounds: where a hand would put its finger. */
static void anchor_on_mesh(const knurl_surface_data *surface, knurl_contact *anchor) {
    static const double from[6][3] = {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 0, 0}, {0, 0, -1}, {0, -1, 0}};
    const knurl_mesh *mesh = surface->mesh;
    double centre[3];
    double size = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        centre[axis] = 0.5 * ((double)mesh->nodes[0].min[axis] + (double)mesh->nodes[0].max[axis]);
        size += (double)mesh->nodes[0].max[axis] - (double)mesh->nodes[0].min[axis];
    }
    for (int i = 0; i < 6; i++) {
        double direction[3];
        double outside[3];
        double opposite[3];
        knurl_triangle t;
        mat3_mul_transposed(surface->rotation, from[i], direction);
        vec3_madd(centre, size, direction, outside);
        vec3_madd(centre, -size, direction, opposite);
        if (knurl_mesh_cross(mesh, outside, opposite, 0, &anchor->triangle)) {
            knurl_mesh_triangle(mesh, anchor->triangle, &t);
            double offset[3];
            vec3_sub(t.corners[0], outside, offset);
            const double s = vec3_dot(offset, t.normal) / vec3_dot(direction, t.normal);
            vec3_madd(outside, s, direction, anchor->proxy);
            vec3_copy(t.normal, anchor->normal);
            return;
        }
    }
    (void)knurl_mesh_closest(mesh, centre, 2.0 * size, anchor);
}

/* m from a point to where a ray leaves the bounds. */
static double reach_along(const knurl_surface_data *surface, const double point[3], const double direction[3]) {
    double reach = HUGE_VAL;
    for (int axis = 0; axis < 3; axis++) {
        const double room =
            direction[axis] > 0.0 ? surface->bounds_max[axis] - point[axis] : surface->bounds_min[axis] - point[axis];
        if (fabs(direction[axis]) > 1e-6) {
            reach = fmin(reach, fmax(0.0, room / direction[axis]));
        }
    }
    return reach;
}

static void describe_anchor(const knurl_surface_data *surface, knurl_surface_info *info) {
    knurl_contact anchor;
    double x[3];
    double y[3];
    double coordinates[2];
    memset(&anchor, 0, sizeof anchor);
    anchor.normal[2] = 1.0;
    if (surface->mesh) {
        knurl_triangle t;
        anchor_on_mesh(surface, &anchor);
        /* once more as a nearest point, for its weights and its face's normal */
        (void)knurl_mesh_closest(surface->mesh, anchor.proxy, 1e-6 + 1e-5 * vec3_length(anchor.proxy), &anchor);
        knurl_mesh_triangle(surface->mesh, anchor.triangle, &t);
        vec3_copy(t.normal, anchor.normal);
    }
    knurl_surface_frame(surface, &anchor, x, y, coordinates);
    mat3_mul(surface->rotation, anchor.proxy, info->anchor);
    vec3_madd(info->anchor, 1.0, surface->position, info->anchor);
    mat3_mul(surface->rotation, x, info->anchor_x);
    mat3_mul(surface->rotation, anchor.normal, info->anchor_normal);
    mat3_mul(surface->rotation, y, y);
    for (int i = 0; i < 4; i++) {
        double direction[3];
        vec3_scale(i % 2 == 0 ? 1.0 : -1.0, i < 2 ? info->anchor_x : y, direction);
        info->anchor_reach[i] = reach_along(surface, info->anchor, direction);
    }
}

/* d(surface coordinate)/d(metre travelled along x): uvs by their own stretch; an axis by how much of it is tangent. */
static void describe_stretch(const knurl_surface_data *surface, double stretch[3]) {
    stretch[0] = stretch[1] = stretch[2] = 1.0;
    if (surface->mesh && !surface->has_axis) {
        memcpy(stretch, surface->mesh->stretch_u, sizeof surface->mesh->stretch_u);
    } else if (surface->mesh) {
        double area = 0.0;
        double sum = 0.0;
        stretch[0] = 1.0;
        stretch[2] = 0.0;
        for (uint32_t i = 0; i < surface->mesh->triangle_count; i++) {
            knurl_triangle t;
            double tangent[3];
            knurl_mesh_triangle(surface->mesh, i, &t);
            vec3_copy(surface->axis, tangent);
            vec3_make_tangent(t.normal, tangent);
            const double length = vec3_length(tangent);
            stretch[0] = fmin(stretch[0], length);
            stretch[2] = fmax(stretch[2], length);
            area += t.area2;
            sum += t.area2 * length;
        }
        stretch[1] = sum / area;
    }
}

knurl_result knurl_scene_surface_info(const knurl_scene *scene, knurl_surface surface, knurl_surface_info *info) {
    const knurl_surface_data *data = knurl_scene_get(scene, surface);
    if (!data) {
        return KNURL_ERROR_STALE_ID;
    }
    knurl_surface_info made;
    memset(&made, 0, sizeof made);
    made.name = data->name;
    made.shape = data->mesh ? "mesh" : "plane";
    made.model = data->mesh ? "mesh+bvh" : "plane";
    made.triangle_count = data->mesh ? data->mesh->triangle_count : 0;
    made.dropped_triangles = data->mesh ? data->mesh->dropped : 0;
    made.double_sided = (uint32_t)data->double_sided;
    made.bytes = sizeof *data + knurl_heap_size(data->name) + (data->mesh ? knurl_mesh_bytes(data->mesh) : 0);
    vec3_copy(data->bounds_min, made.bounds_min);
    vec3_copy(data->bounds_max, made.bounds_max);
    describe_anchor(data, &made);
    describe_stretch(data, made.stretch);
    made.material = data->material;
    return knurl_desc_return("knurl_surface_info", &made, sizeof made, info);
}
