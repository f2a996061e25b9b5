/* Reserved fields: 0, or an error, so that a later version can give them a meaning. SPDX-License-Identifier: MIT */
#include "support/scenes.h"

#include <string.h>

TEST(a_ticks_input_has_zeros_where_it_is_reserved) {
    surface_parts parts = surface_plane();
    knurl_scene *scene = NULL;
    knurl_tick_output output;
    assert_int_equal(knurl_scene_create(NULL, &scene), KNURL_OK);
    (void)add_surface(scene, &parts);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    knurl_tick_input input = {.position = {0.0, 0.0, 0.01}};
    assert_int_equal(knurl_scene_tick(scene, 0, &input, &output), KNURL_OK);
    input.reserved = 1;
    memset(&output, 0x55, sizeof output);
    assert_int_equal(knurl_scene_tick(scene, 0, &input, &output), KNURL_ERROR_ARGUMENT);
    check_message("input.reserved: expected 0");
    assert_true(output.force[0] == 0.0 && output.device_force[2] == 0.0);
    knurl_scene_destroy(scene);
}

TEST(a_workspace_has_zeros_where_it_is_reserved) {
    knurl_workspace workspace;
    knurl_workspace_init(&workspace);
    assert_int_equal(knurl_workspace_check(&workspace), KNURL_OK);
    workspace.reserved = 2.0;
    assert_int_equal(knurl_workspace_check(&workspace), KNURL_ERROR_ARGUMENT);
    check_message("workspace.reserved: expected 0, found 2");
}

TEST(a_grating_has_zeros_where_it_is_reserved) {
    knurl_grating grating = {.spatial_frequency = {1000.0, 0.0}, .amplitude = 1e-4, .update_rate_hz = 1000.0};
    assert_int_equal(knurl_grating_check(&grating), KNURL_OK);
    grating.reserved = 3;
    assert_int_equal(knurl_grating_check(&grating), KNURL_ERROR_ARGUMENT);
    check_message("reserved: expected 0, found 3");
}
