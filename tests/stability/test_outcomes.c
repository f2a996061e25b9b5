/* The laboratory's outcomes for walls and gratings: each as predicted by theory, and its numbers.
 * SPDX-License-Identifier: MIT */
#include "support/close.h"

#include "runaways.h"
#include "stability.h"

#define PI 3.141592653589793

static lab_signals signals;

static lab_result run(const lab_case *c) {
    lab_result r;
    memset(&r, 0, sizeof r);
    if (lab_run(c, &signals, &r)) {
        fail_msg("%s", knurl_error_message());
    }
    return r;
}

static void check_outcome(const lab_result *r, int expected) {
    if (r->outcome != expected) {
        fail_msg("%s instead of %s: activity %g, asked %g, swing %g mm, bangs %g", lab_outcome_name(r->outcome),
                 lab_outcome_name(expected), r->activity, r->asked, 1e3 * r->swing, r->bangs);
    }
}

static int drop_signals(void **state) {
    (void)state;
    lab_signals_free(&signals);
    return 0;
}

TEST(a_wall_below_every_bound_rests_and_gives_nothing_back) {
    for (const lab_grip *grip = lab_grip_named("loose"); grip->name; grip++) {
        lab_case c;
        lab_case_init(&c);
        c.grip = grip;
        c.stiffness = 300.0; /* the Touch alone: 333 N/m */
        const lab_result r = run(&c);
        check_outcome(&r, LAB_REST);
        CHECK_SAME(r.energy, 0.0);
        CHECK_SAME(r.unauthorised, 0.0);
        CHECK_SAME(r.bangs, 0.0);
        /* the hand presses with 1 N against its spring, which yields as much as the wall; dry friction */
        CHECK_CLOSE(signals.motor[signals.count - 1], 1.0 * 300.0 / (300.0 + grip->stiffness), 0.26 + 300.0 * 55e-6);
    }
}

/* An ideal device strokes waves: felt smooth it moves as on the closed form, on facets it is off by their depth. */
TEST(a_smooth_wall_moves_a_device_as_its_closed_form_does) {
    double off[3] = {0.0, 0.0, 0.0};
    for (int wall = LAB_PLANE; wall <= LAB_SMOOTH; wall++) {
        lab_case c;
        lab_case_init(&c);
        c.wall = wall;
        c.speed = 0.1;
        c.device = "preset=ideal&viscous=0.5";
        const lab_result r = run(&c);
        check_outcome(&r, LAB_REST);
        for (size_t i = signals.judged; i < signals.count; i++) {
            off[wall] = fmax(off[wall], fabs(signals.height[i] - signals.reference[i]));
        }
    }
    printf("largest distance from the reference: plane %.3f, facets %.3f, smooth %.3f um\n", 1e6 * off[LAB_PLANE],
           1e6 * off[LAB_FACETS], 1e6 * off[LAB_SMOOTH]);
    assert_true(off[LAB_SMOOTH] < off[LAB_PLANE] + 2e-6);
    assert_true(off[LAB_FACETS] > 10e-6);
}

/* The reference is a linear device on a spring: each odd harmonic of the square wave has its closed form. */
TEST(a_textures_motion_is_the_response_of_mass_spring_and_damper) {
    static const double speeds[] = {0.1, 0.2, 0.25}; /* 50, 100, 125 Hz: whole and even ticks */
    for (size_t i = 0; i < COUNT_OF(speeds); i++) {
        lab_case c;
        lab_case_init(&c);
        c.speed = speeds[i];
        c.device = "preset=ideal&viscous=0.5";
        c.amplitude = 0.0001;
        c.method = KNURL_METHOD_S1;
        const lab_result r = run(&c);
        double sum = 0.0;
        for (int n = 1; n * speeds[i] / c.period < 500.0; n += 2) {
            const double hz = n * speeds[i] / c.period;
            const double w = 2.0 * PI * hz;
            const double force = 4.0 / PI * c.stiffness * c.amplitude / n / sqrt(2.0);
            const double x = force / hypot(c.stiffness + c.grip->stiffness - (0.045 + c.grip->mass) * w * w,
                                           w * (0.5 + c.grip->damping));
            const double band = 20.0 * pow(2.0, floor(3.0 * log2(hz / 20.0) + 0.5) / 3.0);
            sum += pow(x / lab_threshold(band), 2.0);
        }
        CHECK_CLOSE(r.asked, sqrt(sum), 0.05 * sqrt(sum));
    }
}

/* A force that is held over its steps of 1/4000 s would undo K/8000 of damping: more than there is. */
TEST(the_reference_swings_as_a_spring_that_is_never_held) {
    const double decay = 0.2 / (2.0 * 0.045);
    const double w = sqrt(2000.0 / 0.045 - decay * decay);
    lab_case c;
    lab_case_init(&c);
    c.device = "preset=ideal&viscous=0.2";
    c.grip = lab_grip_named("none");
    c.bilateral = 1;
    c.approach = 0.0;
    c.stiffness = 2000.0;
    (void)run(&c);
    for (size_t i = 0; i < signals.count; i++) {
        const double t = (double)i / c.rate;
        const double size = 0.005 * exp(-decay * t);
        CHECK_CLOSE(signals.reference[i], size * (cos(w * t) + decay / w * sin(w * t)), 0.05 * size);
    }
}

TEST(a_grating_within_the_bounds_vibrates_as_it_asks_by_every_method) {
    static const int32_t methods[] = {KNURL_METHOD_S1, KNURL_METHOD_S2, KNURL_METHOD_BANDLIMITED};
    for (size_t i = 0; i < COUNT_OF(methods); i++) {
        lab_case c;
        lab_case_init(&c);
        c.method = methods[i];
        c.amplitude = 0.0002;
        c.speed = 0.1;
        c.settle = 2.25; /* S2 has ended its first event */
        const lab_result r = run(&c);
        check_outcome(&r, LAB_VIBRATION);
        assert_true(r.asked > 1.0 && r.felt > 1.0 && r.activity < 0.5 * r.asked);
    }
}

TEST(a_grating_that_is_too_shallow_to_be_felt_is_a_rest) {
    lab_case c;
    lab_case_init(&c);
    c.method = KNURL_METHOD_S1;
    c.amplitude = 0.00001;
    c.speed = 0.1;
    const lab_result r = run(&c);
    check_outcome(&r, LAB_REST);
}

/* 9 quanta push with 0.891 N, 10 with 0.990, and the hand with 0.948 in between: without dry friction it rests nowhere.
 * At two thirds of the runaway's stiffness that is due to quantisation. */
TEST(a_quantised_device_without_dry_friction_buzzes_below_its_runaway) {
    lab_case c;
    lab_case_init(&c);
    c.device = "preset=touch&coulomb=0";
    c.rate = 4000.0;
    c.grip = lab_grip_named("loose");
    c.stiffness = 1800.0; /* the bound is 1/(1.5 T) = 2667 N/m */
    c.settle = 2.0;
    const lab_result r = run(&c);
    check_outcome(&r, LAB_LIMIT_CYCLE);
    assert_true(r.swing < 0.5e-3);
}

TEST(a_runaway_grows_out_of_the_motors_work) {
    lab_case c;
    lab_case_init(&c);
    c.device = "preset=touch&coulomb=0";
    c.grip = lab_grip_named("loose");
    c.stiffness = 2000.0; /* three times the bound */
    const lab_result r = run(&c);
    check_outcome(&r, LAB_UNSTABLE);
    assert_true(r.bangs > 20.0 && r.unauthorised > 1e-3);
    assert_true(r.reference_bangs < 1.0 && r.reference_swing < 1e-4); /* which has no delay */
    CHECK_CLOSE(r.force_max, 3.3, 1e-9);
}

/* Stable by the same bound without the delay's ticks. */
TEST(a_tick_of_delay_decides) {
    lab_case c;
    lab_case_init(&c);
    c.grip = lab_grip_named("loose");
    c.stiffness = 1000.0; /* 1/(T/2) = 2000, 1/(3 T/2) = 667 N/m */
    c.settle = 2.0;       /* 1 N s/m less K T/2 leave 5 /s */
    c.device = "preset=touch&coulomb=0&resolution=0&delay=0";
    lab_result r = run(&c);
    check_outcome(&r, LAB_REST);
    c.device = "preset=touch&coulomb=0&resolution=0&delay=1";
    r = run(&c);
    check_outcome(&r, LAB_UNSTABLE);
}

TEST(the_hand_crosses_the_surface_at_the_speed_that_was_asked_for) {
    static const double speeds[] = {0.05, 0.1, 0.2};
    for (size_t i = 0; i < COUNT_OF(speeds); i++) {
        lab_case c;
        lab_case_init(&c);
        c.device = "preset=ideal&height=2";
        c.grip = lab_grip_named("firm");
        c.approach = speeds[i];
        c.press = 5.0;
        (void)run(&c);
        size_t at = 1;
        while (signals.height[at] > 0.0 && at + 1 < signals.count) {
            at++;
        }
        const double speed = (signals.height[at - 1] - signals.height[at]) * c.rate;
        CHECK_CLOSE(speed, speeds[i], 0.25 * speeds[i]); /* the mass lags behind the target that slows down */
    }
}

TEST(a_run_repeats_bit_for_bit) {
    lab_signals other;
    lab_case c;
    lab_result one;
    lab_result two;
    memset(&other, 0, sizeof other);
    memset(&one, 0, sizeof one);
    memset(&two, 0, sizeof two);
    lab_case_init(&c);
    c.speed = 0.1;
    c.amplitude = 0.0002;
    one = run(&c);
    assert_int_equal(lab_run(&c, &other, &two), 0);
    assert_memory_equal(signals.height, other.height, signals.count * sizeof *other.height);
    assert_memory_equal(&one, &two, sizeof one);
    lab_signals_free(&other);
}

TEST(an_unknown_device_or_method_is_refused_with_the_librarys_message) {
    lab_result r;
    lab_case c;
    lab_case_init(&c);
    c.device = "weight=3";
    assert_int_equal(lab_run(&c, &signals, &r), 1);
    check_message("weight");
    lab_case_init(&c);
    c.amplitude = 0.001;
    c.method = 77;
    assert_int_equal(lab_run(&c, &signals, &r), 1);
}

TEST(what_runs_away_raw_within_the_devices_own_limits_does_so) {
    for (size_t i = 0; i < COUNT_OF(runaways); i++) {
        const lab_case c = runaway_case(&runaways[i], KNURL_PROTECT_ALL);
        const lab_result r = run(&c);
        if (r.outcome != LAB_UNSTABLE) {
            fail_msg("row %u: %s", (unsigned)i, lab_outcome_name(r.outcome));
        }
    }
}

/* The study's map of amplitudes: 88 cells of speed and amplitude, without protections. S2, which does not follow the
 * position, never runs away. */
TEST(by_amplitude_bandlimited_runs_away_no_more_than_the_best_of_the_others) {
    static stability_cell cells[STABILITY_COLUMNS * STABILITY_ROWS];
    stability_map map;
    int compared = 0;
    for (size_t i = 0; stability_map_at("stability_amplitudes", i, &map); i++) {
        const int32_t method = stability_methods[map.method].method;
        if (method != KNURL_METHOD_BANDLIMITED || map.without != KNURL_PROTECT_ALL ||
            strcmp(map.label, "Falcon") != 0 || strcmp(map.grip, "loose") != 0) {
            continue;
        }
        const size_t count = stability_map_run(&map, &signals, cells);
        for (size_t cell = 0; cell < count; cell++) {
            assert_int_not_equal(cells[cell].result.outcome, LAB_UNSTABLE);
            compared++;
        }
    }
    assert_int_equal(compared, 88);
}

SUITE_FIXTURES(NULL, drop_signals)
