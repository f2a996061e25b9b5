/* Faults of downloaded meshes: mended or reported. SPDX-License-Identifier: MIT */
#include "scene/ask.h"
#include "scene/patch.h"

#define K 400.0 /* N/m, the default */

/* --- reversed twins --- */

/* A sphere (R 30 mm, 1,280 triangles) with reversed copies of triangles 0, step, 2 step, ..., before or after the
 * others. */
static shape sphere_with_twins(uint32_t twins, uint32_t step, int first) {
    SCOPED_SHAPE sphere = shape_sphere(0.03, 3);
    shape s = shape_new(sphere.vertex_count, sphere.index_count + 3 * twins, 0);
    memcpy(s.positions, sphere.positions, sphere.vertex_count * 3 * sizeof(float));
    memcpy(&s.indices[first ? 3 * twins : 0], sphere.indices, sphere.index_count * sizeof(uint32_t));
    for (uint32_t i = 0; i < 3 * twins; i++) {
        s.indices[(first ? 0 : sphere.index_count) + i] = sphere.indices[3 * step * (i / 3) + 2 - i % 3];
    }
    return s;
}

/* m: the largest depth of the sphere's facets inside it: the largest one is in a circle of 0.0953 rad. */
#define SAG (0.03 * (1.0 - cos(0.0953)))

/* 1 if a HIP that is 3 mm inside on its first tick, or has come there from outside, is pushed out along x, and one that
 * leaves from the middle is not held in. */
static int has_one_side(knurl_scene *scene) {
    const double full = K * 0.003;
    const double at_first = tick_at(scene, 0.027, 1e-4, 2e-4).force[0];
    (void)tick_at(scene, 0.04, 1e-4, 2e-4);
    const double entered = tick_at(scene, 0.027, 1e-4, 2e-4).force[0];
    (void)tick_at(scene, 0.04, 1e-4, 2e-4);
    int held = 0;
    const knurl_tick_input absent = {.absent = 1};
    knurl_tick_output out;
    assert_int_equal(knurl_scene_tick(scene, 0, &absent, &out), KNURL_OK);
    for (int i = 0; i < 40; i++) { /* from the middle: deeper than the first tick's capture */
        out = tick_at(scene, 0.001 * i, 1e-4, 2e-4);
        held |= out.contacts > 0 && out.force[0] < 0.0;
    }
    return fabs(at_first - full) < K * SAG && fabs(entered - full) < K * SAG && !held;
}

TEST(few_reversed_twins_leave_a_mesh_its_one_side_and_are_reported) {
    static const uint32_t counts[][2] = {{1, 1}, {1, 700}, {12, 100}, {120, 10}};
    for (size_t i = 0; i < COUNT_OF(counts); i++) {
        for (int first = 0; first < 2; first++) {
            SCOPED_SHAPE s = sphere_with_twins(counts[i][0], counts[i][1], first);
            surface_parts parts = surface_shape(&s);
            SCOPED_SCENE *scene = scene_of(&parts);
            const knurl_surface_info info = first_info(scene);
            const knurl_surface_check check = first_check(scene);
            assert_int_equal(info.reversed_twins, counts[i][0]);
            assert_int_equal(info.double_sided, 0);
            assert_true(has_one_side(scene));
            assert_true(check.exceeded & KNURL_LIMIT_WINDING);
            assert_non_null(strstr(check.message, "reversed twin"));
        }
    }
}

TEST(more_twins_than_a_tenth_of_the_area_make_a_mesh_double_sided_and_are_reported_unless_all_have_one) {
    static const uint32_t counts[][2] = {{320, 4}, {640, 2}, {1280, 1}};
    for (size_t i = 0; i < COUNT_OF(counts); i++) {
        SCOPED_SHAPE s = sphere_with_twins(counts[i][0], counts[i][1], 0);
        surface_parts parts = surface_shape(&s);
        SCOPED_SCENE *scene = scene_of(&parts);
        const knurl_surface_check check = first_check(scene);
        assert_int_equal(first_info(scene).double_sided, 1);
        assert_int_equal((check.exceeded & KNURL_LIMIT_WINDING) != 0, counts[i][0] < 1280);
    }
}

/* --- uvs --- */

#define A  0.0002 /* m */
#define FS 1000.0 /* cycles/m */

/* 0.1 x 0.1 m, 20 x 20 quads with vertices of their own, bent so that it stays a mesh; u, v from 0 to 1. */
static double bent(double x, double y) {
    return 0.002 * cos(30.0 * x) * cos(30.0 * y);
}

static shape plate(void) {
    shape s = shape_sheet(20, 20, (const double[2]){0.05, 0.05}, bent);
    shape_unweld(&s);
    return s;
}

/* Half cycles played on a stroke of 60 mm along x. */
static double play_60_mm(surface_parts *parts) {
    SCOPED_SCENE *scene = scene_of(parts);
    for (int k = 0; k <= 600; k++) {
        const double x = 0.0001 * k - 0.03, y = 0.0013;
        (void)tick_at(scene, x, y, bent(x, y) - 0.001);
    }
    const knurl_hip_counts counts = counts_of(scene);
    return (double)counts.half_cycles_played;
}

static surface_parts grated(const shape *s, int32_t method) {
    surface_parts parts = surface_mesh(s);
    set_grating(&parts, method, FS, 0.0, A);
    return parts;
}

TEST(uvs_of_another_scale_in_a_tenth_of_a_mesh_do_not_change_that_of_the_rest) {
    static const float scales[][2] = {{0.01F, 0.01F}, {0.25F, 1.0F}, {4.0F, 1.0F}, {1.0F, 0.25F}, {1.0F, 4.0F}};
    for (size_t n = 0; n < COUNT_OF(scales); n++) {
        SCOPED_SHAPE s = plate();
        for (uint32_t i = s.index_count * 9 / 10; i < s.index_count; i++) { /* the upper two of 20 rows */
            for (uint32_t k = 0; k < 2; k++) {
                s.uvs[2 * i + k] = 0.5F + scales[n][k] * (s.uvs[2 * i + k] - 0.5F);
            }
        }
        surface_parts parts = grated(&s, KNURL_METHOD_S1);
        CHECK_CLOSE(play_60_mm(&parts), 120.0, 2.0); /* the sheet is a little longer than its shadow */
        SCOPED_SCENE *scene = scene_of(&parts);
        CHECK_CLOSE(first_info(scene).uneven, 0.1, 2e-3); /* by area */
        assert_int_equal((first_check(scene).exceeded & KNURL_LIMIT_STRETCH) != 0,
                         scales[n][0] < 1.0F || scales[n][0] > 1.0F);
        assert_true(!first_check(scene).exceeded || strstr(first_check(scene).message, "of its area"));
    }
}

TEST(uvs_of_a_palette_are_ignored_and_reported_if_a_grating_needs_them) {
    static const int32_t methods[] = {KNURL_METHOD_S1, KNURL_METHOD_BANDLIMITED};
    SCOPED_SHAPE s = plate();
    for (uint32_t i = 0; i < s.index_count; i++) { /* one colour for each triangle */
        s.uvs[2 * i] = (float)(i / 3 % 8) / 8.0F;
        s.uvs[2 * i + 1] = 0.25F;
    }
    for (size_t i = 0; i < COUNT_OF(methods); i++) {
        surface_parts parts = grated(&s, methods[i]);
        CHECK_CLOSE(play_60_mm(&parts), 120.0, 1.0); /* x, projected */
        knurl_scene *scene = scene_of(&parts);
        assert_string_equal(first_info(scene).coordinates, "box, for its uvs have no area");
        assert_true(first_check(scene).exceeded & KNURL_LIMIT_STRETCH);
        knurl_scene_destroy(scene);
        parts.desc.coordinates = KNURL_COORDINATES_BOX; /* explicit */
        scene = scene_of(&parts);
        assert_string_equal(first_info(scene).coordinates, "box");
        assert_int_equal(first_check(scene).exceeded & KNURL_LIMIT_STRETCH, 0);
        knurl_scene_destroy(scene);
    }
    surface_parts smooth = surface_mesh(&s);
    SCOPED_SCENE *scene = scene_of(&smooth);
    assert_int_equal(first_check(scene).exceeded & KNURL_LIMIT_STRETCH, 0);
}

/* A box of which the two sides across an axis alone have uvs: a third of its area. */
TEST(uvs_on_less_than_half_of_the_area_are_ignored) {
    for (size_t axis = 0; axis < 3; axis++) {
        SCOPED_SHAPE box = shape_box((const double[3]){0.02, 0.02, 0.02}, 0);
        shape_unweld(&box);
        box.uvs = calloc(2 * (size_t)box.vertex_count, sizeof *box.uvs);
        assert_non_null(box.uvs);
        for (uint32_t i = 0; i < box.index_count; i++) {
            const float *first = &box.positions[9 * (size_t)(i / 3)], *at = &box.positions[3 * (size_t)i];
            const int across = first[axis] == first[3 + axis] && first[axis] == first[6 + axis];
            for (size_t k = 0; k < 2; k++) {
                box.uvs[2 * i + k] = across ? at[(axis + 1 + k) % 3] : 0.5F;
            }
        }
        surface_parts parts = surface_mesh(&box);
        SCOPED_SCENE *scene = scene_of(&parts);
        assert_string_equal(first_info(scene).coordinates, "box, for its uvs have no area");
    }
}

/* --- box coordinates --- */

/* Round the y axis or the x axis, 1 mm deep in a ball, from an angle on. On each of four sides u or v runs over sqrt(2)
 * times the radius. */
static void check_round_trip(const shape *ball, int about_x, int32_t method, double fs, double from) {
    const double radius = 0.03, u = 4.0 * sqrt(2.0) * radius;
    const double pi = acos(-1.0);
    double last = 0.0;
    surface_parts parts = surface_mesh(ball);
    set_grating(&parts, method, about_x ? 0.0 : fs, about_x ? fs : 0.0, A);
    SCOPED_SCENE *scene = scene_of(&parts);
    for (int k = 0; k <= 2000; k++) {
        const double angle = from + 2.0 * pi * k / 2000.0, r = radius - 0.001;
        const knurl_tick_output out =
            tick_at(scene, about_x ? 1e-4 : r * sin(angle), about_x ? r * sin(angle) : 1e-4, r * cos(angle));
        assert_true(k == 0 || fabs(out.cycles[about_x] - last) < 1.5 * fs * 2.0 * pi * r / 2000.0); /* at seams too */
        last = out.cycles[about_x];
    }
    CHECK_CLOSE((double)counts_of(scene).half_cycles_played, 2.0 * fs * u, 2.0);
    assert_true(first_info(scene).projection_seams > 0);
    assert_int_equal(first_check(scene).exceeded & KNURL_LIMIT_STRETCH, 0);
}

TEST(a_mesh_without_uvs_is_tagged_with_three_numbers_and_no_half_cycle_is_invented_at_a_seam) {
    SCOPED_SHAPE ball = shape_sphere(0.03, 5);
    for (int i = 0; i < 12; i++) {
        check_round_trip(&ball, i / 6, i % 2 ? KNURL_METHOD_S1 : KNURL_METHOD_BANDLIMITED, 300.0 + 71.3 * i, 0.37 * i);
    }
}

/* A box of 40 mm: from its top over an edge of 90 degrees, down a side, and back. Ridges along z on top; on the side
 * facing +x they are upright, so the path down crosses no ridge. */
TEST(ridges_of_a_box_stand_on_each_side_as_its_axes_say) {
    SCOPED_SHAPE box = shape_box((const double[3]){0.02, 0.02, 0.02}, 0);
    surface_parts parts = surface_mesh(&box);
    set_grating(&parts, KNURL_METHOD_S1, FS, 0.0, A);
    SCOPED_SCENE *scene = scene_of(&parts);
    for (int k = 0; k <= 150; k++) {
        (void)tick_at(scene, 0.0001 * k, 0.019, 0.001);
    }
    const double on_top = (double)counts_of(scene).half_cycles_played;
    CHECK_CLOSE(on_top, 30.0, 1.0);
    for (int k = 0; k <= 150; k++) { /* deeper under the side than under the top: it is the side's now */
        (void)tick_at(scene, 0.019, 0.015 - 0.0001 * k, 0.001);
    }
    CHECK_CLOSE((double)counts_of(scene).half_cycles_played, on_top, 9.0); /* the 4 mm beside the corner, in one leap */
    assert_int_equal(first_info(scene).projection_seams, 12);
}

TEST(a_box_takes_no_axis_and_a_shared_shape_no_coordinates) {
    SCOPED_SHAPE ball = shape_sphere(0.03, 2);
    surface_parts parts = surface_mesh(&ball);
    SCOPED_SCENE *scene = empty_scene(1);
    knurl_surface_id first = 0, id = 0;
    parts.desc.coordinates = KNURL_COORDINATES_BOX;
    memcpy(parts.desc.axis, (const double[3]){1.0, 0.5, 0.25}, sizeof parts.desc.axis);
    assert_int_equal(knurl_scene_add_surface(scene, surface_ready(&parts), &id), KNURL_ERROR_ARGUMENT);
    check_message("axis: expected zeros with KNURL_COORDINATES_BOX, found [1, 0.5, 0.25]");
    memset(parts.desc.axis, 0, sizeof parts.desc.axis);
    first = add_surface(scene, &parts);
    parts.desc.coordinates = 7;
    assert_int_equal(knurl_scene_add_surface(scene, surface_ready(&parts), &id), KNURL_ERROR_UNKNOWN);
    check_message("coordinates");
    parts = surface_plane();
    (void)surface_ready(&parts);
    parts.desc.plane = NULL;
    parts.desc.shape_of = first;
    parts.desc.coordinates = KNURL_COORDINATES_BOX;
    assert_int_equal(knurl_scene_add_surface(scene, &parts.desc, &id), KNURL_ERROR_ARGUMENT);
    check_message("coordinates: expected KNURL_COORDINATES_AUTO");
    assert_true(id == 0);
}
