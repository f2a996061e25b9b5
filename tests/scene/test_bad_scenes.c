/* Bad geometry end to end: refused surfaces change nothing, dropped triangles are counted, and accepted ones give a
 * finite force. SPDX-License-Identifier: MIT */
#include "scene/ask.h"
#include "support/ledger.h"
#include "support/poses.h"

#define K 400.0 /* N/m, the default */

static double bent(double x, double y) {
    return 5.0 * x * x - 3.0 * x * y;
}

/* A refused surface does not change an existing contact. */
static void check_refused(knurl_scene *scene, surface_parts *bad, const char *word) {
    knurl_surface_id id = 77;
    const uint64_t bytes = knurl_scene_get_bytes(scene);
    CHECK_REFUSED(knurl_scene_add_surface(scene, surface_ready(bad), &id), KNURL_ERROR_ARGUMENT, id);
    check_message(word);
    assert_int_equal(knurl_scene_get_surface_count(scene), 1);
    assert_true(knurl_scene_get_bytes(scene) == bytes);
    CHECK_CLOSE(tick_at(scene, 0.0, 0.0, -0.001).force[2], K * 0.001, 1e-12L);
}

TEST(bad_meshes_are_refused_while_ticks_go_on) {
    ledger books = {0, 0, 0, 0};
    SCOPED_SHAPE s = shape_sheet(3, 3, (const double[2]){0.05, 0.05}, bent);
    surface_parts good = surface_plane();
    knurl_scene *scene = scene_with(&books);
    configure_plainly(scene, 0);
    (void)add_surface(scene, &good);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    (void)tick_at(scene, 0.0, 0.0, 0.01);
    surface_parts bad = surface_mesh(&s);
    bad.mesh.index_count = 0;
    check_refused(scene, &bad, "corners");
    bad.mesh.index_count = (UINT64_C(3) << 26) + 3; /* more than there are: must not be read */
    check_refused(scene, &bad, "3 x 2^26");
    bad.mesh.index_count = UINT64_MAX / 3 * 3;
    check_refused(scene, &bad, "3 x 2^26");
    bad = surface_mesh(&s);
    bad.mesh.vertex_count = (1u << 28) + 1;
    check_refused(scene, &bad, "vertex_count");
    bad.mesh.vertex_count = 0;
    check_refused(scene, &bad, "vertex_count");
    bad = surface_mesh(&s);
    s.positions[3 * 7 + 1] = NAN;
    check_refused(scene, &bad, "vertex 7");
    s.positions[3 * 7 + 1] = -INFINITY;
    check_refused(scene, &bad, "vertex 7");
    s.positions[3 * 7 + 1] = 0.0f;
    s.indices[5] = s.vertex_count;
    check_refused(scene, &bad, "indices[5]");
    for (uint32_t i = 0; i < s.index_count; i++) {
        s.indices[i] = i % 2;
    }
    check_refused(scene, &bad, "area");
    end_with(scene, &books);
}

/* Ticks about a shape, from all over and close to its corners: finite, and at most K times the reported depth. */
static void probe_all_over(knurl_scene *scene, const shape *s, double scale, uint64_t seed) {
    for (int k = 0; k < 4000; k++) {
        double at[3];
        shape_get(s, (uint32_t)random_integer(&seed, 0, s->vertex_count - 1), at);
        for (int i = 0; i < 3; i++) {
            at[i] += random_between(&seed, -0.2, 0.2) * (k % 3 ? scale : 0.01 * scale);
        }
        const knurl_tick_output out = tick_at(scene, at[0], at[1], at[2]);
        assert_true(isfinite(out.force[0]) && isfinite(out.force[1]) && isfinite(out.force[2]));
        assert_true(isfinite(out.depth) && isfinite(out.proxy[0]) && isfinite(length3(out.normal)));
        assert_true(length3(out.force) <= KNURL_CONTACTS_MAX * K * (fmax(0.0, out.depth) + 1e-9) * (1.0 + 1e-9) + 1e-9);
    }
}

/* Coordinates up to the end of their range: refused, or felt with finite forces. */
TEST(coordinates_of_any_size_give_finite_forces) {
    static const double sizes[] = {1e-30, 1e-12, 1e3, 1e6, 1e9};
    for (size_t i = 0; i < COUNT_OF(sizes); i++) {
        SCOPED_SHAPE s = shape_box((const double[3]){sizes[i], sizes[i], sizes[i]}, 0);
        surface_parts parts = surface_along_x(&s);
        SCOPED_SCENE *scene = empty_scene(1);
        knurl_surface_id id = 77;
        configure_plainly(scene, 0);
        const knurl_result result = knurl_scene_add_surface(scene, surface_ready(&parts), &id);
        assert_true(result == KNURL_OK || result == KNURL_ERROR_ARGUMENT);
        if (result == KNURL_OK) {
            assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
            probe_all_over(scene, &s, sizes[i], 5);
            (void)tick_at(scene, 0.0, 0.0, 0.0);
            const knurl_surface_info info = info_of(scene, id);
            assert_true(isfinite(length3(info.anchor)) && isfinite(length3(info.stretch)));
        } else {
            assert_true(strlen(knurl_error_message()) > 10);
        }
    }
}

/* One vertex far away from a small shape, as broken exporters leave it. */
TEST(stray_vertex_far_away_leaves_the_rest_touchable) {
    SCOPED_SHAPE s = shape_sheet(4, 4, (const double[2]){0.05, 0.05}, bent);
    shape_set(&s, 0, 1e9, 0.0, 0.0); /* a corner: two triangles go there */
    surface_parts parts = surface_along_x(&s);
    SCOPED_SCENE *scene = scene_of(&parts);
    const double z = bent(0.03125, 0.03125); /* inside a triangle far from the stray one; near its facet */
    (void)tick_at(scene, 0.03, 0.03, z + 0.02);
    const knurl_tick_output out = tick_at(scene, 0.03, 0.03, z - 0.002);
    assert_int_equal(out.contacts, 1);
    assert_true(out.depth > 0.0005 && out.depth < 0.004);
    probe_all_over(scene, &s, 0.05, 6);
}

/* --- dropped triangles are counted --- */

/* The sheet's triangles once more: in the same winding, starting at another corner, or reversed. */
static shape twice(int reversed, int apart) {
    shape s = shape_sheet(4, 4, (const double[2]){0.05, 0.05}, bent);
    shape d = shape_new(s.vertex_count, 2 * s.index_count, 0);
    memcpy(d.positions, s.positions, s.vertex_count * 3 * sizeof(float));
    memcpy(d.indices, s.indices, s.index_count * sizeof *s.indices);
    for (uint32_t i = 0; i < s.index_count; i += 3) {
        for (uint32_t k = 0; k < 3; k++) {
            d.indices[s.index_count + i + k] = s.indices[i + (reversed ? 2 - k : (k + 1) % 3)];
        }
    }
    shape_free(&s);
    if (apart) { /* vertices of their own for each, as files have them */
        shape_unweld(&d);
    }
    return d;
}

TEST(duplicates_are_left_out_and_reversed_twins_make_one_sheet_that_is_touched_from_both_sides) {
    for (int i = 0; i < 4; i++) {
        const int reversed = i / 2;
        SCOPED_SHAPE s = twice(reversed, i % 2);
        surface_parts parts = surface_along_x(&s);
        SCOPED_SCENE *scene = scene_of(&parts);
        const knurl_surface_info info = first_info(scene);
        assert_int_equal(info.triangle_count, 32);
        assert_int_equal(info.dropped_triangles, reversed ? 0 : 32);
        assert_int_equal(info.reversed_twins, reversed ? 32 : 0);
        assert_int_equal(info.double_sided, reversed);
        if (!reversed) {
            probe_all_over(scene, &s, 0.05, 7);
            continue;
        }
        (void)tick_at(scene, 0.0, 0.0, 0.03);
        assert_true(tick_at(scene, 0.0, 0.0, -0.001).force[2] > 0.9 * K * 0.001);
        (void)tick_at(scene, 0.2, 0.0, 0.0);
        (void)tick_at(scene, 0.0, 0.0, -0.03);
        assert_true(tick_at(scene, 0.0, 0.0, 0.001).force[2] < -0.9 * K * 0.001);
    }
}

/* --- a heap of anything --- */

typedef struct whole {
    int32_t corner[3]; /* grid points; starting at the smallest, so that equal triangles are equal numbers */
} whole;

static whole whole_of(const int32_t p[3]) {
    const int first = p[0] <= p[1] && p[0] <= p[2] ? 0 : p[1] <= p[2] ? 1 : 2;
    const whole t = {{p[first], p[(first + 1) % 3], p[(first + 2) % 3]}};
    return t;
}

static void grid_point(int32_t number, double out[3]) { /* 4 x 4 x 4 points, 1/64 m apart: floats, exactly */
    out[0] = (number % 4) / 64.0;
    out[1] = (double)(number / 4 % 4) / 64.0;
    out[2] = (double)(number / 16 % 4) / 64.0;
}

static int has_area(const whole *t) {
    double p[3][3];
    double a[3];
    double b[3];
    double n[3];
    for (int k = 0; k < 3; k++) {
        grid_point(t->corner[k], p[k]);
    }
    add3(p[1], -1.0, p[0], a);
    add3(p[2], -1.0, p[0], b);
    cross3(a, b, n);
    return dot3(n, n) > 0.0; /* exact */
}

static int find_whole(const whole *list, uint32_t count, int32_t a, int32_t b, int32_t c) {
    const whole t = whole_of((const int32_t[3]){a, b, c});
    for (uint32_t i = 0; i < count; i++) {
        if (memcmp(&list[i], &t, sizeof t) == 0) {
            return 1;
        }
    }
    return 0;
}

/* Triangles between random points of a small grid: flat ones, twins, edges of many triangles, all through each other.
 * Of several between the same corners the first is kept; counted by comparing all with all. */
TEST(heaps_of_random_triangles_are_sorted_out_and_survived) {
    enum { TRIANGLES = 400 };
    for (uint64_t seed = 1; seed <= 20; seed++) {
        static whole kept[TRIANGLES];
        uint64_t draws = seed;
        uint32_t count = 0;
        uint32_t dropped = 0;
        uint32_t twins = 0;
        SCOPED_SHAPE s = shape_new(3 * TRIANGLES, 3 * TRIANGLES, 0);
        const int32_t points = (int32_t)random_integer(&draws, 4, 60);
        for (uint32_t i = 0; i < TRIANGLES; i++) {
            int32_t p[3];
            for (uint32_t k = 0; k < 3; k++) {
                double at[3];
                p[k] = (int32_t)random_integer(&draws, 0, points);
                grid_point(p[k], at);
                shape_set(&s, 3 * i + k, at[0], at[1], at[2]);
                s.indices[3 * i + k] = 3 * i + k;
            }
            const whole t = whole_of(p);
            if (!has_area(&t) || find_whole(kept, count, p[0], p[1], p[2])) {
                dropped++;
            } else if (find_whole(kept, count, p[2], p[1], p[0])) {
                twins++;
            } else {
                kept[count++] = t;
            }
        }
        surface_parts parts = surface_mesh(&s);
        parts.desc.axis[0] = 0.3;
        parts.desc.axis[1] = 0.9;
        parts.desc.axis[2] = 0.2;
        parts.desc.double_sided = seed % 2 == 0;
        SCOPED_SCENE *scene = scene_of(&parts);
        const knurl_surface_info info = first_info(scene);
        assert_int_equal(info.triangle_count, count);
        assert_int_equal(info.reversed_twins, twins);
        assert_int_equal(info.dropped_triangles, dropped);
        probe_all_over(scene, &s, 0.06, seed);
    }
}

/* Pages of a book: many sheets share one edge. Along it the HIP is held or not, and nothing breaks. */
TEST(edges_of_many_triangles_are_survived) {
    enum { PAGES = 40 };
    SCOPED_SHAPE s = shape_new(2 + 2 * PAGES, 6 * PAGES, 0);
    uint32_t at = 0;
    shape_set(&s, 0, 0.0, -0.05, 0.0);
    shape_set(&s, 1, 0.0, 0.05, 0.0);
    for (uint32_t i = 0; i < PAGES; i++) {
        const double angle = 0.157 * i;
        shape_set(&s, 2 + 2 * i, 0.05 * cos(angle), -0.05, 0.05 * sin(angle));
        shape_set(&s, 3 + 2 * i, 0.05 * cos(angle), 0.05, 0.05 * sin(angle));
        at = shape_quad(&s, at, 0, 2 + 2 * i, 3 + 2 * i, 1);
    }
    surface_parts parts = surface_mesh(&s);
    parts.desc.axis[1] = 1.0;
    parts.material.friction = 0.5;
    SCOPED_SCENE *scene = scene_of(&parts);
    uint64_t seed = 2;
    for (int k = 0; k < 5000; k++) {
        const knurl_tick_output out = tick_at(scene, random_between(&seed, -0.002, 0.002),
                                              random_between(&seed, -0.06, 0.06), random_between(&seed, -0.002, 0.002));
        assert_true(isfinite(length3(out.force)) && length3(out.force) <= KNURL_CONTACTS_MAX * K * 0.1);
    }
}
