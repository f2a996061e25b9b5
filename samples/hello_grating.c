/* The shortest useful program: a plate with a 1 mm grating, stroked by the fake device for two seconds.
 * If you have a device, open it by its name instead of "fake". SPDX-License-Identifier: MIT */
#include <knurl/knurl.h>

#include <stdio.h>

int main(void) {
    knurl_plane_desc plane;
    knurl_material_desc material;
    knurl_surface_desc surface;
    knurl_scene *scene = NULL;
    knurl_device *device = NULL;
    knurl_loop *loop = NULL;
    knurl_plane_desc_init(&plane, sizeof plane); /* 10 x 10 cm */
    knurl_material_desc_init(&material, sizeof material);
    material.spatial_frequency[0] = 1000.0; /* ridges a millimetre apart along x */
    material.amplitude = 0.0002;            /* 0.2 mm up and down */
    material.stiffness = 400.0;             /* N/m */
    knurl_surface_desc_init(&surface, sizeof surface);
    surface.plane = &plane;
    surface.material = &material;
    surface.normal[1] = 1.0; /* the plane's front faces up */

    (void)knurl_device_zero_on_exit(0); /* zero force however this program ends */
    knurl_loop_desc desc;
    knurl_loop_desc_init(&desc, sizeof desc);
    desc.tick_limit = 2000; /* at 1 kHz */
    if (knurl_scene_create(NULL, &scene) == KNURL_OK && knurl_scene_add_surface(scene, &surface, NULL) == KNURL_OK &&
        knurl_scene_commit(scene) == KNURL_OK && knurl_device_open("fake", &device) == KNURL_OK) {
        desc.scene = scene;
        desc.device = device;
        if (knurl_loop_create(&desc, &loop) == KNURL_OK && knurl_loop_start(loop) == KNURL_OK) {
            while (!knurl_loop_wait(loop, 0.25)) {
                knurl_tick_output now;
                (void)knurl_scene_get_tick(scene, 0, &now, NULL);
                printf("x %6.1f mm   depth %5.2f mm   %5.0f Hz   force %5.2f N\n", 1e3 * now.hip[0], 1e3 * now.depth,
                       now.temporal_frequency, now.force[1]);
            }
        }
    }
    const int failed = loop == NULL;
    if (failed) {
        fprintf(stderr, "hello_grating: %s\n", knurl_error_message());
    }
    knurl_loop_destroy(loop);
    knurl_device_close(device);
    knurl_scene_destroy(scene);
    return failed;
}
