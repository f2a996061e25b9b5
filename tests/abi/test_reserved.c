/* Room to grow in structs without struct_size: inputs must have zeros there, outputs are given zeros, so that a later
 * version can give them a meaning. SPDX-License-Identifier: MIT */
#include "support/idle_device.h"
#include "support/scenes.h"

#include <string.h>

static knurl_scene *open_plane(void) {
    surface_parts parts = surface_plane();
    knurl_scene *scene = NULL;
    assert_int_equal(knurl_scene_create(NULL, &scene), KNURL_OK);
    (void)add_surface(scene, &parts);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    return scene;
}

TEST(a_ticks_input_has_zeros_where_it_is_reserved) {
    knurl_scene *scene = open_plane();
    knurl_tick_output output;
    knurl_tick_input input = {.position = {0.0, 0.0, -0.001}};
    assert_int_equal(knurl_scene_tick(scene, 0, &input, &output), KNURL_OK);
    for (size_t i = 0; i < COUNT_OF(input.reserved); i++) {
        input.reserved[i] = 1u << (3 * i);
        memset(&output, 0x55, sizeof output);
        assert_int_equal(knurl_scene_tick(scene, 0, &input, &output), KNURL_ERROR_ARGUMENT);
        check_message("input.reserved: expected zeros");
        assert_true(output.force[0] == 0.0 && output.device_force[2] == 0.0);
        input.reserved[i] = 0;
    }
    assert_int_equal(knurl_scene_tick(scene, 0, &input, &output), KNURL_OK);
    knurl_scene_destroy(scene);
}

/* In contact, beside the surface, without a position and refused. */
TEST(outputs_of_a_tick_have_zeros_where_they_are_reserved) {
    static const uint64_t zeros[16];
    const knurl_tick_input inputs[] = {{.position = {0.0, 0.0, -0.001}},
                                       {.position = {0.0, 0.0, 0.5}},
                                       {.absent = 1},
                                       {.paused = 1},
                                       {.reserved = {1}}};
    knurl_scene *scene = open_plane();
    for (size_t i = 0; i < COUNT_OF(inputs); i++) {
        knurl_tick_output output;
        knurl_hip_counts counts;
        memset(&output, 0x55, sizeof output);
        memset(&counts, 0x55, sizeof counts);
        (void)knurl_scene_tick(scene, 0, &inputs[i], &output);
        assert_memory_equal(output.reserved, zeros, sizeof output.reserved);
        memset(&output, 0x55, sizeof output);
        assert_int_equal(knurl_scene_get_tick(scene, 0, &output, &counts), KNURL_OK);
        assert_memory_equal(output.reserved, zeros, sizeof output.reserved);
        assert_memory_equal(counts.reserved, zeros, sizeof counts.reserved);
    }
    knurl_scene_destroy(scene);
}

TEST(a_workspace_has_zeros_where_it_is_reserved) {
    knurl_workspace workspace;
    knurl_workspace_set_identity(&workspace);
    assert_int_equal(knurl_workspace_check(&workspace), KNURL_OK);
    for (size_t i = 0; i < COUNT_OF(workspace.reserved); i++) {
        workspace.reserved[i] = 2.0;
        assert_int_equal(knurl_workspace_check(&workspace), KNURL_ERROR_ARGUMENT);
        check_message("workspace.reserved: expected zeros, found [");
        workspace.reserved[i] = 0.0;
    }
}

TEST(a_grating_has_zeros_where_it_is_reserved) {
    static const double over[2] = {0.01, 0.0};
    knurl_grating grating = {.spatial_frequency = {1000.0, 0.0}, .amplitude = 1e-4, .update_rate_hz = 1000.0};
    knurl_grating_state before = {0};
    knurl_grating_output output;
    assert_int_equal(knurl_grating_check(&grating), KNURL_OK);
    memset(&output, 0x55, sizeof output);
    knurl_grating_step(&grating, &before, over, over, &output);
    assert_true(output.reserved == 0 && before.reserved[0] == 0 && before.reserved[1] == 0);
    for (size_t i = 0; i < COUNT_OF(grating.reserved); i++) {
        grating.reserved[i] = 3;
        assert_int_equal(knurl_grating_check(&grating), KNURL_ERROR_ARGUMENT);
        check_message("reserved: expected zeros, found [");
        grating.reserved[i] = 0;
    }
}

/* --- samples --- */

static uint32_t reserved_word;

static knurl_result read_sample(void *user, knurl_device_sample *sample) {
    static const uint32_t zeros[9];
    (void)user;
    assert_memory_equal(sample->reserved, zeros, sizeof sample->reserved);
    sample->reserved[4] = reserved_word;
    return KNURL_OK;
}

TEST(a_callers_device_gives_samples_with_zeros_where_they_are_reserved) {
    knurl_device_functions functions = idle_functions();
    knurl_device *device = NULL;
    knurl_device_sample sample;
    knurl_device_event event;
    functions.read = read_sample;
    assert_int_equal(knurl_device_open_functions(&functions, &device), KNURL_OK);
    reserved_word = 7;
    memset(&sample, 0x55, sizeof sample);
    assert_int_equal(knurl_device_read(device, &sample), KNURL_ERROR_DEVICE_NOT_READY);
    assert_int_equal(knurl_device_next_event(device, &event), 1);
    assert_int_equal(event.code, KNURL_FAULT_CORRUPT);
    reserved_word = 0;
    assert_int_equal(knurl_device_read(device, &sample), KNURL_OK);
    knurl_device_close(device);
}
