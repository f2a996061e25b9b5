/* A HIP's counts on a grating: half cycles crossed and played, with every method; and the stretch of its ridges against
 * the material's, on both axes. SPDX-License-Identifier: MIT */
#include "scene/ask.h"

#define A 0.0002

/* 1 mm deep along the plane at a steady speed, for so many metres at 1 kHz. */
static knurl_hip_counts stroke(surface_parts *parts, double vx, double vy, double seconds) {
    SCOPED_SCENE *scene = scene_of(parts);
    const double velocity[3] = {vx, vy, 0.0};
    const int ticks = (int)(1000.0 * seconds + 0.5);
    for (int k = 0; k < ticks; k++) {
        const double t = 0.001 * k;
        const double position[3] = {vx * t - 0.5 * vx * seconds, vy * t - 0.5 * vy * seconds, -0.001};
        (void)tick_moving(scene, position, velocity);
    }
    const knurl_hip_counts counts = counts_of(scene);
    return counts;
}

/* L metres over fs cycles/m cross 2 fs L half cycles. S1 and BANDLIMITED play each of them, give or take one at each
 * end; S2, too, if the period is a whole number of ticks (10 and 50). */
TEST(a_stroke_crosses_two_fs_times_its_metres_and_plays_them) {
    static const int32_t methods[] = {KNURL_METHOD_S1, KNURL_METHOD_S2, KNURL_METHOD_BANDLIMITED};
    static const double speeds[] = {0.02, 0.1};
    for (size_t i = 0; i < COUNT_OF(methods); i++) {
        for (size_t j = 0; j < COUNT_OF(speeds); j++) {
            surface_parts parts = surface_plane();
            set_grating(&parts, methods[i], 1000.0, 0.0, A);
            const knurl_hip_counts counts = stroke(&parts, speeds[j], 0.0, 0.5);
            const double expected = 2.0 * 1000.0 * speeds[j] * 0.5;
            CHECK_CLOSE(counts.half_cycles_crossed, expected, 1e-9 * expected);
            CHECK_CLOSE((double)counts.half_cycles_played, expected, 2.0);
        }
    }
}

/* Eq. 12 on a grid: the faster of the two, here 2 x 500/m x 0.08 m along y against 2 x 1000/m x 0.02 m. */
TEST(a_grid_counts_the_way_by_its_faster_axis) {
    surface_parts parts = surface_plane();
    set_grating(&parts, KNURL_METHOD_BANDLIMITED, 1000.0, 500.0, A);
    const knurl_hip_counts counts = stroke(&parts, 0.04, 0.16, 0.5);
    CHECK_CLOSE(counts.half_cycles_crossed, 80.0, 1e-7);
    CHECK_CLOSE((double)counts.half_cycles_played, 80.0, 2.0);
}

TEST(nothing_is_counted_across_the_ridges_nor_at_rest_nor_without_them) {
    surface_parts parts = surface_plane();
    set_grating(&parts, KNURL_METHOD_BANDLIMITED, 1000.0, 0.0, A);
    for (int i = 0; i < 3; i++) {
        if (i == 2) {
            set_grating(&parts, KNURL_METHOD_BANDLIMITED, 1000.0, 0.0, 0.0);
        }
        const knurl_hip_counts counts = stroke(&parts, i == 2 ? 0.1 : 0.0, i == 0 ? 0.1 : 0.0, 0.5);
        CHECK_SAME(counts.half_cycles_crossed, 0.0L);
        assert_int_equal(counts.half_cycles_played, 0);
        assert_true(counts.contact_ticks == 500);
    }
}

TEST(in_the_air_nothing_is_crossed) {
    surface_parts parts = surface_plane();
    set_grating(&parts, KNURL_METHOD_S1, 1000.0, 0.0, A);
    SCOPED_SCENE *scene = scene_of(&parts);
    for (int k = 0; k < 500; k++) {
        (void)tick_moving(scene, (const double[3]){1e-4 * k, 0.0, 0.002}, (const double[3]){0.1, 0.0, 0.0});
    }
    CHECK_SAME(counts_of(scene).half_cycles_crossed, 0.0L);
    assert_int_equal(counts_of(scene).half_cycles_played, 0);
}

/* A step of a hand's: with amplitudes that jump to 0 between (S2 idles) no half cycle is counted twice. S2 plays whole
 * events of +A and -A: two half cycles each. */
TEST(an_idle_height_of_0_is_no_half_cycle) {
    const knurl_grating grating = {KNURL_METHOD_S2, {0}, {1000.0, 0.0}, A, 1000.0, 0.0};
    knurl_grating_state at;
    knurl_grating_output out;
    unsigned turns = 0;
    memset(&at, 0, sizeof at);
    for (int k = 0; k < 300; k++) { /* 10 ticks of an event, then 90 at rest, three times */
        const double velocity[2] = {k % 100 == 0 ? 0.1 : 0.0, 0.0};
        knurl_grating_step(&grating, &at, (const double[2]){0.0, 0.0}, velocity, &out);
        turns += out.turned;
    }
    assert_int_equal(turns, 5); /* + - + - + - */
}

/* --- stretch --- */

/* A sheet of 4 x 1 cm in two halves, whose v runs `ratio` times as fast in the left half as in the right one. It is
 * bent a little in the middle, so that it stays a mesh. */
static shape uneven_sheet(double ratio) {
    shape s = shape_new(6, 12, 1);
    for (uint32_t i = 0; i < 6; i++) {
        const double x = 0.02 * (i / 2);
        shape_set(&s, i, x, 0.01 * (i % 2), i / 2 == 2 ? 0.002 : 0.0);
        s.uvs[2 * i] = (float)(x / 0.04);
        s.uvs[2 * i + 1] = (float)(i % 2);
    }
    uint32_t at = 0;
    at = shape_quad(&s, at, 0, 2, 3, 1);
    (void)shape_quad(&s, at, 2, 4, 5, 3);
    for (uint32_t i = 0; i < 2; i++) { /* the left rim's v */
        s.uvs[2 * i + 1] = (float)((i % 2) * ratio);
    }
    return s;
}

static knurl_surface_check check_of(surface_parts *parts, knurl_surface_info *info) {
    SCOPED_SCENE *scene = empty_scene(1);
    (void)add_surface(scene, parts);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    const knurl_surface_check check = first_check(scene);
    *info = first_info(scene);
    return check;
}

TEST(across_an_axis_nothing_is_stretched_with_any_uvs) {
    SCOPED_SHAPE s = uneven_sheet(8.0);
    surface_parts parts = surface_mesh(&s);
    knurl_surface_info info;
    parts.desc.axis[1] = 1.0;
    (void)check_of(&parts, &info);
    CHECK_VECTOR(info.stretch_y, 1.0, 1.0, 1.0, 0.0);
    float tangents[6][4] = {{0.0F}};
    for (int i = 0; i < 6; i++) {
        tangents[i][0] = tangents[i][3] = 1.0F;
    }
    parts.mesh.uvs = NULL;
    parts.mesh.tangents = tangents[0];
    parts.desc.axis[1] = 0.0;
    (void)check_of(&parts, &info);
    CHECK_VECTOR(info.stretch, 1.0, 1.0, 1.0, 0.0);
    CHECK_VECTOR(info.stretch_y, 1.0, 1.0, 1.0, 0.0);
}

TEST(stretch_is_reported_along_y_too_and_warned_of_beyond_an_octave) {
    static const double ratios[] = {1.0, 8.0};
    for (size_t i = 0; i < COUNT_OF(ratios); i++) {
        SCOPED_SHAPE s = uneven_sheet(ratios[i]);
        surface_parts parts = surface_mesh(&s);
        knurl_surface_info info;
        set_grating(&parts, KNURL_METHOD_BANDLIMITED, 0.0, 700.0, A);
        const knurl_surface_check check = check_of(&parts, &info);
        if (ratios[i] == 1.0) {
            CHECK_VECTOR(info.stretch_y, 1.0, 1.0, 1.0, 1e-6);
            assert_int_equal(check.exceeded & KNURL_LIMIT_STRETCH, 0);
        } else {
            assert_true(info.stretch_y[2] > 2.0 * info.stretch_y[0] && info.stretch_y[0] > 0.0);
            assert_true((check.exceeded & KNURL_LIMIT_STRETCH) != 0);
            assert_non_null(strstr(check.message, "its uvs stretch: the 700/m along v are felt as"));
            parts.material.method = KNURL_METHOD_S2; /* which counts metres */
            assert_int_equal(check_of(&parts, &info).exceeded & KNURL_LIMIT_STRETCH, 0);
            set_grating(&parts, KNURL_METHOD_BANDLIMITED, 700.0, 0.0, A); /* across it there is nothing to stretch */
            assert_null(strstr(check_of(&parts, &info).message, "along v"));
        }
    }
}
