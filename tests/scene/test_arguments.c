/* Each pointer that may not be null, null by itself: refused, or no effect, and nothing written.
 * SPDX-License-Identifier: MIT */
#include "scene/ask.h"

#include <knurl/knurl.h>

#define REFUSED(call, object) CHECK_REFUSED(call, KNURL_ERROR_ARGUMENT, object)

TEST(edits_of_a_scene_refuse_null) {
    surface_parts parts = surface_plane();
    SCOPED_SCENE *s = scene_of(&parts);
    knurl_scene *none = NULL;
    const knurl_surface_desc *desc = surface_ready(&parts);
    const double at[3] = {0.0, 0.0, 0.1}, q[4] = {0.0, 0.0, 0.0, 1.0};
    knurl_surface_id id = knurl_scene_get_surface(s, 0);
    knurl_scene_desc scene_desc;
    knurl_material_desc material = parts.material;
    knurl_scene_desc_init(&scene_desc, sizeof scene_desc);
    REFUSED(knurl_scene_create(&scene_desc, NULL), none);
    REFUSED(knurl_scene_add_surface(NULL, desc, &id), id);
    REFUSED(knurl_scene_add_surface(s, NULL, &id), id);
    REFUSED(knurl_scene_remove_surface(NULL, id), id);
    REFUSED(knurl_scene_replace_surface(NULL, id, desc), id);
    REFUSED(knurl_scene_replace_surface(s, id, NULL), id);
    REFUSED(knurl_scene_set_material(NULL, id, &material), id);
    REFUSED(knurl_scene_set_material(s, id, NULL), id);
    REFUSED(knurl_scene_get_material(NULL, id, &material), material);
    REFUSED(knurl_scene_get_material(s, id, NULL), id);
    REFUSED(knurl_scene_set_transform(NULL, id, at, q, 0.0), id);
    REFUSED(knurl_scene_set_transform(s, id, NULL, q, 0.0), id);
    REFUSED(knurl_scene_set_transform(s, id, at, NULL, 0.0), id);
    REFUSED(knurl_scene_commit(NULL), id);
    REFUSED(knurl_scene_lock_memory(NULL), id);
    knurl_scene_collect(NULL);
    knurl_scene_destroy(NULL);
}

TEST(questions_to_a_scene_refuse_null) {
    SCOPED_SCENE *s = scene_of_plane();
    const double at[3] = {0.0, 0.0, 0.1}, to[3] = {0.0, 0.0, -0.1};
    char name[KNURL_NAME_SIZE] = "untouched";
    knurl_surface_id id = knurl_scene_get_surface(s, 0);
    knurl_surface_info info;
    knurl_surface_point point;
    knurl_surface_check check;
    knurl_surface_info_init(&info, sizeof info);
    knurl_surface_point_init(&point, sizeof point);
    knurl_surface_check_init(&check, sizeof check);
    REFUSED(knurl_scene_find_surface(NULL, "plate", &id), id);
    REFUSED(knurl_scene_find_surface(s, NULL, &id), id);
    REFUSED(knurl_scene_find_surface(s, "plate", NULL), id);
    REFUSED(knurl_scene_get_surface_name(NULL, id, name), name);
    REFUSED(knurl_scene_get_surface_name(s, id, NULL), id);
    REFUSED(knurl_scene_get_surface_info(NULL, id, &info), info);
    REFUSED(knurl_scene_get_surface_info(s, id, NULL), id);
    REFUSED(knurl_scene_find_closest(NULL, at, 1.0, &point), point);
    REFUSED(knurl_scene_find_closest(s, NULL, 1.0, &point), point);
    REFUSED(knurl_scene_find_closest(s, at, 1.0, NULL), id);
    REFUSED(knurl_scene_find_closest_batch(s, NULL, 1, 1.0, &point), point);
    REFUSED(knurl_scene_cast_ray(NULL, at, to, &point), point);
    REFUSED(knurl_scene_cast_ray(s, NULL, to, &point), point);
    REFUSED(knurl_scene_cast_ray(s, at, NULL, &point), point);
    REFUSED(knurl_scene_cast_ray(s, at, to, NULL), id);
    REFUSED(knurl_scene_check_surface(NULL, 0, id, &check), check);
    REFUSED(knurl_scene_check_surface(s, 0, id, NULL), id);
    assert_int_equal(knurl_scene_get_surface_count(NULL), 0);
    assert_true(knurl_scene_get_surface(NULL, 0) == 0 && knurl_scene_has_surface(NULL, id) == 0);
    assert_true(knurl_scene_get_bytes(NULL) == 0);
}

TEST(functions_of_a_hip_refuse_null) {
    SCOPED_SCENE *s = scene_of_plane();
    knurl_hip_desc desc;
    knurl_workspace workspace;
    knurl_tick_input input;
    knurl_tick_output output;
    knurl_hip_counts counts;
    knurl_hip_contact contact;
    memset(&input, 0, sizeof input);
    memset(&output, 0x5a, sizeof output);
    memset(&counts, 0x5a, sizeof counts);
    knurl_hip_desc_init(&desc, sizeof desc);
    knurl_workspace_set_identity(&workspace);
    REFUSED(knurl_scene_configure_hip(NULL, 0, &desc), desc);
    REFUSED(knurl_scene_get_workspace(NULL, 0, &workspace), workspace);
    REFUSED(knurl_scene_get_workspace(s, 0, NULL), workspace);
    REFUSED(knurl_scene_set_workspace(NULL, 0, &workspace, 0.0), workspace);
    REFUSED(knurl_scene_set_workspace(s, 0, NULL, 0.0), workspace);
    REFUSED(knurl_scene_get_tick(NULL, 0, &output, &counts), output);
    assert_int_equal(knurl_scene_tick(NULL, 0, &input, &output), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_scene_tick(s, 0, NULL, &output), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_scene_tick(s, 0, &input, NULL), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_scene_tick_batch(NULL, 0, &input, 1, &output), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_scene_tick_batch(s, 0, NULL, 1, &output), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_scene_tick_batch(s, 0, &input, 1, NULL), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_scene_get_contacts(NULL, 0, &contact, 1), 0);
}

TEST(workspaces_velocities_and_waves_take_null_as_nothing) {
    const double at[3] = {1.0, 2.0, 3.0};
    double out[3] = {7.0, 7.0, 7.0};
    knurl_workspace workspace;
    knurl_velocity velocity;
    knurl_workspace_set_identity(&workspace);
    assert_int_equal(knurl_velocity_prepare(KNURL_VELOCITY_FOAW, 1e-5, 1000.0, &velocity), KNURL_OK);
    knurl_workspace_to_scene(NULL, at, out);
    knurl_workspace_to_scene(&workspace, NULL, out);
    knurl_workspace_to_scene(&workspace, at, NULL);
    knurl_workspace_to_device(NULL, at, out);
    knurl_workspace_to_device(&workspace, NULL, out);
    knurl_workspace_to_device(&workspace, at, NULL);
    knurl_workspace_vector_to_device(NULL, at, out);
    knurl_workspace_vector_to_device(&workspace, NULL, out);
    knurl_workspace_vector_to_device(&workspace, at, NULL);
    knurl_velocity_update(NULL, at, out);
    knurl_velocity_update(&velocity, NULL, out);
    knurl_velocity_update(&velocity, at, NULL);
    CHECK_VECTOR(out, 7.0, 7.0, 7.0, 0.0);
    CHECK_REFUSED(knurl_velocity_prepare(KNURL_VELOCITY_FOAW, 1e-5, 1000.0, NULL), KNURL_ERROR_ARGUMENT, out);
    CHECK_REFUSED(knurl_workspace_check(NULL), KNURL_ERROR_ARGUMENT, out);
    CHECK_REFUSED(knurl_vibration_event_prepare(2.0, 1.0, NULL), KNURL_ERROR_ARGUMENT, out);
    CHECK_REFUSED(knurl_wave_prepare(KNURL_WAVE_T1, 0.01, 1.0, 1000.0, NULL), KNURL_ERROR_ARGUMENT, out);
    CHECK_SAME(knurl_vibration_event_height(NULL, 0), 0.0);
    CHECK_SAME(knurl_wave_value(NULL, 0), 0.0);
}
