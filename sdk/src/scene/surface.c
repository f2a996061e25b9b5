/* From a description to a surface that can be felt. SPDX-License-Identifier: MIT */
#include "scene/scene_internal.h"

#include "base/base.h"
#include "base/vec3.h"

#include <string.h>

/* How far the crests of each method stand above the surface, in amplitudes: S1 never leaves A; S2's 400 Hz mix reaches
 * (2 + 3 sqrt(1/2))/sqrt(13) = 1.143 A (paper, "Peaks"). */
#define CREST_S1 1.0
#define CREST_S2 1.1431

static knurl_result check_positive(const char *key, const char *unit, double value, int zero_allowed) {
    if (!(isfinite(value) && (value > 0.0 || (zero_allowed && value == 0.0)))) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "%s: expected a finite number %s 0 (%s), found %g", key,
                          zero_allowed ? ">=" : ">", unit, value);
    }
    return KNURL_OK;
}

static knurl_result check_material(knurl_material_desc *m) {
    knurl_grating grating = {{m->spatial_frequency[0], m->spatial_frequency[1]}, m->amplitude, 1000.0, m->method, 0};
    knurl_result result = knurl_grating_check(&grating);
    m->method = grating.method;
    result = result ? result : check_positive("stiffness", "N/m", m->stiffness, 0);
    result = result ? result : check_positive("damping", "N s/m", m->damping, 1);
    result = result ? result : check_positive("friction", "coefficient", m->friction, 1);
    if (!result && m->friction > 0.0) {
        return knurl_fail(KNURL_ERROR_UNSUPPORTED,
                          "friction: Knurl %s renders frictionless surfaces only; expected 0, found %g",
                          knurl_version_string(), m->friction);
    }
    if (!result && !isfinite(m->orientation)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "orientation: expected a finite number (rad), found %g",
                          m->orientation);
    }
    return result;
}

static int is_smooth(const knurl_material_desc *m) {
    return m->amplitude == 0.0 || (m->spatial_frequency[0] == 0.0 && m->spatial_frequency[1] == 0.0);
}

knurl_result knurl_surface_set_material(knurl_surface_data *surface, const knurl_material_desc *desc) {
    knurl_material_desc m;
    knurl_material_desc_init(&m, sizeof m);
    knurl_result result = knurl_desc_read("knurl_material_desc", desc, &m, sizeof m);
    result = result ? result : check_material(&m);
    if (result) {
        return result;
    }
    if (m.method == KNURL_S1 && !is_smooth(&m) && surface->mesh && !surface->mesh->uvs && !surface->has_axis) {
        return knurl_fail(KNURL_ERROR_ARGUMENT,
                          "method: S1 needs surface coordinates: expected uvs or an axis, found neither");
    }
    surface->material = m;
    surface->turn[0] = cos(m.orientation);
    surface->turn[1] = sin(m.orientation);
    surface->reach = is_smooth(&m) ? 0.0 : m.amplitude * (m.method == KNURL_S1 ? CREST_S1 : CREST_S2);
    return KNURL_OK;
}

static knurl_result set_pose(const knurl_surface_desc *d, knurl_surface_data *surface) {
    const double *q = d->rotation;
    const double norm = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!vec3_finite(d->position)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "position: expected finite numbers (m), found [%g, %g, %g]",
                          d->position[0], d->position[1], d->position[2]);
    }
    if (!(fabs(norm - 1.0) <= 1e-3)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT,
                          "rotation: expected a unit quaternion x, y, z, w, found [%g, %g, %g, %g]", q[0], q[1], q[2],
                          q[3]);
    }
    const double unit[4] = {q[0] / norm, q[1] / norm, q[2] / norm, q[3] / norm};
    vec3_copy(d->position, surface->position);
    quat_to_matrix(unit, surface->rotation);
    return KNURL_OK;
}

static knurl_result set_axis(const knurl_surface_desc *d, knurl_surface_data *surface) {
    if (!vec3_finite(d->axis)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "axis: expected finite numbers, found [%g, %g, %g]", d->axis[0],
                          d->axis[1], d->axis[2]);
    }
    vec3_copy(d->axis, surface->axis);
    surface->has_axis = vec3_normalise(surface->axis) > 0.0;
    if (surface->mesh && !surface->has_axis && !surface->mesh->uvs && !surface->mesh->tangents) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "axis: a mesh with neither tangents nor uvs needs one, found none");
    }
    return KNURL_OK;
}

/* The box of a box: the surface's own bounds, turned into the scene. */
static void set_bounds(knurl_surface_data *surface) {
    const double flat[2] = {surface->plane.half_extents[0], surface->plane.half_extents[1]};
    double low[3] = {-flat[0], -flat[1], 0.0};
    double high[3] = {flat[0], flat[1], 0.0};
    for (int axis = 0; surface->mesh && axis < 3; axis++) {
        low[axis] = (double)surface->mesh->nodes[0].min[axis];
        high[axis] = (double)surface->mesh->nodes[0].max[axis];
    }
    for (int row = 0; row < 3; row++) {
        double centre = surface->position[row];
        double half = 0.0;
        for (int column = 0; column < 3; column++) {
            centre += surface->rotation[3 * row + column] * 0.5 * (low[column] + high[column]);
            half += fabs(surface->rotation[3 * row + column]) * 0.5 * (high[column] - low[column]);
        }
        surface->bounds_min[row] = centre - half;
        surface->bounds_max[row] = centre + half;
    }
}

static knurl_result set_shape(knurl_heap *heap, const knurl_surface_desc *d, knurl_surface_data *surface) {
    if (!d->plane == !d->mesh) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "shape: expected exactly one of plane and mesh, found %s",
                          d->plane ? "both" : "none");
    }
    if (d->mesh) {
        knurl_mesh_desc mesh;
        knurl_mesh_desc_init(&mesh, sizeof mesh);
        knurl_result result = knurl_desc_read("knurl_mesh_desc", d->mesh, &mesh, sizeof mesh);
        result = result ? result : knurl_mesh_check(&mesh);
        return result ? result : knurl_mesh_create(heap, &mesh, &surface->mesh);
    }
    knurl_plane_desc plane;
    knurl_plane_desc_init(&plane, sizeof plane);
    knurl_result result = knurl_desc_read("knurl_plane_desc", d->plane, &plane, sizeof plane);
    result = result ? result : check_positive("plane.half_extents[0]", "m", plane.half_extents[0], 0);
    result = result ? result : check_positive("plane.half_extents[1]", "m", plane.half_extents[1], 0);
    knurl_plane_from_rectangle(plane.half_extents, &surface->plane);
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

knurl_result knurl_surface_build(knurl_heap *heap, const knurl_surface_desc *desc, knurl_surface_data *surface) {
    knurl_surface_desc d;
    knurl_surface_desc_init(&d, sizeof d);
    knurl_surface_data made;
    memset(&made, 0, sizeof made);
    knurl_result result = knurl_desc_read("knurl_surface_desc", desc, &d, sizeof d);
    result = result ? result : set_pose(&d, &made);
    result = result ? result : set_shape(heap, &d, &made);
    result = result ? result : set_axis(&d, &made);
    result = result ? result : knurl_surface_set_material(&made, d.material);
    result = result ? result : set_name(heap, d.name, &made);
    if (result) {
        knurl_surface_release(heap, &made);
        return result;
    }
    made.double_sided = d.double_sided != 0;
    set_bounds(&made);
    made.alive = 1;
    made.generation = surface->generation;
    *surface = made;
    return KNURL_OK;
}

void knurl_surface_release(knurl_heap *heap, knurl_surface_data *surface) {
    knurl_mesh_destroy(heap, surface->mesh);
    knurl_heap_free(heap, surface->name);
    surface->mesh = NULL;
    surface->name = NULL;
    surface->alive = 0;
}
