/* Casts against one triangle at a time: the sides that are hit, and the seam beyond the edges.
 * SPDX-License-Identifier: MIT */
#include "support/probe.h"

#include "contact/mesh_cast.h"

/* Every order of corners that keeps the front, and every order of axes that keeps the hand. */
#define WAYS 9

static probe make(const double corners[3][3], int way) {
    shape s = shape_new(3, 3, 0);
    for (int k = 0; k < 3; k++) {
        const double *at = corners[(k + way) % 3];
        shape_set(&s, (uint32_t)k, at[way / 3], at[(way / 3 + 1) % 3], at[(way / 3 + 2) % 3]);
        s.indices[k] = (uint32_t)k;
    }
    return probe_shape(&s);
}

/* From z = ends[0] to ends[1], over (x, y) half way; slant: m along x on each half. */
static int cast(const probe *p, int way, const double xy[2], double slant, const double ends[2], int double_sided,
                knurl_cast_hit *hit) {
    knurl_cast c;
    memset(&c, 0, sizeof c);
    for (int end = 0; end < 2; end++) {
        const double at[3] = {xy[0] + (end ? slant : -slant), xy[1], ends[end]};
        for (int axis = 0; axis < 3; axis++) {
            (end ? c.to : c.from)[axis] = at[(way / 3 + axis) % 3];
        }
    }
    c.double_sided = double_sided;
    return knurl_mesh_cast(p->mesh, &c, hit);
}

static const double plate[3][3] = {{-0.05, -0.04, 0.0}, {0.06, -0.03, 0.0}, {0.01, 0.05, 0.0}};

TEST(a_triangle_reaches_beyond_each_edge_by_the_seam) {
    static const double down[2] = {0.03, -0.02};
    for (int way = 0; way < WAYS; way++) {
        SCOPED_PROBE p = make(plate, way);
        knurl_cast_hit hit;
        for (int edge = 0; edge < 3; edge++) {
            const double *a = plate[edge], *b = plate[(edge + 1) % 3];
            const double length = hypot(b[0] - a[0], b[1] - a[1]);
            for (int step = 1; step < 10; step++) {
                for (int side = -1; side <= 1; side++) {
                    const double off = (side < 0 ? -2.0
                                        : side   ? 1.5
                                                 : 0.5) *
                                       p.mesh->facts.seam / length; /* outwards */
                    const double xy[2] = {a[0] + 0.1 * step * (b[0] - a[0]) + off * (b[1] - a[1]),
                                          a[1] + 0.1 * step * (b[1] - a[1]) - off * (b[0] - a[0])};
                    assert_int_equal(cast(&p, way, xy, 0.0, down, 0, &hit), side < 1);
                    if (side < 1) {
                        CHECK_CLOSE(hit.share, 0.6, 1e-9);
                        CHECK_CLOSE(hit.height, 0.03, 1e-9);
                        assert_int_equal(hit.side, 1);
                    }
                }
            }
        }
    }
}

/* Its edges prolonged meet far beyond its tips. The cast is slanted, so that its box does not exclude the triangle. */
TEST(a_sliver_reaches_beyond_its_tips_by_the_seam_too) {
    static const double sliver[3][3] = {{-0.05, 0.0, 0.0}, {0.05, 0.0, 0.0}, {0.02, 2e-7, 0.0}};
    static const double down[2] = {0.01, -0.01};
    for (int way = 0; way < WAYS; way++) {
        SCOPED_PROBE p = make(sliver, way);
        knurl_cast_hit hit;
        for (int side = -1; side <= 1; side += 2) {
            const double near[2] = {side * (0.05 + 0.5 * p.mesh->facts.seam), 0.0};
            const double beyond[2] = {side * (0.05 + 2.0 * p.mesh->facts.seam), 0.0};
            const double above[2] = {0.02, side * (2e-7 + 2.0 * p.mesh->facts.seam)};
            assert_int_equal(cast(&p, way, near, 0.01, down, 0, &hit), 1);
            assert_int_equal(cast(&p, way, beyond, 0.01, down, 0, &hit), 0);
            assert_int_equal(cast(&p, way, above, 0.01, down, 0, &hit), 0);
        }
    }
}

/* KNURL_CAST_SLACK: a start that rounding put behind the face hits it at once. */
TEST(a_cast_hits_what_it_comes_through_from_the_front_or_from_where_it_stands) {
    static const struct {
        double ends[2];
        int hits, hits_double_sided;
        double share;
    } cases[] = {{{0.02, -0.02}, 1, 1, 0.5},  {{0.01, -0.03}, 1, 1, 0.25},  {{0.02, 0.001}, 0, 0, 0.0},
                 {{-0.02, 0.02}, 0, 1, 0.5},  {{-0.001, -0.02}, 0, 0, 0.0}, {{-1e-9, -0.02}, 1, 1, 0.0},
                 {{-4e-9, -0.02}, 0, 0, 0.0}, {{0.02, 0.0}, 0, 0, 0.0},     {{-0.02, 0.0}, 0, 0, 0.0},
                 {{0.001, 0.02}, 0, 0, 0.0},  {{1e-9, 0.02}, 0, 1, 0.0},    {{-1e-9, -1e-9}, 0, 0, 0.0},
                 {{1e-9, 1e-9}, 0, 0, 0.0}};
    static const double xy[2] = {0.005, 0.0};
    for (int way = 0; way < WAYS; way++) {
        SCOPED_PROBE p = make(plate, way);
        for (size_t i = 0; i < COUNT_OF(cases); i++) {
            for (int both = 0; both < 2; both++) {
                knurl_cast_hit hit;
                const int expected = both ? cases[i].hits_double_sided : cases[i].hits;
                assert_int_equal(cast(&p, way, xy, 0.0, cases[i].ends, both, &hit), expected);
                if (expected) {
                    CHECK_CLOSE(hit.share, cases[i].share, 1e-6);
                    CHECK_CLOSE(hit.height, fabs(cases[i].ends[0]) * (cases[i].share > 0.0 ? 1.0 : -1.0), 1e-9);
                    assert_int_equal(hit.side, cases[i].ends[0] > cases[i].ends[1] ? 1 : -1);
                    CHECK_CLOSE(hit.normal[(5 - way / 3) % 3], hit.side, 1e-12);
                }
            }
        }
    }
}

/* Sheets one above the other, of which a cast meets the first from wherever it comes. */
TEST(the_first_of_several_is_hit) {
    static const double half[2] = {0.05, 0.05};
    static const double xy[2] = {0.013, 0.021};
    for (int order = 0; order < 6; order++) {
        shape s = shape_sheet(1, 1, half, NULL);
        for (int i = 1; i < 3; i++) {
            shape above = shape_sheet(1, 1, half, NULL);
            for (uint32_t v = 0; v < above.vertex_count; v++) {
                above.positions[3 * (size_t)v + 2] = 0.01f * (float)(order & 1 ? i : -i);
            }
            s = shape_join(&s, &above);
        }
        SCOPED_PROBE p = probe_shape(&s);
        const double top = order & 1 ? 0.02 : 0.0;
        const double ends[2] = {top + 0.01 * order + 0.005, -0.05};
        knurl_cast_hit hit;
        assert_int_equal(cast(&p, 0, xy, 0.0, ends, 0, &hit), 1);
        CHECK_CLOSE(hit.point[2], top, 1e-8);
        CHECK_CLOSE(hit.share, (ends[0] - top) / (ends[0] - ends[1]), 1e-6);
    }
}
