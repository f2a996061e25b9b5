/* Loads a tagged glTF scene and has it felt for five seconds: `feel_scene [FILE [DEVICE]]`. README.md shows the lines
 * between the two marks. SPDX-License-Identifier: MIT */
#include <knurl/knurl.h>

#include <stdio.h>

static int fail(void) {
    fprintf(stderr, "feel_scene: %s\n", knurl_error_message());
    return 1; /* the process ends: no need to free anything */
}

int main(int argc, char **argv) {
    const char *file = argc > 1 ? argv[1] : "assets/plate_1d.glb";
    const char *uri = argc > 2 ? argv[2] : "fake";
    knurl_scene *scene = NULL;
    knurl_device *device = NULL;
    knurl_loop *loop = NULL;
    knurl_loop_desc desc;
    (void)knurl_device_zero_on_exit(0); /* however this process ends, the motors get zero force */
    /* README: begin */
    if (knurl_scene_create(NULL, &scene) || knurl_gltf_load_file(scene, file, NULL, NULL) || /* every tagged mesh */
        knurl_scene_commit(scene) || knurl_device_open(uri, &device)) { /* "fake", "touch", "falcon" */
        return fail();
    }
    knurl_loop_desc_init(&desc, sizeof desc);
    desc.scene = scene;
    desc.device = device;
    if (knurl_loop_create(&desc, &loop) || knurl_loop_start(loop)) { /* a real-time thread at 1 kHz */
        return fail();
    }
    /* README: end */
    for (int second = 1; second <= 5 && !knurl_loop_wait(loop, 1.0); second++) {
        knurl_hip_counts counts;
        if (knurl_scene_get_tick(scene, 0, NULL, &counts)) {
            return fail();
        }
        printf("%d s: %.0f ridges, up to %.2f N\n", second, counts.half_cycles_crossed / 2.0, counts.force_max);
    }
    knurl_loop_destroy(loop); /* ramps the force down first */
    knurl_device_close(device);
    knurl_scene_destroy(scene);
    return 0;
}
