/* Surfaces that move: jumps, and the duration of moves. SPDX-License-Identifier: MIT */
#include "moving.h"
#include "scene/ask.h"

/* --- jumps --- */

static void feel_nothing(knurl_scene *scene) {
    for (int k = 0; k < 5; k++) {
        const knurl_tick_output out = stand_at(scene, 0.0, 0.0, 0.0);
        CHECK_VECTOR(out.force, 0.0, 0.0, 0.0, 0.0L);
        assert_int_equal(out.contacts, 0);
    }
}

TEST(jump_passes_by_what_is_on_its_way) {
    static const double ends[] = {0.002, 0.005, 0.05, 0.5};
    for (size_t i = 0; i < COUNT_OF(ends); i++) {
        surface_parts parts = wide_plane();
        const pose low = at_height(0.0, 0.0, -0.02);
        place(&parts, &low);
        SCOPED_SCENE *scene = scene_of(&parts);
        (void)stand_at(scene, 0.0, 0.0, 0.0);
        (void)stand_at(scene, 0.0, 0.0, 0.0);
        raise_to(scene, knurl_scene_get_surface(scene, 0), ends[i], 0.0);
        feel_nothing(scene);
    }
}

/* Its path leads past the HIP, so that every tick tests it, but it is still far away. */
TEST(jump_of_what_was_on_its_way_to_the_hip_passes_by) {
    surface_parts parts = wide_plane();
    const pose low = at_height(0.0, 0.0, -0.2);
    place(&parts, &low);
    SCOPED_SCENE *scene = scene_of(&parts);
    (void)stand_at(scene, 0.0, 0.0, 0.0);
    raise_to(scene, knurl_scene_get_surface(scene, 0), 0.2, 10.0);
    (void)stand_at(scene, 0.0, 0.0, 0.0);
    (void)stand_at(scene, 0.0, 0.0, 0.0);
    raise_to(scene, knurl_scene_get_surface(scene, 0), 0.004, 0.0);
    feel_nothing(scene);
}

/* A HIP that was in contact has a first tick with it: held up to 10 mm deep, no contact beyond; slid past at no speed.
 */
TEST(jump_of_what_is_touched_is_a_first_tick) {
    static const struct {
        double x, z;
        double depth; /* 0: no contact */
    } cases[] = {{0.0, 0.004, 0.005}, {0.0, 0.0088, 0.0098}, {0.0, 0.0092, 0.0},
                 {0.0, 0.3, 0.0},     {0.1, 0.0, 0.001},     {0.4, 0.001, 0.002},
                 {0.0, -0.002, 0.0},  {0.6, 0.0, 0.0},       {0.0, -0.0005, 0.0005}};
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        surface_parts parts = wide_plane();
        knurl_surface_id id;
        set_grating(&parts, KNURL_METHOD_S2, 1000.0, 0.0, 0.0005);
        SCOPED_SCENE *scene = stood_on(&parts, &id);
        const pose end = at_height(cases[i].x, 0.0, cases[i].z);
        move_to(scene, id, &end, 0.0);
        for (int k = 0; k < 3; k++) {
            const knurl_tick_output out = stand_at(scene, 0.0, 0.0, -0.001);
            CHECK_VECTOR(out.force, 0.0, 0.0, K * cases[i].depth, TOL);
            assert_int_equal(out.contacts, cases[i].depth > 0.0);
            CHECK_SAME(out.surface_velocity[0], 0.0);
            assert_int_equal(out.event, KNURL_NO_EVENT);
        }
    }
}

TEST(jump_ends_a_way) {
    knurl_surface_id id;
    SCOPED_SCENE *scene = stood_on_plane(&id);
    raise_to(scene, id, 0.005, 0.05);
    (void)stand_at(scene, 0.0, 0.0, -0.001);
    raise_to(scene, id, 0.0, 0.0);
    for (int k = 0; k < 60; k++) {
        CHECK_CLOSE(stand_at(scene, 0.0, 0.0, -0.001).depth, 0.001, 1e-15L);
    }
}

/* --- time --- */

TEST(a_move_waits_for_the_next_tick) {
    knurl_surface_id id;
    SCOPED_SCENE *scene = stood_on_plane(&id);
    raise_to(scene, id, 0.004, 0.01);
    raise_to(scene, id, 0.008, 0.01); /* no tick in between: from its present position */
    for (int k = 1; k <= 10; k++) {
        CHECK_CLOSE(stand_at(scene, 0.0, 0.0, -0.001).depth, 0.001 + 0.0008 * k, 1e-12L);
    }
}

/* 1 kHz and 4 kHz side by side: each sees the same place at the same second, give or take a period of the slower. */
TEST(hips_of_different_rates_see_the_same_way_in_seconds) {
    static const double rates[2] = {1000.0, 4000.0};
    surface_parts parts = wide_plane();
    SCOPED_SCENE *scene = empty_scene(2);
    knurl_hip_desc hip = hip_in_scene_axes();
    const knurl_tick_input input = {{0.0, 0.0, -0.001}, {0.0, 0.0, 0.0}, 1, 0, 0.0, 0, {0}};
    knurl_tick_output out[2];
    hip.max_force = 100.0;
    for (uint32_t i = 0; i < 2; i++) {
        hip.update_rate_hz = rates[i];
        assert_int_equal(knurl_scene_configure_hip(scene, i, &hip), KNURL_OK);
    }
    const knurl_surface_id id = add_surface(scene, &parts);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    for (int k = 0; k < 480; k++) { /* quarters of a millisecond; a motion of 0.08 s from 0.02 s on */
        assert_int_equal(knurl_scene_tick(scene, 1, &input, &out[1]), KNURL_OK);
        if (k % 4 == 3) {
            assert_int_equal(knurl_scene_tick(scene, 0, &input, &out[0]), KNURL_OK);
        }
        if (k == 79) {
            raise_to(scene, id, 0.004, 0.08);
        }
        for (int i = 0; i < 2 && k > 3; i++) {
            const double since = (k - 79) / 4000.0;
            const double depth = 0.001 + 0.05 * fmin(0.08, fmax(0.0, since));
            CHECK_CLOSE(out[i].depth, depth, 0.05 * 0.00101);
        }
    }
    CHECK_CLOSE(out[0].depth, 0.005, 1e-15L);
    CHECK_CLOSE(out[1].depth, 0.005, 1e-15L);
}

/* The faster of two alone: its own seconds count. */
TEST(way_at_4_khz_takes_its_seconds) {
    surface_parts parts = wide_plane();
    knurl_hip_desc hip = hip_in_scene_axes();
    hip.max_force = 100.0;
    hip.update_rate_hz = 4000.0;
    SCOPED_SCENE *scene = scene_with_hip(&parts, &hip);
    const knurl_surface_id id = knurl_scene_get_surface(scene, 0);
    (void)stand_at(scene, 0.0, 0.0, -0.001);
    raise_to(scene, id, 0.004, 0.02);
    for (int k = 1; k <= 100; k++) {
        CHECK_CLOSE(stand_at(scene, 0.0, 0.0, -0.001).depth, 0.001 + 0.004 * (k < 80 ? k : 80) / 80.0, 1e-12L);
    }
}

/* The bounds of a turning rectangle against its corners along the way: they contain every corner, with a margin of at
 * most the height of a corner's arc over its chord, not the ball in which it could turn.
 */
TEST(bounds_of_a_turn_hold_it_closely) {
    static const double angles[] = {0.001, 0.01, 0.1, 0.5, 1.5, 3.1};
    uint64_t seed = 5;
    for (int round = 0; round < 20 * (int)COUNT_OF(angles); round++) {
        const double angle = angles[round % (int)COUNT_OF(angles)];
        surface_parts parts = surface_plane();
        const pose start = random_pose(&seed);
        pose end = random_pose(&seed);
        double turning[4], axis[3] = {0.0, 0.0, 0.0}, least[3], greatest[3];
        axis[round % 3] = 1.0;
        turn_about(axis, angle, turning);
        turn_after(turning, start.quaternion, end.quaternion);
        parts.plane.half_extents[0] = 0.3;
        place(&parts, &start);
        SCOPED_SCENE *scene = scene_of(&parts);
        const knurl_surface_id id = knurl_scene_get_surface(scene, 0);
        move_to(scene, id, &end, 1.0);
        const knurl_surface_info info = info_of(scene, id);
        for (int i = 0; i < 3; i++) {
            least[i] = HUGE_VAL;
            greatest[i] = -HUGE_VAL;
        }
        for (int k = 0; k < 4 * 101; k++) {
            const double share = k / 4 / 100.0;
            const double corner[3] = {k & 1 ? 0.3 : -0.3, k & 2 ? 0.05 : -0.05, 0.0};
            pose now;
            double at[3];
            turn_about(axis, share * angle, turning);
            turn_after(turning, start.quaternion, now.quaternion);
            for (int i = 0; i < 3; i++) {
                now.position[i] = start.position[i] + share * (end.position[i] - start.position[i]);
            }
            pose_point(&now, corner, at);
            for (int i = 0; i < 3; i++) {
                least[i] = fmin(least[i], at[i]);
                greatest[i] = fmax(greatest[i], at[i]);
            }
        }
        for (int i = 0; i < 3; i++) {
            const double spare = hypot(0.3, 0.05) * fmin(angle * angle / 8.0, 2.0) + 1e-9;
            assert_true(info.bounds_min[i] <= least[i] && info.bounds_max[i] >= greatest[i]);
            assert_true(info.bounds_min[i] >= least[i] - spare && info.bounds_max[i] <= greatest[i] + spare);
        }
    }
}
