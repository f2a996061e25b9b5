/* A workspace that is moved while its HIP ticks. Positions, velocities and forces follow from where it is, by hand.
 * SPDX-License-Identifier: MIT */
#include "support/scenes.h"

#include "base/vec3.h"

#define TICK 0.001 /* s */

/* A wall of 400 N/m with front up at z = 0, 100 x 100 mm. */
static knurl_scene *wall(void) {
    surface_parts parts = surface_plane();
    return scene_of(&parts);
}

static knurl_workspace at(double x, double y, double z) {
    knurl_workspace workspace;
    knurl_workspace_init(&workspace);
    workspace.origin[0] = x;
    workspace.origin[1] = y;
    workspace.origin[2] = z;
    return workspace;
}

static void move(knurl_scene *scene, const knurl_workspace *to, double seconds) {
    assert_int_equal(knurl_scene_set_workspace(scene, 0, to, seconds), KNURL_OK);
}

TEST(the_hip_goes_with_its_workspace_at_its_speed) {
    knurl_scene *scene = wall();
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
    knurl_scene_destroy(scene);
}

/* A quarter turn about z in 0.1 s: the HIP, 10 mm off the origin, goes round at 0.01 m * pi/2 / 0.1 s. */
TEST(a_workspace_that_turns_takes_positions_and_forces_along) {
    static const double quarter[9] = {0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0};
    knurl_scene *scene = wall();
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
    knurl_scene_destroy(scene);
}

/* Down onto the wall: held at its surface, 400 N/m times the depth. The device's own axes are turned upside down, so
 * that its force has the other sign. */
TEST(a_workspace_presses_its_hip_into_a_wall_like_a_hand) {
    static const double over[9] = {1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, -1.0};
    knurl_scene *scene = wall();
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
    knurl_scene_destroy(scene);
}

TEST(a_workspace_that_jumps_touches_nothing_on_its_way) {
    knurl_scene *scene = wall();
    const knurl_workspace to = at(0.0, 0.0, -0.05);
    (void)tick_at(scene, 0.0, 0.0, 0.02);
    move(scene, &to, 0.0);
    const knurl_tick_output out = tick_at(scene, 0.0, 0.0, 0.02);
    CHECK_VECTOR(out.hip, 0.0, 0.0, -0.03, 1e-12);
    assert_int_equal(out.contacts, 0);
    CHECK_VECTOR(out.force, 0.0, 0.0, 0.0, 0.0);
    CHECK_VECTOR(out.hip_velocity, 0.0, 0.0, 0.0, 1e-12);
    knurl_scene_destroy(scene);
}

/* 1 mm ridges under a hand that stands still, in a workspace that passes at 100 mm/s: 100 ridges a second. */
TEST(ridges_are_felt_at_the_workspaces_speed) {
    surface_parts parts = surface_plane();
    set_grating(&parts, KNURL_S1, 1000.0, 0.0, 0.0002);
    knurl_scene *scene = scene_of(&parts);
    const knurl_workspace to = at(0.02, 0.0, 0.0);
    (void)tick_at(scene, 0.0, 0.0, -0.001);
    move(scene, &to, 0.2);
    for (int k = 0; k < 200; k++) {
        CHECK_CLOSE(tick_at(scene, 0.0, 0.0, -0.001).temporal_frequency, 100.0, 1e-6);
    }
    knurl_scene_destroy(scene);
}

TEST(moves_in_a_row_go_on_from_where_the_workspace_is) {
    knurl_scene *scene = wall();
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
    knurl_scene_destroy(scene);
}

TEST(moves_that_are_none_are_refused_with_what_was_expected) {
    knurl_scene *scene = wall();
    knurl_workspace bad = at(0.0, 0.0, 0.0);
    bad.scale = 2.0;
    assert_int_equal(knurl_scene_set_workspace(scene, 0, &bad, 0.1), KNURL_ERROR_ARGUMENT);
    assert_non_null(strstr(knurl_error_message(), "expected 1,"));
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
