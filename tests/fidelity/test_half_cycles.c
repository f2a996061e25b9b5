/* No half cycle is lost at any speed, with any tessellation: gratings of 1, 2 and 4 mm at 49, 99 and 247 mm/s, 16
 * start phases, through the whole tick. SPDX-License-Identifier: MIT */
#include "support/close.h"

#include "half_cycles.h"

static const double periods[] = {0.001, 0.002, 0.004};
static const double speeds[] = {0.049, 0.099, 0.247};

#define CELLS (COUNT_OF(periods) * COUNT_OF(speeds))
#define STEP  (SUITE_SANITIZED ? 4 : 1) /* through the cells */

static half_cycles measured(int surface, const wavy_sheet *sheet, size_t cell) {
    half_cycles h;
    const int failed =
        half_cycles_measure(surface, sheet, periods[cell / COUNT_OF(speeds)], speeds[cell % COUNT_OF(speeds)], &h);
    if (failed) {
        fail_msg("%s", knurl_error_message());
    }
    return h;
}

/* T in ticks. */
static double ticks_of(size_t cell) {
    return 1000.0 * periods[cell / COUNT_OF(speeds)] / speeds[cell % COUNT_OF(speeds)];
}

/* Nothing lost, and the spread that is wanted: CHAI3D's best cells have 0.05 to 0.11. */
static void check_whole(const half_cycles *h, size_t cell, const char *what) {
    if (!(h->lost == 0.0 && h->cv <= 0.08 && h->raw_cv <= 0.08 && h->events > 100.0)) {
        fail_msg("%s, %g mm at %g mm/s: %g events, lost %g, CV %g, raw %g", what, 1e3 * periods[cell / 3],
                 1e3 * speeds[cell % 3], h->events, h->lost, h->cv, h->raw_cv);
    }
}

/* Algorithm 6 plays T to the nearest whole tick, half up; Eqs. 5 and 7 give the impulse of each half. S2 counts no
 * ridges: it plays T/N events a cycle. */
TEST(on_a_plane_every_half_cycle_is_the_same) {
    for (size_t cell = 0; cell < CELLS; cell += STEP) {
        const double ticks = floor(ticks_of(cell) + 0.5);
        const half_cycles h = measured(HALF_CYCLES_PLANE, NULL, cell);
        check_whole(&h, cell, "plane");
        CHECK_SAME(h.ticks_min, ticks);
        CHECK_SAME(h.ticks_max, ticks);
        CHECK_CLOSE(h.raw_cv, 0.0, 1e-9L);
        CHECK_CLOSE(h.worst_half, 0.0, 1e-9L);
        CHECK_CLOSE(h.played_per_crossed, ticks_of(cell) / ticks, 1e-9L);
    }
}

/* Held 1 mm from the facets, only the grating is felt. A moving proxy stays on its facet up to the next one's edge, at
 * most d (1/cos(b) - 1) too deep across a bend b; b is the curvature times a cell's diagonal. */
static void check_facets(uint32_t triangles) {
    wavy_sheet sheet;
    assert_int_equal(wavy_sheet_make(triangles, &sheet), 0);
    const double k = 2.0 * acos(-1.0) / SHEET_WAVE;
    const double diagonal = hypot(2.0 * SHEET_HALF_X / sheet.columns, 2.0 * SHEET_HALF_Y / sheet.rows);
    const double bend = SHEET_AMPLITUDE * k * k * diagonal;
    const double too_deep = HALF_CYCLES_DEPTH * (1.0 / cos(bend) - 1.0);
    const double steepest = sqrt(1.0 + pow(SHEET_AMPLITUDE * k, 2.0));
    for (size_t cell = 0; cell < CELLS; cell += STEP) {
        const half_cycles h = measured(HALF_CYCLES_FACETS, &sheet, cell);
        check_whole(&h, cell, "facets");
        assert_true(h.worst_half <= too_deep / HALF_CYCLES_AMPLITUDE + 1e-4); /* positions are floats */
        /* along the slope and along the arcs round a valley's edges a hand is faster than along x; 1 mm inside a bend
         * of radius 91 mm it is slower */
        assert_true(h.ticks_min >= floor(ticks_of(cell) / steepest / (1.0 + bend) + 0.5));
        assert_true(h.ticks_max <= floor(ticks_of(cell) * (1.0 + bend) + 0.5));
    }
    wavy_sheet_free(&sheet);
}

TEST(on_a_sheet_of_1k_triangles_no_half_cycle_is_lost) {
    check_facets(1000);
}

TEST(on_a_sheet_of_10k_triangles_no_half_cycle_is_lost) {
    check_facets(10000);
}

TEST(on_a_sheet_of_100k_triangles_no_half_cycle_is_lost) {
    check_facets(100000);
}

/* A hand that follows the smooth sheet feels the facets as well: a half cycle is off by at most their height over the
 * amplitude. A facet is within (curvature) (diagonal)^2 / 8 of the sheet. */
TEST(facets_are_felt_as_deep_as_they_are_and_lose_no_half_cycle) {
    static const uint32_t triangles[] = {1000, 10000, 100000};
    for (size_t i = 0; i < COUNT_OF(triangles); i++) {
        wavy_sheet sheet;
        assert_int_equal(wavy_sheet_make(triangles[i], &sheet), 0);
        const double k = 2.0 * acos(-1.0) / SHEET_WAVE;
        const double diagonal = hypot(2.0 * SHEET_HALF_X / sheet.columns, 2.0 * SHEET_HALF_Y / sheet.rows);
        const double sagitta = SHEET_AMPLITUDE * k * k * diagonal * diagonal / 8.0;
        for (size_t cell = 2; cell < CELLS; cell += 3 * STEP) { /* at 247 mm/s, at which halves are short */
            const half_cycles h = measured(HALF_CYCLES_CURVE, &sheet, cell);
            check_whole(&h, cell, "curve");
            assert_true(h.worst_half <= sagitta / HALF_CYCLES_AMPLITUDE + 1e-4);
        }
        wavy_sheet_free(&sheet);
    }
}

/* The measure's own geometry, against the smooth sheet: a fine sheet is as far away as the curve is. */
TEST(the_distance_to_a_sheet_is_that_to_its_curve) {
    wavy_sheet sheet;
    uint64_t seed = 7;
    assert_int_equal(wavy_sheet_make(100000, &sheet), 0);
    for (int i = 0; i < 1000; i++) {
        double point[3];
        double normal[3];
        wavy_sheet_point(random_between(&seed, -0.05, 0.05), random_between(&seed, -0.03, 0.03), point, normal);
        for (int axis = 0; axis < 3; axis++) {
            point[axis] -= HALF_CYCLES_DEPTH * normal[axis];
        }
        CHECK_CLOSE(wavy_sheet_distance(&sheet, point, 0.25 * HALF_CYCLES_DEPTH), HALF_CYCLES_DEPTH, 0.6e-6L);
    }
    wavy_sheet_free(&sheet);
}
