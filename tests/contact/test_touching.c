/* Pairs of triangles that touch, and the seam, against distances that a search over all pairs finds.
 * SPDX-License-Identifier: MIT */
#include "contact/oracle.h"
#include "support/probe.h"

#include "contact/mesh_touch.h"

/* Distance between an edge and a triangle: convex along the edge, so that a search by thirds finds it. */
static double edge_distance(const double from[3], const double to[3], const flat *f) {
    double way[3], low = 0.0, high = 1.0, d2[2] = {0.0, 0.0};
    add3(to, -1.0, from, way);
    for (int i = 0; i < 90; i++) {
        for (int k = 0; k < 2; k++) {
            double at[3];
            add3(from, low + (k + 1) * (high - low) / 3.0, way, at);
            d2[k] = flat_distance2(f, at, HUGE_VAL);
        }
        *(d2[0] < d2[1] ? &high : &low) += (d2[0] < d2[1] ? -1.0 : 1.0) * (high - low) / 3.0;
    }
    return sqrt(d2[0]);
}

typedef struct triangle {
    double corners[3][3];
    flat plane;
    int is_closed; /* every edge has exactly one triangle beyond it */
} triangle;

static int same_place(const double a[3], const double b[3]) {
    return distance3(a, b) <= 0.0;
}

/* Counts the corners that two triangles share; shared: those of the last. */
static int count_shared(const triangle *a, const triangle *b, int shared[2]) {
    int count = 0;
    for (int i = 0; i < 9; i++) {
        if (same_place(a->corners[i / 3], b->corners[i % 3])) {
            shared[0] = i / 3;
            shared[1] = i % 3;
            count++;
        }
    }
    return count;
}

/* The least distance of the edges of one triangle, of all or of the one opposite a corner, from the other. */
static double edges_distance(const triangle *a, int opposite, const triangle *b) {
    double least = HUGE_VAL;
    for (int k = 0; k < 3; k++) {
        if (opposite < 0 || opposite == k) {
            least = fmin(least, edge_distance(a->corners[(k + 1) % 3], a->corners[(k + 2) % 3], &b->plane));
        }
    }
    return least;
}

/* 1 if a plane across an axis separates them. */
static int are_apart(const triangle *a, const triangle *b, double seam) {
    int apart = 0;
    for (int axis = 0; axis < 3; axis++) {
        int below = 1, above = 1;
        for (int i = 0; i < 9; i++) {
            below &= a->corners[i / 3][axis] < b->corners[i % 3][axis] - 2.0 * seam;
            above &= a->corners[i / 3][axis] > b->corners[i % 3][axis] + 2.0 * seam;
        }
        apart |= below | above;
    }
    return apart;
}

static int do_touch(const triangle *a, const triangle *b, double seam) {
    int shared[2] = {-1, -1};
    if (are_apart(a, b, seam)) {
        return 0;
    }
    const int count = count_shared(a, b, shared);
    if (count > 1 || (count == 1 && a->is_closed && b->is_closed)) {
        return 0;
    }
    const double distance = fmin(edges_distance(a, shared[0], b), edges_distance(b, shared[1], a));
    assert_true(distance < 0.9 * seam || distance > 1.1 * seam); /* clear to both */
    return distance < seam;
}

/* Compares the count with that of all pairs, and frees the shape. */
static uint32_t check_count(shape *s) {
    SCOPED_PROBE p = probe_shape(s);
    const uint32_t count = p.mesh->triangle_count;
    triangle *all = calloc(count, sizeof *all);
    uint32_t expected = 0;
    assert_non_null(all);
    for (uint32_t i = 0; i < count; i++) {
        knurl_mesh_corners(p.mesh, i, all[i].corners);
        flat_set(&all[i].plane, (const double (*)[3])all[i].corners);
    }
    for (uint32_t i = 0; i < count; i++) {
        int beyond[3] = {0, 0, 0};
        for (uint32_t j = 0; j < count; j++) {
            for (int k = 0; k < 3; k++) {
                int ends = 0;
                for (int corner = 0; corner < 3; corner++) {
                    ends += same_place(all[j].corners[corner], all[i].corners[(k + 1) % 3]) ||
                            same_place(all[j].corners[corner], all[i].corners[(k + 2) % 3]);
                }
                beyond[k] += j != i && ends == 2;
            }
        }
        all[i].is_closed = beyond[0] == 1 && beyond[1] == 1 && beyond[2] == 1;
    }
    for (uint32_t i = 0; i < count; i++) {
        for (uint32_t j = 0; j < i; j++) {
            expected += (uint32_t)do_touch(&all[i], &all[j], p.mesh->facts.seam);
        }
    }
    assert_true(expected < 4 * count); /* below the limit of counting */
    assert_int_equal(knurl_mesh_count_touching(p.mesh), expected);
    assert_int_equal(p.mesh->facts.touching, expected);
    free(all);
    return expected;
}

TEST(triangles_that_intersect_are_counted) {
    uint32_t sum = 0;
    for (uint64_t seed = 1; seed <= 40; seed++) {
        shape soup = shape_soup(seed, 8 + (uint32_t)seed, 0.4);
        sum += check_count(&soup);
    }
    assert_true(sum > 200);
}

/* Few vertices, so that many triangles share one or two of them. */
TEST(triangles_that_meet_at_a_corner_are_counted_if_they_meet_elsewhere_too) {
    uint32_t sum = 0;
    for (uint64_t seed = 1; seed <= 60; seed++) {
        uint64_t bits = seed;
        shape s = shape_soup(seed, 14, 0.5);
        for (uint32_t i = 0; i < s.index_count; i++) {
            s.indices[i] = i % 3 == 0 ? (uint32_t)random_integer(&bits, 0, 11) : i;
        }
        sum += check_count(&s);
    }
    assert_true(sum > 100);
}

TEST(closed_bodies_are_counted_where_they_meet_and_not_by_themselves) {
    shape alone = shape_sphere(1.0, 2);
    assert_int_equal(check_count(&alone), 0);
    for (int i = 0; i < 6; i++) {
        shape a = shape_sphere(1.0, 1), b = shape_sphere(0.7, 1);
        for (uint32_t v = 0; v < b.vertex_count; v++) {
            b.positions[3 * (size_t)v] += 0.31f + 0.2f * (float)i;
            b.positions[3 * (size_t)v + 1] += 0.037f;
        }
        shape both = shape_join(&a, &b);
        assert_true(check_count(&both) > 0);
    }
}

/* A crumpled sheet: closed fans inside, which are passed over, and triangles with one edge on the rim. */
TEST(fans_are_passed_over_but_for_triangles_at_a_rim) {
    static const double half[2] = {1.0, 1.0};
    uint32_t sum = 0;
    for (uint64_t seed = 1; seed <= 40; seed++) {
        uint64_t bits = seed;
        shape s = shape_sheet(5, 4, half, NULL);
        for (uint32_t v = 0; v < s.vertex_count; v++) {
            for (size_t axis = 0; axis < 3; axis++) {
                s.positions[3 * (size_t)v + axis] += (float)random_between(&bits, -0.5, 0.5);
            }
        }
        sum += check_count(&s);
    }
    assert_true(sum > 100);
}

/* One triangle above another, turned and moved along it, at half a seam and at two: faces, edges and corners meet. */
TEST(a_gap_is_touched_across_up_to_the_seam) {
    uint32_t counts[2] = {0, 0};
    for (uint64_t seed = 1; seed <= 400; seed++) {
        uint64_t bits = seed;
        shape s = shape_new(6, 6, 0);
        double corners[2][3][3], middle[2] = {random_between(&bits, -0.7, 0.7), random_between(&bits, -0.7, 0.7)};
        const double rise = random_between(&bits, 0.0, 1.0) < 0.5 ? 0.0 : random_between(&bits, 0.1, 0.5);
        const int lowest = (int)random_integer(&bits, 0, 2);
        for (int k = 0; k < 6; k++) {
            const double turn = random_between(&bits, 0.0, 1.0) + 2.0943951023931953 * (k % 3);
            double *to = corners[k / 3][k % 3];
            to[0] = cos(turn) + (k > 2 ? middle[0] : 0.0);
            to[1] = sin(turn) + (k > 2 ? middle[1] : 0.0);
            to[2] = k > 2 && k % 3 != lowest ? rise : 0.0;
        }
        const int is_far = seed % 2 == 0;
        const double seam =
            KNURL_SEAM_SHARE * 3.0 + 5e-7; /* near enough: boxes of some 3 m, rounding of 2^-22 of 2 m */
        for (uint32_t v = 0; v < 6; v++) {
            const double *at = corners[v / 3][v % 3];
            shape_set(&s, v, at[0], at[1], at[2] + (v > 2 ? (is_far ? 3.0 : 0.3) * seam : 0.0));
            s.indices[v] = v;
        }
        counts[is_far] += check_count(&s);
    }
    assert_true(counts[0] > 100);
}

/* 1e-7 m, or a millionth of the size, and the rounding of positions. */
TEST(the_seam_grows_with_the_size_and_with_the_distance_from_the_origin) {
    static const double sizes[][2] = {{0.01, 0.0}, {0.1, 0.0}, {3.0, 0.0}, {0.1, 50.0}, {5.0, -1000.0}};
    for (size_t i = 0; i < COUNT_OF(sizes); i++) {
        const double half[3] = {sizes[i][0], 0.5 * sizes[i][0], 0.25 * sizes[i][0]};
        shape box = shape_box(half, 0);
        for (uint32_t v = 0; v < box.vertex_count; v++) {
            box.positions[3 * (size_t)v + 1] += (float)sizes[i][1];
        }
        SCOPED_PROBE p = probe_shape(&box);
        const double farthest = fmax(half[0], fabs(sizes[i][1]) + half[1]);
        const double expected = fmax(1e-7, 2e-6 * length3(half)) + farthest / 4194304.0;
        CHECK_CLOSE(p.mesh->facts.seam, expected, 1e-4 * expected);
    }
}
