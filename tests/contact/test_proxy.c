/* The proxy on meshes: a pressed HIP is held, one that has left is free, and normal and depth are the shape's.
 * SPDX-License-Identifier: MIT */
#include "contact/bodies.h"
#include "support/probe.h"

/* The depth of a sphere's facets below it, and the distance of their edges from the foot of their normals. */
static void measure_facets(const shape *s, double radius, double *sagitta, double *half_width) {
    *sagitta = *half_width = 0.0;
    for (uint32_t i = 0; i < s->index_count / 3; i++) {
        double corners[3][3];
        double normal[3];
        shape_corners(s, i, corners);
        (void)normal3((const double (*)[3])corners, normal);
        const double height = dot3(corners[0], normal);
        *sagitta = fmax(*sagitta, radius - height);
        for (int k = 0; k < 3; k++) {
            *half_width = fmax(*half_width, sqrt(fmax(0.0, dot3(corners[k], corners[k]) - height * height)));
        }
    }
}

TEST(hip_orbiting_inside_a_sphere_is_held_at_its_depth) {
    const double radius = 0.03;
    const double depth = 0.001;
    double sagitta;
    double half_width;
    shape sphere = shape_sphere(radius, 4);
    measure_facets(&sphere, radius, &sagitta, &half_width);
    assert_int_equal(sphere.index_count / 3, 5120);
    assert_true(sagitta > 1e-6 && sagitta < 5e-5);
    /* a HIP inside is held by a facet until its foot passes the facet's edge */
    const double angle = atan2(half_width, radius - sagitta - depth) + 1e-6;
    SCOPED_PROBE p = probe_shape(&sphere);
    assert_false(probe_to(&p, 0.0, 0.0, radius + 0.001));
    for (int k = 0; k < 100000; k++) { /* a spiral of 100 turns over the whole ball: 0.19 m/s and less */
        const double turn = 2.0 * PI * k / 1000.0;
        const double tilt = PI * k / 100000.0;
        const double out[3] = {sin(tilt) * cos(turn), sin(tilt) * sin(turn), cos(tilt)};
        assert_true(probe_to(&p, (radius - depth) * out[0], (radius - depth) * out[1], (radius - depth) * out[2]));
        CHECK_CLOSE(p.contact.z, -depth, sagitta + 1e-8);
        assert_true(dot3(p.contact.normal, out) >= cos(angle));
        CHECK_CLOSE(distance3(p.contact.proxy, p.query.hip), -p.contact.z, 1e-12);
    }
    assert_false(probe_to(&p, 0.0, 0.0, -radius - 0.001));
}

TEST(hip_pressed_through_a_thin_wall_is_held_at_its_front) {
    const double half[3] = {0.04, 0.03, 0.0005};
    shape wall = shape_box(half, 0);
    SCOPED_PROBE p = probe_shape(&wall);
    assert_false(probe_to(&p, 0.01, 0.0, 0.002));
    for (int k = 0; k <= 100; k++) { /* to 3 mm below the front of 1 mm, and sideways all the while */
        const double depth = 3e-5 * k + 1e-6;
        assert_true(probe_to(&p, 0.01 + 1e-4 * k, -1e-4 * k, half[2] - depth));
        CHECK_HELD(&p, 0.01 + 1e-4 * k, -1e-4 * k, (double)(float)half[2], 0.0, 0.0, 1.0,
                   depth + ((double)(float)half[2] - half[2]));
    }
    assert_true(probe_to(&p, 0.02, 0.0, -half[2])); /* back through the rear face: nothing of it is felt */
    assert_true(probe_to(&p, 0.02, 0.0, 0.0));
    CHECK_HELD(&p, 0.02, 0.0, (double)(float)half[2], 0.0, 0.0, 1.0, (double)(float)half[2]);
    assert_false(probe_to(&p, 0.02, 0.0, 0.001));
    assert_true(probe_to(&p, 0.02, 0.0, -0.003)); /* struck through in one tick: held at the front as well */
    assert_true(p.contact.normal[2] > 0.999);
    assert_false(probe_to(&p, 0.02, 0.0, 0.001)); /* and off again in one tick, past both faces */
    assert_false(probe_to(&p, 0.02, 0.0, 0.002));
}

/* The next position of a walk: random, but outwards if the contact is deeper than `depth`, as a hand is pushed
 * (the proxy stays at the wall it was pressed into, so without a force it could be led through the body). */
static void next_place(const probe *p, int held, double depth, double step, const double drift[3], uint64_t *seed,
                       double to[3]) {
    double move[3];
    random_direction(seed, move);
    add3(move, 0.7, drift, move);
    add3(p->query.hip, step * random_between(seed, 0.0, 0.58), move, to);
    if (held && p->contact.z < -depth) {
        add3(p->query.hip, step, p->contact.normal, to);
    }
}

/* A walk near a shape, up to `height` outside and pressed `depth` in, steps up to `step`. In every tick contact must
 * agree with the sign of the distance, unless that is within `bound` of 0. A distance of HUGE_VAL: keep out. */
static void walk_near(probe *p, double (*distance)(const double[3]), const double start[3], double depth, double height,
                      double step, double bound, int ticks, uint64_t seed) {
    double drift[3];
    int held = 0;
    int inside_ticks = 0;
    probe_forget(p);
    (void)probe_at(p, start);
    random_direction(&seed, drift);
    for (int k = 0; k < ticks; k++) {
        double to[3];
        next_place(p, held, depth, step, drift, &seed, to);
        const double d = distance(to);
        if (d > height) {
            random_direction(&seed, drift);
            continue;
        }
        held = probe_at(p, to);
        const int inside = held && p->contact.z < 0.0;
        inside_ticks += inside;
        if (fabs(d) > bound && inside != (d < 0.0)) {
            print_error("tick %d of seed %d at %.9g %.9g %.9g: distance %.3g, but %s\n", k, (int)seed, to[0], to[1],
                        to[2], d, inside ? "held" : "free");
            fail();
        }
    }
    assert_in_range(inside_ticks, ticks / 20, ticks);
}

static const double box_half[3] = {0.020, 0.015, 0.010};

static double near_box(const double p[3]) {
    return box_distance(box_half, p);
}

static double near_room(const double p[3]) {
    return -box_distance(box_half, p);
}

static void check_box(int inside_out, double (*near)(const double p[3]), double z, uint64_t seed) {
    static const double steps[] = {0.0001, 0.0005, 0.002}; /* to 2 m/s at 1 kHz */
    const double start[3] = {0.0, 0.0, z};
    SCOPED_PROBE p = probe_of(shape_box(box_half, inside_out));
    for (size_t i = 0; i < COUNT_OF(steps); i++) {
        walk_near(&p, near, start, 0.003, 0.001, steps[i], 1e-8, 100000, seed + i);
    }
}

TEST(box_holds_what_is_inside_and_nothing_else) {
    check_box(0, near_box, 0.011, 21);
}

TEST(corners_of_a_room_hold) {
    check_box(1, near_room, 0.0095, 31);
}

TEST(hip_sliding_round_an_edge_is_held_all_the_way) {
    SCOPED_PROBE p = probe_of(shape_box(box_half, 0));
    const double depth = 0.001;
    (void)probe_to(&p, 0.0, 0.0, 0.011);
    for (int k = 0; k <= 1900; k++) { /* along the top, 1 mm deep */
        assert_true(probe_to(&p, 1e-5 * k, 0.0, box_half[2] - depth));
        CHECK_CLOSE(-p.contact.z, depth, 1e-8);
    }
    for (int k = 0; k <= 1800; k++) { /* and down the side, 1 mm deep */
        assert_true(probe_to(&p, box_half[0] - depth, 0.0, box_half[2] - depth - 1e-5 * k));
        assert_true(-p.contact.z >= depth - 1e-8);
    }
}

TEST(hip_pressed_in_over_an_edge_is_held_by_the_nearer_face) {
    SCOPED_PROBE p = probe_of(shape_box(box_half, 0));
    for (int k = 1; k <= 50; k++) {
        const double in[2] = {1e-5 * k, 2e-5 * (51 - k)};
        (void)probe_to(&p, box_half[0] + in[0], 0.0, box_half[2] + in[1]);
        assert_true(probe_to(&p, box_half[0] - in[0], 0.0, box_half[2] - in[1]));
        assert_true(-p.contact.z >= fmin(in[0], in[1]) - 1e-8 && -p.contact.z <= fmax(in[0], in[1]) + 1e-8);
        assert_false(probe_to(&p, box_half[0] + in[0], 0.0, box_half[2] + in[1]));
    }
}

TEST(distance_in_front_of_a_box_is_the_boxs) {
    const double reach = 0.0008;
    SCOPED_PROBE p = probe_of(shape_box(box_half, 0));
    p.query.reach = reach;
    uint64_t seed = 5;
    int near = 0;
    for (int k = 0; k < 20000; k++) {
        double hip[3];
        probe_forget(&p);
        for (int axis = 0; axis < 3; axis++) { /* faces, edges and corners */
            const double half = box_half[axis] + reach;
            hip[axis] = random_integer(&seed, 0, 1)
                            ? random_between(&seed, -half, half)
                            : (random_integer(&seed, 0, 1) ? -1.0 : 1.0) * random_between(&seed, box_half[axis], half);
        }
        const double d = near_box(hip);
        if (d < 1e-6 || fabs(d - reach) < 1e-8) {
            continue;
        }
        assert_int_equal(probe_at(&p, hip), d < reach);
        if (d < reach) {
            near++;
            CHECK_CLOSE(p.contact.z, d, 1e-8);
            double back[3];
            add3(hip, -p.contact.z, p.contact.normal, back);
            CHECK_CLOSE(distance3(back, p.contact.proxy), 0.0, 1e-12);
        }
    }
    assert_in_range(near, 5000, 20000);
}

/* body_torus() without its facets. */
static double near_ring(const double p[3]) {
    const double across = sqrt(p[0] * p[0] + p[1] * p[1]) - 0.030;
    return sqrt(across * across + p[2] * p[2]) - 0.008;
}

TEST(ring_holds_what_is_inside_but_for_its_facets) {
    static const double steps[] = {0.0001, 0.0005, 0.002};
    const double start[3] = {0.030, 0.0, 0.0085};
    const uint32_t around = 240;
    const uint32_t tube = 80;
    const double sagitta = 0.038 * (1.0 - cos(PI / around)) + 0.008 * (1.0 - cos(PI / tube)) + 1e-8;
    SCOPED_PROBE p = probe_of(body_torus(around, tube));
    for (size_t i = 0; i < COUNT_OF(steps); i++) {
        walk_near(&p, near_ring, start, 0.003, 0.001, steps[i], sagitta, 100000, 41 + i);
    }
}

/* A V of two planes at right angles; solid below. */
static double near_groove(const double p[3]) {
    const int on_sheet = fabs(p[0]) < 0.01 && fabs(p[1]) < 0.4;
    return on_sheet ? (p[2] - fabs(p[0])) * sqrt(0.5) : HUGE_VAL;
}

static double groove_height(double x, double y) {
    (void)y;
    return fabs(x);
}

TEST(groove_holds_at_its_bottom) {
    static const double steps[] = {0.0001, 0.0005, 0.002};
    const double half[2] = {0.0625, 0.5};
    const double start[3] = {0.0, 0.0, 0.001};
    SCOPED_PROBE p = probe_of(shape_sheet(50, 50, half, groove_height));
    for (size_t i = 0; i < COUNT_OF(steps); i++) {
        walk_near(&p, near_groove, start, 0.002, 0.0007, steps[i], 1e-8, 20000, 51 + i);
    }
}

/* The same walk over two meshes of the same triangles. */
static void compare_on_walk(probe *a, probe *b, double (*distance)(const double[3]), const double start[3],
                            uint64_t seed) {
    const double still[3] = {0.0, 0.0, 0.0};
    int held = probe_at(a, start);
    int held_ticks = 0;
    assert_int_equal(probe_at(b, start), held);
    for (int k = 0; k < 20000; k++) {
        double to[3];
        next_place(a, held, 0.002, 0.0005, still, &seed, to);
        if (distance(to) > 0.001) {
            continue;
        }
        held = probe_at(a, to);
        held_ticks += held;
        assert_int_equal(probe_at(b, to), held);
        if (held) {
            CHECK_CLOSE(b->contact.z, a->contact.z, 1e-12);
            CHECK_CLOSE(distance3(b->contact.proxy, a->contact.proxy), 0.0, 1e-12);
            CHECK_CLOSE(distance3(b->contact.normal, a->contact.normal), 0.0, 1e-9);
        }
    }
    assert_in_range(held_ticks, 2000, 20000);
}

TEST(seams_of_doubled_vertices_do_not_end_the_contact) {
    const double start[3] = {0.030, 0.0, 0.0085};
    shape welded = body_torus(60, 20);
    shape apart = body_torus(60, 20);
    shape_unweld(&apart);
    assert_int_equal(apart.vertex_count, 6 * welded.vertex_count);
    SCOPED_PROBE a = probe_shape(&welded);
    SCOPED_PROBE b = probe_shape(&apart);
    compare_on_walk(&a, &b, near_ring, start, 71);
}

TEST(curved_double_sided_sheet_holds_on_both_sides) {
    const double half[2] = {0.0625, 0.0625};
    SCOPED_PROBE p = probe_of(shape_sheet(50, 50, half, groove_height));
    p.query.double_sided = 1;
    for (int side = -1; side <= 1; side += 2) {
        probe_forget(&p);
        assert_false(probe_to(&p, -0.02, 0.0, 0.02 + 0.020 * side));
        for (int k = 0; k <= 400; k++) { /* across the bottom of the V, 1 mm through it */
            const double x = -0.02 + 0.0001 * k;
            const double z = fabs(x) - 0.001 * sqrt(2.0) * side;
            assert_true(probe_to(&p, x, 0.0003, z));
            assert_true(p.contact.z < 0.0);
            assert_true(p.contact.normal[2] * side > 0.0);
            if (side > 0 ? fabs(x) > 0.001
                         : x < 0.0) { /* otherwise the V's edge holds it, or still the wall that it came along */
                CHECK_CLOSE(-p.contact.z, 0.001, 1e-8);
            }
        }
        assert_false(probe_to(&p, 0.02, 0.0, 0.02 + 0.001 * side));
    }
}
