/* Meshes without normals that are to be smooth: hard edges, reported angles, and the setting. SPDX-License-Identifier:
 * MIT */
#include "scene/ask.h"
#include "scene/smooth.h"

static knurl_surface_info info_as(const shape *s, const float *normals, int32_t smooth) {
    surface_parts parts = surface_mesh(s);
    parts.mesh.normals = normals;
    parts.desc.smooth = smooth;
    SCOPED_SCENE *scene = empty_scene(1);
    return info_of(scene, add_surface(scene, &parts));
}

/* A bar of n sides, 20 mm in radius and length, with flat ends; all vertices are shared. */
static shape make_bar(uint32_t n) {
    shape s = shape_new(2 * n, 6 * n + 6 * (n - 2), 0);
    uint32_t at = 0;
    for (uint32_t i = 0; i < n; i++) {
        const double a = 2.0 * SMOOTH_PI * i / n;
        shape_set(&s, 2 * i, 0.02 * cos(a), 0.02 * sin(a), -0.01);
        shape_set(&s, 2 * i + 1, 0.02 * cos(a), 0.02 * sin(a), 0.01);
        const uint32_t next = (i + 1) % n;
        at = shape_quad(&s, at, 2 * i, 2 * next, 2 * next + 1, 2 * i + 1);
        if (i > 0 && i + 1 < n) {
            const uint32_t ends[6] = {0, 2 * next, 2 * i, 1, 2 * i + 1, 2 * next + 1};
            memcpy(&s.indices[at], ends, sizeof ends);
            at += 6;
        }
    }
    return s;
}

TEST(sides_become_round_from_nine_on_and_ends_keep_their_edges) {
    static const uint32_t sides[] = {3, 4, 6, 8, 9, 10, 12, 16, 64};
    for (size_t k = 0; k < COUNT_OF(sides); k++) {
        const uint32_t n = sides[k];
        const double turn = 2.0 * SMOOTH_PI / n;
        SCOPED_SHAPE s = make_bar(n);
        const knurl_surface_info info = info_as(&s, NULL, KNURL_SMOOTH_ON);
        const int is_round = n >= 9;
        assert_int_equal(info.triangle_count, 4 * n - 4);
        assert_int_equal(info.edges, 6 * n - 6);                     /* three halves of the triangles */
        assert_int_equal(info.hard_edges, is_round ? 2 * n : 3 * n); /* round the ends, and along the sides */
        assert_int_equal(info.curved_triangles, is_round ? 2 * n : 0);
        assert_int_equal(info.bad_normals, 0);
        CHECK_CLOSE(info.facet_angle[1], fmax(SMOOTH_PI / 2.0, turn), 1e-4);
        CHECK_CLOSE(info.felt_angle[1], fmax(SMOOTH_PI / 2.0, is_round ? 0.0 : turn), 1e-4);
        if (is_round) { /* its sides are a cylinder's patches: they bulge by nearly its sagitta */
            CHECK_CLOSE(info.bulge, 4.0 / 3.0 * 0.02 * (1.0 - cos(turn / 2.0)), 0.05 * 0.02 * (1.0 - cos(turn / 2.0)));
        }
    }
}

TEST(angles_at_edges_are_means_by_length) {
    SCOPED_SHAPE s = make_bar(8); /* 16 edges round the ends at 90 degrees, 8 along the sides at 45, diagonals at 0 */
    const knurl_surface_info info = info_as(&s, NULL, KNURL_SMOOTH_AUTO);
    const double side = 2.0 * 0.02 * sin(SMOOTH_PI / 8.0), diagonal = hypot(side, 0.02);
    double ends = 0.0; /* both ends are fans from their first corner, with five diagonals */
    for (int i = 2; i <= 6; i++) {
        ends += 2.0 * 0.04 * sin(i * SMOOTH_PI / 8.0);
    }
    const double length = 16.0 * side + 8.0 * 0.02 + 8.0 * diagonal + ends;
    const double mean = (16.0 * side * SMOOTH_PI / 2.0 + 8.0 * 0.02 * SMOOTH_PI / 4.0) / length;
    CHECK_CLOSE(info.facet_angle[0], mean, 1e-4);
    CHECK_CLOSE(info.felt_angle[0], mean, 1e-4);
}

/* A cone's tip cannot be smooth: its normals would be over 60 degrees off its sides. It stays a tip, and nothing is
 * wrong with the file. */
TEST(a_cones_tip_stays_and_is_no_fault) {
    SCOPED_SHAPE s = shape_new(17, 3 * 16, 0);
    shape_set(&s, 16, 0.0, 0.0, 0.04);
    for (uint32_t i = 0; i < 16; i++) {
        const uint32_t corners[3] = {i, (i + 1) % 16, 16};
        shape_set(&s, i, 0.01 * cos(SMOOTH_PI * i / 8.0), 0.01 * sin(SMOOTH_PI * i / 8.0), 0.0);
        memcpy(&s.indices[3 * i], corners, sizeof corners);
    }
    surface_parts parts = surface_mesh(&s);
    parts.desc.smooth = KNURL_SMOOTH_ON;
    parts.desc.axis[2] = 1.0;
    SCOPED_SCENE *scene = scene_of(&parts);
    assert_int_equal(first_info(scene).bad_normals, 16);
    assert_false(first_check(scene).exceeded & KNURL_LIMIT_NORMALS);
}

TEST(smoothness_is_as_asked_for) {
    smooth_mesh m = smooth_make_sphere(2);
    static const struct {
        int given;
        int32_t smooth;
        uint32_t curved;
    } rows[] = {{0, KNURL_SMOOTH_AUTO, 0},   {0, KNURL_SMOOTH_OFF, 0}, {0, KNURL_SMOOTH_ON, 320},
                {1, KNURL_SMOOTH_AUTO, 320}, {1, KNURL_SMOOTH_OFF, 0}, {1, KNURL_SMOOTH_ON, 320}};
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        const knurl_surface_info info = info_as(&m.s, rows[i].given ? m.normals : NULL, rows[i].smooth);
        assert_int_equal(info.smooth, rows[i].smooth);
        assert_int_equal(info.curved_triangles, rows[i].curved);
        assert_int_equal(info.hard_edges, rows[i].curved ? 0 : 480);
        assert_true(rows[i].curved == 0 || info.felt_angle[0] == 0.0);
    }
    surface_parts parts = smooth_surface(&m, SMOOTH_COMPUTED);
    SCOPED_SCENE *scene = empty_scene(1);
    knurl_surface_id first = add_surface(scene, &parts), second;
    parts.desc.smooth = 3;
    assert_int_equal(knurl_scene_add_surface(scene, &parts.desc, &second), KNURL_ERROR_UNKNOWN);
    assert_string_equal(knurl_error_message(), "smooth: expected one of KNURL_SMOOTH_, found 3");
    parts.desc.smooth = KNURL_SMOOTH_OFF;
    parts.desc.mesh = NULL;
    parts.desc.shape_of = first;
    memset(parts.desc.axis, 0, sizeof parts.desc.axis);
    assert_int_equal(knurl_scene_add_surface(scene, &parts.desc, &second), KNURL_ERROR_ARGUMENT);
    parts.desc.smooth = KNURL_SMOOTH_AUTO;
    assert_int_equal(knurl_scene_add_surface(scene, &parts.desc, &second), KNURL_OK);
    assert_int_equal(info_of(scene, second).smooth, KNURL_SMOOTH_ON);
    smooth_free(&m);
}

/* A flat mesh is a plane, even if it is to be smooth; one whose winding is mixed is smooth after it is turned. */
TEST(computed_normals_come_after_the_other_repairs) {
    shape sheet = shape_sheet(4, 4, (const double[2]){0.02, 0.02}, NULL);
    assert_string_equal(info_as(&sheet, NULL, KNURL_SMOOTH_ON).model, "plane");
    shape_free(&sheet);
    smooth_mesh m = smooth_make_sphere(2);
    const uint32_t second = m.s.indices[1];
    m.s.indices[1] = m.s.indices[2];
    m.s.indices[2] = second;
    const knurl_surface_info info = info_as(&m.s, NULL, KNURL_SMOOTH_ON);
    assert_int_equal(info.turned_triangles, 1);
    assert_int_equal(info.curved_triangles, 320);
    assert_int_equal(info.hard_edges, 0);
    smooth_free(&m);
}
