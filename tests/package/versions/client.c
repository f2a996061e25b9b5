/* A program of one version that runs with the library of another (versions.py): presses a smooth plate 1 mm deep. With
 * LATER it is compiled with the headers of a future version, and uses its new parts on request. usage: client [material
 * | input | function] SPDX-License-Identifier: MIT */
#include <knurl/knurl.h>

#include <stdio.h>
#include <string.h>

static int failed(void) {
    printf("%s\n", knurl_error_message());
    return 1;
}

int main(int count, char **arguments) {
    const char *used = count > 1 ? arguments[1] : "";
    knurl_plane_desc plane;
    knurl_material_desc material;
    knurl_surface_desc surface;
    knurl_surface_info info;
    knurl_surface_id id;
    knurl_scene *scene = NULL;
    knurl_tick_output output;
    knurl_tick_input input;
    memset(&input, 0, sizeof input);
    memset(&info, 0x55, sizeof info);
    memset(&output, 0x55, sizeof output);
    knurl_plane_desc_init(&plane, sizeof plane);
    knurl_material_desc_init(&material, sizeof material);
    knurl_surface_desc_init(&surface, sizeof surface);
    knurl_surface_info_init(&info, sizeof info);
    surface.plane = &plane;
    surface.material = &material;
#ifdef LATER
    material.later = strcmp(used, "material") == 0;
    input.later = strcmp(used, "input") == 0;
#endif
#ifdef LATER_FUNCTION
    printf("%d\n", (int)knurl_later());
#endif
    if (knurl_scene_create(NULL, &scene) || knurl_scene_add_surface(scene, &surface, &id) ||
        knurl_scene_get_surface_info(scene, id, &info) || knurl_scene_commit(scene)) {
        return failed();
    }
    for (int i = 0; i < 1000; i++) {
        input.position[2] = i < 100 ? 0.001 - 0.00002 * i : -0.001;
        if (knurl_scene_tick(scene, 0, &input, &output)) {
            return failed();
        }
    }
#ifdef LATER
    if (info.later != 0.0 || output.later != 0) {
        printf("expected zeros in what an older library does not know, found %g, %lu\n", info.later,
               (unsigned long)output.later);
        return 2;
    }
#endif
    knurl_scene_destroy(scene);
    printf("%.6f N, %s\n", output.force[2], used);
    return 0;
}
