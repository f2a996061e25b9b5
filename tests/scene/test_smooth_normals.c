/* Meshes with normals: which triangles are curved, and which normals are bad and reported.
 * SPDX-License-Identifier: MIT */
#include "scene/ask.h"
#include "scene/smooth.h"

#define K 400.0

static knurl_scene *scene_with(const smooth_mesh *m) {
    surface_parts parts = smooth_surface(m, 1);
    parts.material.stiffness = K;
    return scene_of(&parts);
}

/* A sphere, one of whose vertices has another normal. Returns the number of bad triangles of the five or six there. */
static uint32_t bad_with(double x, double y, double z) {
    smooth_mesh m = smooth_make_sphere(3);
    const double normal[3] = {x, y, z};
    for (int axis = 0; axis < 3; axis++) {
        m.normals[axis] = (float)normal[axis];
    }
    SCOPED_SCENE *scene = scene_with(&m);
    const knurl_surface_info info = first_info(scene);
    double p[3], n[3];
    shape_get(&m.s, 0, p);
    const double length = length3(p);
    for (int k = 0; k < 200; k++) { /* it holds all the same */
        for (int axis = 0; axis < 3; axis++) {
            n[axis] = p[axis] / length * (0.035 - 0.00004 * k) + 0.0001 * (axis == 0);
        }
        const knurl_tick_output out = tick_at(scene, n[0], n[1], n[2]);
        assert_true(length3(out.force) <= K * (0.03 - length3(n) + 0.001) || length3(n) > 0.0305);
        assert_true(k < 135 || length3(out.force) > 0.0);
    }
    assert_int_equal(info.curved_triangles + info.bad_normals, 1280);
    assert_int_equal((first_check(scene).exceeded & KNURL_LIMIT_NORMALS) != 0, info.bad_normals > 0);
    smooth_free(&m);
    return info.bad_normals;
}

TEST(normals_that_cannot_be_right_are_reported_and_their_triangles_felt_flat) {
    const double g = 0.5 * (1.0 + sqrt(5.0)), unit = 1.0 / sqrt(1.0 + g * g); /* of the first vertex: -1, g, 0 */
    assert_int_equal(bad_with(-unit, g * unit, 0.0), 0);
    assert_int_equal(bad_with(-0.95 * unit, 0.95 * g * unit, 0.0), 0); /* of signed bytes */
    assert_int_equal(bad_with(unit, -g * unit, 0.0), 5);               /* turned */
    assert_int_equal(bad_with(-2.0 * unit, 2.0 * g * unit, 0.0), 5);   /* not unit */
    assert_int_equal(bad_with(0.0, 0.0, 0.0), 5);
    assert_int_equal(bad_with(NAN, 0.0, 1.0), 5);
    assert_int_equal(bad_with(HUGE_VAL, 0.0, 0.0), 5);
    assert_int_equal(bad_with(g * unit, unit, 0.0), 5); /* 90 degrees off */
}

/* The apex is 0.05 mm beside the middle of a base of 10 mm, which bulges by over 1 mm between normals 60 degrees apart:
 * straight up, or over the apex. A second triangle, so that it is no plane. */
TEST(normals_that_turn_a_sliver_over_are_bad) {
    static const float corners[18] = {-0.005F, 0.0F,  0.0F, 0.005F, 0.0F,  0.0F, 0.0F, 0.00005F, 0.0F,
                                      -0.005F, 0.05F, 0.0F, 0.005F, 0.05F, 0.0F, 0.0F, 0.05F,    0.01F};
    for (int is_over = 0; is_over <= 1; is_over++) {
        const float y = is_over ? 0.6F : 0.0F, z = is_over ? 0.6245F : 0.866F;
        float normals[18] = {-0.5F, y, z, 0.5F, y, z, 0.0F, 0.0F, 1.0F, 0, -1, 0, 0, -1, 0, 0, -1, 0};
        smooth_mesh m = {shape_new(6, 6, 0), normals};
        memcpy(m.s.positions, corners, sizeof corners);
        for (uint32_t i = 0; i < 6; i++) {
            m.s.indices[i] = i;
        }
        SCOPED_SCENE *scene = scene_with(&m);
        assert_int_equal(first_info(scene).bad_normals, is_over);
        assert_int_equal(first_info(scene).curved_triangles, !is_over);
        shape_free(&m.s);
    }
}

/* Every vertex once, so that it is the first, second or third corner of its triangles. */
TEST(a_zero_normal_is_reported_at_any_corner) {
    smooth_mesh m = smooth_make_sphere(1);
    for (uint32_t v = 0; v < m.s.vertex_count; v++) {
        float *normal = &m.normals[3 * (size_t)v], kept[3];
        uint32_t at_vertex = 0;
        for (uint32_t i = 0; i < m.s.index_count; i++) {
            at_vertex += m.s.indices[i] == v;
        }
        memcpy(kept, normal, sizeof kept);
        memset(normal, 0, sizeof kept);
        SCOPED_SCENE *scene = scene_with(&m);
        assert_int_equal(first_info(scene).bad_normals, at_vertex);
        memcpy(normal, kept, sizeof kept);
    }
    smooth_free(&m);
}

TEST(a_smooth_sphere_says_how_far_it_is_from_its_triangles) {
    smooth_mesh m = smooth_make_sphere(2);
    SCOPED_SCENE *scene = scene_with(&m);
    const knurl_surface_info info = first_info(scene);
    double low = HUGE_VAL;
    for (uint32_t i = 0; i < m.s.index_count / 3; i++) {
        double corners[3][3], n[3];
        shape_corners(&m.s, i, corners);
        (void)normal3((const double (*)[3])corners, n);
        low = fmin(low, dot3(corners[0], n));
    }
    assert_int_equal(info.curved_triangles, 320);
    assert_int_equal(info.bad_normals, 0);
    assert_true(info.bulge >= 0.98 * (0.03 - low) && info.bulge < 1.2 * (0.03 - low)); /* the patch is 1 % off */
    smooth_free(&m);
}

/* With the normals of their faces, meshes are felt as without normals, to the bit. */
TEST(flat_normals_change_nothing) {
    smooth_mesh m = smooth_make_flat(shape_sphere(0.03, 2));
    surface_parts parts = smooth_surface(&m, 0);
    knurl_scene *with = scene_with(&m), *without = scene_of(&parts);
    assert_int_equal(first_info(with).curved_triangles + first_info(with).bad_normals, 0);
    for (int k = 0; k < 2000; k++) {
        const double at[3] = {0.0285 * cos(0.005 * k), 0.01 * sin(0.013 * k), 0.0285 * sin(0.005 * k)};
        const knurl_tick_output a = tick_at(with, at[0], at[1], at[2]), b = tick_at(without, at[0], at[1], at[2]);
        check_same_output(&a, &b);
    }
    knurl_scene_destroy(with);
    knurl_scene_destroy(without);
    smooth_free(&m);
}

/* A flat sheet stays a plane if its normals are perpendicular to it, and not otherwise. */
TEST(a_flat_mesh_is_a_plane_if_its_normals_are) {
    for (int bent = 0; bent < 2; bent++) {
        smooth_mesh m = {shape_sheet(4, 4, (const double[2]){0.05, 0.05}, NULL), NULL};
        m.normals = calloc(m.s.vertex_count, 3 * sizeof(float));
        for (uint32_t v = 0; v < m.s.vertex_count; v++) {
            const double x = bent ? 4.0 * (double)m.s.positions[3 * v] : 0.0; /* as on a cylinder of 0.25 m */
            m.normals[3 * v] = (float)sin(x);
            m.normals[3 * v + 2] = (float)cos(x);
        }
        SCOPED_SCENE *scene = scene_with(&m);
        const knurl_surface_info info = first_info(scene);
        assert_string_equal(info.model, bent ? "mesh+bvh" : "plane");
        assert_int_equal(info.curved_triangles, bent ? 32 : 0);
        smooth_free(&m);
    }
}

/* A roof of two smooth sheets, bent alike, that meet at an edge of 60 degrees: vertices of their own there. */
TEST(an_edge_with_split_normals_stays_an_edge) {
    smooth_mesh m = {shape_new(8, 12, 1), calloc(8, 3 * sizeof(float))};
    static const float slopes[4] = {-0.55f, -0.4f, 0.4f, 0.55f};
    for (uint32_t v = 0; v < 8; v++) { /* left foot, left ridge, right ridge, right foot; two of each */
        const double x = v < 2 ? -0.02 : v < 6 ? 0.0 : 0.02;
        shape_set(&m.s, v, x, v % 2 ? 0.02 : -0.02, x == 0.0 ? 0.02 * tan(SMOOTH_PI / 6.0) : 0.0);
        const float slope = slopes[v / 2];
        m.normals[3 * v] = slope;
        m.normals[3 * v + 2] = sqrtf(1.0f - slope * slope);
    }
    uint32_t at = shape_quad(&m.s, 0, 0, 2, 3, 1);
    (void)shape_quad(&m.s, at, 4, 6, 7, 5);
    SCOPED_SCENE *scene = scene_with(&m);
    assert_int_equal(first_info(scene).curved_triangles, 4);
    const double top = 0.02 * tan(SMOOTH_PI / 6.0);
    (void)tick_at(scene, -0.002, 0.001, top + 0.002);
    const knurl_tick_output left = tick_at(scene, -0.0008, 0.001, top - 0.0015);
    (void)tick_at(scene, 0.002, 0.001, top + 0.002);
    const knurl_tick_output right = tick_at(scene, 0.0008, 0.001, top - 0.0015);
    CHECK_CLOSE(left.normal[0], -0.4, 0.02);
    CHECK_CLOSE(right.normal[0], 0.4, 0.02);
    CHECK_CLOSE(length3(left.force), length3(right.force), 0.001); /* the diagonals of the quads differ */
    smooth_free(&m);
}

/* A double-sided smooth sheet has the same depth and normal line from both sides. */
TEST(both_sides_of_a_smooth_sheet_are_one_surface) {
    smooth_mesh m = smooth_make(&smooth_patches[3], 300); /* a cylinder of 40 mm, from inside */
    surface_parts parts = smooth_surface(&m, 1);
    parts.material.stiffness = K;
    parts.desc.double_sided = 1;
    SCOPED_SCENE *scene = scene_of(&parts);
    static const double depths[] = {0.0001, 0.001, 0.003};
    for (int side = -1; side <= 1; side += 2) {
        for (size_t i = 0; i < COUNT_OF(depths); i++) {
            for (double u = -0.6; u < 0.6; u += 0.0137) {
                const double r = 0.04 + side * depths[i], far = 0.04 - side * 0.006;
                configure_plainly(scene, 0);
                (void)tick_at(scene, far * cos(u), far * sin(u), 0.003);
                const knurl_tick_output out = tick_at(scene, r * cos(u), r * sin(u), 0.003);
                CHECK_CLOSE(out.depth, depths[i], 2e-6);
                CHECK_VECTOR(out.normal, -side * cos(u), -side * sin(u), 0.0, 1e-3);
            }
        }
    }
    smooth_free(&m);
}

/* A smooth mesh that is moved and turned gives the same force, turned. */
TEST(a_moved_smooth_mesh_pushes_likewise) {
    smooth_mesh m = smooth_make_sphere(2);
    surface_parts parts = smooth_surface(&m, 1);
    const double half = sqrt(0.5);
    parts.desc.position[0] = 1000.0;
    parts.desc.rotation[2] = parts.desc.rotation[3] = half; /* a quarter turn round z */
    parts.material.stiffness = K;
    knurl_scene *here = scene_with(&m), *there = scene_of(&parts);
    for (int k = 0; k < 500; k++) {
        const double at[3] = {0.0291 * cos(0.01 * k), 0.0291 * sin(0.01 * k), 0.0003 * sin(0.1 * k)};
        const knurl_tick_output a = tick_at(here, at[0], at[1], at[2]);
        const knurl_tick_output b = tick_at(there, 1000.0 - at[1], at[0], at[2]);
        CHECK_VECTOR(b.force, -a.force[1], a.force[0], a.force[2], 1e-8);
        assert_true(k == 0 || length3(a.force) > 0.0);
    }
    knurl_scene_destroy(here);
    knurl_scene_destroy(there);
    smooth_free(&m);
}

/* A rough sheet with any normals, up to 65 degrees off the mean: finite, never a pull, held as by its triangles, and at
 * most the bulge deeper. */
TEST(the_force_is_bounded_with_any_normals) {
    uint64_t seed = 5;
    for (int round = 0; round < 40; round++) {
        const double tilt = 0.03 * round;
        smooth_mesh m = {shape_sheet(12, 12, (const double[2]){0.03, 0.03}, NULL), NULL};
        m.normals = calloc(m.s.vertex_count, 3 * sizeof(float));
        for (uint32_t v = 0; v < m.s.vertex_count; v++) {
            const double a = random_between(&seed, 0.0, 2.0 * SMOOTH_PI), t = random_between(&seed, 0.0, tilt);
            m.s.positions[3 * v + 2] = (float)random_between(&seed, 0.0, 0.003);
            m.normals[3 * v] = (float)(sin(t) * cos(a));
            m.normals[3 * v + 1] = (float)(sin(t) * sin(a));
            m.normals[3 * v + 2] = (float)cos(t);
        }
        surface_parts flat_parts = smooth_surface(&m, 0);
        flat_parts.material.stiffness = K;
        knurl_scene *smooth = scene_with(&m), *flat = scene_of(&flat_parts);
        const double bulge = first_info(smooth).bulge;
        double at[3] = {0.0, 0.0, 0.02}, velocity[3] = {0.0, 0.0, -0.1};
        for (int k = 0; k < 5000; k++) {
            if (k % 25 == 24) {
                random_direction(&seed, velocity);
            }
            for (int i = 0; i < 3; i++) {
                const double low = i == 2 ? -0.002 : -0.025, high = i == 2 ? 0.008 : 0.025;
                at[i] = fmin(high, fmax(low, at[i] + 0.0002 * velocity[i]));
            }
            const knurl_tick_output out = tick_at(smooth, at[0], at[1], at[2]);
            const knurl_tick_output as_is = tick_at(flat, at[0], at[1], at[2]);
            assert_true(isfinite(length3(out.force)) && dot3(out.force, out.normal) >= 0.0);
            assert_true(length3(out.force) <= length3(as_is.force) + K * (bulge + 1e-6));
            assert_true(out.contacts == 0 || as_is.contacts > 0 || out.depth <= bulge + 1e-6);
        }
        knurl_scene_destroy(smooth);
        knurl_scene_destroy(flat);
        smooth_free(&m);
    }
}
