/* Surface coordinates: which way x and y run at a contact, and where on the grating it is. SPDX-License-Identifier: MIT
 */
#include "scene/scene_internal.h"

#include "base/vec3.h"

void knurl_surface_frame(const knurl_surface_data *surface, const knurl_contact *contact, double x[3], double y[3],
                         double coordinates[2]) {
    double along[3] = {1.0, 0.0, 0.0};
    double place[2] = {0.0, 0.0};
    if (surface->has_axis) {
        vec3_copy(surface->axis, along);
    } else if (surface->mesh) {
        along[0] = 0.0; /* stays 0 where the uvs have no area */
        knurl_mesh_frame(surface->mesh, contact, along, place);
    }
    vec3_copy(along, x);
    vec3_make_tangent(contact->normal, x);
    if (!(vec3_length(x) >
          1e-9 * vec3_length(along))) { /* x stands on the surface like a post: any direction is as good */
        vec3_any_tangent(contact->normal, x);
    }
    vec3_normalise(x);
    vec3_cross(contact->normal, x, y);
    if (surface->has_axis) {
        place[0] = vec3_dot(contact->proxy, surface->axis);
        place[1] = vec3_dot(contact->proxy, y);
    } else if (!surface->mesh) {
        place[0] = contact->proxy[0];
        place[1] = contact->proxy[1] * contact->normal[2];
    }
    const double c = surface->turn[0];
    const double s = surface->turn[1];
    for (int i = 0; i < 3 && s != 0.0; i++) { /* the orientation turns the frame, so the coordinates turn back */
        const double unturned = x[i];
        x[i] = c * unturned + s * y[i];
        y[i] = c * y[i] - s * unturned;
    }
    coordinates[0] = c * place[0] + s * place[1];
    coordinates[1] = c * place[1] - s * place[0];
}
