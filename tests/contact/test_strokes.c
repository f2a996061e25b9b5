/* Strokes over rough meshes: out of one ridge into the next, through all of it in one tick. A HIP inside is held.
 * SPDX-License-Identifier: MIT */
#include "support/probe.h"

static double steep_height(double x, double y) {
    (void)y;
    return 2.0 * fabs(x);
}

/* From inside one wall of a steep groove into the other in one tick: out and in again within one path. */
TEST(groove_crossed_in_one_tick_holds_on_its_other_side) {
    const double half[2] = {0.0625, 0.0625};
    SCOPED_PROBE p = probe_of(shape_sheet(50, 50, half, steep_height));
    for (int k = 0; k < 20; k++) { /* 1 m/s at 1 kHz, up to 0.19 mm deep */
        const double x = 0.0005;
        const double depth = 1e-5 * k + 1e-6;
        const double z = 2.0 * x - depth * sqrt(5.0);
        probe_forget(&p);
        assert_false(probe_to(&p, -x, 0.0003, 2.0 * x + 1e-5));
        assert_true(probe_to(&p, -x, 0.0003, z));
        assert_true(probe_to(&p, x, 0.0003, z));
        CHECK_CLOSE(-p.contact.z, depth, 1e-8);
        assert_true(p.contact.normal[0] < 0.0);
    }
}

#define CELLS   60
#define SPACING 0.001 /* m between vertices */

/* A sheet as rough as a rasp: noise of so many metres at every vertex. */
typedef struct rasp {
    probe p;
    double amplitude;
    double heights[CELLS + 1][CELLS + 1];
} rasp;

static void rasp_init(rasp *r, double amplitude, uint64_t seed) {
    const double half[2] = {0.5 * CELLS * SPACING, 0.5 * CELLS * SPACING};
    shape sheet = shape_sheet(CELLS, CELLS, half, NULL);
    for (uint32_t v = 0; v < sheet.vertex_count; v++) {
        sheet.positions[3 * v + 2] = (float)random_between(&seed, -amplitude, amplitude);
        r->heights[v / (CELLS + 1)][v % (CELLS + 1)] = (double)sheet.positions[3 * v + 2];
    }
    r->amplitude = amplitude;
    r->p = probe_shape(&sheet);
}

/* The height of the rasp's triangles (shape_quad()'s two of a cell) at a place. */
static double rasp_height(const rasp *r, double x, double y) {
    const double u = x / SPACING + 0.5 * CELLS;
    const double v = y / SPACING + 0.5 * CELLS;
    const int i = (int)floor(u);
    const int j = (int)floor(v);
    const double a = r->heights[j][i];
    const double b = r->heights[j][i + 1];
    const double c = r->heights[j + 1][i + 1];
    const double d = r->heights[j + 1][i];
    return u - i > v - j ? a + (u - i) * (b - a) + (v - j) * (c - b) : a + (v - j) * (d - a) + (u - i) * (c - d);
}

/* From above all of it to below all of it in one tick, straight down and slanted, then lifted off again. */
TEST(fast_strokes_do_not_tunnel_through_a_rasp) {
    uint64_t seed = 61;
    for (uint64_t i = 1; i < 4; i++) {
        rasp r;
        rasp_init(&r, 0.001, i);
        for (int k = 0; k < 5000; k++) {
            const double x = random_between(&seed, -0.02, 0.02);
            const double y = random_between(&seed, -0.02, 0.02);
            const double slant = k % 2 ? 0.004 : 0.0;
            probe_forget(&r.p);
            assert_false(probe_to(&r.p, x, y, 0.00101));
            assert_true(probe_to(&r.p, x + random_between(&seed, -slant, slant),
                                 y + random_between(&seed, -slant, slant), random_between(&seed, -0.003, -0.00101)));
            assert_true(r.p.contact.z < 0.0);
            assert_false(probe_to(&r.p, x, y, 0.0015));
        }
        probe_free(&r.p);
    }
}

/* Wanders over the rasp, pressed in by up to 1 mm; steps up to `step`. */
static void wander(rasp *r, double step, uint64_t seed) {
    double drift[3] = {1.0, 0.0, 0.0};
    double to[3] = {0.0, 0.0, r->amplitude};
    int held = 0;
    int solid_ticks = 0;
    probe_forget(&r->p);
    for (int k = 0; k < 30000; k++) {
        held = probe_at(&r->p, to);
        const double height = rasp_height(r, to[0], to[1]);
        solid_ticks += to[2] < height;
        if (to[2] < height - 1e-6 && !(held && r->p.contact.z < 0.0)) {
            print_error("amplitude %g, steps of %g: lost at tick %d, %g m deep\n", r->amplitude, step, k,
                        height - to[2]);
            fail();
        }
        double move[3];
        random_direction(&seed, move);
        add3(move, 0.7, drift, move);
        add3(r->p.query.hip, step * random_between(&seed, 0.0, 0.58), move, to);
        if (held && r->p.contact.z < -0.001) {
            add3(r->p.query.hip, step, r->p.contact.normal, to); /* pushed out */
        }
        if (fabs(to[0]) > 0.025 || fabs(to[1]) > 0.025 || to[2] > r->amplitude + 0.0005) {
            random_direction(&seed, drift);
            drift[2] = -fabs(drift[2]);
            memcpy(to, r->p.query.hip, sizeof to);
        }
    }
    assert_in_range(solid_ticks, 3000, 30000);
}

TEST(nothing_that_wanders_in_a_rasp_is_lost) {
    static const double amplitudes[] = {0.0002, 0.0005, 0.001, 0.002};
    static const double steps[] = {0.0001, 0.0003, 0.001, 0.002}; /* 2 m/s at 1 kHz and less */
    for (size_t i = 0; i < COUNT_OF(amplitudes) * COUNT_OF(steps); i++) {
        rasp r;
        rasp_init(&r, amplitudes[i / COUNT_OF(steps)], 7 + i);
        wander(&r, steps[i % COUNT_OF(steps)], 17 + i);
        probe_free(&r.p);
    }
}

static double teeth_amplitude;

/* Teeth 1 mm apart. */
static double teeth_height(double x, double y) {
    const double phase = x * 1000.0 - floor(x * 1000.0);
    (void)y;
    return teeth_amplitude * (1.0 - 2.0 * fabs(2.0 * phase - 1.0));
}

/* Dragged over teeth with a hand that shakes a little: out of one tooth through the air into the next, finally within
 * one tick. A HIP in a tooth must be held. (In between, the previous tooth may still hold it: it is a thin wall.) */
static void drag_over_teeth(probe *p, double step, uint64_t seed) {
    double z = 0.0;
    probe_forget(p);
    (void)probe_to(p, -0.06, 0.0, 0.002);
    for (double x = -0.06; x < 0.06; x += step * random_between(&seed, 0.5, 1.0)) {
        const double hip[3] = {x, 0.0003, z};
        if (!probe_inside(p, hip) && z < teeth_height(x, 0.0) - 1e-6) {
            print_error("amplitude %g, %g m a tick: lost at x %.9g, z %.9g\n", teeth_amplitude, step, x, z);
            fail();
        }
        z += 0.3 * step * random_between(&seed, -1.0, 1.0);
        z = fmin(0.9 * teeth_amplitude, fmax(-0.6 * teeth_amplitude, z));
    }
}

TEST(strokes_over_teeth_never_lose_the_tooth_they_are_in) {
    static const double amplitudes[] = {0.0005, 0.00025, 0.0001};
    static const double steps[] = {0.00005, 0.0001, 0.00025, 0.0005, 0.001, 0.002}; /* m a tick */
    const double half[2] = {0.0625, 0.005};
    for (size_t i = 0; i < COUNT_OF(amplitudes); i++) {
        teeth_amplitude = amplitudes[i];
        SCOPED_PROBE p = probe_of(shape_sheet(500, 2, half, teeth_height));
        for (size_t k = 0; k < 5 * COUNT_OF(steps); k++) {
            drag_over_teeth(&p, steps[k % COUNT_OF(steps)], 81 + k);
        }
    }
}

/* Two sheets of one mesh, 1 mm apart: a HIP that lifts off the lower one is behind the upper one, but did not pass it.
 */
TEST(sheet_behind_which_the_hip_lifts_off_does_not_hold_it) {
    const double half[2] = {0.03, 0.03};
    shape sheet = shape_sheet(10, 10, half, NULL);
    shape both = shape_new(2 * sheet.vertex_count, 2 * sheet.index_count, 0);
    for (uint32_t v = 0; v < 2 * sheet.vertex_count; v++) {
        double p[3];
        shape_get(&sheet, v % sheet.vertex_count, p);
        shape_set(&both, v, p[0], p[1], v < sheet.vertex_count ? 0.0 : 0.001);
    }
    for (uint32_t i = 0; i < 2 * sheet.index_count; i++) {
        both.indices[i] = sheet.indices[i % sheet.index_count] + (i < sheet.index_count ? 0 : sheet.vertex_count);
    }
    shape_free(&sheet);
    SCOPED_PROBE p = probe_shape(&both);
    for (int k = 1; k < 20; k++) {
        probe_forget(&p);
        assert_false(probe_to(&p, 0.001, 0.002, 0.0004));
        assert_true(probe_to(&p, 0.001, 0.002, -0.0002));
        CHECK_CLOSE(p.contact.z, -0.0002, 1e-9);
        assert_false(probe_to(&p, 0.001, 0.002, 0.00005 * k));
        assert_false(probe_to(&p, 0.001, 0.002, 0.0005));
    }
    assert_false(probe_to(&p, 0.001, 0.002, 0.0015));
    assert_true(probe_to(&p, 0.001, 0.002, -0.0005)); /* through both at once: held by the first it met */
    CHECK_CLOSE(p.contact.z, -0.0015, 1e-8);
}
