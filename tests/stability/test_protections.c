/* The passivity controller in the laboratory: what runs away is stopped, what is calm is left alone to the bit.
 * SPDX-License-Identifier: MIT */
#include "support/close.h"

#include "runaways.h"

#define PASSIVITY_ONLY (KNURL_UNGUARDED_ALL & ~(uint32_t)KNURL_UNGUARDED_PASSIVITY)
#define STOPPED        2.5 /* s after the hand has come down */

static lab_signals signals;
static lab_signals others;

static lab_result run(const lab_case *c, lab_signals *into) {
    lab_result r;
    memset(&r, 0, sizeof r);
    if (lab_run(c, into, &r)) {
        fail_msg("%s", knurl_error_message());
    }
    return r;
}

static int drop_signals(void **state) {
    (void)state;
    lab_signals_free(&signals);
    lab_signals_free(&others);
    return 0;
}

/* m from the lowest to the highest over the last quarter of a second. */
static double late_swing(const lab_signals *s, const double *values) {
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    for (size_t i = s->count - 250; i < s->count; i++) {
        low = fmin(low, values[i]);
        high = fmax(high, values[i]);
    }
    return high - low;
}

/* A runaway bounces off its wall: force between nothing and newtons. Stopped: half of it at most is left, of a force
 * that the same run has without the controller, and the laboratory no longer calls it unstable. */
TEST(every_runaway_at_a_devices_own_limits_is_stopped_by_the_defaults) {
    for (size_t i = 0; i < COUNT_OF(runaways); i++) {
        lab_case c = runaway_case(&runaways[i], KNURL_UNGUARDED_ALL);
        c.settle = STOPPED;
        assert_int_equal(run(&c, &others).outcome, LAB_UNSTABLE);
        c.unguarded = 0;
        const lab_result r = run(&c, &signals);
        uint64_t acted = 0;
        size_t first = 0;
        for (size_t k = 0; k < signals.count; k++) {
            const int acts = (signals.flags[k] & KNURL_TICK_PASSIVITY) != 0;
            first = acts && !acted ? k : first;
            acted += (uint64_t)acts;
        }
        print_message(
            "%s, %s, method %d, %g N/m, %g m/s: acts %g s after the hand began to come down; force swing %.2f N "
            "instead of %.2f N, motion %.2f mm instead of %.2f mm: %s\n",
            runaways[i].device, runaways[i].grip, (int)runaways[i].method, runaways[i].stiffness, runaways[i].speed,
            0.001 * (double)first, late_swing(&signals, signals.written), late_swing(&others, others.written),
            1e3 * late_swing(&signals, signals.height), 1e3 * late_swing(&others, others.height),
            lab_outcome_name(r.outcome));
        assert_true(acted > 0);
        assert_int_not_equal(r.outcome, LAB_UNSTABLE);
    }
}

static const char *const devices[] = {"preset=touch", "preset=falcon"};
static const double most[] = {1020.0, 3000.0}; /* N/m: what their makers promise */
static const char *const grips[] = {"loose", "light", "medium", "firm"};
static const int32_t methods[] = {KNURL_METHOD_DEFAULT, KNURL_S1, KNURL_S2, KNURL_LOCKED}; /* the first: a flat wall */
static const double speeds[] = {0.01, 0.05, 0.1, 0.3};

/* Runs raw, and where that is calm with the controller: the same forces. Returns 1 where it was calm. */
static int compare(size_t device, const char *grip, int32_t method, double speed, double stiffness) {
    lab_case c;
    lab_case_init(&c);
    c.device = devices[device];
    c.grip = lab_grip_named(grip);
    c.method = method;
    c.stiffness = stiffness;
    c.amplitude = method == KNURL_METHOD_DEFAULT ? 0.0 : 0.0002;
    c.speed = speed;
    if (run(&c, &others).outcome > LAB_VIBRATION) {
        return 0;
    }
    c.unguarded = PASSIVITY_ONLY;
    (void)run(&c, &signals);
    if (memcmp(signals.written, others.written, signals.count * sizeof *signals.written) != 0) {
        fail_msg("%s, %s, method %d, %g m/s, %g N/m: not the same forces", devices[device], grip, (int)method, speed,
                 stiffness);
    }
    return 1;
}

TEST(calm_walls_and_textures_are_left_alone_to_the_bit) {
    int calm = 0;
    for (size_t i = 0; i < COUNT_OF(devices) * COUNT_OF(grips) * COUNT_OF(methods) * COUNT_OF(speeds); i++) {
        const size_t device = i % COUNT_OF(devices);
        const size_t grip = i / COUNT_OF(devices) % COUNT_OF(grips);
        const size_t method = i / (COUNT_OF(devices) * COUNT_OF(grips)) % COUNT_OF(methods);
        const size_t speed = i / (COUNT_OF(devices) * COUNT_OF(grips) * COUNT_OF(methods));
        for (int row = 0; row < 4; row++) {
            const double stiffness = 100.0 * pow(most[device] / 100.0, row / 3.0);
            calm += compare(device, grips[grip], methods[method], speeds[speed], stiffness);
        }
    }
    print_message("%d of 512 cases are calm, and left alone\n", calm);
    assert_true(calm > 400);
}

/* An account that fills slowly must not be raised by something as quick as a tap on a wall that friction keeps passive.
 */
TEST(a_hard_tap_on_a_passive_wall_is_left_alone) {
    lab_case c;
    lab_case_init(&c);
    c.grip = lab_grip_named("light");
    c.stiffness = 660.0; /* (0.5 + 0.5 N s/m)/1.5 ms is 667 N/m */
    c.approach = 0.25;
    c.press = 1.0;
    (void)run(&c, &others);
    c.unguarded = PASSIVITY_ONLY;
    (void)run(&c, &signals);
    assert_memory_equal(signals.written, others.written, signals.count * sizeof *signals.written);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(every_runaway_at_a_devices_own_limits_is_stopped_by_the_defaults, drop_signals),
        cmocka_unit_test_teardown(calm_walls_and_textures_are_left_alone_to_the_bit, drop_signals),
        cmocka_unit_test_teardown(a_hard_tap_on_a_passive_wall_is_left_alone, drop_signals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
