/* What is felt at points of a tagged glTF file: `cycles FILE < POINTS`. POINTS has lines of x y z, m, and a normal; 0 0
 * 0 is that of the closest triangle (glTF's axes). A HIP enters the surface at each point, and a line is printed: the
 * distance of its proxy from the point (m), and its position on the grating, in cycles along x and y.
 * SPDX-License-Identifier: MIT */
#include <knurl/knurl.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define OUTSIDE 1e-4 /* m: the HIP comes from here */
#define INSIDE  1e-6 /* m */

static int fail(void) {
    fprintf(stderr, "cycles: %s\n", knurl_error_message());
    return 1;
}

/* A tick with the HIP at `height` (m) above the point p[0..2] along the normal p[3..5]. */
static knurl_result tick(knurl_scene *scene, const double p[6], double height, uint32_t absent,
                         knurl_tick_output *output) {
    knurl_tick_input input = {.absent = absent};
    for (int i = 0; i < 3; i++) {
        input.position[i] = p[i] + height * p[3 + i];
    }
    return knurl_scene_tick(scene, 0, &input, output);
}

/* Prints how far the proxy is from a point (m), and the cycles there. */
static knurl_result feel(knurl_scene *scene, double p[6]) {
    knurl_tick_output output;
    knurl_surface_point point;
    double off = 0.0;
    knurl_surface_point_init(&point, sizeof point);
    knurl_result result = knurl_scene_find_closest(scene, p, 1.0, &point);
    if (p[3] == 0.0 && p[4] == 0.0 && p[5] == 0.0) {
        memcpy(p + 3, point.normal, sizeof point.normal);
    }
    result = result ? result : tick(scene, p, 0.0, 1, &output);
    result = result ? result : tick(scene, p, OUTSIDE, 0, &output);
    result = result ? result : tick(scene, p, -INSIDE, 0, &output);
    for (int i = 0; i < 3 && !result; i++) {
        off += (output.proxy[i] - p[i]) * (output.proxy[i] - p[i]);
    }
    if (!result) {
        printf("%.9g %.12g %.12g\n", sqrt(off), output.cycles[0], output.cycles[1]);
    }
    return result;
}

int main(int argc, char **argv) {
    knurl_scene *scene = NULL;
    knurl_workspace workspace;
    knurl_hip_desc desc;
    knurl_hip_desc_init(&desc, sizeof desc);
    knurl_workspace_set_identity(&workspace);
    desc.workspace = &workspace;
    desc.resolution = 0.0;
    if (argc != 2) {
        fputs("usage: cycles FILE < POINTS\n", stderr);
        return 2;
    }
    if (knurl_scene_create(NULL, &scene) || knurl_gltf_load_file(scene, argv[1], NULL, NULL) ||
        knurl_scene_configure_hip(scene, 0, &desc) || knurl_scene_commit(scene)) {
        return fail();
    }
    char line[256];
    while (fgets(line, sizeof line, stdin)) {
        double p[6];
        char *rest = line;
        for (int i = 0; i < 6; i++) {
            p[i] = strtod(rest, &rest);
        }
        if (feel(scene, p)) {
            return fail();
        }
    }
    knurl_scene_destroy(scene);
    return 0;
}
