/* A workspace that is moved and zoomed while its HIP ticks. Expected positions, velocities and forces are computed by
 * hand from its pose. SPDX-License-Identifier: MIT */
#include "scene/ask.h"

#include "base/vec3.h"

#define TICK 0.001 /* s */

static knurl_workspace at(double x, double y, double z) {
    knurl_workspace workspace;
    knurl_workspace_set_identity(&workspace);
    workspace.origin[0] = x;
    workspace.origin[1] = y;
    workspace.origin[2] = z;
    return workspace;
}

/* A workspace at (0, 0, z) of some scale. */
static knurl_workspace zoomed(double z, double scale) {
    knurl_workspace workspace = at(0.0, 0.0, z);
    workspace.scale = scale;
    return workspace;
}

static void move(knurl_scene *scene, const knurl_workspace *to, double seconds) {
    assert_int_equal(knurl_scene_set_workspace(scene, 0, to, seconds), KNURL_OK);
}

TEST(the_hip_goes_with_its_workspace_at_its_speed) {
    SCOPED_SCENE *scene = scene_of_plane();
    const knurl_workspace to = at(0.01, 0.0, 0.02);
    (void)tick_at(scene, 0.001, 0.0, 0.03);
    move(scene, &to, 0.1); /* 0.1 m/s along x, 0.2 m/s along z */
    for (int k = 1; k <= 100; k++) {
        const knurl_tick_output out = tick_at(scene, 0.001, 0.0, 0.03);
        CHECK_VECTOR(out.hip, 0.001 + 0.1 * TICK * k, 0.0, 0.03 + 0.2 * TICK * k, 1e-12);
        CHECK_VECTOR(out.hip_velocity, 0.1, 0.0, 0.2, 1e-9);
    }
    const knurl_tick_output out = tick_at(scene, 0.001, 0.0, 0.03);
    CHECK_VECTOR(out.hip, 0.011, 0.0, 0.05, 1e-12);
    CHECK_VECTOR(out.hip_velocity, 0.0, 0.0, 0.0, 1e-12);
}

/* A quarter turn about z in 0.1 s: the HIP, 10 mm from the origin, moves at 0.01 m * pi/2 / 0.1 s. */
TEST(a_workspace_that_turns_takes_positions_and_forces_along) {
    static const double quarter[9] = {0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0};
    SCOPED_SCENE *scene = scene_of_plane();
    knurl_workspace to = at(0.0, 0.0, 0.0);
    memcpy(to.rotation, quarter, sizeof quarter);
    (void)tick_at(scene, 0.01, 0.0, 0.01);
    move(scene, &to, 0.1);
    for (int k = 1; k <= 50; k++) {
        const knurl_tick_output out = tick_at(scene, 0.01, 0.0, 0.01);
        CHECK_CLOSE(vec3_length(out.hip_velocity), 0.15707963267948966, 1e-9);
        if (k == 50) { /* half way: 45 degrees */
            CHECK_VECTOR(out.hip, 0.0070710678118654752, 0.0070710678118654752, 0.01, 1e-12);
        }
    }
    for (int k = 0; k < 51; k++) {
        (void)tick_at(scene, 0.01, 0.0, 0.01);
    }
    CHECK_VECTOR(tick_at(scene, 0.01, 0.0, 0.01).hip, 0.0, 0.01, 0.01, 1e-12);
}

/* Down onto the wall: held at its surface, 400 N/m times the depth. The device's own axes are turned upside down, so
 * that its force has the other sign. */
TEST(a_workspace_presses_its_hip_into_a_wall_like_a_hand) {
    static const double over[9] = {1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, -1.0};
    SCOPED_SCENE *scene = scene_of_plane();
    knurl_workspace start = at(0.0, 0.0, 0.01);
    memcpy(start.rotation, over, sizeof over);
    move(scene, &start, 0.0);
    (void)tick_at(scene, 0.0, 0.0, 0.0);
    knurl_workspace to = start;
    to.origin[2] = -0.004;
    move(scene, &to, 0.05);
    for (int k = 0; k < 50; k++) {
        (void)tick_at(scene, 0.0, 0.0, 0.0);
    }
    const knurl_tick_output out = tick_at(scene, 0.0, 0.0, 0.0);
    CHECK_VECTOR(out.force, 0.0, 0.0, 1.6, 1e-9);
    CHECK_VECTOR(out.device_force, 0.0, 0.0, -1.6, 1e-9);
}

TEST(a_workspace_that_jumps_touches_nothing_on_its_way) {
    SCOPED_SCENE *scene = scene_of_plane();
    const knurl_workspace to = at(0.0, 0.0, -0.05);
    (void)tick_at(scene, 0.0, 0.0, 0.02);
    move(scene, &to, 0.0);
    const knurl_tick_output out = tick_at(scene, 0.0, 0.0, 0.02);
    CHECK_VECTOR(out.hip, 0.0, 0.0, -0.03, 1e-12);
    assert_int_equal(out.contacts, 0);
    CHECK_VECTOR(out.force, 0.0, 0.0, 0.0, 0.0);
    CHECK_VECTOR(out.hip_velocity, 0.0, 0.0, 0.0, 1e-12);
}

/* 1 mm ridges under a hand at rest, in a workspace that passes at 100 mm/s: 100 ridges a second. */
TEST(ridges_are_felt_at_the_workspaces_speed) {
    surface_parts parts = surface_plane();
    set_grating(&parts, KNURL_METHOD_S1, 1000.0, 0.0, 0.0002);
    SCOPED_SCENE *scene = scene_of(&parts);
    const knurl_workspace to = at(0.02, 0.0, 0.0);
    (void)tick_at(scene, 0.0, 0.0, -0.001);
    move(scene, &to, 0.2);
    for (int k = 0; k < 200; k++) {
        CHECK_CLOSE(tick_at(scene, 0.0, 0.0, -0.001).temporal_frequency, 100.0, 1e-6);
    }
}

TEST(moves_in_a_row_go_on_from_where_the_workspace_is) {
    SCOPED_SCENE *scene = scene_of_plane();
    const knurl_workspace first = at(0.1, 0.0, 0.0);
    const knurl_workspace second = at(0.0, 0.0, 0.0);
    knurl_workspace told;
    (void)tick_at(scene, 0.0, 0.0, 0.03);
    move(scene, &first, 0.1);
    for (int k = 0; k < 20; k++) {
        (void)tick_at(scene, 0.0, 0.0, 0.03);
    }
    move(scene, &second, 0.02); /* from x = 20 mm, at 1 m/s */
    CHECK_CLOSE(tick_at(scene, 0.0, 0.0, 0.03).hip[0], 0.019, 1e-12);
    assert_int_equal(knurl_scene_get_workspace(scene, 0, &told), KNURL_OK);
    CHECK_VECTOR(told.origin, 0.0, 0.0, 0.0, 0.0);
}

TEST(invalid_moves_are_refused_with_the_expected_values) {
    knurl_scene *scene = scene_of_plane();
    knurl_workspace bad = at(0.0, 0.0, 0.0);
    bad.scale = 0.0;
    assert_int_equal(knurl_scene_set_workspace(scene, 0, &bad, 0.1), KNURL_ERROR_ARGUMENT);
    assert_non_null(strstr(knurl_error_message(), "workspace.scale"));
    bad = at(NAN, 0.0, 0.0);
    assert_int_equal(knurl_scene_set_workspace(scene, 0, &bad, 0.1), KNURL_ERROR_ARGUMENT);
    bad = at(0.0, 0.0, 0.0);
    assert_int_equal(knurl_scene_set_workspace(scene, 0, &bad, NAN), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_scene_set_workspace(scene, 0, &bad, 11.0), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_scene_set_workspace(scene, 1, &bad, 0.1), KNURL_ERROR_ARGUMENT);
    knurl_scene_destroy(scene);
    scene = empty_scene(1);
    assert_int_equal(knurl_scene_set_workspace(scene, 0, &bad, 0.1), KNURL_ERROR_STATE);
    knurl_scene_destroy(scene);
}

/* Doubled in a second: the scale is 2^t, the velocity the change of position. */
TEST(a_zoom_carries_the_hip_from_the_origin_at_its_speed) {
    SCOPED_SCENE *scene = scene_of_plane();
    const knurl_workspace to = zoomed(0.01, 2.0);
    const knurl_workspace start = at(0.0, 0.0, 0.01);
    move(scene, &start, 0.0);
    (void)tick_at(scene, 0.01, 0.02, 0.03);
    move(scene, &to, 1.0);
    for (int k = 1; k <= 1000; k++) {
        const double scale = exp2(TICK * k);
        const double rate = (scale - exp2(TICK * (k - 1))) / TICK;
        const knurl_tick_output out = tick_at(scene, 0.01, 0.02, 0.03);
        CHECK_VECTOR(out.hip, 0.01 * scale, 0.02 * scale, 0.01 + 0.03 * scale, 1e-12);
        CHECK_VECTOR(out.hip_velocity, 0.01 * rate, 0.02 * rate, 0.03 * rate, 1e-9);
    }
    const knurl_tick_output out = tick_at(scene, 0.01, 0.02, 0.03);
    CHECK_VECTOR(out.hip, 0.02, 0.04, 0.07, 1e-12);
    CHECK_VECTOR(out.hip_velocity, 0.0, 0.0, 0.0, 0.0);
}

/* As above, with 200 ticks without a position: the velocity after them is that of one tick. */
TEST(a_zoom_that_goes_on_without_a_position_is_not_made_up_for_in_one_tick) {
    SCOPED_SCENE *scene = scene_of_plane();
    const knurl_workspace to = zoomed(0.0, 2.0);
    knurl_tick_input input;
    knurl_tick_output out;
    memset(&input, 0, sizeof input);
    (void)tick_at(scene, 0.01, 0.02, 0.03);
    move(scene, &to, 1.0);
    (void)tick_at(scene, 0.01, 0.02, 0.03);
    input.absent = 1;
    for (int k = 2; k <= 201; k++) {
        assert_int_equal(knurl_scene_tick(scene, 0, &input, &out), KNURL_OK);
    }
    const double scale = exp2(0.202), rate = (scale - exp2(0.201)) / TICK;
    out = tick_at(scene, 0.01, 0.02, 0.03);
    CHECK_VECTOR(out.hip, 0.01 * scale, 0.02 * scale, 0.03 * scale, 1e-12);
    CHECK_VECTOR(out.hip_velocity, 0.01 * rate, 0.02 * rate, 0.03 * rate, 1e-9);
}

TEST(a_zoom_takes_a_fifth_of_a_second_for_a_factor_of_e_at_least) {
    SCOPED_SCENE *scene = scene_of_plane();
    const knurl_workspace in = zoomed(0.0, exp(-2.0));
    (void)tick_at(scene, 0.03, 0.0, 0.03);
    move(scene, &in, 0.001);
    for (int k = 1; k <= 400; k++) {
        CHECK_CLOSE(tick_at(scene, 0.03, 0.0, 0.03).hip[0], 0.03 * exp(-0.005 * k), 1e-12);
    }
    CHECK_CLOSE(tick_at(scene, 0.03, 0.0, 0.03).hip[0], 0.03 * exp(-2.0), 1e-15);
}

/* Engines set a workspace in every frame. */
TEST(a_zoom_goes_on_while_the_workspace_is_moved_on) {
    SCOPED_SCENE *scene = scene_of_plane();
    const knurl_workspace first = zoomed(0.0, exp(1.0));
    knurl_workspace told;
    (void)tick_at(scene, 0.03, 0.0, 0.03);
    move(scene, &first, 1.0);
    for (int k = 1; k <= 1000; k++) {
        const knurl_workspace to = zoomed(0.0001 * k, exp(1.0));
        move(scene, &to, 0.001);
        CHECK_CLOSE(tick_at(scene, 0.03, 0.0, 0.03).hip[0], 0.03 * exp(0.001 * k), 1e-12);
    }
    assert_int_equal(knurl_scene_get_workspace(scene, 0, &told), KNURL_OK);
    CHECK_SAME(told.scale, exp(1.0));
}

TEST(a_jump_ends_a_zoom) {
    SCOPED_SCENE *scene = scene_of_plane();
    const knurl_workspace to = zoomed(0.0, 2.0);
    (void)tick_at(scene, 0.03, 0.0, 0.03);
    move(scene, &to, 1.0);
    (void)tick_at(scene, 0.03, 0.0, 0.03);
    move(scene, &to, 0.0);
    CHECK_VECTOR(tick_at(scene, 0.03, 0.0, 0.03).hip, 0.06, 0.0, 0.06, 0.0);
}

/* 11 mm below the origin, which is 10 mm above the wall: 1 mm deep, then 3.2 mm. The HIP moves at 5/s times 13.2 mm at
 * most, and the force grows by 400 N/m times that. */
TEST(a_zoom_presses_its_hip_into_a_wall_without_a_jump) {
    SCOPED_SCENE *scene = scene_of_plane();
    const knurl_workspace start = at(0.0, 0.0, 0.01);
    const knurl_workspace to = zoomed(0.01, 1.2);
    move(scene, &start, 0.0);
    for (int k = 0; k < 100; k++) {
        (void)tick_at(scene, 0.0, 0.0, -0.009 - 0.00002 * k);
    }
    (void)tick_at(scene, 0.0, 0.0, -0.011);
    double force = tick_at(scene, 0.0, 0.0, -0.011).force[2];
    CHECK_CLOSE(force, 0.4, 1e-9);
    move(scene, &to, 0.0001);
    for (int k = 0; k < 100; k++) {
        const knurl_tick_output out = tick_at(scene, 0.0, 0.0, -0.011);
        assert_int_equal(out.contacts, 1);
        assert_true(out.force[2] >= force && out.force[2] - force <= 400.0 * 5.0 * 0.0132 * TICK);
        force = out.force[2];
    }
    CHECK_CLOSE(force, 1.28, 1e-9);
}

/* From 2 mm above the wall to 19.6 mm and 25 mm below it, farther than a first tick reaches. */
TEST(a_zoom_that_jumps_touches_nothing) {
    SCOPED_SCENE *scene = scene_of_plane();
    const knurl_workspace start = at(0.0, 0.0, 0.02);
    move(scene, &start, 0.0);
    (void)tick_at(scene, 0.0, 0.0, -0.018);
    for (int k = 0; k < 10; k++) {
        const knurl_workspace to = zoomed(0.02, k % 2 ? 2.2 : 2.5);
        move(scene, &to, 0.0);
        const knurl_tick_output out = tick_at(scene, 0.0, 0.0, -0.018);
        assert_int_equal(out.contacts, 0);
        CHECK_VECTOR(out.force, 0.0, 0.0, 0.0, 0.0);
        CHECK_VECTOR(out.hip_velocity, 0.0, 0.0, 0.0, 0.0);
    }
}

/* Ridges on a wall beyond the device's limits, with all protections: the same bits at the same scale. */
static knurl_scene *stiff_wall(double scale) {
    surface_parts parts = surface_plane();
    knurl_workspace workspace = zoomed(0.0, scale);
    knurl_hip_desc desc;
    knurl_hip_desc_init(&desc, sizeof desc);
    desc.workspace = &workspace;
    desc.clamp = 1;
    set_grating(&parts, KNURL_METHOD_BANDLIMITED, 1000.0, 0.0, 0.0002);
    parts.material.stiffness = 5000.0;
    knurl_scene *scene = scene_of(&parts);
    assert_int_equal(knurl_scene_configure_hip(scene, 0, &desc), KNURL_OK);
    return scene;
}

TEST(after_a_zoom_all_is_as_with_a_hip_of_that_scale) {
    knurl_scene *scenes[2] = {stiff_wall(2.0), stiff_wall(1.0)};
    knurl_tick_output out[2];
    const knurl_workspace to = zoomed(0.0, 2.0);
    move(scenes[1], &to, 0.1);
    for (int k = 0; k < 300; k++) { /* above it */
        out[0] = tick_at(scenes[0], 0.0, 0.0, 0.01);
        out[1] = tick_at(scenes[1], 0.0, 0.0, 0.01);
    }
    for (int k = 0; k < 2000; k++) { /* in and out of it, slowly and fast */
        const double x = 0.00005 * k;
        const double z = 0.0005 * sin(1e-5 * k * k);
        out[0] = tick_at(scenes[0], x, 0.0, z);
        out[1] = tick_at(scenes[1], x, 0.0, z);
        assert_memory_equal(out[0].force, out[1].force, sizeof out[0].force);
    }
    const knurl_surface_check checks[2] = {first_check(scenes[0]), first_check(scenes[1])};
    knurl_scene_destroy(scenes[0]);
    knurl_scene_destroy(scenes[1]);
    assert_memory_equal(&checks[0], &checks[1], sizeof checks[0]);
    CHECK_SAME(checks[1].stiffness, 10000.0);
}
