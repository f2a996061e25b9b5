/* The nearest point of a mesh against the oracle, a million times, and the oracle against brute force.
 * SPDX-License-Identifier: MIT */
#include "contact/moon.h"
#include "contact/oracle.h"
#include "support/probe.h"

#include "contact/mesh_query.h"

/* Double arithmetic on coordinates of 0.1 m: some hundred roundings. */
#define TOLERANCE 1e-14

static int64_t total_queries;
static int total_meshes;
static double total_worst;

/* A point near the mesh, or for one query of sixteen anywhere round it. */
static void random_point(const shape *s, double size, uint64_t *seed, double out[3]) {
    double direction[3];
    random_direction(seed, direction);
    if (random_integer(seed, 0, 15) == 0) {
        for (int axis = 0; axis < 3; axis++) {
            out[axis] = random_between(seed, -size, size);
        }
        return;
    }
    shape_get(s, s->indices[random_integer(seed, 0, s->index_count - 1)], out);
    add3(out, random_between(seed, 0.0, 0.05) * random_between(seed, 0.0, size), direction, out);
}

/* Compares, and frees the shape. */
static void compare(shape *s, const char *name, double size, int64_t queries, uint64_t seed) {
    SCOPED_SHAPE copy = body_copy(s);
    oracle o = oracle_make(&copy);
    SCOPED_PROBE p = probe_shape(s);
    double worst = 0.0;
    for (int64_t k = 0; k < queries; k++) {
        double at[3];
        knurl_contact found;
        random_point(&copy, size, &seed, at);
        const double expected = oracle_distance(&o, at);
        assert_true(knurl_mesh_closest(p.mesh, at, 10.0, NULL, NULL, &found));
        worst = fmax(worst, fabs(distance3(found.proxy, at) - expected));
        assert_false(k % 8 == 0 && expected > 1e-9 &&
                     knurl_mesh_closest(p.mesh, at, expected * (1.0 - 1e-9) - TOLERANCE, NULL, NULL, &found));
    }
    printf("closest point: %-14s %7u triangles, %7lld queries, worst deviation %.2g m\n", name,
           (unsigned)p.mesh->triangle_count, (long long)queries, worst);
    total_queries += queries;
    total_meshes++;
    total_worst = fmax(total_worst, worst);
    assert_true(worst <= TOLERANCE);
    oracle_free(&o);
}

/* KNURL_LONG=10 in the environment makes ten times as many queries. */
static int64_t times(int64_t queries) {
    const char *longer = getenv("KNURL_LONG");
    return queries * (longer ? strtol(longer, NULL, 10) : 1) / (SUITE_SANITIZED ? 10 : 1);
}

TEST(oracle_agrees_with_brute_force) {
    for (uint64_t i = 0; i < 4; i++) {
        uint64_t seed = 1000 + i;
        SCOPED_SHAPE s = i == 0   ? body_wavy(12)
                         : i == 1 ? body_torus(24, 10)
                         : i == 2 ? body_soup(7, 200)
                                  : body_lump(5, 2, 0.1);
        oracle o = oracle_make(&s);
        for (int k = 0; k < 1000; k++) {
            double at[3];
            random_point(&s, 0.1, &seed, at);
            CHECK_CLOSE(oracle_distance(&o, at), shape_distance(&s, at), TOLERANCE);
        }
        oracle_free(&o);
    }
}

TEST(closest_point_is_the_oracles_on_smooth_meshes) {
    shape small = body_wavy(22);
    shape large = body_wavy(224);
    shape sphere = shape_sphere(0.03, 4);
    shape torus = body_torus(60, 24);
    compare(&small, "wavy sheet", 0.1, times(300000), 11);
    compare(&large, "wavy sheet", 0.1, times(50000), 12); /* its memory is beyond the caches: slow */
    compare(&sphere, "sphere", 0.05, times(100000), 13);
    compare(&torus, "torus", 0.05, times(100000), 14);
}

TEST(closest_point_is_the_oracles_on_rough_meshes) {
    shape box = body_box();
    compare(&box, "box", 0.05, times(200000), 15);
    for (uint64_t i = 0; i < 3; i++) {
        shape noise = body_noise(20 + i, 30, i == 2 ? 0.03 : 0.003);
        shape soup = body_soup(30 + i, 500);
        shape lump = body_lump(40 + i, 3, 0.15);
        compare(&noise, "random heights", 0.05, times(25000), 16 + i);
        compare(&soup, "soup", 0.05, times(25000), 26 + i);
        compare(&lump, "lump", 0.05, times(25000), 36 + i);
    }
}

TEST(closest_point_is_the_oracles_on_the_moon) {
    shape moon = body_moon();
    if (moon.index_count == 0) {
        skip();
    }
    compare(&moon, "moon", 0.15, times(50000), 17);
}

static int report(void **state) {
    (void)state;
    printf("closest point: %lld queries on %d meshes, worst deviation %.2g m\n", (long long)total_queries, total_meshes,
           total_worst);
    return 0;
}

SUITE_FIXTURES(NULL, report)
