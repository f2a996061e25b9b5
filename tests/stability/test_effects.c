/* Effects in the laboratory: they run away raw, and rest within the limit. SPDX-License-Identifier: MIT */
#include "lab.h"

#include "support/close.h"

static lab_signals signals;

static int outcome(const char *device, const char *grip, double rate, int32_t effect, double stiffness, double damping,
                   uint32_t without) {
    lab_case c;
    lab_result result;
    lab_case_init(&c);
    c.device = device;
    c.grip = lab_grip_named(grip);
    c.rate = rate;
    c.settle = 1.5;
    c.effect = effect;
    c.stiffness = stiffness;
    c.period = 0.01;
    c.press = effect == KNURL_EFFECT_DETENT ? 0.0 : 1.0;
    c.without = without;
    c.damping = fmin(damping, 1000.0);
    assert_int_equal(lab_run(&c, &signals, &result), 0);
    return result.outcome;
}

static const struct {
    int32_t kind;
    double stiffness, damping;
} stiff[] = {{KNURL_EFFECT_SPRING, 5000.0, 0.5},
             {KNURL_EFFECT_PLANE, 5000.0, 0.5},
             {KNURL_EFFECT_DETENT, 4000.0, 0.5},
             {KNURL_EFFECT_DAMPER, 0.0, 100.0}};

TEST(a_loosely_held_device_shakes_in_stiff_effects_and_rests_within_the_limit) {
    static const char *const devices[] = {"preset=touch", "preset=falcon"};
    for (size_t d = 0; d < COUNT_OF(devices); d++) {
        for (size_t i = 0; i < COUNT_OF(stiff); i++) {
            const double k = stiff[i].stiffness, b = stiff[i].damping;
            assert_true(outcome(devices[d], "loose", 1000.0, stiff[i].kind, k, b, KNURL_PROTECT_ALL) >=
                        LAB_LIMIT_CYCLE);
            assert_int_equal(outcome(devices[d], "loose", 1000.0, stiff[i].kind, k, b, 0), LAB_REST);
        }
    }
}

/* Also late, slow and fast devices, in every hand. */
TEST(the_limit_holds_at_other_rates_and_delays) {
    static const char *const devices[] = {"preset=touch", "preset=touch&delay=4", "preset=touch&delay=8&coulomb=0.05",
                                          "preset=falcon&viscous=0.1&coulomb=0.1"};
    static const double rates[] = {500.0, 2000.0};
    for (size_t d = 0; d < COUNT_OF(devices); d++) {
        for (size_t r = 0; r < COUNT_OF(rates); r++) {
            for (size_t i = 0; i < COUNT_OF(stiff); i++) {
                for (const lab_grip *g = lab_grips + 1; g->name; g++) {
                    assert_true(outcome(devices[d], g->name, rates[r], stiff[i].kind, 10.0 * stiff[i].stiffness,
                                        20.0 * stiff[i].damping, 0) != LAB_UNSTABLE);
                }
            }
        }
    }
    lab_signals_free(&signals);
}
