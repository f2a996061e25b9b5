/* The method AREA through a whole tick: the mean of what lies between two ticks' surface coordinates, whatever the
 * surface. SPDX-License-Identifier: MIT */
#include "support/geometry.h"
#include "support/scenes.h"

#define A     0.001 /* m */
#define K     400.0 /* N/m, the default */
#define DEPTH 0.003 /* m: below every trough, so that contact is never lost */
#define FS    850.0 /* cycles/m */

/* The mean of Eq. 11's bars between two places, in cycles, by 2000 samples, over sinc(d). */
static double mean_between(double from, double to) {
    const double d = fabs(to - from);
    double sum = 0.0;
    for (int i = 0; i < 2000; i++) {
        sum += cos(6.283185307179586 * (from + (i + 0.5) / 2000.0 * (to - from))) >= 0.0 ? 1.0 : -1.0;
    }
    return A * sum / 2000.0 * (3.141592653589793 * d / sin(3.141592653589793 * d));
}

/* 60 mm along x, forwards or back; `cycles`: fs times the coordinate there. */
static void check_stroke(surface_parts *parts, double (*cycles)(double x), double speed) {
    knurl_scene *scene = scene_of(parts);
    configure_plainly(scene, 0);
    const double from = speed > 0.0 ? -0.03 : 0.03;
    double before = cycles(from);
    const int ticks = (int)(0.06 / fabs(speed) * 1000.0);
    (void)tick_at(scene, from, 0.004, 0.01); /* it comes from above */
    for (int k = 0; k < ticks; k++) {
        const double p[3] = {from + 0.001 * speed * k, 0.004, -DEPTH};
        const double v[3] = {speed, 0.0, 0.0};
        const knurl_tick_output out = tick_moving(scene, p, v);
        const double now = cycles(p[0]);
        assert_int_equal(out.contacts, 1);
        assert_int_equal(out.flags & KNURL_TICK_FREQUENCY, 0);
        CHECK_CLOSE(length3(out.force), K * (out.height + out.depth), 1e-9L);
        if (k > 0) { /* positions on a mesh are floats */
            CHECK_CLOSE(out.height, mean_between(before, now), 3e-3L * A);
        }
        before = now;
    }
    knurl_scene_destroy(scene);
}

static void check_strokes(surface_parts *parts, double (*cycles)(double x)) {
    static const double speeds[] = {0.04, -0.04, 0.21, -0.21};
    for (size_t i = 0; i < COUNT_OF(speeds); i++) {
        check_stroke(parts, cycles, speeds[i]);
    }
}

static double plain(double x) {
    return FS * x;
}

TEST(on_a_plane_it_is_the_mean_along_x) {
    surface_parts parts = surface_plane();
    set_grating(&parts, KNURL_METHOD_AREA, FS, 0.0, A);
    check_strokes(&parts, plain);
}

/* 30 degrees: x cos + y sin. */
static double turned(double x) {
    return FS * (sqrt(0.75) * x + 0.5 * 0.004);
}

TEST(an_orientation_turns_the_ridges) {
    surface_parts parts = surface_plane();
    set_grating(&parts, KNURL_METHOD_AREA, FS, 0.0, A);
    parts.material.orientation = asin(0.5);
    check_strokes(&parts, turned);
}

/* du/dx from 0.5 to 2 in five steps, u continuous; the scale makes the mean of dx/du, by area, 1. */
static const double slopes[5] = {0.5, 0.8, 1.0, 1.5, 2.0};

static double stepped(double x) {
    double u = 0.0;
    for (int i = 0; i < 5; i++) {
        u += slopes[i] * fmax(0.0, fmin(x + 0.05 - 0.02 * i, 0.02));
    }
    return u;
}

static double cycles_stepped(double x) {
    double scale = 0.0;
    for (int i = 0; i < 5; i++) {
        scale += 0.2 / slopes[i];
    }
    return FS * scale * stepped(x);
}

TEST(where_uvs_stretch_it_is_the_mean_of_their_stripes) {
    static const double half[2] = {0.05, 0.05};
    shape s = shape_sheet(50, 4, half, NULL);
    for (uint32_t v = 0; v < s.vertex_count; v++) {
        double p[3];
        shape_get(&s, v, p);
        s.uvs[2 * v] = (float)stepped(p[0]);
        s.uvs[2 * v + 1] = (float)p[1];
    }
    surface_parts parts = surface_mesh(&s);
    set_grating(&parts, KNURL_METHOD_AREA, FS, 0.0, A);
    check_strokes(&parts, cycles_stepped);
    shape_free(&s);
}

/* A crest of 1.46 A is there before the HIP is at the surface, as Eq. 9 has it. */
TEST(contact_begins_with_its_highest_crest) {
    for (int i = 0; i < 2; i++) {
        surface_parts parts = surface_plane();
        set_grating(&parts, KNURL_METHOD_AREA, 1000.0, 0.0, A);
        knurl_scene *scene = scene_of(&parts);
        configure_plainly(scene, 0);
        const double z = (i ? 1.58 : 1.56) * A;
        int contacts = 0;
        for (int k = 0; k < 200; k++) {
            const double p[3] = {-0.04 + 0.45e-3 * k, 0.0, z};
            const double v[3] = {0.45, 0.0, 0.0};
            contacts += (int)tick_moving(scene, p, v).contacts;
        }
        assert_true(i ? contacts == 0 : contacts > 190);
        knurl_scene_destroy(scene);
    }
}

/* The fundamental does not jump with the material, nor does the way: from one tick to the next it is the mean of the
 * new ridges over the way that was gone. */
TEST(another_material_is_felt_at_once_over_the_same_way) {
    for (int change = 20; change < 30; change++) {
        surface_parts parts = surface_plane();
        set_grating(&parts, KNURL_METHOD_AREA, FS, 0.0, A);
        knurl_scene *scene = scene_of(&parts);
        configure_plainly(scene, 0);
        double fs = FS;
        for (int k = 0; k < 60; k++) {
            const double p[3] = {0.0002 * k - 0.01, 0.004, -DEPTH};
            const double v[3] = {0.2, 0.0, 0.0};
            const knurl_tick_output out = tick_moving(scene, p, v);
            if (k > 0) {
                CHECK_CLOSE(out.height, mean_between(fs * (p[0] - 0.0002), fs * p[0]), 3e-3L * A);
            }
            if (k == change) {
                fs = 0.7 * FS;
                set_grating(&parts, KNURL_METHOD_AREA, fs, 0.0, A);
                assert_int_equal(knurl_scene_set_material(scene, out.surface, &parts.material), KNURL_OK);
            }
        }
        knurl_scene_destroy(scene);
    }
}

TEST(ridges_begun_are_the_events_that_are_counted) {
    surface_parts parts = surface_plane();
    knurl_hip_counts counts;
    set_grating(&parts, KNURL_METHOD_AREA, FS, 0.0, A);
    knurl_scene *scene = scene_of(&parts);
    configure_plainly(scene, 0);
    for (int k = 0; k < 400; k++) {
        const double p[3] = {0.0001 * k - 0.02, 0.004, -DEPTH};
        const double v[3] = {0.1, 0.0, 0.0};
        (void)tick_moving(scene, p, v);
    }
    assert_int_equal(knurl_scene_get_tick(scene, 0, NULL, &counts), KNURL_OK);
    CHECK_CLOSE((double)counts.events, FS * 0.04, 1.0);
    CHECK_CLOSE((double)counts.half_cycles_played, 2.0 * FS * 0.04, 1.0);
    knurl_scene_destroy(scene);
}
