/* Attenuation of a tick's force: the attenuated force is reported, counted and limited. And a tick without contact.
 * SPDX-License-Identifier: MIT */
#include "scene/ask.h"

#include "base/vec3.h"

#define K 400.0

/* A wall of 400 N/m with front up at z = 0; device axes are the scene's; every protection. */
static knurl_scene *wall(uint32_t without) {
    knurl_hip_desc hip = hip_in_scene_axes();
    surface_parts parts = surface_plane();
    hip.resolution = 0.0;
    hip.protections = KNURL_PROTECT_ALL & ~without;
    return scene_with_hip(&parts, &hip);
}

static knurl_tick_output tick(knurl_scene *scene, double z, double attenuation, uint32_t paused) {
    knurl_tick_input input;
    knurl_tick_output output;
    memset(&input, 0, sizeof input);
    input.position[2] = z;
    input.attenuation = attenuation;
    input.paused = paused;
    assert_int_equal(knurl_scene_tick(scene, 0, &input, &output), KNURL_OK);
    return output;
}

TEST(the_share_that_is_asked_for_is_sent_and_told) {
    static const double shares[] = {0.0, 0.25, 0.5, 0.999, 1.0};
    for (size_t i = 0; i < COUNT_OF(shares); i++) {
        SCOPED_SCENE *scene = wall(KNURL_PROTECT_ALL);
        knurl_tick_output told;
        const knurl_tick_output out = tick(scene, -0.005, shares[i], 0); /* 2 N */
        CHECK_CLOSE(out.force[2], 2.0 * (1.0 - shares[i]), 1e-12);
        CHECK_CLOSE(out.device_force[2], 2.0 * (1.0 - shares[i]), 1e-12);
        assert_int_equal(out.contacts, 1);
        CHECK_CLOSE(out.depth, 0.005, 1e-15);
        assert_int_equal(knurl_scene_get_tick(scene, 0, &told, NULL), KNURL_OK);
        assert_memory_equal(&told, &out, sizeof out);
        CHECK_CLOSE(counts_of(scene).force_max, 2.0 * (1.0 - shares[i]), 1e-12);
    }
}

TEST(an_invalid_share_sends_nothing) {
    static const double wrong[] = {-1e-9, -1.0,        1.0 + 1e-9,       2.0,
                                   1e300, (double)NAN, (double)INFINITY, -(double)INFINITY};
    for (size_t i = 0; i < COUNT_OF(wrong); i++) {
        SCOPED_SCENE *scene = wall(KNURL_PROTECT_ALL);
        const knurl_tick_output out = tick(scene, -0.005, wrong[i], 0);
        CHECK_VECTOR(out.force, 0.0, 0.0, 0.0, 0.0);
        CHECK_VECTOR(out.device_force, 0.0, 0.0, 0.0, 0.0);
        CHECK_SAME(counts_of(scene).force_max, 0.0L);
    }
}

/* theta' = ((F/0.88 N)^2 - theta)/60 s. */
TEST(unsent_force_warms_no_motor) {
    SCOPED_SCENE *scene = wall(KNURL_PROTECT_ALL & ~KNURL_PROTECT_HEAT);
    for (int i = 0; i < 5000; i++) {
        (void)tick(scene, -0.005, 0.5, 0); /* 1 N of 2 */
    }
    CHECK_CLOSE(counts_of(scene).heat, (1.0 - exp(-5.0 / 60.0)) / (0.88 * 0.88), 1e-9);
    for (int i = 0; i < 60000; i++) {
        (void)tick(scene, -0.005, 1.0, 0);
    }
    CHECK_CLOSE(counts_of(scene).heat, (1.0 - exp(-5.0 / 60.0)) / (0.88 * 0.88) * exp(-1.0), 1e-9);
}

/* 12 N of which 3.3 N can be played: half of that is 1.65 N. */
TEST(a_share_is_of_what_the_device_can_play) {
    SCOPED_SCENE *scene = wall(KNURL_PROTECT_ALL);
    for (int i = 1; i <= 30; i++) {
        (void)tick(scene, -0.001 * i, 0.0, 0);
    }
    const knurl_tick_output out = tick(scene, -0.03, 0.5, 0);
    CHECK_CLOSE(out.force[2], 1.65, 1e-12);
    assert_int_equal(out.flags & KNURL_TICK_FORCE_LIMIT, 0); /* it was not shortened to that */
}

/* From zero to full within a tick: 3.3 N within 5 ms is 0.66 N per tick, from the force sent before. */
TEST(the_slew_limit_is_from_what_was_sent) {
    SCOPED_SCENE *scene = wall(KNURL_PROTECT_ENTRY);
    for (int i = 0; i < 20; i++) {
        (void)tick(scene, -0.008, 0.0, 0);
    }
    CHECK_CLOSE(tick(scene, -0.008, 0.0, 0).force[2], 3.2, 1e-12);
    CHECK_SAME(tick(scene, -0.008, 1.0, 0).force[2], 0.0L); /* a falling force is not limited */
    for (int i = 1; i <= 6; i++) {
        CHECK_CLOSE(tick(scene, -0.008, 0.0, 0).force[2], fmin(3.2, 0.66 * i), 1e-12);
    }
}

/* 0.5 m/s is 0.5 mm a tick. */
TEST(a_wall_that_was_not_felt_comes_back_as_after_an_entry) {
    SCOPED_SCENE *scene = wall(0);
    for (int i = 0; i < 30; i++) {
        (void)tick(scene, -0.008, 0.0, 0);
    }
    const uint64_t entries = counts_of(scene).entry_ticks;
    for (int i = 0; i < 10; i++) {
        assert_int_equal(tick(scene, -0.008, 1.0, 0).flags & KNURL_TICK_ENTRY, 0);
    }
    assert_true(counts_of(scene).entry_ticks == entries);
    for (int i = 1; i <= 20; i++) {
        const knurl_tick_output out = tick(scene, -0.008, 0.0, 0);
        CHECK_CLOSE(out.force[2], K * fmin(0.008, 0.0005 * i), 1e-12);
    }
}

TEST(a_non_finite_force_is_found_at_any_share) {
    static const double shares[] = {0.0, 0.5, 1.0};
    for (size_t i = 0; i < COUNT_OF(shares); i++) {
        SCOPED_SCENE *scene = wall(KNURL_PROTECT_ALL);
        (void)tick(scene, -0.001, shares[i], 0);
        const knurl_tick_output out = tick(scene, (double)NAN, shares[i], 0);
        assert_true((out.flags & KNURL_TICK_NOT_FINITE) != 0);
        CHECK_VECTOR(out.force, 0.0, 0.0, 0.0, 0.0);
    }
}

/* It moves at 0.1 m/s through the wall and stops; 1 mm inside, the next tick is a first one. */
TEST(a_paused_tick_tells_where_the_hip_is_and_touches_nothing) {
    SCOPED_SCENE *scene = wall(0);
    for (int i = 0; i < 100; i++) {
        (void)tick(scene, -0.004, 0.0, 0);
    }
    CHECK_CLOSE(tick(scene, -0.004, 0.0, 0).force[2], 1.6, 1e-12);
    knurl_tick_output out = tick(scene, -0.004, 0.0, 1);
    const uint64_t touched = counts_of(scene).contact_ticks;
    for (int i = 1; i <= 30; i++) {
        out = tick(scene, -0.004 + 0.0001 * i, 0.0, 1);
        CHECK_VECTOR(out.force, 0.0, 0.0, 0.0, 0.0);
        CHECK_VECTOR(out.device_force, 0.0, 0.0, 0.0, 0.0);
        CHECK_VECTOR(out.hip, 0.0, 0.0, -0.004 + 0.0001 * i, 1e-15);
        CHECK_VECTOR(out.proxy, 0.0, 0.0, -0.004 + 0.0001 * i, 1e-15);
        assert_true(out.surface == 0 && out.contacts == 0 && (out.flags & KNURL_TICK_CONTACT) == 0);
    }
    CHECK_CLOSE(out.hip_velocity[2], 0.1, 0.005);
    assert_true(counts_of(scene).contact_ticks == touched);
    CHECK_CLOSE(tick(scene, -0.001, 0.0, 0).force[2], K * 0.0005, 1e-3);
    CHECK_CLOSE(tick(scene, -0.001, 0.0, 0).force[2], K * 0.001, 1e-3);
}
