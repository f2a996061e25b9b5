/* Contact with a bounded plane, and with a flat mesh, which has to be the same thing.
 * SPDX-License-Identifier: MIT */
#include "support/probe.h"

#define HALF_X 0.0625 /* m; exact as floats, so that a mesh can have the plane's outline */
#define HALF_Y 0.03125

TEST(plane_is_entered_from_the_front) {
    probe p = probe_plane(HALF_X, HALF_Y);
    assert_false(probe_to(&p, 0.01, -0.02, 0.001));
    assert_true(probe_to(&p, 0.01, -0.02, -0.0005));
    CHECK_HELD(&p, 0.01, -0.02, 0.0, 0.0, 0.0, 1.0, 0.0005);
    assert_int_equal(p.contact.triangle, 0);
}

TEST(y_of_a_plane_is_a_quarter_turn_on_from_its_axis) {
    static const double half[2] = {0.1, 0.1}, axis[3] = {0.36, 0.48, 0.8};
    knurl_plane plane;
    knurl_plane_from_rectangle(half, axis, &plane);
    CHECK_CLOSE(plane.x[0], 0.6, 1e-15);
    CHECK_CLOSE(plane.x[1], 0.8, 1e-15);
    CHECK_CLOSE(plane.map[0][0], 0.36, 1e-15); /* metres along the axis, which is not in the plane */
    CHECK_CLOSE(plane.map[0][1], 0.48, 1e-15);
    CHECK_CLOSE(plane.map[1][0], -0.8, 1e-15);
    CHECK_CLOSE(plane.map[1][1], 0.6, 1e-15);
    CHECK_CLOSE(plane.facts.stretch[0][1], 0.6, 1e-15);
    CHECK_CLOSE(plane.facts.stretch[1][1], 1.0, 1e-15);
}

TEST(plane_holds_until_the_hip_is_in_front_again) {
    probe p = probe_plane(HALF_X, HALF_Y);
    (void)probe_to(&p, 0.0, 0.0, 0.001);
    for (int k = 1; k <= 40; k++) { /* in and out again, and sideways */
        const double z = -0.001 * (k <= 20 ? k : 40 - k);
        assert_true(probe_to(&p, 0.001 * k, -0.0005 * k, z));
        CHECK_HELD(&p, 0.001 * k, -0.0005 * k, 0.0, 0.0, 0.0, 1.0, -z);
    }
    assert_false(probe_to(&p, 0.0, 0.0, 1e-8));
}

TEST(plane_is_left_over_its_outline) {
    static const double beyond[4][2] = {{HALF_X, 0.0}, {-HALF_X, 0.0}, {0.0, HALF_Y}, {0.0, -HALF_Y}};
    for (size_t i = 0; i < COUNT_OF(beyond); i++) {
        probe p = probe_plane(HALF_X, HALF_Y);
        const double *edge = beyond[i];
        (void)probe_to(&p, 0.0, 0.0, 0.001);
        assert_true(probe_to(&p, edge[0], edge[1], -0.001)); /* on the outline is on the plane */
        assert_false(probe_to(&p, 1.0001 * edge[0], 1.0001 * edge[1], -0.001));
        assert_false(probe_to(&p, 0.9 * edge[0], 0.9 * edge[1], -0.001)); /* back under it: not from behind */
    }
}

TEST(plane_is_not_touched_from_behind) {
    probe p = probe_plane(HALF_X, HALF_Y);
    p.query.reach = 0.001;
    assert_false(probe_to(&p, 0.0, 0.0, -0.020));
    assert_false(probe_to(&p, 0.0, 0.0, -0.0001));
    assert_false(probe_to(&p, 0.0, 0.0, 0.002));
    assert_true(probe_to(&p, 0.0, 0.0, -0.0001)); /* but from the front it still is */
}

TEST(double_sided_plane_is_touched_from_behind_with_its_normal_turned_round) {
    probe p = probe_plane(HALF_X, HALF_Y);
    p.query.double_sided = 1;
    assert_false(probe_to(&p, 0.01, 0.02, -0.020));
    assert_false(probe_to(&p, 0.01, 0.02, -0.0001));
    assert_true(probe_to(&p, 0.01, 0.02, 0.002));
    CHECK_HELD(&p, 0.01, 0.02, 0.0, 0.0, 0.0, -1.0, 0.002);
    assert_true(probe_to(&p, 0.01, 0.02, 0.001));
    assert_false(probe_to(&p, 0.01, 0.02, -0.001));
    assert_false(probe_to(&p, 0.01, 1.0, -0.001)); /* round the outside to the front */
    assert_false(probe_to(&p, 0.01, 1.0, 0.001));
    assert_false(probe_to(&p, 0.01, 0.02, 0.001));
    assert_true(probe_to(&p, 0.01, 0.02, -0.001));
    CHECK_HELD(&p, 0.01, 0.02, 0.0, 0.0, 0.0, 1.0, 0.001);
}

TEST(plane_is_not_tunnelled_in_one_tick) {
    static const double speeds[] = {0.002, 0.02, 0.2, 2.0}; /* m a tick: 2 m/s and more */
    for (size_t i = 0; i < COUNT_OF(speeds); i++) {
        for (int double_sided = 0; double_sided <= 1; double_sided++) {
            probe p = probe_plane(HALF_X, HALF_Y);
            p.query.double_sided = double_sided;
            assert_false(probe_to(&p, 0.01, 0.01, 0.5 * speeds[i]));
            assert_true(probe_to(&p, 0.02, 0.01, -0.5 * speeds[i]));
            CHECK_HELD(&p, 0.02, 0.01, 0.0, 0.0, 0.0, 1.0, 0.5 * speeds[i]);
        }
    }
}

TEST(plane_is_crossed_where_the_path_meets_it) {
    probe p = probe_plane(HALF_X, HALF_Y);
    (void)probe_to(&p, 2.0 * HALF_X, 0.0, 0.001);
    assert_false(probe_to(&p, 0.5 * HALF_X, 0.0, -0.001)); /* met at 1.25 half extents: in under the edge */
    (void)probe_to(&p, 1.2 * HALF_X, 0.0, 0.001);
    assert_true(probe_to(&p, 0.5 * HALF_X, 0.0, -0.001)); /* met at 0.85 */
    (void)probe_to(&p, 0.0, 0.9 * HALF_Y, 0.001);
    assert_false(probe_to(&p, 0.0, 1.3 * HALF_Y, -0.0001)); /* met inside, and over the edge in the same tick */
}

TEST(plane_slid_under_from_outside_is_never_touched) {
    probe p = probe_plane(HALF_X, HALF_Y);
    p.query.reach = 0.0005;
    for (int k = 0; k <= 200; k++) {
        assert_false(probe_to(&p, 0.1 - 0.001 * k, 0.0, -0.0001));
    }
}

TEST(reach_begins_contact_in_front) {
    probe p = probe_plane(HALF_X, HALF_Y);
    p.query.reach = 0.0005;
    assert_false(probe_to(&p, 0.01, 0.0, 0.000501));
    assert_true(probe_to(&p, 0.01, 0.0, 0.0005));
    CHECK_HELD(&p, 0.01, 0.0, 0.0, 0.0, 0.0, 1.0, -0.0005);
    assert_true(probe_to(&p, 0.01, 0.0, -0.001));
    assert_true(probe_to(&p, 0.01, 0.0, 0.0004));
    assert_false(probe_to(&p, 0.01, 0.0, 0.000501));
    assert_false(probe_to(&p, 0.01, 1.1 * HALF_Y, 0.0001)); /* beside it there is nothing to reach */
}

TEST(reach_counts_behind_a_double_sided_plane) {
    probe p = probe_plane(HALF_X, HALF_Y);
    p.query.reach = 0.0005;
    p.query.double_sided = 1;
    assert_false(probe_to(&p, 0.01, 0.0, -0.020));
    assert_true(probe_to(&p, 0.01, 0.0, -0.0004));
    CHECK_HELD(&p, 0.01, 0.0, 0.0, 0.0, 0.0, -1.0, -0.0004);
    assert_true(probe_to(&p, 0.01, 0.0, 0.0001));
    CHECK_HELD(&p, 0.01, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0001);
}

TEST(first_tick_may_be_pressed_in_up_to_the_capture_depth) {
    shape sheet = shape_sheet(4, 4, (const double[2]){HALF_X, HALF_Y}, NULL);
    probe probes[2] = {probe_plane(HALF_X, HALF_Y), probe_shape(&sheet)};
    for (int i = 0; i < 2; i++) {
        probe *p = &probes[i];
        assert_true(probe_to(p, 0.01, 0.005, -0.999 * KNURL_CAPTURE_DEPTH));
        CHECK_HELD(p, 0.01, 0.005, 0.0, 0.0, 0.0, 1.0, 0.999 * KNURL_CAPTURE_DEPTH);
        assert_true(probe_to(p, 0.01, 0.005, -2.0 * KNURL_CAPTURE_DEPTH)); /* once held, at any depth */
        probe_forget(p);
        assert_false(probe_to(p, 0.01, 0.005, -1.001 * KNURL_CAPTURE_DEPTH));
        assert_false(probe_to(p, 0.01, 0.005, -0.5 * KNURL_CAPTURE_DEPTH)); /* no first tick any more */
        probe_forget(p);
        assert_false(probe_to(p, 1.1 * HALF_X, 0.005, -0.0001)); /* beside it */
    }
    probe_free(&probes[1]);
}

TEST(first_tick_behind_a_double_sided_plane_is_behind_it) {
    probe p = probe_plane(HALF_X, HALF_Y);
    p.query.double_sided = 1;
    assert_false(probe_to(&p, 0.01, 0.005, -0.001)); /* not pressed in from the front: there is no inside */
    assert_false(probe_to(&p, 0.01, 0.005, -0.0005));
    assert_true(probe_to(&p, 0.01, 0.005, 0.0005)); /* pressed in from behind */
    CHECK_HELD(&p, 0.01, 0.005, 0.0, 0.0, 0.0, -1.0, 0.0005);
    p.query.reach = 0.001;
    probe_forget(&p);
    assert_true(probe_to(&p, 0.01, 0.005, -0.0009));
    CHECK_HELD(&p, 0.01, 0.005, 0.0, 0.0, 0.0, -1.0, -0.0009);
    probe_forget(&p);
    assert_false(probe_to(&p, 0.01, 0.005, -0.0011));
}

/* A HIP whose positions are multiples of an encoder's count is exactly on the surface now and then. */
static void check_exact_touchdown(probe *p, int side) {
    p->query.double_sided = side < 0;
    probe_forget(p);
    (void)probe_to(p, 0.0, 0.0, 0.020 * side);
    (void)probe_to(p, 0.01, 0.0, 0.0);
    assert_true(probe_to(p, 0.01, 0.0, -0.001 * side)); /* on through it */
    CHECK_HELD(p, 0.01, 0.0, 0.0, 0.0, 0.0, side, 0.001);
    (void)probe_to(p, 0.01, 0.0, 0.0);
    assert_false(probe_to(p, 0.01, 0.0, 0.001 * side)); /* and off again on the same side */
    (void)probe_to(p, 0.01, 0.0, 0.0);
    assert_false(probe_to(p, 0.01, 0.0, 0.001 * side)); /* touched and lifted */
}

TEST(plane_stopped_at_exactly_is_held_from_the_side_the_hip_came_from) {
    probe p = probe_plane(HALF_X, HALF_Y);
    check_exact_touchdown(&p, 1);
    check_exact_touchdown(&p, -1);
}

TEST(mesh_stopped_at_exactly_is_held_from_the_side_the_hip_came_from) {
    SCOPED_PROBE p = probe_of(shape_sheet(5, 5, (const double[2]){HALF_X, HALF_Y}, NULL));
    check_exact_touchdown(&p, 1);
    check_exact_touchdown(&p, -1);
}

TEST(double_sided_front_stopped_at_exactly_ends_the_contact) {
    shape sheet = shape_sheet(5, 5, (const double[2]){HALF_X, HALF_Y}, NULL);
    probe probes[2] = {probe_plane(HALF_X, HALF_Y), probe_shape(&sheet)};
    for (int i = 0; i < 2; i++) {
        probes[i].query.double_sided = 1;
        (void)probe_to(&probes[i], 0.01, 0.0, 0.020);
        (void)probe_to(&probes[i], 0.01, 0.0, 0.0);
        assert_false(probe_to(&probes[i], 0.01, 0.0, 0.001));
    }
    probe_free(&probes[1]);
}

/* A walk that presses in, lifts off and runs over the edge, of steps up to `step` m. */
static void compare_with_a_flat_mesh(double reach, int double_sided, double step, uint64_t seed) {
    SCOPED_PROBE mesh = probe_of(shape_sheet(12, 7, (const double[2]){HALF_X, HALF_Y}, NULL));
    probe plane = probe_plane(HALF_X, HALF_Y);
    const double range[3] = {1.2 * HALF_X, 1.2 * HALF_Y, 0.004};
    double hip[3] = {0.0, 0.0, 0.004};
    int held_ticks = 0;
    mesh.query.reach = plane.query.reach = reach;
    mesh.query.double_sided = plane.query.double_sided = double_sided;
    for (int k = 0; k < 20000; k++) {
        for (int axis = 0; axis < 3; axis++) {
            const double moved = hip[axis] + random_between(&seed, -step, step);
            hip[axis] = fabs(moved) <= range[axis] ? moved : hip[axis];
        }
        const int held = probe_at(&plane, hip);
        assert_int_equal(probe_at(&mesh, hip), held);
        if (held) {
            const knurl_contact *c = &plane.contact;
            CHECK_HELD(&mesh, c->proxy[0], c->proxy[1], c->proxy[2], c->normal[0], c->normal[1], c->normal[2], -c->z);
            held_ticks++;
        }
    }
    assert_in_range(held_ticks, 2000, 18000);
}

TEST(flat_mesh_equals_a_plane) {
    compare_with_a_flat_mesh(0.0, 0, 0.0005, 1);
    compare_with_a_flat_mesh(0.0007, 0, 0.0005, 2);
    compare_with_a_flat_mesh(0.0007, 0, 0.005, 3);
}

TEST(flat_double_sided_mesh_equals_a_double_sided_plane) {
    compare_with_a_flat_mesh(0.0, 1, 0.0005, 4);
    compare_with_a_flat_mesh(0.0007, 1, 0.0005, 5);
    compare_with_a_flat_mesh(0.0007, 1, 0.005, 6);
}
