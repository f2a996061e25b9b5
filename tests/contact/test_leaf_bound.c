/* The lower bound by which most triangles of a leaf are left out of a search: never above the distance, and close below
 * it for triangles that are not needles. SPDX-License-Identifier: MIT */
#include "contact/closest_point.h"
#include "contact/leaf_bound.h"

#include "support/close.h"
#include "support/suite.h"

#include <stdio.h>
#include <string.h>

/* Four triangles of any size and thinness, near one another or not, at up to 10 km from the origin. */
static void make_triangles(uint64_t *seed, float positions[36], double p[3]) {
    const double far = random_integer(seed, 0, 1) ? pow(10.0, random_between(seed, -3.0, 4.0)) : 0.0;
    const double apart = pow(10.0, random_between(seed, -6.0, 1.0));
    double origin[3];
    for (int axis = 0; axis < 3; axis++) {
        origin[axis] = far * random_between(seed, -1.0, 1.0);
        p[axis] = origin[axis] + apart * random_between(seed, -1.0, 1.0);
    }
    for (int t = 0; t < 4; t++) {
        const double size = pow(10.0, random_between(seed, -6.0, -1.0));
        const double thin = pow(10.0, random_between(seed, -6.0, 0.0)), along = random_between(seed, -1.0, 2.0);
        for (int axis = 0; axis < 3; axis++) {
            const double a = origin[axis] + apart * random_between(seed, -1.0, 1.0);
            const double edge = size * random_between(seed, -1.0, 1.0);
            positions[9 * t + axis] = (float)a;
            positions[9 * t + 3 + axis] = (float)(a + edge);
            positions[9 * t + 6 + axis] = (float)(a + along * edge + thin * size * random_between(seed, -1.0, 1.0));
        }
    }
}

/* 2 for one that is not thin, 1 for one that meshes keep (mesh_build.c), else 0. */
static int quality(const knurl_mesh *mesh, uint32_t triangle) {
    double corners[3][3], ab[3], ac[3], bc[3], normal[3];
    knurl_mesh_corners(mesh, triangle, corners);
    vec3_sub(corners[1], corners[0], ab);
    vec3_sub(corners[2], corners[0], ac);
    vec3_sub(corners[2], corners[1], bc);
    vec3_cross(ab, ac, normal);
    const double longest = fmax(fmax(vec3_dot(ab, ab), vec3_dot(ac, ac)), vec3_dot(bc, bc));
    const double share = vec3_dot(normal, normal) / (longest * longest);
    return !(longest >= 1e-18 && share > 1e-12) ? 0 : share < 1e-2 ? 1 : 2;
}

/* Four triangles within KNURL_COORDINATE_MAX (m), and a point as far from them as one in a scene can be in a surface's
 * own frame. */
static void make_largest(uint64_t *seed, float positions[36], double p[3]) {
    const double most = KNURL_COORDINATE_MAX;
    const int64_t is_corner = random_integer(seed, 0, 1);
    for (int i = 0; i < 36; i++) { /* in half of them corners of the cube */
        const double at = random_between(seed, -most, most);
        positions[i] = (float)(is_corner ? copysign(most, at) : at);
    }
    for (int axis = 0; axis < 3; axis++) {
        p[axis] = random_between(seed, -2.0, 2.0) * most;
        p[axis] = random_integer(seed, 0, 1) ? p[axis] : copysign(2.0 * most, p[axis]);
    }
}

typedef void maker(uint64_t *seed, float positions[36], double p[3]);

/* Triangles tested, those of them that are not thin, and those of these whose bound is close. */
typedef struct counts {
    int tested, good, close;
} counts;

static counts compare(maker *make, uint64_t seed, int rounds) {
    float positions[36];
    uint32_t corners[12];
    knurl_mesh mesh;
    counts n = {0, 0, 0};
    memset(&mesh, 0, sizeof mesh);
    mesh.positions = positions;
    mesh.triangles = corners;
    for (uint32_t i = 0; i < 12; i++) {
        corners[i] = i;
    }
    for (int round = 0; round < rounds; round++) {
        double p[3];
        knurl_leaf_point from;
        make(&seed, positions, p);
        knurl_leaf_point_set(p, &from);
        const knurl_float4 bound2 = knurl_leaf_bound2(&mesh, 0, 3, &from);
        for (uint32_t t = 0; t < 4; t++) {
            knurl_closest_point closest;
            const int kind = quality(&mesh, t);
            if (kind > 0) {
                knurl_closest_on_triangle(&mesh, t, p, &closest);
                assert_false((double)bound2[t] > closest.distance2);
                n.tested++;
                n.good += kind == 2;
                n.close += kind == 2 && (double)bound2[t] > 0.998 * closest.distance2;
            }
        }
    }
    return n;
}

TEST(the_bound_holds_at_the_largest_coordinates) {
    assert_true(compare(make_largest, 10, 50000).tested > 100000);
}

TEST(the_bound_is_never_above_the_distance_and_seldom_far_below) {
    const counts n = compare(make_triangles, 9, 200000);
    assert_true(n.tested > 500000);
    printf("leaf bound: %d triangles, %d of them not thin, %d with a close bound\n", n.tested, n.good, n.close);
    assert_true(n.close > 0.9 * n.good); /* not if a point is a thousand times nearer than a triangle is long */
}
