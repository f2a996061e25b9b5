/* A scene that is edited, and a HIP that presses into it. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_EDITS_H
#define KNURL_TEST_EDITS_H

#include "support/poses.h"

#include <stdio.h>

#define K   400.0 /* N/m, the default */
#define TOL 1e-9L

static const double UPRIGHT[4] = {0.0, 0.0, 0.0, 1.0};

static knurl_scene *open_scene(int committed) {
    knurl_scene *scene = empty_scene(1);
    configure_plainly(scene, 0);
    if (committed) {
        assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    }
    return scene;
}

static void set_stiffness(knurl_scene *scene, knurl_surface_id surface, double stiffness) {
    knurl_material_desc material;
    knurl_material_desc_init(&material, sizeof material);
    material.stiffness = stiffness;
    assert_int_equal(knurl_scene_set_material(scene, surface, &material), KNURL_OK);
}

static void set_place(knurl_scene *scene, knurl_surface_id surface, double x, double y, double z) {
    const double position[3] = {x, y, z};
    assert_int_equal(knurl_scene_set_transform(scene, surface, position, UPRIGHT, 0.0), KNURL_OK);
}

/* Presses HIP 0 from above to z at (x, 0). Returns the last tick. */
static knurl_tick_output press(knurl_scene *scene, double x, double z) {
    (void)tick_at(scene, x, 0.0, 0.05);
    return tick_at(scene, x, 0.0, z);
}

/* A scene whose one surface is pressed 1 mm deep. */
static knurl_scene *pressed_scene(knurl_surface_id *id) {
    surface_parts parts = surface_plane();
    knurl_scene *scene = scene_of(&parts);
    *id = knurl_scene_get_surface(scene, 0);
    (void)press(scene, 0.0, -0.001);
    return scene;
}

#endif
