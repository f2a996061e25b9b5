/* Surface coordinates on a mesh: tangents and uvs at a contact. SPDX-License-Identifier: MIT */
#include "contact/contact.h"

#include "base/vec3.h"

/* A vertex attribute of `width` floats at a contact. */
static void interpolate(const knurl_mesh *mesh, const float *values, uint32_t width, const knurl_contact *contact,
                        double *out) {
    for (uint32_t k = 0; k < width; k++) {
        out[k] = 0.0;
        for (uint32_t corner = 0; corner < 3; corner++) {
            const size_t vertex = mesh->triangles[3 * (size_t)contact->triangle + corner];
            out[k] += contact->weights[corner] * (double)values[width * vertex + k];
        }
    }
}

/* x from the tangents, else from dP/du; position on the grating from the uvs, scaled to mean metres. */
void knurl_mesh_frame(const knurl_mesh *mesh, const knurl_contact *contact, double x[3], double coordinates[2]) {
    x[0] = x[1] = x[2] = coordinates[0] = coordinates[1] = 0.0;
    double du[3];
    double dv[3];
    if (knurl_mesh_uv_frame(mesh, contact->triangle, du, dv)) {
        double uv[2];
        double across[3];
        interpolate(mesh, mesh->uvs, 2, contact, uv);
        vec3_cross(du, dv, across);
        /* y = n x x, whichever way v runs: glTF's v runs down the image. */
        coordinates[0] = uv[0] * mesh->uv_scale[0];
        coordinates[1] = uv[1] * mesh->uv_scale[1] * (vec3_dot(across, contact->normal) < 0.0 ? -1.0 : 1.0);
        vec3_copy(du, x);
    }
    if (mesh->tangents) {
        interpolate(mesh, mesh->tangents, 3, contact, x);
    }
}
