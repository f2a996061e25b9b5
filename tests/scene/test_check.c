/* Surfaces checked against a device's limits: each limit by its equation, and enforced with clamp.
 * SPDX-License-Identifier: MIT */
#include "scene/ask.h"

/* A device of round numbers: b + the lightest hand's 2 N s/m are 3 N s/m, T/2 + delay 1.5 ms: 2000 N/m. */
static knurl_hip_desc device(const knurl_workspace *workspace) {
    knurl_hip_desc hip;
    knurl_hip_desc_init(&hip, sizeof hip);
    hip.resolution = 1e-4;
    hip.max_force = 4.0;
    hip.continuous_force = 1.0;
    hip.viscous = 1.0;
    hip.delay = 1.0;
    hip.max_stiffness = 2500.0;
    hip.workspace = workspace;
    return hip;
}

typedef struct setting {
    surface_parts parts;
    knurl_hip_desc hip;
    knurl_workspace workspace;
} setting;

static setting plain(void) {
    setting s;
    s.parts = surface_plane();
    s.parts.desc.name = "brick";
    knurl_workspace_set_identity(&s.workspace);
    s.hip = device(NULL);
    return s;
}

static knurl_scene *scene_in(setting *s) {
    s->hip.workspace = &s->workspace;
    return scene_with_hip(&s->parts, &s->hip);
}

static knurl_surface_check check_of(setting *s) {
    SCOPED_SCENE *scene = scene_in(s);
    const knurl_surface_check check = first_check(scene);
    return check;
}

TEST(a_surface_within_its_limits_has_nothing_to_be_warned_of) {
    setting s = plain();
    s.parts.material.stiffness = 1999.0;
    set_grating(&s.parts, KNURL_METHOD_S2, 1000.0, 0.0, 0.0004);
    const knurl_surface_check check = check_of(&s);
    assert_int_equal(check.exceeded, 0);
    assert_string_equal(check.message, "");
    CHECK_CLOSE(check.stiffness, 1999.0, 1e-9);
    CHECK_CLOSE(check.stiffness_limit, 2000.0, 1e-9);
}

/* (b + B)/(T/2 + td) with the wall's own B: 5/1.5 ms; at 2 kHz the delay is half as long: 3/0.75 ms. */
TEST(a_message_ends_in_whatever_an_older_caller_has_of_it) {
    setting s = plain();
    s.parts.material.stiffness = 4000.0;
    SCOPED_SCENE *scene = scene_in(&s);
    for (uint32_t room = 1; room < 100; room++) {
        knurl_surface_check older;
        memset(&older, 0x77, sizeof older);
        older.struct_size = (uint32_t)offsetof(knurl_surface_check, message) + room;
        assert_int_equal(knurl_scene_check_surface(scene, 0, knurl_scene_get_surface(scene, 0), &older), KNURL_OK);
        assert_int_equal(strlen(older.message), room - 1); /* the sentence is longer */
    }
}

TEST(stability_is_the_bound_of_a_delayed_wall_and_says_by_how_much) {
    setting s = plain();
    s.parts.material.stiffness = 5000.0;
    s.hip.max_stiffness = (double)INFINITY;
    knurl_surface_check check = check_of(&s);
    assert_int_equal(check.exceeded, KNURL_LIMIT_STABILITY);
    CHECK_CLOSE(check.stiffness_limit, 2000.0, 1e-9);
    assert_non_null(strstr(check.message, "'brick'"));
    assert_non_null(strstr(check.message, "5000 N/m is 2.5 times the 2000 N/m"));
    s.parts.material.damping = 2.0;
    CHECK_CLOSE(check_of(&s).stiffness_limit, 5.0 / 1.5e-3, 1e-9);
    s.parts.material.damping = 0.0;
    s.hip.update_rate_hz = 2000.0;
    CHECK_CLOSE(check_of(&s).stiffness_limit, 4000.0, 1e-9);
    s.hip.update_rate_hz = KNURL_DEFAULT;
    s.hip.delay = 0.0;
    check = check_of(&s);
    CHECK_CLOSE(check.stiffness_limit, 6000.0, 1e-9);
    assert_int_equal(check.exceeded, 0);
}

TEST(a_workspace_that_magnifies_makes_walls_stiffer) {
    setting s = plain();
    s.parts.material.stiffness = 300.0;
    s.workspace.scale = 10.0;
    const knurl_surface_check check = check_of(&s);
    CHECK_CLOSE(check.stiffness, 3000.0, 1e-9);
    assert_int_equal(check.exceeded, KNURL_LIMIT_STABILITY | KNURL_LIMIT_STIFFNESS);
}

/* Peaks: S1 2, bandlimited 8/pi, S2 (2 + 3 sqrt(1/2) + 2 + 3 sqrt 2)/sqrt 13. */
TEST(amplitude_is_held_against_the_methods_highest_swing) {
    const double swings[][2] = {{KNURL_METHOD_S1, 2.0},
                                {KNURL_METHOD_S2, (4.0 + 3.0 * (sqrt(0.5) + sqrt(2.0))) / sqrt(13.0)},
                                {KNURL_METHOD_BANDLIMITED, 8.0 / 3.14159265358979324}};
    for (size_t i = 0; i < COUNT_OF(swings); i++) {
        setting s = plain();
        s.parts.material.stiffness = 1000.0;
        s.hip.continuous_force = (double)INFINITY;
        set_grating(&s.parts, (int32_t)swings[i][0], 1000.0, 0.0, 0.004 / swings[i][1] * 0.999);
        assert_int_equal(check_of(&s).exceeded, 0);
        CHECK_CLOSE(check_of(&s).amplitude_limit, 0.004 / swings[i][1], 1e-12);
        set_grating(&s.parts, (int32_t)swings[i][0], 1000.0, 0.0, 0.004 / swings[i][1] * 1.001);
        assert_int_equal(check_of(&s).exceeded, KNURL_LIMIT_AMPLITUDE);
    }
}

/* The paper's third experiment: 700 N/m and 2.7 mm on a Touch swing 3.78 N and are 1.89 N rms; a tenth of it is fine.
 */
TEST(the_papers_amplitude_as_printed_is_beyond_a_touch) {
    setting s = plain();
    knurl_hip_desc_init(&s.hip, sizeof s.hip);
    s.parts.material.stiffness = 700.0;
    set_grating(&s.parts, KNURL_METHOD_S1, 1000.0, 0.0, 0.0027);
    const knurl_surface_check check = check_of(&s);
    assert_int_equal(check.exceeded, KNURL_LIMIT_AMPLITUDE | KNURL_LIMIT_HEAT);
    assert_non_null(strstr(check.message, "3.78 N"));
    assert_non_null(strstr(check.message, "1.89 N rms"));
    s.parts.material.amplitude = 0.00027;
    assert_int_equal(check_of(&s).exceeded, 0);
}

TEST(ridges_finer_than_two_position_steps_are_reported) {
    setting s = plain();
    set_grating(&s.parts, KNURL_METHOD_S2, 0.0, 5001.0, 1e-4);
    assert_int_equal(check_of(&s).exceeded, KNURL_LIMIT_PERIOD);
    set_grating(&s.parts, KNURL_METHOD_S2, 0.0, 4999.0, 1e-4);
    assert_int_equal(check_of(&s).exceeded, 0);
    s.workspace.scale = 2.0; /* two device steps are 0.4 mm here */
    set_grating(&s.parts, KNURL_METHOD_S2, 0.0, 2501.0, 1e-4);
    assert_int_equal(check_of(&s).exceeded, KNURL_LIMIT_PERIOD);
}

/* 5000 N/m is felt as 2000 N/m, and 2 mm as the 0.5 mm whose rms is 1 N on it; without clamp unchanged. */
TEST(clamp_keeps_walls_and_textures_within_their_limits) {
    for (uint32_t clamp = 0; clamp < 2; clamp++) {
        setting s = plain();
        s.parts.material.stiffness = 5000.0;
        set_grating(&s.parts, KNURL_METHOD_S1, 100.0, 0.0, 0.002);
        s.hip.clamp = clamp;
        s.hip.protections = 0;
        s.hip.resolution = 0.0;
        knurl_scene *scene = scene_in(&s);
        const knurl_tick_output out = tick_at(scene, 0.0, 0.0, -0.0002);
        const double k = clamp ? 2000.0 : 5000.0;
        const double a = clamp ? 0.0005 : 0.002;
        CHECK_CLOSE(out.height, a, 1e-15);
        CHECK_CLOSE(out.force[2], fmin(4.0, k * (a + 0.0002)), 1e-12);
        knurl_scene_destroy(scene);
        knurl_surface_check check = check_of(&s);
        CHECK_CLOSE(check.amplitude_limit, 1.0 / k, 1e-12);
        assert_true((check.exceeded & KNURL_LIMIT_HEAT) != 0); /* the requested value, or the clamped one */
    }
}

TEST(checks_of_nothing_are_refused) {
    setting s = plain();
    knurl_surface_check check;
    SCOPED_SCENE *scene = scene_in(&s);
    knurl_surface_check_init(&check, sizeof check);
    const knurl_surface_id surface = knurl_scene_get_surface(scene, 0);
    assert_int_equal(knurl_scene_check_surface(scene, 1, surface, &check), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_scene_remove_surface(scene, surface), KNURL_OK);
    assert_int_equal(knurl_scene_check_surface(scene, 0, surface, &check), KNURL_ERROR_STALE_ID);
}

/* A long name and every limit at once: five lines, the last one to its end. */
TEST(every_limit_at_once_has_its_whole_sentence) {
    setting s = plain();
    int lines = 1;
    s.parts.desc.name = "a surface that was given a very long name indeed";
    s.parts.material.stiffness = 123456.0;
    set_grating(&s.parts, KNURL_METHOD_S2, 123456.0, 0.0, 0.012345);
    const knurl_surface_check check = check_of(&s);
    const char *end = "lower spatial_frequency";
    assert_int_equal(check.exceeded, 31);
    for (const char *at = strchr(check.message, '\n'); at; at = strchr(at + 1, '\n')) {
        lines++;
    }
    assert_int_equal(lines, 5);
    assert_string_equal(check.message + strlen(check.message) - strlen(end), end);
}
