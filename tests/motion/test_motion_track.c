/* Positions between counts: the bounds that hold of every motion, closed forms, and ridges felt through them.
 * SPDX-License-Identifier: MIT */
#include "motion/velocity.h"
#include "support/bandlimited.h"

#define COUNT 0.055e-3 /* m: the Touch's */
#define RATE  1000.0

static knurl_velocity estimator(double resolution, double rate) {
    knurl_velocity made;
    assert_int_equal(knurl_velocity_prepare(KNURL_VELOCITY_AUTO, resolution, rate, &made), KNURL_OK);
    return made;
}

static double counted(double x) {
    return COUNT * floor(x / COUNT + 0.5);
}

/* Follows x along an axis of its own by FOAW's velocity. */
static double follow(knurl_velocity *e, double x, double velocity[3]) {
    const double position[3] = {0.0, counted(x), 0.0};
    double tracked[3];
    knurl_velocity_update(e, position, velocity);
    knurl_velocity_track(e, position, velocity, tracked);
    CHECK_SAME(tracked[0], 0.0);
    CHECK_SAME(tracked[2], 0.0);
    return tracked[1];
}

/* 1e5 random ticks: steps, rests, reversals, jumps, and velocities that have nothing to do with them. */
TEST(it_is_never_more_than_half_a_count_off_the_measured_position) {
    uint64_t seed = 3;
    knurl_velocity e = estimator(COUNT, RATE);
    double x[3] = {0.0, 0.0, 0.0}, tracked[3];
    for (int k = 0; k < 100000; k++) {
        double position[3], velocity[3];
        for (int i = 0; i < 3; i++) {
            x[i] += random_between(&seed, -3e-4, 3e-4) * (k / 500 % 2) +
                    (k % 997 == 0 ? random_between(&seed, -0.1, 0.1) : 0.0);
            position[i] = counted(x[i]);
            velocity[i] = k % 89 == 0 ? random_between(&seed, -1e9, 1e9) : random_between(&seed, -0.3, 0.3);
        }
        knurl_velocity_track(&e, position, velocity, tracked);
        for (int i = 0; i < 3; i++) {
            assert_true(fabs(tracked[i] - position[i]) <= 0.5 * COUNT * (1.0 + 1e-9));
        }
    }
}

TEST(positions_that_are_exact_stay_as_they_are) {
    knurl_velocity e = estimator(0.0, RATE);
    double tracked[3];
    for (int k = 0; k < 100; k++) {
        const double position[3] = {0.1e-3 * k, sin(k), 0.0}, velocity[3] = {0.1, 7.0, -3.0};
        knurl_velocity_track(&e, position, velocity, tracked);
        for (int i = 0; i < 3; i++) {
            CHECK_SAME(tracked[i], position[i]);
        }
    }
}

/* Within wide counts a velocity that steps from 0 to v is followed as a mean of time constant T is: after n ticks with
 * a share s of each new one, v (1 - (1 - s)^n). */
TEST(a_step_of_velocity_is_taken_on_over_20_ms) {
    static const double wide = 1.0, v = 0.3, none[3] = {0.0, 0.0, 0.0}, step[3] = {0.3, 0.0, 0.0};
    knurl_velocity e = estimator(wide, RATE);
    double tracked[3], left = 1.0, expected = 0.0;
    knurl_velocity_track(&e, none, none, tracked);
    for (int n = 1; n <= 100; n++) {
        left *= 1.0 - 1.0 / (KNURL_TRACK_S * RATE);
        expected += v * (1.0 - left) / RATE;
        knurl_velocity_track(&e, none, step, tracked);
        CHECK_CLOSE(tracked[0], expected, 1e-12L);
    }
    CHECK_CLOSE(left, exp(-0.1 / KNURL_TRACK_S), 1e-3L);
}

/* 5.5 mm/s is a count in 10 ms: from there on it is taken on at once, less that. */
TEST(a_larger_step_of_velocity_is_taken_on_at_once_but_for_a_count_in_10_ms) {
    static const double rates[] = {1000.0, 2000.0, 10000.0}, none[3] = {0.0, 0.0, 0.0};
    for (size_t i = 0; i < COUNT_OF(rates); i++) {
        knurl_velocity e = estimator(COUNT, rates[i]);
        const double step[3] = {0.0, 0.0, 0.02};
        double tracked[3];
        knurl_velocity_track(&e, none, none, tracked);
        knurl_velocity_track(&e, none, step, tracked);
        CHECK_CLOSE(tracked[2], (0.02 - COUNT / 0.01) / rates[i], 1e-15L);
    }
}

/* Steady motion: the deviation from its mean over 51 ms, as an rms in counts; slower changes are not tones. Speeds of
 * about one count per tick, at which the encoder's steps beat slowly with the ticks, are the worst. With FOAW's
 * velocity itself, as until November 2026, it is 0.235. */
TEST(in_steady_motion_little_is_left_of_the_counts) {
    enum { TICKS = 2500, LEAD = 500, WINDOW = 51 };
    static double off[TICKS];
    double worst = 0.0;
    for (double speed = 0.022; speed < 0.24; speed *= 1.021) {
        knurl_velocity e = estimator(COUNT, RATE);
        double velocity[3], squares = 0.0, sum = 0.0;
        for (int k = 0; k < TICKS; k++) {
            off[k] = (follow(&e, speed * k / RATE, velocity) - speed * k / RATE) / COUNT;
            sum += k >= LEAD ? off[k] - (k >= LEAD + WINDOW ? off[k - WINDOW] : 0.0) : 0.0;
            if (k >= LEAD + WINDOW) {
                const double strays = off[k - WINDOW / 2] - sum / WINDOW;
                squares += strays * strays / (TICKS - LEAD - WINDOW);
            }
        }
        worst = fmax(worst, sqrt(squares));
    }
    print_message("rms: %.3f counts\n", worst);
    assert_true(worst < 0.1);
}

/* Strokes to and fro, on top of a drift, to 250 mm/s. */
TEST(in_strokes_it_is_within_a_count_of_the_true_position) {
    for (int i = 1; i <= 25; i++) {
        knurl_velocity e = estimator(COUNT, RATE);
        double velocity[3];
        for (int k = 0; k < 4000; k++) {
            const double x = 0.01 * i / (4.0 * 3.141592653589793) * sin(12.566370614359172 * k / RATE) + 1e-6 * k;
            assert_true(fabs(follow(&e, x, velocity) - x) <= COUNT * (1.0 + 1e-9));
        }
    }
}

TEST(an_encoder_that_flickers_makes_no_half_cycle_on_an_edge) {
    const double edge = 0.25e-3;
    for (int place = -20; place <= 20; place++) {
        band_scan s = band_on(1000.0, 0.0, RATE, COUNT);
        knurl_velocity e = estimator(COUNT, RATE);
        int turns = 0;
        for (int k = 0; k < 500; k++) {
            const double at[3] = {edge + COUNT * (place / 20.0 - 0.5 + k / 7 % 2), 0.0, 0.0};
            double velocity[3], tracked[3];
            knurl_velocity_update(&e, at, velocity);
            knurl_velocity_track(&e, at, velocity, tracked);
            (void)band_x(&s, tracked[0], velocity[0]);
            turns += k > 100 ? (int)s.out.turned : 0; /* its mean velocity has died away */
        }
        assert_int_equal(turns, 0);
    }
}

TEST(a_velocity_that_is_no_number_leaves_nothing_behind) {
    knurl_velocity e = estimator(COUNT, RATE), fresh = e;
    static const double none[3] = {0.0, 0.0, 0.0}, odd[3] = {NAN, INFINITY, -INFINITY}, slow[3] = {0.01, 0.01, 0.01};
    double tracked[3], expected[3];
    knurl_velocity_track(&e, none, odd, tracked);
    for (int i = 0; i < 3; i++) {
        assert_true(fabs(tracked[i]) <= 0.5 * COUNT);
    }
    knurl_velocity_reset(&e);
    knurl_velocity_track(&e, none, slow, tracked);
    knurl_velocity_track(&fresh, none, slow, expected);
    for (int i = 0; i < 3; i++) {
        CHECK_SAME(tracked[i], expected[i]);
    }
}
