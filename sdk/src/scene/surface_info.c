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
static void anchor_on_mesh(const knurl_surface_data *surface, const knurl_pose *pose, knurl_contact *anchor) {
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
        mat3_mul_transposed(pose->rotation, from[i], direction);
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
static double reach_along(const knurl_surface_info *info, const double direction[3]) {
    double reach = HUGE_VAL;
    for (int axis = 0; axis < 3; axis++) {
        const double edge = direction[axis] > 0.0 ? info->bounds_max[axis] : info->bounds_min[axis];
        if (fabs(direction[axis]) > 1e-6) {
            reach = fmin(reach, fmax(0.0, (edge - info->anchor[axis]) / direction[axis]));
        }
    }
    return reach;
}

static void describe_anchor(const knurl_surface_data *surface, const knurl_pose *pose, knurl_surface_info *info) {
    knurl_contact anchor;
    double x[3];
    double y[3];
    double coordinates[2];
    memset(&anchor, 0, sizeof anchor);
    anchor.normal[2] = 1.0;
    if (surface->mesh) {
        knurl_triangle t;
        anchor_on_mesh(surface, pose, &anchor);
        /* once more as a nearest point, for its weights and its face's normal */
        (void)knurl_mesh_closest(surface->mesh, anchor.proxy, 1e-6 + 1e-5 * vec3_length(anchor.proxy), &anchor);
        knurl_mesh_triangle(surface->mesh, anchor.triangle, &t);
        vec3_copy(t.normal, anchor.normal);
    } else {
        anchor.proxy[0] = surface->plane->inside[0];
        anchor.proxy[1] = surface->plane->inside[1];
    }
    knurl_surface_frame(surface, surface->record, &anchor, x, y, coordinates);
    knurl_pose_to_parent(pose, anchor.proxy, info->anchor);
    mat3_mul(pose->rotation, x, info->anchor_x);
    mat3_mul(pose->rotation, anchor.normal, info->anchor_normal);
    mat3_mul(pose->rotation, y, y);
    for (int i = 0; i < 4; i++) {
        double direction[3];
        vec3_scale(i % 2 == 0 ? 1.0 : -1.0, i < 2 ? info->anchor_x : y, direction);
        info->anchor_reach[i] = reach_along(info, direction);
    }
}

/* d(surface coordinate)/d(metre travelled along x): uvs by their own stretch; an axis by how much of it is tangent. */
static void describe_stretch(const knurl_surface_data *surface, double stretch[3]) {
    const knurl_mesh *mesh = surface->mesh;
    if (!mesh || !surface->has_axis) {
        memcpy(stretch, mesh ? mesh->stretch_u : surface->plane->stretch, 3 * sizeof *stretch);
        return;
    }
    double area = 0.0;
    double sum = 0.0;
    stretch[0] = 1.0;
    stretch[2] = 0.0;
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        knurl_triangle t;
        double tangent[3];
        knurl_mesh_triangle(mesh, i, &t);
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

static void describe_model(const knurl_surface_data *surface, knurl_surface_info *info) {
    const knurl_mesh *mesh = surface->mesh;
    const knurl_plane *plane = surface->plane;
    info->shape = surface->shape;
    info->model = mesh ? "mesh+bvh" : plane->outline ? "plane+outline" : "plane";
    info->why = surface->why;
    info->triangle_count = mesh ? mesh->triangle_count : plane->triangle_count;
    info->dropped_triangles = mesh ? mesh->dropped : plane->dropped;
    info->reversed_twins = mesh ? mesh->reversed_twins : plane->reversed_twins;
    info->model_error = mesh ? 0.0 : plane->flatness; /* meshes are given as floats, and kept as they are given */
    info->double_sided = (uint32_t)surface->double_sided;
    info->bytes = knurl_heap_size(surface) + knurl_heap_size(surface->record) + knurl_heap_size(surface->name) +
                  (mesh ? knurl_mesh_bytes(mesh) : knurl_plane_bytes(plane));
}

/* Where it stands now. Of what moves the bounds hold the whole way. */
static void describe(const knurl_scene *scene, const knurl_surface_data *surface, knurl_surface_info *info) {
    knurl_pose pose;
    memset(info, 0, sizeof *info);
    info->name = surface->name;
    info->material = surface->record->material;
    if (surface->has_axis) {
        vec3_copy(surface->axis, info->axis);
    }
    const double now = knurl_scene_time(scene);
    knurl_motion_at(&surface->record->motion, now, &pose);
    knurl_surface_bounds(surface, &surface->record->motion, now, info->bounds_min, info->bounds_max);
    describe_model(surface, info);
    describe_anchor(surface, &pose, info);
    describe_stretch(surface, info->stretch);
}

knurl_result knurl_scene_surface_info(const knurl_scene *scene, knurl_surface surface, knurl_surface_info *info) {
    knurl_surface_info made;
    knurl_scene_lock(scene);
    const knurl_surface_data *data = knurl_scene_get(scene, surface);
    if (data) {
        describe(scene, data, &made);
    }
    knurl_scene_unlock(scene);
    return data ? knurl_desc_return("knurl_surface_info", &made, sizeof made, info) : KNURL_ERROR_STALE_ID;
}
