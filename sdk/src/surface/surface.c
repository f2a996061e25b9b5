/* Builds a surface from its description. SPDX-License-Identifier: MIT */
#include "surface/surface.h"

#include "base/base.h"
#include "base/number.h"

#include <string.h>

void knurl_surface_desc_init(knurl_surface_desc *desc, uint32_t size) {
    const knurl_surface_desc defaults = {.rotation = {0.0, 0.0, 0.0, 1.0}};
    knurl_desc_write(&defaults, sizeof defaults, desc, size);
}

knurl_result knurl_surface_check_pose(const double position[3], const double rotation[4], knurl_pose *pose) {
    const double *q = rotation;
    const double norm = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    const knurl_result result = knurl_check_coordinates("position", "m", position);
    if (result) {
        return result;
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

/* The shortest turn from +z to a unit normal; exact for the six axes. */
static void turn_to(const double n[3], double rotation[9]) {
    static const double over[9] = {1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, -1.0};
    const double side2 = n[0] * n[0] + n[1] * n[1];
    const double share = n[2] > 0.0 ? 1.0 / (1.0 + n[2]) : (1.0 - n[2]) / side2; /* the same, but for rounding */
    const double across = -n[0] * n[1] * share;
    const double turned[9] = {
        1.0 - n[0] * n[0] * share, across, n[0], across, 1.0 - n[1] * n[1] * share, n[1], -n[0], -n[1], n[2]};
    memcpy(rotation, n[2] < 0.0 && side2 < 1e-30 ? over : turned, sizeof turned);
}

static knurl_result set_pose(const knurl_surface_desc *d, knurl_pose *pose) {
    double normal[3];
    knurl_result result = knurl_surface_check_pose(d->position, d->rotation, pose);
    result = result ? result : knurl_check_coordinates("normal", "", d->normal);
    if (result) {
        return result;
    }
    vec3_copy(d->normal, normal);
    if (vec3_normalise(normal) > 0.0) {
        const double *q = d->rotation;
        if (q[0] != 0.0 || q[1] != 0.0 || q[2] != 0.0 || q[3] != 1.0) {
            return knurl_fail(KNURL_ERROR_ARGUMENT,
                              "rotation: expected 0, 0, 0, 1 with a normal, found [%g, %g, %g, %g]", q[0], q[1], q[2],
                              q[3]);
        }
        turn_to(normal, pose->rotation);
        knurl_pose_settle(pose);
    }
    return KNURL_OK;
}

static knurl_result set_axis(const knurl_surface_desc *d, knurl_surface_data *surface) {
    const knurl_result result = knurl_check_coordinates("axis", "", d->axis);
    if (result) {
        return result;
    }
    vec3_copy(d->axis, surface->axis);
    if (!(vec3_normalise(surface->axis) > 0.0)) {
        memset(surface->axis, 0, sizeof surface->axis);
    }
    return KNURL_OK;
}

static knurl_result set_shape(knurl_heap *heap, const knurl_surface_desc *d, uint32_t full_model,
                              knurl_surface_data *surface) {
    const int has_axis = vec3_length(surface->axis) > 0.0;
    const knurl_shape_desc shape = {d->plane,
                                    d->mesh,
                                    has_axis ? surface->axis : NULL,
                                    d->coordinates == KNURL_COORDINATES_BOX,
                                    (full_model & KNURL_FULL_MESHES) != 0,
                                    d->smooth};
    if (d->smooth < KNURL_SMOOTH_AUTO || d->smooth > KNURL_SMOOTH_ON) {
        return knurl_fail(KNURL_ERROR_UNKNOWN, "smooth: expected one of KNURL_SMOOTH_, found %d", (int)d->smooth);
    }
    if (d->coordinates < KNURL_COORDINATES_AUTO || d->coordinates > KNURL_COORDINATES_BOX) {
        return knurl_fail(KNURL_ERROR_UNKNOWN, "coordinates: expected one of KNURL_COORDINATES_, found %d",
                          (int)d->coordinates);
    }
    if (shape.is_box && has_axis) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "axis: expected zeros with KNURL_COORDINATES_BOX, found [%g, %g, %g]",
                          d->axis[0], d->axis[1], d->axis[2]);
    }
    const knurl_result result =
        knurl_shape_create(heap, &shape, &surface->shape, surface->local.position, surface->local.rotation);
    surface->given = d->mesh ? "mesh" : "plane";
    surface->double_sided = d->double_sided != 0 || surface->shape.double_sided;
    return result;
}

void knurl_surface_share(const knurl_surface_data *surface, knurl_shared_shape *shared) {
    shared->shape = knurl_shape_share(&surface->shape);
    shared->local = surface->local;
    shared->given = surface->given;
    vec3_copy(surface->axis, shared->axis);
}

static knurl_result set_shared_shape(const knurl_surface_desc *d, const knurl_shared_shape *shared,
                                     knurl_surface_data *surface) {
    surface->shape = shared->shape; /* first: knurl_surface_release() then drops this reference after a failure */
    surface->local = shared->local;
    surface->given = shared->given;
    surface->double_sided = d->double_sided != 0 || shared->shape.double_sided;
    if (d->plane || d->mesh) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "shape: expected exactly one of plane, mesh and shape_of, found more");
    }
    if (vec3_length(surface->axis) > 0.0) {
        return knurl_fail(KNURL_ERROR_ARGUMENT,
                          "axis: expected zeros with shape_of, whose axis is used, found [%g, %g, %g]", d->axis[0],
                          d->axis[1], d->axis[2]);
    }
    if (d->coordinates != KNURL_COORDINATES_AUTO) {
        return knurl_fail(
            KNURL_ERROR_ARGUMENT,
            "coordinates: expected KNURL_COORDINATES_AUTO with shape_of, whose coordinates are used, found "
            "%d",
            (int)d->coordinates);
    }
    if (d->smooth != KNURL_SMOOTH_AUTO) {
        return knurl_fail(KNURL_ERROR_ARGUMENT,
                          "smooth: expected KNURL_SMOOTH_AUTO with shape_of, whose shape is used, found %d",
                          (int)d->smooth);
    }
    vec3_copy(shared->axis, surface->axis);
    return KNURL_OK;
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

/* Adds the bounds of the shape's box in a pose. */
static void add_box(const knurl_surface_data *surface, const knurl_pose *pose, double low[3], double high[3]) {
    for (int row = 0; row < 3; row++) {
        double centre = pose->position[row];
        double half = 0.0;
        for (int column = 0; column < 3; column++) {
            const double cell = pose->rotation[3 * row + column];
            centre += cell * 0.5 * (surface->shape.low[column] + surface->shape.high[column]);
            half += fabs(cell) * 0.5 * (surface->shape.high[column] - surface->shape.low[column]);
        }
        low[row] = knurl_min(low[row], centre - half);
        high[row] = knurl_max(high[row], centre + half);
    }
}

/* Between the two poses whose bounds are in low and high, a corner's arc leaves its chord by up to radius * angle^2 / 8
 * (the error of linear interpolation), and stays in the ball around the origin's path. The smaller bound is used. */
static void add_turning(const knurl_surface_data *surface, const knurl_motion *motion, double low[3], double high[3]) {
    const double seconds = motion->end_time - motion->start_time;
    const double angle = motion->rate * seconds;
    const double radius = surface->radius;
    const double bulge = 0.125 * radius * angle * angle;
    for (int i = 0; i < 3; i++) {
        const double from = motion->start.position[i] - motion->arm[i];
        const double to = from + seconds * motion->velocity[i];
        low[i] = knurl_max(low[i] - bulge, knurl_min(low[i], knurl_min(from, to) - radius));
        high[i] = knurl_min(high[i] + bulge, knurl_max(high[i], knurl_max(from, to) + radius));
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
    if (motion->rate != 0.0) {
        add_turning(surface, motion, low, high);
    }
}

static float round_down(double value) {
    const float f = (float)value;
    return (double)f > value ? nextafterf(f, -HUGE_VALF) : f;
}

static float round_up(double value) {
    return -round_down(-value);
}

void knurl_surface_box(const knurl_surface_data *surface, const knurl_record *record, double time, double margin,
                       float box[6]) {
    double low[3];
    double high[3];
    knurl_surface_bounds(surface, &record->motion, time, low, high);
    for (int i = 0; i < 3; i++) {
        box[i] = round_down(low[i] - record->reach - margin);
        box[3 + i] = round_up(high[i] + record->reach + margin);
    }
}

void knurl_surface_set_boxes(const knurl_surface_data *surface, knurl_record *record) {
    knurl_surface_box(surface, record, -HUGE_VAL, 0.0, record->moving_box);
    knurl_surface_box(surface, record, HUGE_VAL, 0.0, record->end_box);
}

void knurl_surface_set_arrival(const knurl_surface_data *surface, knurl_record *record, double margin) {
    knurl_surface_box(surface, record, HUGE_VAL, margin, record->arrived);
}

void knurl_surface_release(knurl_heap *heap, knurl_retired *retired) {
    knurl_surface_data *surface = (knurl_surface_data *)(void *)retired; /* its first member */
    if (surface) {
        knurl_shape_destroy(heap, &surface->shape);
        knurl_heap_free(heap, surface->record);
        knurl_heap_free(heap, surface->name);
        knurl_heap_free(heap, surface);
    }
}

/* m: the farthest corner from the origin that the surface rotates about. */
static double find_radius(const knurl_surface_data *surface) {
    double radius2 = 0.0;
    for (int corner = 0; corner < 8; corner++) {
        const double own[3] = {corner & 1 ? surface->shape.high[0] : surface->shape.low[0],
                               corner & 2 ? surface->shape.high[1] : surface->shape.low[1],
                               corner & 4 ? surface->shape.high[2] : surface->shape.low[2]};
        double there[3];
        knurl_pose_to_parent(&surface->local, own, there);
        radius2 = knurl_max(radius2, vec3_dot(there, there));
    }
    return sqrt(radius2);
}

static knurl_result fill_in(knurl_heap *heap, const knurl_surface_desc *d, uint32_t full_model,
                            const knurl_shared_shape *shared, knurl_surface_data *surface) {
    knurl_pose pose;
    knurl_result result = set_axis(d, surface);
    if (shared) {
        const knurl_result taken = set_shared_shape(d, shared, surface);
        result = result ? result : taken;
    }
    result = result ? result : set_pose(d, &pose);
    result = result || shared ? result : set_shape(heap, d, full_model, surface);
    knurl_pose_settle(&surface->local);
    surface->radius = result ? 0.0 : find_radius(surface);
    surface->record = result ? NULL : knurl_record_copy(heap, NULL);
    result = !result && !surface->record ? KNURL_ERROR_MEMORY : result;
    result = result ? result : knurl_record_set_material(surface->record, &surface->shape, d->material, full_model);
    result = result ? result : set_name(heap, d->name, surface);
    if (!result) {
        knurl_motion_place(&pose, &surface->local, &surface->record->motion);
        knurl_surface_set_boxes(surface, surface->record);
        knurl_surface_set_arrival(surface, surface->record, 0.0);
    }
    return result;
}

knurl_result knurl_surface_build(knurl_heap *heap, const knurl_surface_desc *desc, uint32_t full_model,
                                 const knurl_shared_shape *shared, knurl_surface_data **surface) {
    knurl_surface_data *made = knurl_heap_alloc(heap, 1, sizeof *made);
    if (!made) {
        if (shared) {
            knurl_shape_destroy(heap, &shared->shape);
        }
        return KNURL_ERROR_MEMORY;
    }
    const knurl_result result = fill_in(heap, desc, full_model, shared, made);
    if (result) {
        knurl_surface_release(heap, &made->retired);
        return result;
    }
    made->retired.release = knurl_surface_release;
    *surface = made;
    return KNURL_OK;
}
