/* The map between a device's workspace and the scene. SPDX-License-Identifier: MIT */
#include <knurl/motion.h>

#include "base/handle.h"
#include "base/number.h"
#include "base/vec3.h"

#include <string.h>

void knurl_workspace_set_identity(knurl_workspace *workspace) {
    if (KNURL_IS_NULL(workspace)) {
        return;
    }
    memset(workspace, 0, sizeof *workspace);
    workspace->rotation[0] = workspace->rotation[4] = workspace->rotation[8] = 1.0;
    workspace->scale = 1.0;
}

knurl_result knurl_workspace_check(const knurl_workspace *workspace) {
    if (KNURL_IS_NULL(workspace)) {
        return KNURL_ERROR_ARGUMENT;
    }
    const double *r = workspace->rotation;
    double cross[3];
    static const knurl_field scale = {"scale", offsetof(knurl_workspace, scale), {1e-9, 1e9, "", 0}};
    knurl_result result = knurl_check_coordinates("workspace.origin", "m", workspace->origin);
    result = result ? result : knurl_fields_check("workspace", &scale, 1, workspace);
    if (result) {
        return result;
    }
    const double *reserved = workspace->reserved;
    if (!(reserved[0] == 0.0 && reserved[1] == 0.0 && reserved[2] == 0.0)) { /* reserved for later versions */
        return knurl_fail(KNURL_ERROR_ARGUMENT, "workspace.reserved: expected zeros, found [%g, %g, %g]", reserved[0],
                          reserved[1], reserved[2]);
    }
    vec3_cross(r, r + 3, cross); /* the third row of a rotation is the cross product of the others */
    const double off =
        fmax(fabs(vec3_dot(r, r) - 1.0), fmax(fabs(vec3_dot(r + 3, r + 3) - 1.0), fabs(vec3_dot(r, r + 3))));
    vec3_sub(cross, r + 6, cross);
    if (!(off <= 1e-6 && vec3_length(cross) <= 1e-6)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT,
                          "workspace.rotation: expected a right-handed rotation matrix, found one that "
                          "is off orthonormal by more than 1e-6");
    }
    return KNURL_OK;
}

void knurl_workspace_to_scene(const knurl_workspace *workspace, const double device[3], double scene[3]) {
    if (!workspace || !device || !scene) {
        return;
    }
    double turned[3];
    mat3_mul(workspace->rotation, device, turned);
    vec3_madd(workspace->origin, workspace->scale, turned, scene);
}

void knurl_workspace_to_device(const knurl_workspace *workspace, const double scene[3], double device[3]) {
    if (!workspace || !scene || !device) {
        return;
    }
    double offset[3];
    vec3_sub(scene, workspace->origin, offset);
    vec3_scale(1.0 / workspace->scale, offset, offset);
    mat3_mul_transposed(workspace->rotation, offset, device);
}

void knurl_workspace_vector_to_device(const knurl_workspace *workspace, const double scene[3], double device[3]) {
    if (!workspace || !scene || !device) {
        return;
    }
    mat3_mul_transposed(workspace->rotation, scene, device);
}
