/* A consumer in C: presses a smooth plate 1 mm deep, which answers with K times the depth. SPDX-License-Identifier: MIT
 */
#include <knurl/knurl.h>

#include <math.h>
#include <stdio.h>

static int failed(const char *what) {
    fprintf(stderr, "%s: %s\n", what, knurl_error_message());
    return 1;
}

int main(void) {
    knurl_plane_desc plane;
    knurl_material_desc material;
    knurl_surface_desc surface;
    knurl_scene *scene = NULL;
    knurl_plane_desc_init(&plane, sizeof plane);
    knurl_material_desc_init(&material, sizeof material);
    knurl_surface_desc_init(&surface, sizeof surface);
    material.stiffness = 400.0;
    surface.plane = &plane;
    surface.material = &material;
    if (knurl_scene_create(NULL, &scene) || knurl_scene_add_surface(scene, &surface, NULL) ||
        knurl_scene_commit(scene)) {
        return failed("scene");
    }
#ifdef WITH_GLTF
    if (knurl_gltf_load_memory(scene, "", 0, "nothing", NULL, NULL, NULL) != KNURL_ERROR_FORMAT) {
        return failed("an empty file");
    }
#endif
    knurl_tick_input input = {{0.0, 0.0, 0.001}, {0.0, 0.0, 0.0}, 0, 0, 0.0, 0, {0}};
    knurl_tick_output output;
    for (int i = 0; i < 1000; i++) {
        input.position[2] = fmax(-0.001, 0.001 - 0.00001 * i);
        if (knurl_scene_tick(scene, 0, &input, &output)) {
            return failed("tick");
        }
    }
    knurl_scene_destroy(scene);
    printf("%.6f N, knurl %s\n", output.force[2], knurl_version_string());
    return fabs(output.force[2] - 0.4) > 1e-9;
}
