/* The method AREA, a grating at a time, against a numerical integral along the way and knurl_grating_step()'s
 * description. SPDX-License-Identifier: MIT */
#include "support/area.h"

#include <stdlib.h>

#define RATE 1000.0
#define FS   1000.0 /* cycles/m */

/* What AREA is to give for a way of d cycles that ends at phase `to`: the square wave, a sine's sign, summed piece by
 * piece between its edges, over d, over sinc(d). */
static long double integrate(long double to, long double d) {
    const long double pi = 3.14159265358979323846264338327950288L;
    const long double from = to - d;
    long double sum = 0.0L;
    long double begin = from;
    for (long double edge = floorl(2.0L * from + 1.0L) / 2.0L; begin < to; edge += 0.5L) {
        const long double end = edge < to ? edge : to;
        sum += (end - begin) * (sinl(2.0L * pi * 0.5L * (begin + end)) > 0.0L ? 1.0L : -1.0L);
        begin = end;
    }
    return A * sum / d * (pi * d / sinl(pi * d));
}

TEST(a_way_along_a_line_gives_its_numerical_integral) {
    uint64_t seed = 1;
    for (int i = 0; i < 100000; i++) {
        const double fs = random_between(&seed, 100.0, 3000.0);
        const double start = random_between(&seed, -0.05, 0.05);
        const double d = random_between(&seed, 1e-3, 0.5);
        const double way = (random_bits(&seed) & 1 ? d : -d) / fs;
        area_walk w = area_on(fs, 0.0, RATE);
        (void)area_x(&w, start, 0.01 * way);
        const double height = area_x(&w, start + way, 0.01 * way);
        const long double went = fabsl((long double)(start + way) - start) * fs;
        const long double to = (way > 0.0 ? 1.0L : -1.0L) * (long double)(start + way) * fs + 0.25L;
        CHECK_CLOSE(height, integrate(to, went), 1e-9L * A);
    }
}

/* Three ticks: a start, a way along the faster axis, one along the other, or back. Speeds are a hundredth of what the
 * positions say, which only have to tell the axis: no events. */
TEST(ways_over_a_grid_give_their_numerical_integral) {
    uint64_t seed = 2;
    int turned = 0;
    int crossed = 0;
    for (int i = 0; i < 100000; i++) {
        const double fs[2] = {random_between(&seed, 100.0, 3000.0), random_between(&seed, 100.0, 3000.0)};
        area_walk w = area_on(fs[0], fs[1], RATE);
        double position[2] = {random_between(&seed, -0.02, 0.02), random_between(&seed, -0.02, 0.02)};
        double way[2] = {0.0, 0.0};
        double sign = 0.0; /* of the way before, along its axis */
        int last = -1;
        long double phase = 0.0L;
        for (int k = 0; k < 3; k++) {
            double cycles[2] = {random_between(&seed, -0.5, 0.5), random_between(&seed, -0.5, 0.5)};
            const double more = fabs(cycles[1] / cycles[0]);
            if (fabs(cycles[0]) < 1e-3 || fabs(cycles[1]) < 1e-3 || (more > 0.9 && more < 1.11)) {
                k--; /* no way, or one that leaves open which axis it is */
                continue;
            }
            const int along = more > 1.0;
            const double before = position[along];
            for (int j = 0; j < 2; j++) {
                way[j] = cycles[j] / fs[j];
                position[j] += k > 0 ? way[j] : 0.0;
            }
            const double velocity[2] = {way[0], way[1]};
            const double height = area(&w, position, velocity);
            const double forward = way[along] > 0.0 ? 1.0 : -1.0;
            if (k == 0) { /* Eq. 11's bars across that axis */
                phase = forward * (long double)position[along] * fs[along] + 0.25L;
            } else {
                const int back = along == last && forward != sign;
                const long double went = fabsl((long double)position[along] - before) * fs[along];
                phase = (back ? 0.5L - phase : phase) + went;
                CHECK_CLOSE(height, integrate(phase, went), 1e-9L * A);
                turned += back;
                crossed += along != last;
            }
            sign = forward;
            last = along;
        }
    }
    assert_true(turned > 30000 && crossed > 30000);
}

TEST(the_first_tick_is_the_points) {
    static const double fs[2] = {FS, 0.0};
    for (int i = 0; i < 100; i++) {
        const double position[2] = {(i - 50.37) * 0.000137, 0.0};
        area_walk w = area_on(FS, 0.0, RATE);
        CHECK_CLOSE(area_x(&w, position[0], 0.3), knurl_grating_s1(position, fs, A), 1e-10L * A);
    }
}

/* d -> 0: S1's heights but for the ticks in which an edge is crossed, and S1's half a tick ago by sign at any d. */
TEST(slow_it_is_s1_and_its_signs_are_those_of_the_ways_middle) {
    static const double fs[2] = {FS, 0.0};
    uint64_t seed = 3;
    area_walk w = area_on(FS, 0.0, RATE);
    double x = 0.0123456;
    (void)area_x(&w, x, 0.0);
    for (int k = 0; k < 100000; k++) {
        const double step = random_between(&seed, -0.44e-3, 0.44e-3);
        const double middle[2] = {x + 0.5 * step, 0.0};
        x += step;
        const double height = area_x(&w, x, step * RATE);
        if (height != 0.0) {
            assert_true((height > 0.0) == (knurl_grating_s1(middle, fs, A) > 0.0));
        }
    }
    for (int k = 0; k < 10000; k++) {
        const double position[2] = {0.0123456 + 1e-7 * k, 0.0};
        const double height = area_x(&w, position[0], 1e-4);
        if (k > 0 && fabs(knurl_grating_s1(position, fs, A) - w.last_point) < A) {
            CHECK_CLOSE(height, knurl_grating_s1(position, fs, A), 1e-7L * A);
        }
        w.last_point = knurl_grating_s1(position, fs, A);
    }
}

/* Every frequency of a whole number of Hz at which no event plays, eleven phases: over a second the sum telescopes, two
 * changes of sign a cycle, and the phases' mean line is the square wave's, 4/pi A. A single phase is off where cycles
 * are whole ticks, because what folds back falls onto the line itself: by 23 % at 4 ticks a cycle, the most there is;
 * and ten phases are one to a cycle of 10 ticks, so it takes a number that has no factor with such cycles. */
TEST(steady_scans_neither_push_nor_drift_nor_droop) {
    enum { PHASES = 11 };
    static const double rates[] = {1000.0, 2000.0, 5000.0, 10000.0};
    const size_t count = getenv("KNURL_LONG") ? COUNT_OF(rates) : 2;
    for (size_t r = 0; r < count; r++) {
        const int ticks = (int)rates[r];
        for (int f = 20; f <= 450; f++) {
            double line[2] = {0.0, 0.0};
            for (int i = 0; i < PHASES; i++) {
                const double start = i / (double)PHASES;
                area_walk w = area_on(FS, 0.0, rates[r]);
                const double speed = f / FS;
                double sum = 0.0;
                double turns = 0.0;
                (void)area_x(&w, start / FS - speed / rates[r], speed);
                (void)area_x(&w, start / FS, speed);
                for (int k = 1; k <= ticks; k++) {
                    const double height = area_x(&w, start / FS + speed * k / rates[r], speed);
                    const double angle =
                        6.283185307179586 * (f * (k - 0.5) / rates[r] + start + 0.25); /* way's middle */
                    assert_true(w.state.playing == 0);
                    sum += height;
                    turns += w.out.turned;
                    line[0] += height * sin(angle);
                    line[1] += height * cos(angle);
                }
                CHECK_CLOSE(sum / ticks, 0.0, 1e-9L * A);
                CHECK_CLOSE(turns, 2.0 * f, 1.0);
            }
            const double per_phase = 2.0 / (PHASES * ticks);
            CHECK_CLOSE(hypot(line[0], line[1]) * per_phase, 1.2732395447351628 * A, 0.01L * 1.2732395447351628L * A);
        }
    }
}

/* A hand that turns where it likes between the same two places crosses the same heights backwards, on lines and grids:
 * the way from x to x' is the mean of what lies between, in either direction. */
TEST(a_reversal_meets_the_same_ridges) {
    uint64_t seed = 4;
    for (int i = 0; i < 1000; i++) {
        area_walk w = area_on(FS, i % 2 ? 700.0 : 0.0, RATE);
        const double angle = i % 2 ? random_between(&seed, 0.0, 6.28) : 0.0;
        const double speed = random_between(&seed, 0.01, 0.3);
        double heights[64];
        for (int k = 0; k < 127; k++) {
            const int at = k < 64 ? k : 126 - k;
            const double sign = k < 64 ? 1.0 : -1.0;
            const double position[2] = {0.01 + cos(angle) * speed * at / RATE, sin(angle) * speed * at / RATE};
            const double velocity[2] = {sign * speed * cos(angle), sign * speed * sin(angle)};
            const double height = area(&w, position, velocity);
            if (k < 64) {
                heights[k] = height;
            } else { /* from at + 1 to at, where heights[at + 1] went from at to at + 1 */
                CHECK_CLOSE(height, heights[at + 1], 1e-9L * A);
            }
        }
    }
}

/* Round a circle the axis changes eight times, and the phase goes on: as many ridges as Eq. 12 counts, the hysteresis
 * of the axes aside, and no way in a tick that is longer than the speed allows. */
TEST(round_a_circle_a_grid_is_one_tone) {
    area_walk w = area_on(FS, FS, RATE);
    const double radius = 0.02;
    const double speed = 0.15;
    double before = 0.0;
    double most = 0.0;
    double least = 1.0;
    int changes = 0;
    int axis = 0;
    for (int k = 0; k < 10000; k++) {
        const double angle = speed / radius * k / RATE;
        const double position[2] = {radius * cos(angle), radius * sin(angle)};
        const double velocity[2] = {-speed * sin(angle), speed * cos(angle)};
        (void)area(&w, position, velocity);
        const double went = w.state.phase - before;
        if (k > 0) {
            most = fmax(most, went);
            least = fmin(least, went);
            changes += w.state.axis != axis;
        }
        axis = w.state.axis;
        before = w.state.phase;
    }
    assert_true(changes >= 36 && changes <= 48); /* 11.9 rounds, four changes each */
    assert_true(most <= 0.15 * (1.0 + 1e-3));
    assert_true(least >= 0.15 * cos(atan(1.1)) - 1e-3); /* where the other axis has 1.1 times the cycles */
}

/* Position by position, or by the velocity alone. */
TEST(without_a_position_the_way_is_the_velocitys) {
    uint64_t seed = 5;
    for (int grid = 0; grid < 2; grid++) {
        area_walk placed = area_on(FS, grid ? 900.0 : 0.0, RATE);
        area_walk blind = area_on(FS, grid ? 900.0 : 0.0, RATE);
        double position[2] = {0.0, 0.0};
        double velocity[2] = {0.05, 0.01};
        for (int k = 0; k < 20000; k++) {
            for (int j = 0; j < 2; j++) {
                velocity[j] += random_between(&seed, -0.02, 0.02) - 0.01 * velocity[j];
                position[j] += k > 0 ? velocity[j] / RATE : 0.0;
            }
            CHECK_CLOSE(area(&blind, NULL, velocity), area(&placed, position, velocity), 1e-7L * A);
        }
    }
}

TEST(the_event_is_the_latest_ridge) {
    area_walk w = area_on(FS, 0.0, RATE);
    (void)area_x(&w, 0.00048, 0.1); /* in a groove: none has begun */
    assert_true(w.out.event == KNURL_NO_EVENT);
    for (int k = 1; k < 2000; k++) {
        const double x = 0.00048 + 1e-4 * k;
        (void)area_x(&w, x, 0.1);
        CHECK_CLOSE((double)w.out.event, floor((x - 0.00005) * FS + 0.25) - 1.0, 0.0L); /* the way's middle */
    }
}

/* An encoder at rest on an edge: one count to and fro, at any of the places of a count round the edge. */
TEST(at_rest_on_an_edge_a_flickering_count_does_not_toggle_the_height) {
    const double count = 0.055e-3;
    for (int place = -20; place <= 20; place++) {
        area_walk w = area_on(FS, place % 2 ? FS : 0.0, RATE);
        uint64_t seed = 7;
        double first = 0.0;
        w.grating.resolution = count;
        for (int k = 0; k < 200; k++) {
            const double flicker = random_bits(&seed) % 2 ? count : 0.0;
            const double x = 0.25 / FS + count * place / 20.0 - 0.5 * count + flicker;
            const double height = area_x(&w, x, k < 20 ? 0.0 : flicker > 0.0 ? 0.0037 : -0.0037);
            const int settled = k > 21 && height == w.before;
            first = k == 21 ? height : first;
            assert_true(k <= 21 || settled);
        }
    }
}

/* 1 mm/s over 20 ridges, there and back: 18 ticks a count. */
TEST(slowly_across_edges_each_of_them_toggles_once) {
    const double count = 0.055e-3;
    area_walk w = area_on(FS, 0.0, RATE);
    int turns = 0;
    w.grating.resolution = count;
    for (int k = 0; k < 40000; k++) {
        const double true_x = 1e-6 * (k < 20000 ? k : 40000 - k);
        const double noise = k % 3 == 0 ? 0.4 * count : 0.0;
        const double x = count * floor((true_x + noise) / count + 0.5);
        (void)area_x(&w, x, k < 20000 ? 0.001 : -0.001);
        turns += (int)w.out.turned;
    }
    assert_int_equal(turns, 80);
}
