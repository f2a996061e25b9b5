/* Gratings of the method BANDLIMITED against its formulas, by spectra, and over random ways. SPDX-License-Identifier:
 * MIT
 */
#include "support/bandlimited.h"

#define RATE 1000.0
#define FS   1000.0
#define PI   3.141592653589793

TEST(steady_scans_are_the_formulas_of_its_docstring) {
    uint64_t seed = 1;
    for (int i = 0; i < 400; i++) {
        const double rate = random_between(&seed, 500.0, 10000.0), fs = random_between(&seed, 100.0, 3000.0);
        const double d = random_between(&seed, -0.499, 0.499), start = random_between(&seed, -20.0, 20.0);
        band_scan s = band_on(fs, 0.0, rate, 0.0);
        for (int k = 0; k < 25; k++) {
            long double within;
            const double at = start + d * k;
            const double height = band_x(&s, at / fs, d * rate / fs);
            const double expected = band_height(k ? at - d : at, at, fabs(d), &within);
            CHECK_CLOSE(height, expected, within + 1e-9L);
        }
    }
}

/* The spectrum of a scan of whole cycles: lines at the ridges' odd multiples below f_h/2, and no others. */
TEST(no_tone_but_the_ridges_own_is_played_from_a_twelfth_of_the_update_rate_on) {
    enum { TICKS = 500 };
    for (int cycles = 42; cycles < TICKS / 2; cycles++) {
        band_scan s = band_on(FS, 0.0, RATE, 0.0);
        double height[TICKS];
        for (int k = 0; k < TICKS; k++) {
            height[k] = band_x(&s, (0.123 + (double)(cycles * k) / TICKS) / FS, RATE * cycles / TICKS / FS);
        }
        for (int line = 0; line <= TICKS / 2; line++) {
            double re = 0.0, im = 0.0;
            for (int k = 0; k < TICKS; k++) {
                const double a = 2.0 * PI * (double)(line * k % TICKS) / TICKS;
                re += height[k] * cos(a) * 2.0 / TICKS;
                im += height[k] * sin(a) * 2.0 / TICKS;
            }
            if (line == cycles) {
                CHECK_CLOSE(hypot(re, im), 4.0 / PI, BAND_EXACT);
            } else if (line % cycles != 0 || line / cycles % 2 == 0) {
                CHECK_CLOSE(hypot(re, im), 0.0, BAND_EXACT);
            }
        }
    }
}

TEST(a_hip_at_rest_feels_the_height_of_its_place) {
    for (int i = 0; i < 64; i++) {
        const double x = (i + 0.5) / 32.0 / FS;
        band_scan s = band_on(FS, 0.0, RATE, 0.0);
        (void)band_x(&s, x, 0.0);
        CHECK_SAME(band_x(&s, x, 0.0), (i + 8) % 32 < 16 ? 1.0 : -1.0); /* S1: cos(2 pi p) > 0 */
    }
}

/* Also after a rest on it, which has no direction. */
TEST(ridges_along_y_are_at_its_positions) {
    band_scan s = band_on(0.0, FS, RATE, 0.0);
    for (int k = 0; k < 50; k++) {
        const double y = 0.0003 + (k < 10 ? 0.0 : 0.2e-3 * (k - 9));
        const double height = band_step(&s, (const double[2]){0.7, y}, 0.1, k < 10 ? 0.0 : 0.2);
        CHECK_CLOSE(height, k < 10 ? -1.0 : band_harmonics(FS * y, 0.2), BAND_EXACT);
    }
}

TEST(above_half_the_update_rate_the_sign_changes_every_tick) {
    band_scan s = band_on(FS, 0.0, RATE, 0.0);
    double last = band_x(&s, 0.0, 0.7);
    for (int k = 1; k < 100; k++) {
        const double height = band_x(&s, 0.7e-3 * k, 0.7);
        CHECK_SAME(fabs(height), 0.7);
        assert_true(height * last < 0.0);
        assert_int_equal(s.out.above_nyquist, 1);
        last = height;
    }
    CHECK_CLOSE(band_x(&s, 0.0, 0.2), band_harmonics(0.0, 0.2), BAND_EXACT); /* it has no memory of that */
}

TEST(without_a_position_the_velocity_is_summed_up) {
    for (int axis = 0; axis < 2; axis++) {
        band_scan with = band_on(FS, 0.0, RATE, 0.0), without = band_on(axis ? 0.0 : FS, axis ? FS : 0.0, RATE, 0.0);
        uint64_t seed = 4;
        double x = 0.0, v = 0.1;
        (void)band_x(&with, x, v);
        (void)band_step(&without, NULL, axis ? 0.0 : v, axis ? v : 0.0);
        without.state.tracked[axis] = without.state.phase = 0.0;
        for (int k = 0; k < 5000; k++) {
            v += random_between(&seed, -0.01, 0.01) - 0.02 * v;
            x += v / RATE;
            CHECK_CLOSE(band_step(&without, NULL, axis ? 0.0 : v, axis ? v : 0.0), band_x(&with, x, v), 1e-6L);
        }
    }
}

TEST(along_an_axis_a_grid_is_a_line) {
    band_scan grid = band_on(FS, 0.7 * FS, RATE, 0.0), line = band_on(FS, 0.0, RATE, 0.0);
    for (int k = 0; k < 1000; k++) {
        CHECK_SAME(band_x(&grid, 0.21e-3 * k, 0.21), band_x(&line, 0.21e-3 * k, 0.21));
    }
}

/* Random walks over random grids: in phase, a tick advances by Eq. 12's cycles, also when the other axis takes over
 * (at 1.1 times as many), so that by cos's symmetry the height is that of a phase d farther on. */
TEST(on_a_grid_the_phase_moves_on_by_the_cycles_of_the_axis_that_crosses_the_most) {
    uint64_t seed = 5;
    for (int i = 0; i < 100; i++) {
        const double fs[2] = {random_between(&seed, 300.0, 2000.0), random_between(&seed, 300.0, 2000.0)};
        band_scan s = band_on(fs[0], fs[1], RATE, 0.0);
        double at[2] = {0.0, 0.0}, angle = random_between(&seed, 0.0, 6.0);
        for (int k = 0; k < 1000; k++) {
            const double before = s.state.phase, speed = 0.1;
            angle += random_between(&seed, -0.05, 0.05);
            const double v[2] = {speed * cos(angle), speed * sin(angle)};
            at[0] += v[0] / RATE;
            at[1] += v[1] / RATE;
            (void)band_step(&s, at, v[0], v[1]);
            const double moved = fabs(fabs(s.state.phase) - fabs(before));
            const double most = knurl_grating_frequency(fs, v) / RATE;
            if (k > 0 && fabs(before) > 1.0) {
                assert_true(moved <= most + 1e-9 && moved >= most / 1.1 - 1e-9);
            }
        }
    }
}

/* From +-x to +-y in the middle of a cycle: played on as on a line that never turned. */
TEST(the_wave_continues_when_the_other_axis_takes_over) {
    const double step = 0.03; /* cycles a tick */
    for (int signs = 0; signs < 4; signs++) {
        const double x = signs & 1 ? -1.0 : 1.0, y = signs & 2 ? -1.0 : 1.0;
        band_scan grid = band_on(FS, FS, RATE, 0.0), line = band_on(FS, 0.0, RATE, 0.0);
        double at[2] = {0.0, 0.0};
        for (int k = 0; k < 60; k++) {
            const double v[2] = {k < 25 ? x * step * RATE / FS : 0.0, k < 25 ? 0.0 : y * step * RATE / FS};
            at[0] += v[0] / RATE;
            at[1] += v[1] / RATE;
            const double expected = band_x(&line, (k + 1) * step / FS, step * RATE / FS);
            CHECK_CLOSE(band_step(&grid, at, v[0], v[1]), expected, 1e-9);
        }
    }
}

TEST(events_count_the_ridges_begun) {
    band_scan s = band_on(FS, 0.0, RATE, 0.0);
    for (int k = 0; k < 1000; k++) {
        (void)band_x(&s, (0.5 + 0.1 * k) / FS, 0.1 * RATE / FS); /* from a trough */
    }
    assert_true(s.out.event == 99);
}

TEST(non_finite_inputs_leave_a_finite_height) {
    static const double odd[] = {0.0, -0.0, 1e-308, 1e308, -1e308, 1e18, INFINITY, NAN};
    for (size_t i = 0; i < COUNT_OF(odd) * COUNT_OF(odd); i++) {
        band_scan s = band_on(FS, 500.0, RATE, 0.055e-3);
        for (int k = 0; k < 4; k++) {
            const double at[2] = {1e-4 * k, k % 2 ? 1e9 : 0.0};
            (void)band_step(&s, at, odd[i % COUNT_OF(odd)], odd[i / COUNT_OF(odd)]);
        }
    }
}
