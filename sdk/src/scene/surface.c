/* From a description to a surface that can be felt. SPDX-License-Identifier: MIT */
#include "scene/scene_internal.h"

#include "base/base.h"

#include <string.h>

void knurl_surface_desc_init(knurl_surface_desc *desc, uint32_t size) {
    const knurl_surface_desc defaults = {.rotation = {0.0, 0.0, 0.0, 1.0}};
    knurl_desc_write(&defaults, sizeof defaults, desc, size);
}

knurl_result knurl_surface_check_pose(const double position[3], const double rotation[4], knurl_pose *pose) {
    const double *q = rotation;
    const double norm = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!vec3_finite(position)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "position: expected finite numbers (m), found [%g, %g, %g]",
                          position[0], position[1], position[2]);
    }
    if (!(fabs(norm - 1.0) <= 1e-3)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT,
                          "rotation: expected a unit quaternion x, y, z, w, found [%g, %g, %g, %g]", q[0], q[1], q[2],
                          q[3]);
    }
    const double unit[4] = {q[0] / norm, q[1] / norm, q[2] / norm, q[3] / norm};
    vec3_copy(position, pose->position);
    quat_to_matrix(unit, pose->rotation);
    knurl_pose_settle(pose);
    return KNURL_OK;
}

static knurl_result set_axis(const knurl_surface_desc *d, knurl_surface_data *surface) {
    if (!vec3_finite(d->axis)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "axis: expected finite numbers, found [%g, %g, %g]", d->axis[0],
                          d->axis[1], d->axis[2]);
    }
    vec3_copy(d->axis, surface->axis);
    surface->has_axis = vec3_normalise(surface->axis) > 0.0;
    return KNURL_OK;
}

static knurl_result check_extent(const char *key, double value) {
    if (!(value > 0.0 && isfinite(value))) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "%s: expected a finite number > 0 (m), found %g", key, value);
    }
    return KNURL_OK;
}

static knurl_result set_plane(knurl_heap *heap, const knurl_surface_desc *d, knurl_surface_data *surface) {
    knurl_plane_desc plane;
    knurl_plane_desc_init(&plane, sizeof plane);
    knurl_result result = knurl_desc_read("knurl_plane_desc", d->plane, &plane, sizeof plane);
    result = result ? result : check_extent("plane.half_extents[0]", plane.half_extents[0]);
    result = result ? result : check_extent("plane.half_extents[1]", plane.half_extents[1]);
    if (result) {
        return result;
    }
    surface->shape = "plane";
    surface->why = "given as a plane";
    surface->plane = knurl_heap_alloc(heap, 1, sizeof *surface->plane);
    if (!surface->plane) {
        return KNURL_ERROR_MEMORY;
    }
    knurl_plane_from_rectangle(plane.half_extents, surface->plane);
    if (!surface->has_axis) {
        return KNURL_OK;
    }
    const double along = hypot(surface->axis[0], surface->axis[1]);
    if (along > 1e-9) { /* across it like a post, any direction is as good */
        knurl_plane *p = surface->plane;
        for (int i = 0; i < 2; i++) {
            p->x[i] = surface->axis[i] / along;
            p->map[0][i] = surface->axis[i];
        }
        p->map[1][0] = -p->x[1];
        p->map[1][1] = p->x[0];
        p->stretch[0] = p->stretch[1] = p->stretch[2] = along;
    }
    return KNURL_OK;
}

static knurl_result set_mesh(knurl_heap *heap, const knurl_surface_desc *d, uint32_t full_model,
                             knurl_surface_data *surface) {
    knurl_mesh_desc mesh;
    knurl_mesh_desc_init(&mesh, sizeof mesh);
    knurl_result result = knurl_desc_read("knurl_mesh_desc", d->mesh, &mesh, sizeof mesh);
    result = result ? result : knurl_mesh_check(&mesh);
    if (!result && !surface->has_axis && !mesh.uvs && !mesh.tangents) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "axis: a mesh with neither tangents nor uvs needs one, found none");
    }
    surface->shape = "mesh";
    surface->why = "the full model was asked for (KNURL_FULL_MESHES)";
    if (!result && !(full_model & KNURL_FULL_MESHES)) {
        result = knurl_plane_from_mesh(heap, &mesh, surface->has_axis ? surface->axis : NULL, &surface->plane,
                                       surface->local.position, surface->local.rotation, &surface->why);
    }
    if (!result && surface->plane) {
        surface->double_sided |= surface->plane->double_sided;
    } else if (!result) {
        result = knurl_mesh_create(heap, &mesh, &surface->mesh);
        surface->double_sided |= result == KNURL_OK && surface->mesh->double_sided;
    }
    return result;
}

static knurl_result set_shape(knurl_heap *heap, const knurl_surface_desc *d, uint32_t full_model,
                              knurl_surface_data *surface) {
    if (!d->plane == !d->mesh) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "shape: expected exactly one of plane and mesh, found %s",
                          d->plane ? "both" : "none");
    }
    const knurl_result result = d->mesh ? set_mesh(heap, d, full_model, surface) : set_plane(heap, d, surface);
    for (int axis = 0; !result && axis < 3; axis++) {
        const double half = !surface->mesh && axis < 2 ? surface->plane->half_extents[axis] : 0.0;
        surface->low[axis] = surface->mesh ? (double)surface->mesh->nodes[0].min[axis] : -half;
        surface->high[axis] = surface->mesh ? (double)surface->mesh->nodes[0].max[axis] : half;
    }
    return result;
}

static knurl_result set_name(knurl_heap *heap, const char *name, knurl_surface_data *surface) {
    const size_t length = name ? strlen(name) : 0;
    surface->name = knurl_heap_alloc(heap, length + 1, 1);
    if (!surface->name) {
        return KNURL_ERROR_MEMORY;
    }
    memcpy(surface->name, name ? name : "", length);
    return KNURL_OK;
}

/* The box of a box. */
static void add_box(const knurl_surface_data *surface, const knurl_pose *pose, double low[3], double high[3]) {
    for (int row = 0; row < 3; row++) {
        double centre = pose->position[row];
        double half = 0.0;
        for (int column = 0; column < 3; column++) {
            const double turn = pose->rotation[3 * row + column];
            centre += turn * 0.5 * (surface->low[column] + surface->high[column]);
            half += fabs(turn) * 0.5 * (surface->high[column] - surface->low[column]);
        }
        low[row] = fmin(low[row], centre - half);
        high[row] = fmax(high[row], centre + half);
    }
}

void knurl_surface_bounds(const knurl_surface_data *surface, const knurl_motion *motion, double time, double low[3],
                          double high[3]) {
    for (int i = 0; i < 3; i++) {
        low[i] = HUGE_VAL;
        high[i] = -HUGE_VAL;
    }
    add_box(surface, &motion->end, low, high);
    if (knurl_motion_is_over(motion, time)) {
        return;
    }
    add_box(surface, &motion->start, low, high);
    if (motion->rate != 0.0) { /* what turns stays in a ball round the origin's way */
        double radius2 = 0.0;
        for (int corner = 0; corner < 8; corner++) {
            const double own[3] = {corner & 1 ? surface->high[0] : surface->low[0],
                                   corner & 2 ? surface->high[1] : surface->low[1],
                                   corner & 4 ? surface->high[2] : surface->low[2]};
            double there[3];
            knurl_pose_to_parent(&surface->local, own, there);
            radius2 = fmax(radius2, vec3_dot(there, there));
        }
        const double seconds = motion->end_time - motion->start_time;
        for (int i = 0; i < 3; i++) {
            const double from = motion->start.position[i] - motion->arm[i];
            const double to = from + seconds * motion->velocity[i];
            low[i] = fmin(low[i], fmin(from, to) - sqrt(radius2));
            high[i] = fmax(high[i], fmax(from, to) + sqrt(radius2));
        }
    }
}

void knurl_surface_release(knurl_heap *heap, knurl_retired *retired) {
    knurl_surface_data *surface = (knurl_surface_data *)(void *)retired; /* its first member */
    if (surface) {
        knurl_mesh_destroy(heap, surface->mesh);
        knurl_plane_destroy(heap, surface->plane);
        knurl_heap_free(heap, surface->record);
        knurl_heap_free(heap, surface->name);
        knurl_heap_free(heap, surface);
    }
}

static knurl_result fill_in(knurl_heap *heap, const knurl_surface_desc *d, uint32_t full_model,
                            knurl_surface_data *surface) {
    static const double identity[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    knurl_pose pose;
    memcpy(surface->local.rotation, identity, sizeof identity);
    surface->double_sided = d->double_sided != 0;
    knurl_result result = knurl_surface_check_pose(d->position, d->rotation, &pose);
    result = result ? result : set_axis(d, surface);
    result = result ? result : set_shape(heap, d, full_model, surface);
    knurl_pose_settle(&surface->local);
    surface->record = result ? NULL : knurl_record_copy(heap, NULL);
    result = !result && !surface->record ? KNURL_ERROR_MEMORY : result;
    result = result ? result : knurl_record_set_material(surface->record, surface, d->material, full_model);
    result = result ? result : set_name(heap, d->name, surface);
    if (!result) {
        knurl_motion_place(&pose, &surface->local, &surface->record->motion);
        knurl_record_set_box(surface, surface->record, 0.0);
    }
    return result;
}

knurl_result knurl_surface_build(knurl_heap *heap, const knurl_surface_desc *desc, uint32_t full_model,
                                 knurl_surface_data **surface) {
    knurl_surface_desc d;
    knurl_surface_desc_init(&d, sizeof d);
    knurl_result result = knurl_desc_read("knurl_surface_desc", desc, &d, sizeof d);
    if (result) {
        return result;
    }
    knurl_surface_data *made = knurl_heap_alloc(heap, 1, sizeof *made);
    result = made ? fill_in(heap, &d, full_model, made) : KNURL_ERROR_MEMORY;
    if (result) {
        knurl_surface_release(heap, made ? &made->retired : NULL);
        return result;
    }
    made->retired.release = knurl_surface_release;
    *surface = made;
    return KNURL_OK;
}
