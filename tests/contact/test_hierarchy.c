/* The hierarchy over a mesh's triangles, and its two queries against brute force. SPDX-License-Identifier: MIT */
#include "hierarchy.h"

#include "contact/mesh_query.h"

static double bumps(double x, double y) {
    return 0.003 * sin(200.0 * x) * cos(130.0 * y);
}

TEST(hierarchy_holds_every_triangle_once) {
    static const uint32_t counts[] = {1, 2, 3, 4, 5, 6, 17, 100, 1000};
    for (size_t i = 0; i < COUNT_OF(counts); i++) {
        shape soup = shape_soup(100 + i, counts[i], 0.2);
        const uint64_t sum = sum_of_corners(soup.positions, soup.indices, soup.index_count);
        SCOPED_PROBE p = probe_shape(&soup);
        assert_int_equal(p.mesh->triangle_count, counts[i]);
        assert_true(sum_of_corners(p.mesh->positions, p.mesh->triangles, 3 * (size_t)counts[i]) == sum);
        check_hierarchy(p.mesh);
    }
}

TEST(hierarchy_of_1e5_triangles_is_sound) {
    const double half[2] = {0.1, 0.1};
    SCOPED_PROBE p = probe_of(shape_sheet(250, 200, half, bumps));
    assert_int_equal(p.mesh->triangle_count, 100000);
    check_hierarchy(p.mesh);
}

/* Triangles whose boxes all have the same centre: no plane parts them. */
TEST(hierarchy_of_triangles_with_one_centre_is_sound) {
    const uint32_t count = 20000;
    shape star = shape_new(3 * count, 3 * count, 0);
    for (uint32_t i = 0; i < count; i++) {
        const double r = 1.0 + i % 7;
        shape_set(&star, 3 * i, r, r, r);
        shape_set(&star, 3 * i + 1, -r, -r, -r);
        shape_set(&star, 3 * i + 2, r, -r, i % 2 ? r : -r);
        for (uint32_t k = 0; k < 3; k++) {
            star.indices[3 * i + k] = 3 * i + k;
        }
    }
    SCOPED_PROBE p = probe_shape(&star);
    check_hierarchy(p.mesh);
}

/* Triangles along each axis, each 8 times smaller and nearer than the one before, down to some nanometres: every split
 * can part off few only. */
TEST(hierarchy_of_ever_smaller_triangles_keeps_its_depth) {
    const uint32_t levels = 50;
    shape tail = shape_new(9 * levels, 9 * levels, 0);
    for (uint32_t i = 0; i < 3 * levels; i++) {
        const double size = ldexp(1.0, 120 - 3 * (int)(i / 3));
        double corners[3][3] = {{0.0}};
        for (uint32_t k = 0; k < 3; k++) {
            corners[k][i % 3] = k == 1 ? 1.25 * size : size;
            corners[k][(i + 1) % 3] = k == 2 ? 1e-3 * size : 0.0;
            shape_set(&tail, 3 * i + k, corners[k][0], corners[k][1], corners[k][2]);
            tail.indices[3 * i + k] = 3 * i + k;
        }
    }
    SCOPED_PROBE p = probe_shape(&tail);
    assert_int_equal(p.mesh->triangle_count, 3 * levels);
    check_hierarchy(p.mesh);
}

/* Flat except for rounding errors: extents whose inverse overflows a float. */
TEST(hierarchy_of_subnormal_noise_is_sound) {
    shape sheet = shape_sheet(20, 20, (const double[2]){0.05, 0.05}, NULL);
    uint64_t seed = 1;
    for (uint32_t v = 0; v < sheet.vertex_count; v++) {
        sheet.positions[3 * v + 2] = (float)random_between(&seed, -1e-40, 1e-40);
    }
    SCOPED_PROBE p = probe_shape(&sheet);
    check_hierarchy(p.mesh);
    (void)probe_to(&p, 0.01, 0.02, 0.001);
    assert_true(probe_to(&p, 0.01, 0.02, -0.001));
    CHECK_CLOSE(p.contact.z, -0.001, 1e-12);
}

/* The nearest of all triangles, for points in it, at its corners, on it, and outside; with a radius that just holds. */
static void compare_closest(shape *s, uint64_t seed, int points) {
    SCOPED_SHAPE copy = shape_new(s->vertex_count, s->index_count, 0);
    memcpy(copy.positions, s->positions, s->vertex_count * 3 * sizeof(float));
    memcpy(copy.indices, s->indices, s->index_count * sizeof(uint32_t));
    SCOPED_PROBE p = probe_shape(s);
    for (int k = 0; k < points; k++) {
        knurl_contact found;
        double at[3];
        double direction[3];
        shape_get(&copy, (uint32_t)random_integer(&seed, 0, copy.vertex_count - 1), at);
        random_direction(&seed, direction);
        add3(at, k % 5 ? random_between(&seed, 0.0, k % 5 == 1 ? 1.5 : 0.1) : 0.0, direction, at);
        const double expected = shape_distance(&copy, at);
        assert_true(knurl_mesh_closest(p.mesh, at, expected + 1e-9, NULL, NULL, &found));
        CHECK_CLOSE(distance3(found.proxy, at), expected, 1e-9);
        knurl_triangle triangle;
        double again[3] = {0.0, 0.0, 0.0};
        knurl_mesh_triangle(p.mesh, found.triangle, &triangle);
        for (uint32_t i = 0; i < 3; i++) { /* weights and triangle give the same point */
            add3(again, found.weights[i], triangle.corners[i], again);
        }
        CHECK_CLOSE(distance3(again, found.proxy), 0.0, 1e-12);
        CHECK_CLOSE(found.weights[0] + found.weights[1] + found.weights[2], 1.0, 1e-12);
        assert_false(expected > 1e-6 && knurl_mesh_closest(p.mesh, at, expected - 1e-9, NULL, NULL, &found));
    }
}

TEST(closest_point_matches_brute_force) {
    const double half[2] = {1.0, 1.0};
    for (uint64_t i = 0; i < 4; i++) {
        shape soup = shape_soup(200 + i, 150, i < 2 ? 0.05 : 0.5);
        compare_closest(&soup, 210 + i, 2500);
    }
    shape sphere = shape_sphere(1.0, 2);
    compare_closest(&sphere, 220, 1500);
    shape sheet = shape_sheet(10, 10, half, NULL);
    compare_closest(&sheet, 221, 1500);
}

/* The first of all crossings, by brute force; 0 if one is too close to an edge or an end to decide. */
static int first_crossing(const shape *s, const double a[3], const double b[3], int double_sided, crossing *first) {
    first->side = 0;
    first->s = 2.0;
    for (uint32_t i = 0; i < s->index_count / 3; i++) {
        double corners[3][3];
        crossing c;
        shape_corners(s, i, corners);
        if (!cross_triangle((const double (*)[3])corners, a, b, &c) || (c.side < 0 && !double_sided)) {
            continue;
        }
        if (fabs(c.margin) < 1e-5 || c.s < 1e-5 || c.s > 1.0 - 1e-5 || fabs(c.s - first->s) < 1e-9) {
            return 0;
        }
        if (c.margin > 0.0 && c.s < first->s) {
            *first = c;
        }
    }
    return 1;
}

static void compare_cross(uint64_t seed, uint32_t triangles, double size, double stroke) {
    SCOPED_SHAPE copy = shape_soup(seed, triangles, size);
    SCOPED_PROBE p = probe_of(shape_soup(seed, triangles, size));
    int hits = 0;
    for (int k = 0; k < 6000; k++) {
        double a[3];
        double b[3];
        double direction[3];
        crossing expected;
        uint32_t found = UINT32_MAX;
        random_direction(&seed, direction);
        for (int axis = 0; axis < 3; axis++) {
            a[axis] = random_between(&seed, -1.0, 1.0);
        }
        add3(a, stroke, direction, b);
        if (!first_crossing(&copy, a, b, k % 2, &expected)) {
            continue;
        }
        assert_int_equal(knurl_mesh_cross(p.mesh, a, b, k % 2, NULL, NULL, &found), expected.side);
        if (expected.side != 0) {
            knurl_triangle triangle;
            crossing c = {0.0, 0.0, 0};
            knurl_mesh_triangle(p.mesh, found, &triangle);
            assert_true(cross_triangle((const double (*)[3])triangle.corners, a, b, &c));
            CHECK_CLOSE(c.s, expected.s, 1e-9);
            hits++;
        }
    }
    assert_in_range(hits, 200, 6000);
}

TEST(first_crossing_matches_brute_force) {
    compare_cross(301, 200, 0.3, 0.3);
    compare_cross(302, 200, 0.3, 2.0);
    compare_cross(303, 60, 0.5, 1.0);
}

/* Through every edge and corner of a closed body from outside to its middle: between two neighbours there is no gap. */
TEST(no_stroke_slips_between_neighbours) {
    SCOPED_SHAPE copy = shape_sphere(0.03, 3);
    SCOPED_PROBE p = probe_of(shape_sphere(0.03, 3));
    for (uint32_t i = 0; i < copy.index_count; i++) {
        for (int k = 0; k <= 4; k++) { /* along the edge from corner i to the next: at its ends, and between */
            const double middle[3] = {0.0, 0.0, 0.0};
            double from[3];
            double to[3];
            uint32_t found;
            shape_get(&copy, copy.indices[i], from);
            shape_get(&copy, copy.indices[i % 3 == 2 ? i - 2 : i + 1], to);
            add3(to, -1.0, from, to);
            add3(from, 0.25 * k, to, from);
            add3(middle, 1.001, from, from);
            assert_int_equal(knurl_mesh_cross(p.mesh, from, middle, 0, NULL, NULL, &found), 1);
            assert_int_equal(knurl_mesh_cross(p.mesh, middle, from, 0, NULL, NULL, &found), 0);
            assert_int_equal(knurl_mesh_cross(p.mesh, middle, from, 1, NULL, NULL, &found), -1);
        }
    }
}
