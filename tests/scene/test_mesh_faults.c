/* Faults of downloaded meshes: mended or told. SPDX-License-Identifier: MIT */
#include "scene/patch.h"

#define K 400.0 /* N/m, the default */

static knurl_surface_info info_of(const knurl_scene *scene) {
    knurl_surface_info info;
    knurl_surface_info_init(&info, sizeof info);
    assert_int_equal(knurl_scene_get_surface_info(scene, knurl_scene_get_surface(scene, 0), &info), KNURL_OK);
    return info;
}

static knurl_surface_check check_of(const knurl_scene *scene) {
    knurl_surface_check check;
    knurl_surface_check_init(&check, sizeof check);
    assert_int_equal(knurl_scene_check_surface(scene, 0, knurl_scene_get_surface(scene, 0), &check), KNURL_OK);
    return check;
}

/* --- reversed twins --- */

/* A sphere (R 30 mm, 1,280 triangles) with reversed copies of triangles 0, step, 2 step, ..., before or after the
 * others. */
static shape sphere_with_twins(uint32_t twins, uint32_t step, int first) {
    shape sphere = shape_sphere(0.03, 3);
    shape s = shape_new(sphere.vertex_count, sphere.index_count + 3 * twins, 0);
    memcpy(s.positions, sphere.positions, sphere.vertex_count * 3 * sizeof(float));
    memcpy(&s.indices[first ? 3 * twins : 0], sphere.indices, sphere.index_count * sizeof(uint32_t));
    for (uint32_t i = 0; i < 3 * twins; i++) {
        s.indices[(first ? 0 : sphere.index_count) + i] = sphere.indices[3 * step * (i / 3) + 2 - i % 3];
    }
    shape_free(&sphere);
    return s;
}

/* m: the sphere's facets lie at most this far inside it: the largest stands on a circle of 0.0953 rad. */
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

TEST(few_reversed_twins_leave_a_mesh_its_one_side_and_are_told) {
    static const uint32_t counts[][2] = {{1, 1}, {1, 700}, {12, 100}, {120, 10}};
    for (size_t i = 0; i < COUNT_OF(counts); i++) {
        for (int first = 0; first < 2; first++) {
            SCOPED_SHAPE s = sphere_with_twins(counts[i][0], counts[i][1], first);
            surface_parts parts = surface_shape(&s);
            SCOPED_SCENE *scene = scene_of(&parts);
            const knurl_surface_info info = info_of(scene);
            const knurl_surface_check check = check_of(scene);
            assert_int_equal(info.reversed_twins, counts[i][0]);
            assert_int_equal(info.double_sided, 0);
            assert_true(has_one_side(scene));
            assert_true(check.exceeded & KNURL_LIMIT_WINDING);
            assert_non_null(strstr(check.message, "reversed twin"));
        }
    }
}

TEST(more_twins_than_a_tenth_of_the_area_make_a_mesh_double_sided_and_are_told_unless_all_have_one) {
    static const uint32_t counts[][2] = {{320, 4}, {640, 2}, {1280, 1}};
    for (size_t i = 0; i < COUNT_OF(counts); i++) {
        SCOPED_SHAPE s = sphere_with_twins(counts[i][0], counts[i][1], 0);
        surface_parts parts = surface_shape(&s);
        SCOPED_SCENE *scene = scene_of(&parts);
        const knurl_surface_check check = check_of(scene);
        assert_int_equal(info_of(scene).double_sided, 1);
        assert_int_equal((check.exceeded & KNURL_LIMIT_WINDING) != 0, counts[i][0] < 1280);
    }
}
