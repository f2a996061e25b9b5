/* The laboratory against closed forms: its signals agree with theory. If the study's table scans more, the tests use
 * the rows at 1 kHz and the corners. SPDX-License-Identifier: MIT */
#include "support/close.h"

#include "stability.h"

#include <stdlib.h>

static lab_signals signals; /* reused from run to run */

static double found(const stability_loop *loop) {
    const double stiffness = stability_found(loop, &signals);
    if (stiffness < 0.0) {
        fail_msg("%s", knurl_error_message());
    }
    return stiffness;
}

static int drop_signals(void **state) {
    (void)state;
    lab_signals_free(&signals);
    return 0;
}

/* --- critical stiffness --- */

/* The eigenvalues of this very loop, computed elsewhere. */
TEST(the_discretised_loop_has_the_poles_that_are_known) {
    static const double known[] = {1001.0, 334.0, 201.0};
    for (int delay = 0; delay < 3; delay++) {
        const stability_loop loop = {0.072, 0.5, 0.0, delay, 1000.0};
        CHECK_CLOSE(stability_exact(&loop), known[delay], 0.5);
    }
}

TEST(a_held_mass_loses_its_rest_at_the_stiffness_that_delay_and_damping_allow) {
    static const double known[] = {1000.0, 1000.0 / 3.0, 200.0}; /* b/(T/2 + td) */
    for (int delay = 0; delay < 3; delay++) {
        const stability_loop loop = {0.072, 0.5, 0.0, delay, 1000.0};
        CHECK_CLOSE(stability_bound(&loop), known[delay], 1e-9);
        const double stiffness = found(&loop);
        CHECK_CLOSE(stiffness, known[delay], 0.02 * known[delay]);
        CHECK_CLOSE(stiffness, stability_exact(&loop), 0.003 * known[delay]);
    }
}

/* The bound is an approximation, on the hopeful side; the poles are exact. */
TEST(a_damped_wall_loses_its_rest_within_a_tenth_of_the_bound_and_at_the_exact_pole) {
    for (int delay = 0; delay < 3; delay++) {
        const stability_loop loop = {0.072, 0.5, 5.0, delay, 1000.0};
        const double bound = 5.5 / (1e-3 * (0.5 + delay));
        const double stiffness = found(&loop);
        CHECK_CLOSE(stiffness, bound, 0.1 * bound);
        CHECK_CLOSE(stiffness, stability_exact(&loop), 0.001 * bound);
        assert_true(stiffness < bound);
    }
}

TEST(the_critical_stiffness_grows_with_the_update_rate) {
    static const double rates[] = {2000.0, 4000.0};
    for (size_t i = 0; i < COUNT_OF(rates); i++) {
        const stability_loop loop = {0.072, 0.5, 0.0, 1.0, rates[i]};
        const double bound = 0.5 * rates[i] / 1.5;
        CHECK_CLOSE(found(&loop), bound, 0.02 * bound);
    }
}

/* A mass that is ten times as large swings more slowly; the bound does not know the mass. */
TEST(the_critical_stiffness_does_not_depend_on_the_mass) {
    const stability_loop loop = {0.72, 0.5, 0.0, 1.0, 1000.0};
    CHECK_CLOSE(found(&loop), 1000.0 / 3.0, 0.02 * 1000.0 / 3.0);
}

/* --- energy --- */

TEST(a_slow_hand_gets_back_what_it_gave_where_the_damper_takes_what_the_wall_leaks) {
    static const double known[] = {1000.0, 1000.0 / 3.0, 200.0};
    for (int delay = 0; delay < 3; delay++) {
        const stability_loop loop = {0.072, 0.5, 0.0, delay, 1000.0};
        CHECK_CLOSE(stability_passive_found(&loop, 10.0), known[delay], 0.02 * known[delay]);
    }
}

/* Signals of at most 2000 ticks, all 0. */
static lab_signals make_signals(size_t count) {
    static double rows[3][2000];
    lab_signals s;
    memset(rows, 0, sizeof rows);
    memset(&s, 0, sizeof s);
    s.count = count;
    s.height = rows[0];
    s.motor = rows[1];
    s.texture = rows[2];
    return s;
}

/* Signals of a device that zigzags by one step a tick, the worst motion there is, under the law F = -K x - B dx/dt. */
static double zigzag_gain(double stiffness, double damping, size_t count) {
    const double step = 1e-5;
    const lab_signals s = make_signals(count);
    lab_case c;
    lab_result r;
    lab_case_init(&c);
    memset(&r, 0, sizeof r);
    c.stiffness = stiffness;
    for (size_t i = 0; i < count; i++) {
        const double before = i % 2 > 0 ? 0.5 * step : -0.5 * step;
        s.height[i] = -before;
        if (i + 1 < count) {
            s.motor[i + 1] = -stiffness * s.height[i] - damping * (s.height[i] - before) * 1000.0;
        }
    }
    lab_energies(&c, &s, &r);
    return r.energy / ((double)(count - 1) * step * step * 1000.0); /* over the integral of v^2 */
}

/* Colgate and Schenkel: b > K T/2 + |B|. A damper b absorbs b times the integral of v^2. */
TEST(the_observer_finds_what_a_zigzag_gets_out_of_a_sampled_wall) {
    static const double walls[][2] = {{400.0, 0.0}, {1000.0, 0.0}, {400.0, 2.0}, {2000.0, 5.0}};
    for (size_t i = 0; i < COUNT_OF(walls); i++) {
        const double needed = walls[i][0] * 1e-3 / 2.0 + walls[i][1];
        CHECK_CLOSE(zigzag_gain(walls[i][0], walls[i][1], 2000), needed, 0.01 * needed);
    }
}

/* K dx^2/2 a tick. Both sides are sums over the same signals: the identity is exact if the forces acted as written. */
TEST(a_held_force_gives_half_k_dx_squared_a_tick_more_than_the_spring_took) {
    lab_case c;
    lab_result r;
    lab_case_init(&c);
    c.device = "preset=ideal&viscous=0.5";
    c.grip = lab_grip_named("none");
    c.bilateral = 1;
    c.approach = 0.0;
    assert_int_equal(lab_run(&c, &signals, &r), 0);
    double given = 0.0;
    double leak = 0.0;
    for (size_t i = 1; i < signals.count; i++) {
        const double step = signals.height[i] - signals.height[i - 1];
        given += signals.motor[i] * step;
        leak += 0.5 * c.stiffness * step * step;
    }
    const double first = signals.height[0];
    const double last = signals.height[signals.count - 1];
    CHECK_CLOSE(given + 0.5 * c.stiffness * (last * last - first * first), leak, 1e-9 * leak);
    assert_true(leak > 0.0);
}

/* A texture that lifts a resting device by dH at the force F = K (H - z) puts K [(H' - z)^2 - (H - z)^2]/2 into the
 * spring: that energy is not due to the wall. */
TEST(energy_that_the_texture_put_in_is_authorised) {
    enum { COUNT = 500 };
    const lab_signals s = make_signals(COUNT);
    lab_case c;
    lab_result r;
    lab_case_init(&c);
    memset(&r, 0, sizeof r);
    for (int i = 0; i < COUNT; i++) { /* pressed 1 mm deep; H jumps by 0.2 mm, and the device follows in 0.5 um steps */
        s.texture[i] = i < 10 ? 0.0 : 0.2e-3;
        s.height[i] = i < 10 ? -1e-3 : fmin(-0.8e-3, -1e-3 + 0.5e-6 * (i - 10));
        s.motor[i] = i > 0 ? c.stiffness * (s.texture[i - 1] - s.height[i - 1]) : 0.0;
    }
    lab_energies(&c, &s, &r);
    const double lift = 0.5 * c.stiffness * (1.2e-3 * 1.2e-3 - 1e-3 * 1e-3);
    CHECK_CLOSE(r.energy, lift, 0.01 * lift);
    CHECK_CLOSE(r.unauthorised, 0.0, 0.01 * lift);
}

/* --- quantised walls --- */

static void check_region(double beta, double sigma, int expected) {
    lab_result r;
    memset(&r, 0, sizeof r);
    assert_int_equal(stability_region_run(beta, sigma, &signals, &r), 0);
    assert_int_equal(stability_region_expected(beta, sigma), expected);
    if (r.outcome != expected) {
        fail_msg("beta %g, sigma %g: %s instead of %s", beta, sigma, lab_outcome_name(r.outcome),
                 lab_outcome_name(expected));
    }
}

/* Abbott and Okamura: K <= min(2 b/T, 2 fc/Delta) is beta >= 1/2 and sigma >= 1/2. */
TEST(a_quantised_wall_within_both_bounds_rests) {
    static const double inside[] = {0.6, 1.0, 3.0};
    for (size_t i = 0; i < COUNT_OF(inside); i++) {
        for (size_t j = 0; j < COUNT_OF(inside); j++) {
            check_region(inside[i], inside[j], LAB_REST);
        }
    }
}

TEST(a_quantised_wall_with_too_little_dry_friction_buzzes) {
    static const double betas[] = {0.7, 1.0, 2.0};
    for (size_t i = 0; i < COUNT_OF(betas); i++) {
        check_region(betas[i], 0.1, LAB_LIMIT_CYCLE);
        check_region(betas[i], 0.2, LAB_LIMIT_CYCLE);
    }
}

/* Between a third and a half of the quantum's force there is no rest position either, but the motion is too small to be
 * felt: less than 2 um, against 7 um at 30 Hz. */
TEST(near_the_bound_a_limit_cycle_is_there_and_is_not_felt) {
    lab_result r;
    memset(&r, 0, sizeof r);
    assert_int_equal(stability_region_run(1.0, 0.45, &signals, &r), 0);
    assert_int_equal(r.outcome, LAB_REST);
    assert_true(r.swing > 1e-8 && r.swing < 2e-6);
    assert_int_equal(stability_region_run(1.0, 0.55, &signals, &r), 0);
    assert_true(r.swing < 1e-12);
}

TEST(a_quantised_wall_with_too_little_damping_runs_away) {
    static const double sigmas[] = {0.1, 0.3, 0.7, 2.0};
    for (size_t i = 0; i < COUNT_OF(sigmas); i++) {
        check_region(0.2, sigmas[i], LAB_UNSTABLE);
        check_region(0.35, sigmas[i], LAB_UNSTABLE);
    }
}

/* Damping is short of the bound by a tenth; dry friction holds swings up to 4 fc/((K T/2 - b) pi w): 13 mm. */
TEST(dry_friction_holds_a_fall_that_is_smaller_than_it_can_take) {
    check_region(0.45, 2.0, LAB_REST);
    check_region(0.45, 0.4, LAB_UNSTABLE);
}

/* --- people's walls --- */

/* Dry friction of a device that slides at v acts across its path as fc/v N s/m: 0.5 + 0.26/v + 0.5 of a loose hand. */
TEST(a_device_that_slides_loses_its_rest_where_friction_over_speed_says) {
    static const double speeds[] = {0.15, 0.25};
    for (size_t i = 0; i < COUNT_OF(speeds); i++) {
        const double bound = (1.0 + 0.26 / speeds[i]) / 1.5e-3;
        lab_case c;
        lab_case_init(&c);
        c.device = "preset=touch&resolution=0";
        c.grip = lab_grip_named("loose");
        c.speed = speeds[i];
        CHECK_CLOSE(stability_clean_found(&c, &signals), bound, 0.1 * bound);
    }
}

/* Choi and Tan: 0.325 N/mm at 250 Hz to 0.904 at 40 kHz. Another device, hand and texture: the trend only. */
TEST(the_largest_clean_stiffness_grows_with_the_update_rate) {
    static const double rates[] = {250.0, 500.0, 4000.0};
    double last = 0.0;
    for (size_t i = 0; i < COUNT_OF(rates); i++) {
        lab_case c;
        lab_case_init(&c);
        c.rate = rates[i];
        c.grip = lab_grip_named("loose");
        c.speed = 0.15;
        const double clean = stability_clean_found(&c, &signals);
        assert_true(clean > 1.05 * last);
        last = clean;
    }
}

SUITE_FIXTURES(NULL, drop_signals)
