/* Meshes whose triangles do not hang together as a surface's should: contact that the geometry holds is not lost.
 * SPDX-License-Identifier: MIT */
#include "contact/bodies.h"
#include "contact/oracle.h"
#include "support/probe.h"

static void turn_over(shape *s, uint32_t triangle) {
    const uint32_t a = s->indices[3 * (size_t)triangle];
    s->indices[3 * (size_t)triangle] = s->indices[3 * (size_t)triangle + 1];
    s->indices[3 * (size_t)triangle + 1] = a;
}

/* Strokes over a flat sheet at z = 0, `depth` below it, at all angles through its middle: held at that depth all along.
 */
static void stroke_over(probe *p, double depth) {
    for (int turn = 0; turn < 36; turn++) {
        const double cx = cos(PI * turn / 18.0 + 1e-3), cy = sin(PI * turn / 18.0 + 1e-3);
        probe_forget(p);
        (void)probe_to(p, -0.018 * cx, -0.018 * cy, 0.001);
        for (int k = -180; k <= 180; k++) {
            assert_true(probe_to(p, 1e-4 * k * cx, 1e-4 * k * cy, -depth));
            CHECK_CLOSE(-p->contact.z, depth, 1e-8);
            assert_true(p->contact.normal[2] > 0.999);
        }
    }
}

static const double half[2] = {0.02, 0.02};

/* A fin on an edge in the middle of a sheet, below (way -1) or above, facing either side. */
TEST(three_sheets_on_one_edge_hold_on) {
    for (int way = -1; way <= 1; way += 2) {
        for (int turned = 0; turned < 2; turned++) {
            shape sheet = shape_sheet(8, 8, half, NULL);
            shape fin = shape_sheet(2, 8, half, NULL);
            for (uint32_t v = 0; v < fin.vertex_count; v++) {
                const double y = (double)fin.positions[3 * (size_t)v + 1];
                shape_set(&fin, v, 0.0, y, way * 0.002 * (v % 3));
            }
            for (uint32_t i = 0; turned && i < fin.index_count / 3; i++) {
                turn_over(&fin, i);
            }
            SCOPED_PROBE p = probe_of(shape_join(&sheet, &fin));
            assert_true(p.mesh->non_manifold_count >= 9);
            if (way < 0) {
                stroke_over(&p, 0.001);
            }
            stroke_over(&p, 0.0001);
        }
    }
}

/* The sheet in two halves that touch in one vertex only, and a cone with its tip at that vertex. */
TEST(bow_ties_hold_on) {
    shape sheet = shape_sheet(8, 8, half, NULL);
    shape cone = shape_new(9, 24, 0);
    for (uint32_t i = 0; i < 8; i++) {
        shape_set(&cone, i + 1, 0.001 * cos(PI * i / 4.0), 0.001 * sin(PI * i / 4.0), 0.005);
        const uint32_t corners[3] = {0, i + 1, (i + 1) % 8 + 1};
        memcpy(&cone.indices[3 * (size_t)i], corners, sizeof corners);
    }
    SCOPED_PROBE p = probe_of(shape_join(&sheet, &cone));
    assert_true(p.mesh->non_manifold_count > 0);
    stroke_over(&p, 0.001);
}

TEST(double_layers_hold_across_every_border) {
    for (int32_t front = 1; front >= -1; front -= 2) {
        shape top = shape_sheet(8, 8, half, NULL);
        shape bottom = shape_sheet(8, 8, half, NULL);
        for (uint32_t i = 0; i < bottom.index_count / 3; i++) {
            turn_over(&bottom, i);
        }
        SCOPED_PROBE p = probe_of(shape_join(front > 0 ? &top : &bottom, front > 0 ? &bottom : &top));
        assert_int_equal(p.mesh->facts.reversed_twins, 128);
        p.query.double_sided = p.mesh->double_sided;
        stroke_over(&p, 0.001);
    }
}

/* With any facing of triangles, walking around a vertex reaches all of its triangles, also at the rim. */
TEST(triangles_turned_at_random_hang_together) {
    uint64_t seed = 9;
    shape sheet = shape_sheet(20, 20, half, NULL);
    for (uint32_t i = 0; i < sheet.index_count / 3; i++) {
        if (random_integer(&seed, 0, 1)) {
            turn_over(&sheet, i);
        }
    }
    SCOPED_PROBE p = probe_shape(&sheet);
    assert_int_equal(p.mesh->non_manifold_count, 0);
    assert_int_equal(p.mesh->triangle_count, 800);
}

/* The larger one of two that face opposite ways is the front, in any order. */
TEST(the_larger_area_is_the_front) {
    for (uint32_t small = 0; small < 2; small++) {
        static const double places[4][2] = {{0.0, -0.01}, {0.0, 0.01}, {-0.03, 0.0}, {0.01, 0.0}};
        shape s = shape_new(4, 6, 0);
        for (uint32_t v = 0; v < 4; v++) {
            shape_set(&s, v, places[v][0], places[v][1], 0.0);
        }
        memcpy(&s.indices[small ? 0 : 3], (const uint32_t[3]){0, 1, 2}, 3 * sizeof(uint32_t)); /* faces up */
        memcpy(&s.indices[small ? 3 : 0], (const uint32_t[3]){0, 1, 3}, 3 * sizeof(uint32_t)); /* faces down */
        SCOPED_PROBE p = probe_shape(&s);
        assert_int_equal(p.mesh->facts.turned, 1);
        (void)probe_to(&p, 0.002, 0.0, 0.001);
        assert_true(probe_to(&p, 0.002, 0.0, -0.001));
    }
}

/* A double-sided surface has no inside: a HIP first seen behind it is behind it. */
TEST(first_tick_behind_a_double_sided_sheet_is_behind) {
    shape sheet = shape_sheet(8, 8, half, NULL);
    SCOPED_PROBE p = probe_shape(&sheet);
    p.query.double_sided = 1;
    assert_false(probe_to(&p, 0.001, 0.002, -0.005));
    probe_forget(&p);
    p.query.reach = 0.001;
    assert_true(probe_to(&p, 0.001, 0.002, -0.0007));
    CHECK_CLOSE(p.contact.z, 0.0007, 1e-12);
    assert_true(p.contact.normal[2] < -0.999);
    assert_int_equal(p.state.side, -1);
    probe_forget(&p);
    p.query.double_sided = 0; /* single-sided: pressed in from the start */
    assert_true(probe_to(&p, 0.001, 0.002, -0.005));
    CHECK_CLOSE(-p.contact.z, 0.005, 1e-12);
}

/* Two halves of a sheet, with vertices of their own, whose borders along x = 0 run `gap` m apart; four times as many on
 * the right, so that hardly any meet. */
static shape halves(double gap) {
    shape left = shape_sheet(4, 4, half, NULL);
    shape right = shape_sheet(4, 16, half, NULL);
    for (uint32_t v = 0; v < left.vertex_count; v++) {
        left.positions[3 * (size_t)v] -= (float)(half[0] + 0.5 * gap);
    }
    for (uint32_t v = 0; v < right.vertex_count; v++) {
        right.positions[3 * (size_t)v] += (float)(half[0] + 0.5 * gap);
    }
    return shape_join(&left, &right);
}

/* In by one half and at the end of the tick below the other, at all angles. */
TEST(entering_beside_a_t_junction_and_passing_it_in_one_tick_holds) {
    SCOPED_PROBE p = probe_of(halves(0.0));
    for (int line = -18; line <= 18; line++) {
        for (int k = 1; k <= 60; k++) {
            for (int32_t front = 1; front >= -1; front -= 2) {
                const double y = 0.001 * line + 1e-5;
                const double across = k % 2 ? 0.0001 * k : -0.0001 * k;
                p.query.double_sided = front < 0;
                probe_forget(&p);
                (void)probe_to(&p, -across, y, front * 0.001);
                assert_true(probe_to(&p, across, y + 0.0002, -front * 0.0015));
                CHECK_CLOSE(p.contact.z, -0.0015, 1e-12);
                CHECK_CLOSE(p.contact.normal[2], front, 1e-12);
            }
        }
    }
}

/* A slot of 1 mm, crossed within a tick from inside: in reach on its own side beyond it is in contact, further is not;
 * in the slot itself there is nothing. */
TEST(leaving_a_sheet_across_a_slot_is_in_reach_beyond_it) {
    SCOPED_PROBE p = probe_of(halves(0.001));
    p.query.reach = 0.0005;
    p.query.double_sided = 1;
    for (int32_t side = 1; side >= -1; side -= 2) {
        for (int way = -1; way <= 1; way += 2) {
            for (int k = -2; k <= 12; k++) {
                const double x = way * (0.0001 * k + 0.00005); /* the slot ends at 0.5 mm */
                for (int height = -6; height <= 6; height++) {
                    const double z = 0.0001 * height + 0.00005;
                    probe_forget(&p);
                    (void)probe_to(&p, -0.002 * way, 0.0011, side * 0.0003);
                    assert_true(probe_to(&p, -0.002 * way, 0.0011, -side * 0.0003));
                    const int over_the_slot = k < 5;
                    assert_int_equal(probe_to(&p, x, 0.0031, side * z), !over_the_slot && z <= 0.0005);
                    if (p.state.side != 0) {
                        assert_int_equal(p.state.side, side);
                        CHECK_CLOSE(p.contact.z, z, 1e-12);
                    }
                }
            }
        }
    }
}

/* A plate of 1 mm whose top is cut in two along T-junctions: pressed 3 mm through the plate, over the cut. */
TEST(t_junction_on_a_thin_plate_is_slid_over_however_deep) {
    shape left = shape_sheet(4, 4, half, NULL);
    shape right = shape_sheet(8, 32, half, NULL);
    shape bottom = shape_sheet(3, 3, (const double[2]){0.04, 0.02}, NULL);
    for (uint32_t v = 0; v < left.vertex_count; v++) {
        left.positions[3 * (size_t)v] -= 0.02f;
    }
    for (uint32_t v = 0; v < right.vertex_count; v++) {
        right.positions[3 * (size_t)v] += 0.02f;
    }
    for (uint32_t i = 0; i < bottom.index_count / 3; i++) {
        turn_over(&bottom, i);
    }
    for (uint32_t v = 0; v < bottom.vertex_count; v++) {
        bottom.positions[3 * (size_t)v + 2] = -0.001f;
    }
    shape top = shape_join(&left, &right);
    SCOPED_PROBE p = probe_of(shape_join(&top, &bottom));
    for (int line = -15; line <= 15; line++) {
        for (int way = -1; way <= 1; way += 2) {
            probe_forget(&p);
            (void)probe_to(&p, -0.015 * way, 0.001 * line, 0.001);
            for (int k = -150; k <= 150; k++) {
                assert_true(probe_to(&p, 0.0001 * k * way + 3e-6, 0.001 * line, -0.003));
                CHECK_CLOSE(-p.contact.z, 0.003, 1e-8);
            }
        }
    }
}

/* Anything at all: a HIP that wanders through random triangles, welded in part, many on one edge, some turned over. */
TEST(soup_of_everything_stays_finite_and_on_the_mesh) {
    for (uint64_t i = 0; i < 6; i++) {
        uint64_t seed = 500 + i;
        shape s = body_soup(400 + i, 400);
        for (uint32_t k = 0; k < s.index_count; k++) { /* few vertices, shared at random */
            s.indices[k] = (uint32_t)random_integer(&seed, 0, i < 3 ? 30 : 300);
        }
        SCOPED_SHAPE copy = body_copy(&s);
        SCOPED_PROBE p = probe_shape(&s);
        p.query.double_sided = (int32_t)(i % 2);
        p.query.reach = i % 3 ? 0.0005 : 0.0;
        double hip[3] = {0.0, 0.0, 0.0};
        for (int k = 0; k < 20000; k++) {
            double move[3];
            random_direction(&seed, move);
            add3(hip, k % 7 ? 0.0003 : 0.003, move, hip);
            for (int axis = 0; axis < 3; axis++) {
                hip[axis] = fmax(-0.06, fmin(0.06, hip[axis]));
            }
            if (probe_at(&p, hip)) {
                knurl_triangle t;
                assert_true(p.contact.triangle < p.mesh->triangle_count);
                knurl_mesh_triangle(p.mesh, p.contact.triangle, &t);
                const double *w = p.contact.weights;
                const int is_on_edge = w[0] <= 0.0 || w[1] <= 0.0 || w[2] <= 0.0; /* it may be in front of a fold */
                CHECK_CLOSE(triangle_distance((const double (*)[3])t.corners, p.contact.proxy), 0.0,
                            is_on_edge ? 2.0 * p.mesh->facts.seam : 1e-12);
                assert_true(isfinite(p.contact.z) && fabs(p.contact.z) < 0.3);
            }
        }
    }
}
