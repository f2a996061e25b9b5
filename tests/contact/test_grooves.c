/* Square grooves as true geometry, and walls thinner than a tick's distance: a proxy must neither lock nor pass
 * through. SPDX-License-Identifier: MIT */
#include "contact/bodies.h"
#include "support/probe.h"

#include <stdio.h>

static const double speeds[] = {0.049, 0.099, 0.247, 1.37, 2.0}; /* m/s; 1.37: not a whole number of periods a tick */

/* Grooves along y, half a period wide: 80 mm by 40 mm, the ridges' tops at z = 0. */
static shape make_grooves(double period, double depth) {
    const uint32_t periods = (uint32_t)(0.08 / period + 0.5);
    const uint32_t nx = 4 * periods;
    const uint32_t ny = 20;
    shape s = shape_new((nx + 1) * (ny + 1), 6 * nx * ny, 0);
    uint32_t at = 0;
    for (uint32_t j = 0; j <= ny; j++) {
        for (uint32_t i = 0; i <= nx; i++) { /* top, wall, bottom, wall */
            const uint32_t v = j * (nx + 1) + i;
            shape_set(&s, v, -0.04 + period * (i / 4) + (i % 4 ? 0.5 * period * (i % 4 < 3 ? 1 : 2) : 0.0),
                      -0.02 + 0.04 * j / ny, i % 4 < 2 ? 0.0 : -depth);
            if (i < nx && j < ny) {
                at = shape_quad(&s, at, v, v + 1, v + nx + 2, v + nx + 1);
            }
        }
    }
    return s;
}

/* To and fro, 1 mm below the ridges; the proxy may not lag by more than the half period that it cannot see past. */
static double drag(double period, double depth, double speed, double across) {
    SCOPED_PROBE p = probe_of(make_grooves(period, depth));
    double worst = 0.0;
    double x = -0.03;
    double way = 0.001 * speed;
    (void)probe_to(&p, x, 1e-5, 0.001);
    for (int k = 0; k < 3000; k++) {
        way = fabs(x + way) > 0.03 ? -way : way;
        x += way;
        assert_true(probe_to(&p, x, 1e-5 + across * sin(0.01 * k), -0.001));
        assert_true(p.contact.z < 0.0);
        worst = fmax(worst, fabs(p.contact.proxy[0] - x));
    }
    return worst;
}

TEST(proxy_does_not_lock_in_square_grooves) {
    static const double periods[] = {0.001, 0.002};
    const double depth = 0.00025;
    for (size_t i = 0; i < COUNT_OF(periods); i++) {
        for (size_t k = 0; k < COUNT_OF(speeds); k++) {
            const double straight = drag(periods[i], depth, speeds[k], 0.0);
            const double askew = drag(periods[i], depth, speeds[k], 0.01);
            printf("grooves of %.0f mm at %.0f mm/s: lag at most %.3f mm\n", 1e3 * periods[i], 1e3 * speeds[k],
                   1e3 * fmax(straight, askew));
            assert_true(fmax(straight, askew) <= 0.5 * periods[i] + depth);
        }
    }
}

/* Off the middle of a wall and near its rims, straight and askew, 2 mm a tick against 0.5 mm. */
TEST(fast_strokes_do_not_get_through_a_thin_wall) {
    const double half[3] = {0.04, 0.03, 0.00025};
    uint64_t seed = 3;
    SCOPED_PROBE p = probe_of(shape_box(half, 0));
    for (int k = 0; k < 20000; k++) {
        double hip[3];
        double way[3];
        const double front = random_integer(&seed, 0, 1) ? 1.0 : -1.0;
        for (int axis = 0; axis < 2; axis++) {
            hip[axis] = random_between(&seed, -0.9, 0.9) * half[axis];
            way[axis] = random_between(&seed, -0.001, 0.001);
        }
        hip[2] = front * random_between(&seed, 0.0003, 0.0015);
        way[2] = -front * 0.002;
        probe_forget(&p);
        assert_false(probe_at(&p, hip));
        for (int tick = 0; tick < 3; tick++) { /* through it and 5 mm beyond: the front holds along all of it */
            add3(hip, 1.0, way, hip);
            const double depth = half[2] - front * hip[2];
            if (depth > 1e-6) {
                assert_true(probe_at(&p, hip));
                CHECK_CLOSE(-p.contact.z, depth, 1e-8);
                assert_true(p.contact.normal[2] * front > 0.999);
            } else {
                (void)probe_at(&p, hip);
            }
        }
    }
}

/* Two thin fins side by side: a HIP that leaves one in a tick and goes through the next is held by the next. */
TEST(second_wall_behind_a_first_holds_in_the_same_tick) {
    const double half[3] = {0.0002, 0.02, 0.01};
    shape one = shape_box(half, 0);
    shape two = shape_new(16, 72, 0);
    for (uint32_t v = 0; v < 16; v++) {
        double p[3];
        shape_get(&one, v % 8, p);
        shape_set(&two, v, p[0] + (v < 8 ? -0.001 : 0.001), p[1], p[2]);
    }
    for (uint32_t i = 0; i < 72; i++) {
        two.indices[i] = one.indices[i % 36] + (i < 36 ? 0 : 8);
    }
    shape_free(&one);
    SCOPED_PROBE p = probe_shape(&two);
    assert_false(probe_to(&p, 0.0005, 0.001, 0.0)); /* between the fins, pressed into the left one */
    assert_true(probe_to(&p, -0.0009, 0.001, 0.0));
    assert_true(p.contact.normal[0] > 0.999);
    assert_true(probe_to(&p, 0.0030, 0.001, 0.0)); /* across the gap and through the right one in one tick */
    CHECK_CLOSE(p.contact.normal[0], -1.0, 1e-9);
    CHECK_CLOSE(-p.contact.z, 0.0030 - 0.0008, 1e-8);
    assert_true(probe_to(&p, 0.0012, 0.001, 0.0));
    assert_false(probe_to(&p, 0.0, 0.001, 0.0));
}

/* Floors one above another: pressed through the upper one's valley, a HIP is not handed on to the lower one. */
TEST(valley_above_another_floor_keeps_its_hip) {
    shape s = shape_new(12, 24, 0);
    uint32_t at = 0;
    for (uint32_t floor = 0; floor < 2; floor++) {
        for (uint32_t v = 0; v < 6; v++) { /* a V along y, 5 mm deep; 2 mm below it a flat one */
            const double x = -0.01 + 0.01 * (v % 3);
            shape_set(&s, 6 * floor + v, x, v < 3 ? -0.02 : 0.02, floor ? -0.007 : (v % 3 == 1 ? -0.005 : 0.0));
        }
        const uint32_t a = 6 * floor;
        at = shape_quad(&s, at, a, a + 1, a + 4, a + 3);
        at = shape_quad(&s, at, a + 1, a + 2, a + 5, a + 4);
    }
    SCOPED_PROBE p = probe_shape(&s);
    (void)probe_to(&p, 0.0, 0.0, 0.001);
    for (int k = 0; k <= 100; k++) { /* straight down through the bottom of the V, past the floor below */
        assert_true(probe_to(&p, 1e-4, 0.0, -0.0052 - 4e-5 * k));
        assert_true(p.contact.proxy[2] > -0.0051);
    }
    for (int k = 0; k <= 100; k++) { /* and askew, at which the corner's facets face away */
        assert_true(probe_to(&p, 1e-4 + 3e-5 * k, 0.0, -0.0085));
        assert_true(p.contact.proxy[2] > -0.0051);
    }
}
