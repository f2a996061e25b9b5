/* The method LOCKED at a surface: lift-off, changes of surface and material in an event, an encoder at rest, ways to
 * count, and a surface that moves. SPDX-License-Identifier: MIT */
#include "support/geometry.h"
#include "support/locked.h"
#include "support/scenes.h"

#define K     400.0 /* N/m, the default */
#define DEPTH 0.003
#define FS    1000.0   /* cycles/m */
#define COUNT 0.055e-3 /* m: an encoder's */

static knurl_tick_output slide(knurl_scene *scene, double x, double z, double speed) {
    return tick_moving(scene, (const double[3]){x, 0.004, z}, (const double[3]){speed, 0.0, 0.0});
}

/* Eq. 11 of the default grating at x; on no edge. */
static double bars(double x) {
    return x * FS + 0.25 - floor(x * FS + 0.25) < 0.5 ? A : -A;
}

static surface_parts grating_on(const shape *mesh, int32_t method) {
    surface_parts parts = mesh ? surface_mesh(mesh) : surface_plane();
    set_grating(&parts, method, FS, 0.0, A);
    return parts;
}

/* A gently curved sheet, which stays a mesh: u and v in metres along x and y. */
static double dome(double x, double y) {
    return -0.1 * (x * x + y * y);
}

static shape curved_sheet(void) {
    static const double half[2] = {0.05, 0.05};
    shape s = shape_sheet(8, 8, half, dome);
    for (uint32_t v = 0; v < s.vertex_count; v++) {
        s.uvs[2 * v] = s.positions[3 * v];
        s.uvs[2 * v + 1] = s.positions[3 * v + 1];
    }
    return s;
}

/* In each tick of an event of 7: up and away, and back again. */
TEST(lift_off_in_an_event_ends_it_and_the_touch_after_begins_anew) {
    shape curved = curved_sheet();
    for (int i = 0; i < 2 * 14; i++) {
        surface_parts parts = grating_on(i % 2 ? &curved : NULL, KNURL_METHOD_LOCKED);
        knurl_scene *scene = scene_of(&parts);
        const int lift = 20 + i / 2;
        int64_t event = KNURL_NO_EVENT;
        (void)slide(scene, 0.0, 0.01, 0.0);
        for (int k = 0; k < 80; k++) {
            const double x = -0.002 + 0.143e-3 * k;
            const int up = k >= lift && k < lift + 3;
            const knurl_tick_output out = slide(scene, x, up ? 0.01 : -DEPTH, 0.143);
            assert_int_equal(out.contacts, !up);
            if (up) {
                CHECK_SAME(length3(out.force), 0.0);
                CHECK_SAME(out.height, 0.0);
                assert_true(out.event == KNURL_NO_EVENT);
            } else if (k >= lift + 3) { /* nothing is left of what was cut off: it begins at 0, at a rising edge */
                assert_true(out.event == event || out.event == event + 1);
                assert_true(out.event != 0 || event == 0 || out.height > 0.0);
            }
            event = up ? KNURL_NO_EVENT : out.event;
        }
        assert_true(event >= 3);
        knurl_scene_destroy(scene);
    }
    shape_free(&curved);
}

/* Two plates of other gratings side by side at one height: the second begins anew, and is as strong as it should be. */
TEST(a_change_of_surface_in_an_event_begins_the_other_ones_anew) {
    surface_parts left = grating_on(NULL, KNURL_METHOD_LOCKED);
    surface_parts right = grating_on(NULL, KNURL_METHOD_LOCKED);
    knurl_scene *scene = empty_scene(1);
    left.desc.position[0] = -0.05;
    right.desc.position[0] = 0.05;
    right.material.spatial_frequency[0] = 700.0;
    right.material.amplitude = 0.5 * A;
    const knurl_surface_id first = add_surface(scene, &left);
    const knurl_surface_id second = add_surface(scene, &right);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    for (int i = 0; i < 14; i++) {
        double last = 0.0;
        int64_t event = KNURL_NO_EVENT;
        knurl_surface_id on = 0;
        configure_plainly(scene, 0);
        (void)slide(scene, -0.01, 0.01, 0.0);
        for (int k = 0; k < 130; k++) {
            const double x = -0.01 + 1e-5 * i + 3e-6 + 0.2e-3 * k;
            const knurl_tick_output out = slide(scene, x, -DEPTH, 0.2);
            assert_int_equal(out.contacts, 1);
            assert_true(out.surface == (x < 0.0 ? first : second));
            assert_true(length3(out.force) <= K * (DEPTH + A) * (1.0 + 1e-12));
            assert_true(k == 0 || fabs(out.height - last) <= HIGHEST_STEP);
            assert_true(out.surface == on || out.event <= 0);
            event = out.event > event ? out.event : event;
            last = out.height;
            on = out.surface;
        }
        assert_true(event > 5);
    }
    knurl_scene_destroy(scene);
}

/* What the material becomes in an event of 5 ticks, and what is then felt. */
static void change_in_an_event(int32_t method, double fs, double amplitude, int given) {
    for (int change = 20; change < 26; change++) {
        surface_parts parts = grating_on(NULL, KNURL_METHOD_LOCKED);
        knurl_scene *scene = scene_of(&parts);
        double sum = 0.0;
        int64_t event = KNURL_NO_EVENT;
        int64_t at_change = 0;
        int over = 0;
        (void)slide(scene, 0.0, 0.01, 0.0);
        for (int k = 0; k < 80; k++) {
            const double x = -0.01 + 1e-5 + 0.2e-3 * k;
            const knurl_tick_output out = given ? slide(scene, x, -DEPTH, 0.2) : tick_at(scene, x, 0.004, -DEPTH);
            if (out.event != event) {
                CHECK_CLOSE(sum, 0.0, 1e-12L * A);
                sum = 0.0;
                over |= k > change;
            }
            sum += out.event != KNURL_NO_EVENT ? out.height : 0.0;
            event = out.event;
            at_change = k <= change ? event : at_change;
            assert_true(over || event == at_change || k <= change);
            assert_true(!over || fabs(out.height) <= 1.4142135623730951 * amplitude * (1.0 + 1e-12));
            assert_true(!over || method == KNURL_METHOD_LOCKED || method == KNURL_METHOD_S2 || fabs(out.height) == amplitude);
            if (k == change) {
                set_grating(&parts, method, fs, 0.0, amplitude);
                assert_int_equal(knurl_scene_set_material(scene, out.surface, &parts.material), KNURL_OK);
            }
        }
        assert_true(over && (amplitude > 0.0 ? method == KNURL_METHOD_S1 || event > at_change : event == KNURL_NO_EVENT));
        knurl_scene_destroy(scene);
    }
}

TEST(a_change_of_material_waits_for_the_events_end) {
    for (int given = 0; given < 2; given++) {
        change_in_an_event(KNURL_METHOD_LOCKED, FS, 0.3 * A, given);
        change_in_an_event(KNURL_METHOD_LOCKED, 0.7 * FS, A, given);
        change_in_an_event(KNURL_METHOD_LOCKED, 1.9 * FS, 0.5 * A, given);
        change_in_an_event(KNURL_METHOD_S2, FS, A, given);
        change_in_an_event(KNURL_METHOD_S1, FS, A, given);
        change_in_an_event(KNURL_METHOD_LOCKED, 0.0, 0.0, given); /* smooth */
    }
}

/* A HIP with an encoder of its own, its axes the scene's. */
static void configure_counted(knurl_scene *scene) {
    knurl_hip_desc desc;
    knurl_workspace workspace;
    knurl_workspace_init(&workspace);
    knurl_hip_desc_init(&desc, sizeof desc);
    desc.resolution = COUNT;
    desc.max_force = 1e6;
    desc.workspace = &workspace;
    assert_int_equal(knurl_scene_configure_hip(scene, 0, &desc), KNURL_OK);
}

/* At rest near an edge of a surface that is moved in tenths of a count, one count to and fro on some axes. Edges lie
 * across `along`, where the surface's coordinate grows by `steep` a metre. */
static void check_flicker(surface_parts *parts, const double along[3], const double normal[3], double steep,
                          uint32_t axes) {
    uint64_t seed = 10;
    for (int place = 0; place < 60; place++) {
        knurl_scene *scene = empty_scene(1);
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
            toggles += k > 60 && out.height * first < 0.0; /* it settles first */
            first = out.height;
            assert_true(k < 30 || out.event == KNURL_NO_EVENT);
            assert_true(length3(out.force) <= K * (A + out.depth) * (1.0 + 1e-12));
        }
        if (toggles > 0) {
            fail_msg("place %d: %d toggles", place, toggles);
        }
        knurl_scene_destroy(scene);
    }
}

TEST(at_rest_on_an_edge_a_flicker_on_any_axis_does_not_toggle_it) {
    static const double x[3] = {1.0, 0.0, 0.0};
    static const double up[3] = {0.0, 0.0, 1.0};
    shape curved = curved_sheet();
    surface_parts plane = grating_on(NULL, KNURL_METHOD_LOCKED);
    surface_parts mesh = grating_on(&curved, KNURL_METHOD_LOCKED);
    check_flicker(&plane, x, up, 1.0, 1);
    check_flicker(&plane, x, up, 1.0, 7);
    check_flicker(&mesh, x, up, 1.0, 1);
    check_flicker(&mesh, x, up, 1.0, 7);
    shape_free(&curved);
}

/* Turned so that x runs along the count's diagonal: all three axes together move it by sqrt(3) counts. */
TEST(at_rest_on_an_edge_of_a_turned_plane_as_well) {
    const double x[3] = {sqrt(1.0 / 3.0), sqrt(1.0 / 3.0), sqrt(1.0 / 3.0)};
    const double normal[3] = {-sqrt(0.5), 0.0, sqrt(0.5)};
    surface_parts plane = grating_on(NULL, KNURL_METHOD_LOCKED);
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

/* The middle fifth of the sheet has uvs three times as dense, so that the mean of |dP/du| is 0.8 + 0.2/3, and what is
 * scaled to it grows there by 2.6 a metre. */
TEST(at_rest_on_an_edge_of_dense_uvs_as_well) {
    static const double half[2] = {0.05, 0.05};
    static const double x[3] = {1.0, 0.0, 0.0};
    static const double up[3] = {0.0, 0.0, 1.0};
    shape s = shape_sheet(50, 4, half, dome);
    for (uint32_t v = 0; v < s.vertex_count; v++) {
        const float at = s.positions[3 * v];
        s.uvs[2 * v] = at + 2.0f * fmaxf(-0.01f, fminf(0.01f, at));
        s.uvs[2 * v + 1] = s.positions[3 * v + 1];
    }
    surface_parts dense = grating_on(&s, KNURL_METHOD_LOCKED);
    check_flicker(&dense, x, up, 3.0 * (0.8 + 0.2 / 3.0), 1);
    check_flicker(&dense, x, up, 3.0 * (0.8 + 0.2 / 3.0), 7);
    shape_free(&s);
}

/* 1 mm/s over 20 ridges and back in whole counts, on a plane and on a mesh. */
TEST(slowly_from_an_encoder_each_edge_toggles_once) {
    shape curved = curved_sheet();
    for (int i = 0; i < 2; i++) {
        surface_parts parts = grating_on(i ? &curved : NULL, KNURL_METHOD_LOCKED);
        knurl_scene *scene = scene_of(&parts);
        double last = 0.0;
        int toggles = 0;
        configure_counted(scene);
        (void)tick_at(scene, 0.0, 0.0, 0.01);
        for (int k = 0; k < 40000; k++) {
            const double x = 1e-6 * (k < 20000 ? k : 40000 - k);
            const double noise = k % 3 == 0 ? 0.4 : 0.0;
            const knurl_tick_output out =
                tick_at(scene, COUNT * floor(x / COUNT + noise + 0.5), 0.0, COUNT * floor(-DEPTH / COUNT));
            assert_true(out.event == KNURL_NO_EVENT || k < 30);
            toggles += out.height * last < 0.0;
            last = out.height;
        }
        assert_int_equal(toggles, 80);
        knurl_scene_destroy(scene);
    }
    shape_free(&curved);
}

/* Tangents say which way x runs and nothing says where on it the HIP is: cycles of the way, from where it was touched.
 */
TEST(on_a_mesh_with_tangents_alone_the_way_is_counted) {
    shape curved = curved_sheet();
    surface_parts parts = grating_on(&curved, KNURL_METHOD_LOCKED);
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
        int64_t event = KNURL_NO_EVENT;
        configure_plainly(scene, 0);
        (void)slide(scene, -0.045, 0.01, 0.0);
        for (int k = 0; k < 320; k++) {
            const knurl_tick_output out = slide(scene, -0.045 + speed * k / 1000.0, -DEPTH, speed);
            rises += last < 0.0 && out.height > 0.0;
            event = out.event;
            last = out.height;
        }
        if (fast) {
            CHECK_CLOSE((double)event, 0.25 * 320.0, 2.0); /* along a slope of 0.2 % */
        } else {
            CHECK_CLOSE(rises, 20, 1);
            assert_true(event == KNURL_NO_EVENT);
        }
    }
    knurl_scene_destroy(scene);
    shape_free(&curved);
    free(tangents);
}

/* What slides under a HIP at rest is crossed backwards. 50 mm/s, then 250. */
TEST(a_surface_that_slides_under_a_hip_at_rest_is_kept_step_with) {
    static const double upright[4] = {0.0, 0.0, 0.0, 1.0};
    for (int fast = 0; fast < 2; fast++) {
        surface_parts parts = grating_on(NULL, KNURL_METHOD_LOCKED);
        knurl_scene *scene = scene_of(&parts);
        const knurl_surface_id id = knurl_scene_get_surface(scene, 0);
        const double way[3] = {fast ? 0.025 : 0.005, 0.0, 0.0};
        int64_t events = -1;
        int begun = 0;
        (void)slide(scene, 0.01012, 0.01, 0.0);
        (void)slide(scene, 0.01012, -DEPTH, 0.0);
        assert_int_equal(knurl_scene_set_transform(scene, id, way, upright, 0.1), KNURL_OK);
        for (int k = 1; k <= 100; k++) {
            const double x = 0.01012 - way[0] * k / 100.0;
            const knurl_tick_output out = slide(scene, 0.01012, -DEPTH, 0.0);
            CHECK_CLOSE(out.surface_velocity[0], -10.0 * way[0], 1e-9);
            if (out.event != KNURL_NO_EVENT && out.event != events) {
                CHECK_CLOSE(0.25 - x * FS, floor(0.75 - x * FS), k > 12 ? 0.126 : 0.5);
                begun++;
            }
            CHECK_SAME(out.event == KNURL_NO_EVENT ? out.height : bars(x), bars(x));
            events = out.event;
        }
        assert_true(fast ? begun >= 23 && begun <= 26 : begun == 0);
        knurl_scene_destroy(scene);
    }
}
