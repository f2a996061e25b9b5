/* Rims, gaps and tips of meshes. SPDX-License-Identifier: MIT */
#include "support/probe.h"

#define PI 3.14159265358979323846

TEST(beyond_the_rim_of_an_open_sheet_the_contact_ends) {
    const double half[2] = {0.0625, 0.03125};
    SCOPED_PROBE p = probe_of(shape_sheet(9, 7, half, NULL));
    for (int k = 0; k < 24; k++) { /* out over edges and corners, all round */
        const double to[2] = {half[0] * 1.5 * cos(2.0 * PI * k / 24.0), half[1] * 1.5 * sin(2.0 * PI * k / 24.0)};
        probe_forget(&p);
        (void)probe_to(&p, 0.0, 0.0, 0.001);
        for (int step = 0; step <= 100; step++) {
            const double x = to[0] * step / 100.0;
            const double y = to[1] * step / 100.0;
            const double over = fmax(fabs(x) - half[0], fabs(y) - half[1]);
            assert_int_equal(probe_to(&p, x, y, -0.001), over < 0.0);
        }
        assert_false(probe_to(&p, 0.0, 0.0, -0.001)); /* and back under it: nothing there */
    }
}

TEST(nothing_in_front_of_a_rim_is_in_reach) {
    const double half[2] = {0.0625, 0.03125};
    SCOPED_PROBE p = probe_of(shape_sheet(9, 7, half, NULL));
    p.query.reach = 0.001;
    assert_true(probe_to(&p, 0.0624, 0.0, 0.0005));
    assert_false(probe_to(&p, 0.0626, 0.0, 0.0005));
    assert_false(probe_to(&p, 0.0626, 0.0, 0.0));
}

/* Two sheets that share a border, along which one has eight times as many vertices: rims in the middle of a surface. */
static shape shape_with_t_junctions(void) {
    SCOPED_SHAPE coarse = shape_sheet(4, 4, (const double[2]){0.03125, 0.03125}, NULL);
    SCOPED_SHAPE fine = shape_sheet(8, 32, (const double[2]){0.03125, 0.03125}, NULL);
    shape both = shape_new(coarse.vertex_count + fine.vertex_count, coarse.index_count + fine.index_count, 0);
    for (uint32_t v = 0; v < both.vertex_count; v++) {
        const int left = v < coarse.vertex_count;
        double p[3];
        shape_get(left ? &coarse : &fine, left ? v : v - coarse.vertex_count, p);
        shape_set(&both, v, p[0] + (left ? -0.03125 : 0.03125), p[1], 0.0);
    }
    for (uint32_t i = 0; i < both.index_count; i++) {
        both.indices[i] =
            i < coarse.index_count ? coarse.indices[i] : fine.indices[i - coarse.index_count] + coarse.vertex_count;
    }
    return both;
}

TEST(border_of_t_junctions_is_slid_over) {
    SCOPED_PROBE p = probe_of(shape_with_t_junctions());
    for (int way = -1; way <= 1; way += 2) {
        for (int line = -30; line <= 30; line++) {
            probe_forget(&p);
            (void)probe_to(&p, -0.02 * way, 0.001 * line, 0.001);
            for (int k = -200; k <= 200; k++) {
                assert_true(probe_to(&p, 0.0001 * k * way + 1e-7, 0.001 * line, -0.001));
                CHECK_CLOSE(-p.contact.z, 0.001, 1e-8);
            }
        }
    }
}

/* A tall spike of three faces, one of them cut into many slivers: at its tip the slivers must not outvote the others.
 */
TEST(tip_of_a_spike_is_reached_from_all_round) {
    enum { SLIVERS = 40 };
    shape spike = shape_new(SLIVERS + 4, 3 * (SLIVERS + 3), 0);
    uint32_t at = 0;
    double base[3][3];
    shape_set(&spike, 0, 0.0, 0.0, 0.0);
    for (int k = 0; k < 3; k++) {
        base[k][0] = 0.004 * cos(2.0 * PI * k / 3.0);
        base[k][1] = 0.004 * sin(2.0 * PI * k / 3.0);
        base[k][2] = -0.03;
    }
    for (uint32_t i = 0; i <= SLIVERS; i++) { /* from the first corner of the base to the second */
        const double t = (double)i / SLIVERS;
        shape_set(&spike, i + 1, base[0][0] * (1.0 - t) + base[1][0] * t, base[0][1] * (1.0 - t) + base[1][1] * t,
                  -0.03);
    }
    shape_set(&spike, SLIVERS + 2, base[2][0], base[2][1], -0.03);
    for (uint32_t i = 0; i < SLIVERS; i++, at += 3) {
        memcpy(&spike.indices[at], (const uint32_t[3]){0, i + 1, i + 2}, 3 * sizeof(uint32_t));
    }
    memcpy(&spike.indices[at], (const uint32_t[3]){0, SLIVERS + 1, SLIVERS + 2}, 3 * sizeof(uint32_t));
    memcpy(&spike.indices[at + 3], (const uint32_t[3]){0, SLIVERS + 2, 1}, 3 * sizeof(uint32_t));
    memcpy(&spike.indices[at + 6], (const uint32_t[3]){1, SLIVERS + 2, SLIVERS + 1}, 3 * sizeof(uint32_t));
    SCOPED_PROBE p = probe_shape(&spike);
    p.query.reach = 0.001;
    for (int k = 0; k < 360; k++) { /* as far down as the tip is still the nearest point, all around */
        const double up = 0.14;     /* the faces lean by 0.067, the edges by 0.13 */
        const double hip[3] = {0.0005 * cos(PI * k / 180.0), 0.0005 * sin(PI * k / 180.0), 0.0005 * up};
        const double distance = length3(hip);
        probe_forget(&p);
        assert_true(probe_at(&p, hip));
        CHECK_CLOSE(p.contact.z, distance, 1e-9);
        CHECK_CLOSE(dot3(p.contact.normal, hip), distance, 1e-9);
    }
}

/* The whole disc, and one from which a slice of a degree was cut: its hub is walked round from both sides of the cut.
 */
static void walk_across_hub(uint32_t cut) {
    const uint32_t count = 1000;
    shape disc = shape_new(count + 1, 3 * (count - cut), 0);
    for (uint32_t i = 0; i < count; i++) {
        const double angle = 2.0 * PI * i / count;
        const uint32_t corners[3] = {0, i + 1, (i + 1) % count + 1};
        shape_set(&disc, i + 1, 0.02 * cos(angle), 0.02 * sin(angle), 0.0);
        if (i < count - cut) {
            memcpy(&disc.indices[3 * (size_t)i], corners, sizeof corners);
        }
    }
    SCOPED_PROBE p = probe_shape(&disc);
    for (int turn = 0; turn < 40; turn++) {
        const double angle = 0.1 + turn;
        probe_forget(&p);
        (void)probe_to(&p, 0.01 * cos(angle), 0.01 * sin(angle), 0.001);
        for (int k = 0; k <= 200; k++) {
            const double r = 0.01 - 0.0001 * k;
            assert_true(probe_to(&p, r * cos(angle), r * sin(angle), -0.001));
            CHECK_CLOSE(-p.contact.z, 0.001, 1e-8);
        }
    }
}

TEST(hub_of_very_many_triangles_is_walked_across) {
    walk_across_hub(0);
    walk_across_hub(3);
}
