/* The method BANDLIMITED through a whole tick: on every surface, ridges are at its coordinates.
 * SPDX-License-Identifier: MIT */
#include "scene/ask.h"
#include "support/bandlimited.h"
#include "support/geometry.h"

#define A     0.001 /* m */
#define K     400.0 /* N/m, the default */
#define DEPTH 0.003 /* m: below every trough, so that contact is never lost */
#define FS    1000.0
#define COUNT 0.055e-3 /* m: an encoder's */

static surface_parts grating_on(const shape *mesh, int32_t method) {
    surface_parts parts = mesh ? surface_mesh(mesh) : surface_plane();
    set_grating(&parts, method, FS, 0.0, A);
    return parts;
}

static knurl_tick_output slide(knurl_scene *scene, double x, double z, double speed) {
    return tick_moving(scene, (const double[3]){x, 0.004, z}, (const double[3]){speed, 0.0, 0.0});
}

/* A gently curved sheet, which stays a mesh: u and v in metres along x and y. */
static double dome(double x, double y) {
    return -0.1 * (x * x + y * y);
}

static shape sheet(double (*u)(double x, double y), double (*height)(double, double)) {
    static const double half[2] = {0.05, 0.05};
    shape s = shape_sheet(50, 4, half, height);
    for (uint32_t v = 0; v < s.vertex_count; v++) {
        double p[3];
        shape_get(&s, v, p);
        s.uvs[2 * v] = (float)u(p[0], p[1]);
        s.uvs[2 * v + 1] = (float)p[1];
    }
    return s;
}

static double plain(double x, double y) {
    (void)y;
    return x;
}

static shape curved_sheet(void) {
    return sheet(plain, dome);
}

/* 60 mm along a direction and back, at 40 and 210 mm/s. cycles: fs times the coordinate at a place. */
static void check_strokes(surface_parts *parts, const double direction[3], double (*cycles)(const double p[3])) {
    static const double speeds[] = {0.04, -0.04, 0.21, -0.21};
    for (size_t i = 0; i < COUNT_OF(speeds); i++) {
        SCOPED_SCENE *scene = scene_of(parts);
        double before = 0.0;
        int compared = 0;
        configure_plainly(scene, 0);
        (void)tick_at(scene, 0.0, 0.004, 0.01); /* it comes from above */
        for (int k = 0; k < (int)(60.0 / fabs(speeds[i])); k++) {
            const double at = speeds[i] * k / 1000.0 - (speeds[i] > 0.0 ? 0.03 : -0.03);
            const double p[3] = {at * direction[0], 0.004 + at * direction[1], -DEPTH};
            const double v[3] = {speeds[i] * direction[0], speeds[i] * direction[1], 0.0};
            const knurl_tick_output out = tick_moving(scene, p, v);
            const double now = cycles(p);
            long double within;
            assert_int_equal(out.contacts, 1);
            CHECK_CLOSE(length3(out.force), K * (out.height + out.depth), 1e-9L);
            const double expected = band_height(before, now, out.temporal_frequency / 1000.0, &within);
            if (k > 0 && fabs(now - before) < 0.49 &&
                fabs(out.temporal_frequency / 1000.0 - fabs(now - before)) < 1e-4) {
                CHECK_CLOSE(out.height, A * expected, 4e-3L * A); /* positions and uvs on a mesh are floats */
                compared++;
            }
            before = now;
        }
        assert_true(compared > 50);
    }
}

static const double along_x[3] = {1.0, 0.0, 0.0}, askew[3] = {0.8, 0.6, 0.0};

static double cycles_of_x(const double p[3]) {
    return FS * p[0];
}

TEST(on_a_plane_it_is_in_step_with_x) {
    surface_parts parts = grating_on(NULL, KNURL_METHOD_DEFAULT);
    check_strokes(&parts, along_x, cycles_of_x);
}

/* 30 degrees: x cos + y sin. */
static double cycles_turned(const double p[3]) {
    return FS * (sqrt(0.75) * p[0] + 0.5 * p[1]);
}

TEST(an_orientation_turns_the_ridges) {
    surface_parts parts = grating_on(NULL, KNURL_METHOD_BANDLIMITED);
    parts.material.orientation = asin(0.5);
    check_strokes(&parts, along_x, cycles_turned);
    check_strokes(&parts, askew, cycles_turned);
}

/* Half a turn about x: its back is up and its y runs down; n x x seen from behind is the scene's y again. */
TEST(a_double_sided_surface_is_in_step_from_behind_as_well) {
    surface_parts parts = grating_on(NULL, KNURL_METHOD_BANDLIMITED);
    parts.desc.double_sided = 1;
    parts.material.orientation = asin(0.5);
    parts.desc.rotation[0] = 1.0;
    parts.desc.rotation[3] = 0.0;
    check_strokes(&parts, askew, cycles_turned);
}

/* Uvs that run u = x + y / 2: one stretch all over, so the sheet becomes a plane, sheared. dP/du is x; u in metres. */
static double sheared(double x, double y) {
    return x + 0.5 * y;
}

static double cycles_sheared(const double p[3]) {
    return FS * (p[0] + 0.5 * p[1]);
}

TEST(sheared_uvs_of_a_flat_sheet_are_kept_step_with) {
    SCOPED_SHAPE s = sheet(sheared, NULL);
    surface_parts parts = grating_on(&s, KNURL_METHOD_BANDLIMITED);
    check_strokes(&parts, along_x, cycles_sheared);
    check_strokes(&parts, askew, cycles_sheared);
}

/* du/dx from 0.55 to 2, within two octaves, in five steps, u continuous; the scale makes the mean of dx/du, by area, 1.
 */
static const double slopes[5] = {0.55, 0.8, 1.0, 1.5, 2.0};

static double stepped(double x, double y) {
    double u = 0.0;
    (void)y;
    for (int i = 0; i < 5; i++) {
        u += slopes[i] * fmax(0.0, fmin(x + 0.05 - 0.02 * i, 0.02));
    }
    return u;
}

static double cycles_stepped(const double p[3]) {
    double scale = 0.0;
    for (int i = 0; i < 5; i++) {
        scale += 0.2 / slopes[i];
    }
    return FS * scale * stepped(p[0], p[1]);
}

TEST(stretched_uvs_are_kept_step_with) {
    SCOPED_SHAPE s = sheet(stepped, NULL);
    surface_parts parts = grating_on(&s, KNURL_METHOD_BANDLIMITED);
    check_strokes(&parts, along_x, cycles_stepped);
}

/* A crest of 4/pi A is there before the HIP is at the surface, as Eq. 9 has it. */
TEST(contact_begins_with_its_highest_crest) {
    for (int i = 0; i < 2; i++) {
        surface_parts parts = grating_on(NULL, KNURL_METHOD_BANDLIMITED);
        SCOPED_SCENE *scene = scene_of(&parts);
        int contacts = 0;
        configure_plainly(scene, 0);
        for (int k = 0; k < 100; k++) {
            contacts += (int)slide(scene, -0.04 + 0.3e-3 * k, (i ? 1.28 : 1.27) * A, 0.3).contacts;
        }
        assert_true(i ? contacts == 0 : contacts > 95);
    }
}

/* Up for three ticks, and back on the surface farther on. */
TEST(a_lift_off_leaves_nothing_behind) {
    surface_parts parts = grating_on(NULL, KNURL_METHOD_BANDLIMITED);
    SCOPED_SCENE *scene = scene_of(&parts);
    configure_plainly(scene, 0);
    for (int k = 0; k < 200; k++) {
        const int up = k % 20 >= 17;
        const double x = -0.01 + 0.143e-3 * k;
        const knurl_tick_output out = slide(scene, x, up ? 0.01 : -DEPTH, 0.143);
        if (up) {
            CHECK_SAME(length3(out.force), 0.0);
        } else {
            CHECK_CLOSE(out.height, A * band_harmonics(FS * x, 0.143), BAND_EXACT * A);
        }
    }
}

/* A change of material in the middle of a ridge is felt at once; a started event of S2 plays to its end. */
TEST(another_material_is_felt_in_the_next_tick) {
    for (int change = 20; change < 26; change++) {
        surface_parts parts = grating_on(NULL, KNURL_METHOD_BANDLIMITED);
        SCOPED_SCENE *scene = scene_of(&parts);
        double fs = FS;
        configure_plainly(scene, 0);
        for (int k = 0; k < 60; k++) {
            const double x = -0.01 + 0.2e-3 * k;
            const knurl_tick_output out = slide(scene, x, -DEPTH, 0.2);
            CHECK_CLOSE(out.height, A * band_harmonics(fs * x, 0.2e-3 * fs), BAND_EXACT * A);
            if (k == change) {
                fs = 0.7 * FS;
                set_grating(&parts, KNURL_METHOD_BANDLIMITED, fs, 0.0, A);
                assert_int_equal(knurl_scene_set_material(scene, out.surface, &parts.material), KNURL_OK);
            }
        }
    }
}

TEST(an_event_of_s2_is_played_to_its_end_first) {
    surface_parts parts = grating_on(NULL, KNURL_METHOD_S2);
    SCOPED_SCENE *scene = scene_of(&parts);
    double sum = 0.0;
    configure_plainly(scene, 0);
    for (int k = 0; k < 40; k++) {
        const double x = -0.01 + 0.1e-3 * k; /* events of 10 ticks */
        const knurl_tick_output out = slide(scene, x, -DEPTH, 0.1);
        sum += k < 20 ? out.height : 0.0;
        if (k >= 20) {
            CHECK_CLOSE(out.height, A * band_harmonics(FS * x, 0.1), BAND_EXACT * A);
        }
        if (k == 12) {
            set_grating(&parts, KNURL_METHOD_BANDLIMITED, FS, 0.0, A);
            assert_int_equal(knurl_scene_set_material(scene, out.surface, &parts.material), KNURL_OK);
        }
    }
    CHECK_CLOSE(sum, 0.0, 1e-12L * A);
}

/* A surface that slides under a HIP at rest is crossed backwards: 10 ticks per cycle. */
TEST(a_surface_that_slides_under_a_hip_at_rest_is_kept_step_with) {
    surface_parts parts = grating_on(NULL, KNURL_METHOD_BANDLIMITED);
    SCOPED_SCENE *scene = scene_of(&parts);
    configure_plainly(scene, 0);
    (void)slide(scene, 0.01012, 0.01, 0.0);
    (void)slide(scene, 0.01012, -DEPTH, 0.0);
    glide_to(scene, 0.01, 0.0, 0.0, 0.1);
    for (int k = 1; k <= 100; k++) {
        const knurl_tick_output out = slide(scene, 0.01012, -DEPTH, 0.0);
        CHECK_CLOSE(out.surface_velocity[0], -0.1, 1e-9);
        CHECK_CLOSE(out.height, A * band_harmonics(FS * (0.01012 - 1e-4 * k), 0.1), 2.0L * BAND_EXACT * A);
    }
}

/* A HIP with an encoder of its own, its axes the scene's. */
static void configure_counted(knurl_scene *scene) {
    knurl_hip_desc desc = hip_in_scene_axes();
    desc.resolution = COUNT;
    desc.max_force = 1e6;
    assert_int_equal(knurl_scene_configure_hip(scene, 0, &desc), KNURL_OK);
}

/* A HIP at rest whose position was not tracked in the last tick is where it was measured. */
TEST(an_old_tracked_position_is_not_used_while_an_event_of_s2_plays_on) {
    surface_parts parts = grating_on(NULL, KNURL_METHOD_BANDLIMITED);
    SCOPED_SCENE *scene = scene_of(&parts);
    configure_counted(scene);
    knurl_tick_output out = slide(scene, 0.0, -DEPTH, 0.0);
    for (int k = 0; k < 24; k++) {
        const double x = COUNT * floor(k < 20 ? 0.03 * k : 1.0);
        out = slide(scene, x, -DEPTH, k < 20 ? 0.03 * COUNT * 1000.0 : k < 22 ? 0.02 : 0.0);
        if (k == 19 || k == 21) { /* S2 plays an event of 50 ticks, which the smooth surface inherits */
            set_grating(&parts, k == 19 ? KNURL_METHOD_S2 : KNURL_METHOD_BANDLIMITED, FS, 0.0, k == 19 ? A : 0.0);
            assert_int_equal(knurl_scene_set_material(scene, out.surface, &parts.material), KNURL_OK);
        }
    }
    assert_true(out.height != 0.0);
    CHECK_CLOSE(out.cycles[0], FS * COUNT, 1e-12);
}

/* At rest near an edge of a surface that is moved in tenths of a count, one count to and fro on some axes. Edges are
 * across `along`, along which the surface's coordinate grows by `steep` per metre. */
static void check_flicker(surface_parts *parts, const double along[3], const double normal[3], double steep,
                          uint32_t axes) {
    uint64_t seed = 10;
    for (int place = 0; place < 60; place++) {
        SCOPED_SCENE *scene = empty_scene(1);
        for (int i = 0; i < 3; i++) {
            parts->desc.position[i] = along[i] * (0.25 / (FS * steep) + COUNT * (place / 10.0 - 3.0));
        }
        (void)add_surface(scene, parts);
        assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
        configure_counted(scene);
        (void)tick_at(scene, 0.01 * normal[0], 0.01 * normal[1], 0.01 * normal[2]);
        double first = 0.0;
        int toggles = 0;
        for (int k = 0; k < 400; k++) {
            double p[3];
            for (uint32_t i = 0; i < 3; i++) {
                const double flicker = axes >> i & 1 ? (double)(random_bits(&seed) >> 20 & 1) : 0.0;
                p[i] = COUNT * (floor(-DEPTH * normal[i] / COUNT) + flicker);
            }
            const knurl_tick_output out = tick_at(scene, p[0], p[1], p[2]);
            toggles += k > 150 && out.height * first < 0.0; /* it settles first */
            first = out.height;
            assert_true(length3(out.force) <= K * (BAND_CREST * A + out.depth));
        }
        if (toggles > 0) {
            fail_msg("place %d: %d toggles", place, toggles);
        }
    }
}

TEST(at_rest_on_an_edge_a_flicker_on_any_axis_does_not_toggle_it) {
    static const double x[3] = {1.0, 0.0, 0.0}, y[3] = {0.0, 1.0, 0.0}, up[3] = {0.0, 0.0, 1.0};
    SCOPED_SHAPE curved = curved_sheet();
    surface_parts plane = grating_on(NULL, KNURL_METHOD_BANDLIMITED);
    surface_parts mesh = grating_on(&curved, KNURL_METHOD_BANDLIMITED);
    check_flicker(&plane, x, up, 1.0, 1);
    check_flicker(&plane, x, up, 1.0, 7);
    set_grating(&plane, KNURL_METHOD_BANDLIMITED, 0.0, FS, A);
    check_flicker(&plane, y, up, 1.0, 2);
    check_flicker(&plane, y, up, 1.0, 7);
    check_flicker(&mesh, x, up, 1.0, 1);
    check_flicker(&mesh, x, up, 1.0, 7);
}

/* Turned so that x runs along the count's diagonal: all three axes together move it by sqrt(3) counts. */
TEST(at_rest_on_an_edge_of_a_turned_plane_as_well) {
    const double x[3] = {sqrt(1.0 / 3.0), sqrt(1.0 / 3.0), sqrt(1.0 / 3.0)};
    const double normal[3] = {-sqrt(0.5), 0.0, sqrt(0.5)};
    surface_parts plane = grating_on(NULL, KNURL_METHOD_BANDLIMITED);
    double rotation[9];
    double y[3];
    cross3(normal, x, y);
    for (int i = 0; i < 3; i++) {
        rotation[3 * i] = x[i];
        rotation[3 * i + 1] = y[i];
        rotation[3 * i + 2] = normal[i];
    }
    const double w = 0.5 * sqrt(1.0 + rotation[0] + rotation[4] + rotation[8]);
    plane.desc.rotation[0] = (rotation[7] - rotation[5]) / (4.0 * w);
    plane.desc.rotation[1] = (rotation[2] - rotation[6]) / (4.0 * w);
    plane.desc.rotation[2] = (rotation[3] - rotation[1]) / (4.0 * w);
    plane.desc.rotation[3] = w;
    check_flicker(&plane, x, normal, 1.0, 1);
    check_flicker(&plane, x, normal, 1.0, 7);
}

/* The middle fifth of the sheet has uvs three times as dense, so that the mean of |dP/du| is 0.8 + 0.2/3, and
 * coordinates scaled to it grow there by 2.6 per metre. */
TEST(at_rest_on_an_edge_of_dense_uvs_as_well) {
    static const double half[2] = {0.05, 0.05};
    static const double x[3] = {1.0, 0.0, 0.0};
    static const double up[3] = {0.0, 0.0, 1.0};
    SCOPED_SHAPE s = shape_sheet(50, 4, half, dome);
    for (uint32_t v = 0; v < s.vertex_count; v++) {
        const float at = s.positions[3 * v];
        s.uvs[2 * v] = at + 2.0f * fmaxf(-0.01f, fminf(0.01f, at));
        s.uvs[2 * v + 1] = s.positions[3 * v + 1];
    }
    surface_parts dense = grating_on(&s, KNURL_METHOD_BANDLIMITED);
    check_flicker(&dense, x, up, 3.0 * (0.8 + 0.2 / 3.0), 1);
    check_flicker(&dense, x, up, 3.0 * (0.8 + 0.2 / 3.0), 7);
}

/* 1 mm/s over 20 ridges and back in whole counts, every third of which flickers: 80 edges. */
static int count_toggles(const shape *mesh, int32_t method) {
    surface_parts parts = grating_on(mesh, method);
    SCOPED_SCENE *scene = scene_of(&parts);
    double last = 0.0;
    int toggles = 0;
    configure_counted(scene);
    (void)tick_at(scene, 0.0, 0.0, 0.01);
    for (int k = 0; k < 40000; k++) {
        const double x = 1e-6 * (k < 20000 ? k : 40000 - k);
        const double noise = k % 3 == 0 ? 0.4 : 0.0;
        const knurl_tick_output out =
            tick_at(scene, COUNT * floor(x / COUNT + noise + 0.5), 0.0, COUNT * floor(-DEPTH / COUNT));
        toggles += out.height * last < 0.0;
        last = out.height;
    }
    return toggles;
}

TEST(slowly_from_a_noisy_encoder_few_edges_toggle_twice) {
    SCOPED_SHAPE curved = curved_sheet();
    for (int i = 0; i < 2; i++) {
        const int toggles = count_toggles(i ? &curved : NULL, KNURL_METHOD_BANDLIMITED);
        print_message("%d; S1: %d\n", toggles, count_toggles(i ? &curved : NULL, KNURL_METHOD_S1));
        assert_true(toggles >= 80 && toggles <= 100);
    }
}

/* Tangents define the direction of x, but no origin: cycles of the distance, from the first touch.
 */
TEST(on_a_mesh_with_tangents_alone_the_distance_is_counted) {
    shape curved = curved_sheet();
    surface_parts parts = grating_on(&curved, KNURL_METHOD_BANDLIMITED);
    float *tangents = calloc(4 * (size_t)curved.vertex_count, sizeof *tangents);
    assert_non_null(tangents);
    for (uint32_t v = 0; v < curved.vertex_count; v++) {
        tangents[4 * v] = 1.0F;
    }
    parts.mesh.uvs = NULL;
    parts.mesh.tangents = tangents;
    knurl_scene *scene = scene_of(&parts);
    for (int fast = 0; fast < 2; fast++) {
        const double speed = fast ? 0.25 : 0.0625; /* a quarter and a sixteenth of a cycle a tick */
        double last = 0.0;
        int rises = 0;
        configure_plainly(scene, 0);
        (void)slide(scene, -0.045, 0.01, 0.0);
        for (int k = 0; k < 320; k++) {
            const knurl_tick_output out = slide(scene, -0.045 + speed * k / 1000.0, -DEPTH, speed);
            rises += last < 0.0 && out.height > 0.0;
            last = out.height != 0.0 ? out.height : last;
        }
        CHECK_CLOSE(rises, speed * 320.0, 2.0); /* along a slope of 0.2 % */
    }
    knurl_scene_destroy(scene);
    shape_free(&curved);
    free(tangents);
}
