/* Dry ticks change neither the HIP nor any of its later ticks. SPDX-License-Identifier: MIT */
#include "scene/scene.h"

#include "support/scenes.h"

#define TICKS 4000

/* A rough ball with a grating, and a plate through it that is pushed to and fro. */
static knurl_scene *make_scene(knurl_surface_id *wall) {
    knurl_scene *scene = empty_scene(1);
    shape ball = shape_sphere(0.02, 3);
    surface_parts parts = surface_mesh(&ball);
    set_grating(&parts, KNURL_METHOD_BANDLIMITED, 700.0, 0.0, 0.0002);
    parts.material.friction = 0.3;
    parts.desc.axis[0] = 1.0;
    (void)add_surface(scene, &parts);
    shape_free(&ball);
    parts = surface_plane();
    set_grating(&parts, KNURL_METHOD_S2, 900.0, 0.0, 0.0003);
    parts.desc.position[2] = 0.015;
    *wall = add_surface(scene, &parts);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    return scene;
}

static void dry_tick(knurl_scene *scene, knurl_hip *scratch, const double position[3]) {
    knurl_tick_input input;
    knurl_tick_output output;
    memset(&input, 0, sizeof input);
    memcpy(input.position, position, sizeof input.position);
    knurl_hip_begin_dry(scene, &scene->hips[0], scratch);
    knurl_hip_tick(scene, scratch, &input, NULL, &output);
    knurl_hip_end_dry(&scene->hips[0]);
}

TEST(a_dry_tick_before_each_tick_changes_no_bit_of_any) {
    static knurl_hip scratch;
    knurl_surface_id walls[2];
    knurl_scene *scenes[2] = {make_scene(&walls[0]), make_scene(&walls[1])};
    knurl_hip_counts counts[2];
    uint64_t contacts = 0;
    double last[3] = {0.0, 0.0, 0.0};
    knurl_hip_init_dry(&scenes[1]->hips[0], &scratch);
    for (int i = 0; i < TICKS; i++) {
        knurl_tick_output out[2];
        knurl_tick_input input;
        memset(&input, 0, sizeof input);
        for (int axis = 0; axis < 3; axis++) {
            input.position[axis] = 0.021 * sin(0.003 * i * (axis + 1) + axis);
        }
        input.absent = i % 1000 == 999;
        for (int k = 0; k < 2; k++) {
            if (i % 300 == 299) {
                static const double level[4] = {0.0, 0.0, 0.0, 1.0};
                const double position[3] = {0.0, 0.0, 0.015 + 0.003 * sin(0.01 * i)};
                assert_int_equal(knurl_scene_set_transform(scenes[k], walls[k], position, level, 0.1), KNURL_OK);
            }
            if (k == 1) {
                dry_tick(scenes[k], &scratch, last);
            }
            assert_int_equal(knurl_scene_tick(scenes[k], 0, &input, &out[k]), KNURL_OK);
            out[k].surface = 0; /* ids carry their scene */
        }
        assert_memory_equal(&out[0], &out[1], sizeof out[0]);
        contacts += out[0].contacts > 0;
        memcpy(last, input.position, sizeof last);
    }
    for (int k = 0; k < 2; k++) {
        assert_int_equal(knurl_scene_get_tick(scenes[k], 0, NULL, &counts[k]), KNURL_OK);
        knurl_scene_destroy(scenes[k]);
    }
    assert_memory_equal(&counts[0], &counts[1], sizeof counts[0]);
    assert_true(contacts > TICKS / 4);
}

TEST(what_an_edit_takes_away_is_kept_while_a_dry_tick_may_read_it) {
    static knurl_hip scratch;
    knurl_surface_id wall;
    knurl_scene *scene = make_scene(&wall);
    const double at[3] = {0.04, 0.0, 0.0149};
    knurl_hip_init_dry(&scene->hips[0], &scratch);
    for (int i = 0; i < 50; i++) {
        dry_tick(scene, &scratch, at);
    }
    assert_int_equal(scratch.contacts.active_count, 1);
    assert_int_equal(scene->hips[0].contacts.active_count, 0); /* the HIP itself has felt nothing */
    assert_int_equal(scene->hips[0].pinned, 0);                /* and holds nothing up */
    assert_int_equal(knurl_scene_remove_surface(scene, wall), KNURL_OK);
    dry_tick(scene, &scratch, at); /* under ASan: it is gone */
    assert_int_equal(scratch.contacts.active_count, 0);
    knurl_scene_destroy(scene);
}

TEST(dry_ticks_of_a_hip_that_is_in_contact_write_nothing_to_it) {
    static knurl_hip scratch;
    static knurl_hip before;
    knurl_surface_id wall;
    knurl_scene *scene = make_scene(&wall);
    knurl_tick_input input;
    knurl_tick_output output;
    memset(&input, 0, sizeof input);
    input.position[0] = 0.04;
    for (int i = 0; i < 50; i++) {
        input.position[2] = 0.016 - 0.00003 * i;
        assert_int_equal(knurl_scene_tick(scene, 0, &input, &output), KNURL_OK);
    }
    assert_int_equal(scene->hips[0].contacts.active_count, 1);
    before = scene->hips[0];
    knurl_hip_init_dry(&scene->hips[0], &scratch);
    for (int i = 0; i < 50; i++) {
        const double beside[3] = {0.041, 0.0, 0.0145};
        dry_tick(scene, &scratch, beside);
    }
    assert_int_equal(scratch.contacts.active_count, 1);
    assert_memory_equal(&scene->hips[0], &before, sizeof before);
    knurl_scene_destroy(scene);
}
