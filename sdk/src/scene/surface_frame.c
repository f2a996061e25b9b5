/* Surface coordinates: which way x and y run at a contact, and where on the grating it is. SPDX-License-Identifier: MIT
 */
#include "scene/scene_internal.h"

/* On a mesh x is made tangent to the contact's normal, which is no face's at edges. */
static void mesh_frame(const knurl_surface_data *surface, const knurl_contact *contact, double x[3], double place[2]) {
    double along[3];
    if (surface->has_axis) {
        vec3_copy(surface->axis, along);
    } else {
        knurl_mesh_frame(surface->mesh, contact, along, place);
    }
    vec3_copy(along, x);
    vec3_make_tangent(contact->normal, x);
    const double length2 = vec3_dot(x, x);
    if (!(length2 > 1e-18 * vec3_dot(along, along))) { /* like a post on the surface: any direction is as good */
        vec3_any_tangent(contact->normal, x);
    } else {
        vec3_scale(1.0 / sqrt(length2), x, x);
    }
}

void knurl_surface_frame(const knurl_surface_data *surface, const knurl_record *record, const knurl_contact *contact,
                         double x[3], double y[3], double coordinates[2]) {
    if (surface->mesh) {
        mesh_frame(surface, contact, x, coordinates);
    } else {
        knurl_plane_frame(surface->plane, contact, x, coordinates);
    }
    vec3_cross(contact->normal, x, y);
    if (surface->mesh && surface->has_axis) {
        coordinates[0] = vec3_dot(contact->proxy, surface->axis);
        coordinates[1] = vec3_dot(contact->proxy, y);
    }
    const double c = record->turn[0];
    const double s = record->turn[1];
    if (s != 0.0 || c != 1.0) { /* the orientation turns the frame, so the coordinates turn back */
        const double place[2] = {coordinates[0], coordinates[1]};
        for (int i = 0; i < 3; i++) {
            const double unturned = x[i];
            x[i] = c * unturned + s * y[i];
            y[i] = c * y[i] - s * unturned;
        }
        coordinates[0] = c * place[0] + s * place[1];
        coordinates[1] = c * place[1] - s * place[0];
    }
}

int knurl_surface_has_coordinates(const knurl_surface_data *surface) {
    return surface->mesh ? surface->mesh->uvs || surface->has_axis : surface->plane->has_coordinates;
}

/* Before the orientation turns them. 0: where there are no coordinates. */
static int find_rates(const knurl_surface_data *surface, const knurl_contact *contact, const double velocity[3],
                      double rates[2], double *steepest) {
    if (!surface->mesh) {
        knurl_plane_rates(surface->plane, contact, velocity, rates, steepest);
        return surface->plane->has_coordinates;
    }
    if (!surface->has_axis) {
        return knurl_mesh_rates(surface->mesh, contact, velocity, rates, steepest);
    }
    double x[3];
    double y[3];
    double place[2];
    mesh_frame(surface, contact, x, place);
    vec3_cross(contact->normal, x, y);
    rates[0] = vec3_dot(velocity, surface->axis);
    rates[1] = vec3_dot(velocity, y);
    *steepest = 1.0;
    return 1;
}

int knurl_surface_rates(const knurl_surface_data *surface, const knurl_record *record, const knurl_contact *contact,
                        const double velocity[3], double rates[2], double *steepest) {
    double straight[2];
    if (!find_rates(surface, contact, velocity, straight, steepest)) {
        return 0;
    }
    rates[0] = record->turn[0] * straight[0] + record->turn[1] * straight[1];
    rates[1] = record->turn[0] * straight[1] - record->turn[1] * straight[0];
    return 1;
}
