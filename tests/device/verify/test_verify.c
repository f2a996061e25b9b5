/* knurl verify passes simulated devices that are well, and finds and names each planted defect.
 * SPDX-License-Identifier: MIT */
#include "device/verify/planted.h"

#include "base/system.h"
#include "device/doubles.h"
#include "support/close.h"

#include <stdio.h>
#include <stdlib.h>

#define MASS 0.05 /* kg */

static verify v;

/* The step that finds each defect, and the words that name it. */
static const struct {
    const char *step, *words;
} named[DEFECTS] = {{"", ""},
                    {"axes", "swapped axis: it reads as"},
                    {"scale", "half gain"},
                    {"latency", "late by"},
                    {"friction", "sticky joint"},
                    {"noise", "noisy encoder"},
                    {"signs", "wrong sign: it moves along -y"}};

static const char *const presets[] = {"touch", "falcon", "woodenhaptics", "omega", "inverse3"};

#define PRESETS (SUITE_SANITIZED ? 1 : COUNT_OF(presets))

static const char *fake_uri(size_t preset) {
    static char uri[128];
    (void)snprintf(uri, sizeof uri, "fake:?preset=%s&tremor=0&lose_at=150", presets[preset]);
    return uri;
}

static void print_failures(const char *name) {
    print_error("%s: %d passed, %d failed\n", name, verify_count(&v, VERIFY_PASS), verify_count(&v, VERIFY_FAIL));
    for (int i = 0; i < v.finding_count; i++) {
        const verify_finding *f = &v.findings[i];
        if (f->verdict != VERIFY_PASS) {
            print_error("%s: %s: %.4g, expected %.4g to %.4g: %s\n", f->step, f->what, f->measured, f->least, f->most,
                        f->note);
        }
    }
}

/* Nothing failed, and no more than the steps in `allowed` were not measured. */
static void check_well(const char *name, const char *allowed, int passes) {
    int is_well = verify_count(&v, VERIFY_FAIL) == 0 && verify_count(&v, VERIFY_PASS) >= passes;
    for (int i = 0; i < v.finding_count; i++) {
        is_well &= v.findings[i].verdict != VERIFY_NOT_MEASURED || strstr(allowed, v.findings[i].step) != NULL;
    }
    if (!is_well) {
        print_failures(name);
    }
    assert_true(is_well);
}

static int is_named(planted_defect defect) {
    int found = 0;
    for (int i = 0; i < v.finding_count; i++) {
        const verify_finding *f = &v.findings[i];
        found |= f->verdict == VERIFY_FAIL && strcmp(f->step, named[defect].step) == 0 &&
                 strstr(f->note, named[defect].words) != NULL;
    }
    return found;
}

static void check_named(planted_defect defect, const char *name) {
    if (!is_named(defect)) {
        print_failures(name);
        fail_msg("%s: %s was not found", name, planted_names[defect]);
    }
}

/* Time is simulated, no fake device measures an orientation or has a stop. */
TEST(fake_devices_that_are_well_pass_every_step) {
    for (size_t i = 0; i < PRESETS; i++) {
        planted_run(&v, fake_uri(i), NULL, CLEAN, NULL, NULL, MASS);
        check_well(presets[i], "rate orientation faults", 20);
        assert_true(v.response.row_count > 5);
    }
}

TEST(each_planted_defect_of_a_fake_device_is_found_and_named) {
    for (size_t i = 0; i < PRESETS; i++) {
        for (planted_defect d = CLEAN + 1; d < DEFECTS; d++) {
            planted_run(&v, fake_uri(i), NULL, d, NULL, "response,faults", MASS);
            check_named(d, presets[i]);
        }
    }
}

static void try_defects(const device_double *through) {
    for (planted_defect d = CLEAN + 1; d < DEFECTS; d++) {
        planted_run(&v, NULL, through, d, named[d].step, NULL, MASS);
        check_named(d, through->name);
    }
}

/* A caller's functions have no mechanics in their double. One test, because the stand-ins for the makers' libraries can
 * only be loaded in turn: static TLS has no room for two, nor for the Touch's after Force Dimension's, which stays. */
TEST(every_driver_passes_over_its_double_and_planted_defects_are_found_through_it) {
    const int is_long = getenv("KNURL_LONG") != NULL;
    for (size_t i = 0; i < (SUITE_SANITIZED ? 2 : double_count); i++) {
        if (doubles[i]->hold) {
            planted_run(&v, NULL, doubles[i], CLEAN, is_long ? NULL : "signs,faults", NULL, MASS);
            check_well(doubles[i]->name, "orientation faults", is_long ? 21 : 5);
        }
        if (doubles[i]->hold && (is_long || i == 0)) { /* 10 s each */
            try_defects(doubles[i]);
        }
    }
}

/* Its driver's own check finds it, or verify does: one of a Falcon's three motors turns several axes. */
TEST(motors_that_are_backwards_are_found_and_nothing_pushes_after) {
    int told = 0;
    for (size_t i = 0; i < double_count; i++) {
        if (doubles[i]->open_backwards) {
            device_double backwards = *doubles[i];
            backwards.open = backwards.open_backwards;
            planted_run(&v, NULL, &backwards, CLEAN, "signs,friction", NULL, MASS);
            const verify_finding *last = &v.findings[v.finding_count - 1];
            told += strncmp(v.findings[0].note, "backwards_", 10) == 0;
            assert_true(verify_count(&v, VERIFY_FAIL) > 0);
            assert_true(strcmp(last->step, "friction") == 0 && last->verdict == VERIFY_NOT_MEASURED);
        }
    }
    assert_int_equal(told, 2); /* a WoodenHaptics', by either wire */
}

/* --- numbers, by equations: a mass of 0.2 kg held by 700 N/m, without a quantum --- */

static double measured(const char *uri, planted_defect defect, const char *step) {
    planted_run(&v, uri, NULL, defect, step, NULL, MASS);
    assert_true(v.finding_count > 0);
    return v.findings[0].measured;
}

#define EXACT "fake:?mass=0.2&resolution=0&tremor=0&viscous=0&exact=1&max_force=10&continuous_force=10"

TEST(a_latency_grows_by_a_tick_with_each_tick_of_delay) {
    const double none = measured(EXACT "&coulomb=0&delay=0", CLEAN, "latency");
    CHECK_CLOSE(measured(EXACT "&coulomb=0&delay=2", CLEAN, "latency"), none + 2.0, 0.3);
    CHECK_CLOSE(measured(EXACT "&coulomb=0&delay=9", CLEAN, "latency"), none + 9.0, 0.3);
}

/* 0.1 mm of motion is taken for one: that takes up to 0.07 N of the hand's spring. */
TEST(a_friction_is_the_dry_friction_and_at_most_the_springs_share) {
    CHECK_CLOSE(measured(EXACT "&coulomb=0.3", CLEAN, "friction"), 0.335, 0.04);
    CHECK_CLOSE(measured(EXACT "&coulomb=0", CLEAN, "friction"), 0.035, 0.05);
    CHECK_CLOSE(measured(EXACT "&coulomb=0", STICKY_JOINT, "friction"), 0.635, 0.04);
}

/* Of an even distribution of 0.6 mm: 0.6 / sqrt(12). */
TEST(a_noise_is_its_rms) {
    CHECK_CLOSE(measured(EXACT, NOISY_ENCODER, "noise"), 0.6 / sqrt(12.0), 0.005);
    CHECK_CLOSE(measured(EXACT, CLEAN, "noise"), 0.0, 1e-6);
}

TEST(a_scale_is_that_of_the_force) {
    CHECK_CLOSE(measured(EXACT "&coulomb=0.3", HALF_GAIN, "scale"), 0.5, 0.005);
    CHECK_CLOSE(measured(EXACT "&coulomb=0.3", CLEAN, "scale"), 1.0, 0.01);
}

/* A gain that weighs nothing is unknown, and not the friction's. */
TEST(a_mass_that_was_not_hung_leaves_the_scale_unknown) {
    planted_without_mass = 1;
    planted_run(&v, EXACT "&coulomb=0.3", NULL, CLEAN, "scale,friction", NULL, MASS);
    planted_without_mass = 0;
    assert_int_equal(v.finding_count, 2);
    assert_int_equal(v.findings[0].verdict, VERIFY_NOT_MEASURED);
    CHECK_CLOSE(v.findings[1].measured, 0.335, 0.04);
}

/* A held mass without dry friction is stable below K = b/(T/2 + td), less the hand's spring; a step of the search is a
 * quarter. */
TEST(the_stiffest_wall_is_that_of_a_sampled_spring) {
    for (int delay = 0; delay <= 2; delay++) {
        char uri[256];
        (void)snprintf(uri, sizeof uri, EXACT "&coulomb=0&delay=%d", delay);
        const double bound = 5.0 / (0.0005 + 0.001 * delay);
        const double found = measured(uri, CLEAN, "wall");
        print_message("delay %d: %.0f N/m, the bound is %.0f\n", delay, found, bound);
        assert_true(found > bound / 1.25 / 1.25 && found < 1.25 * bound);
    }
}

/* --- safety --- */

TEST(no_force_is_above_1_newton_but_while_a_mass_is_weighed) {
    for (planted_defect d = CLEAN; d < DEFECTS; d++) {
        planted_run(&v, EXACT, NULL, d, NULL, "response,faults", MASS);
        assert_true(planted_strongest(0) > 0.5 && planted_strongest(0) <= VERIFY_FORCE + 1e-12);
        assert_true(planted_strongest(1) <= VERIFY_WEIGHING + 1e-12);
        CHECK_SAME(v.limit, VERIFY_FORCE); /* again, after the weighing */
    }
}

TEST(a_device_that_can_hold_less_gets_less) {
    planted_run(&v, "fake:?max_force=0.5&tremor=0", NULL, CLEAN, "signs,friction,latency,wall", NULL, MASS);
    assert_true(planted_strongest(0) <= 0.5 + 1e-12);
}

TEST(nothing_pushes_after_a_wrong_sign_and_no_latency_is_told_of_a_sticky_joint) {
    planted_run(&v, EXACT, NULL, WRONG_SIGN, "signs,scale,friction,latency,wall,response,faults", NULL, MASS);
    assert_int_equal(v.finding_count, 3 + 6);
    for (int i = 3; i < v.finding_count; i++) {
        assert_string_equal(v.findings[i].note, "the signs of the force have to be right first");
    }
    planted_run(&v, EXACT, NULL, STICKY_JOINT, "friction,latency", NULL, MASS);
    assert_string_equal(v.findings[1].note, "a joint sticks, which comes first");
    planted_run(&v, EXACT, NULL, NOISY_ENCODER, "noise,latency", NULL, MASS);
    assert_string_equal(v.findings[1].note, "positions are noisy, which comes first");
}

static double play_once(verify *on) {
    return verify_play(on, 0.1, NULL) ? NAN : 1.0;
}

/* Another loop has the device. */
TEST(a_measurement_that_could_not_be_made_says_why) {
    static volatile sig_atomic_t interrupted;
    double measured = 0.0;
    double expected = 0.0;
    double none[3] = {0.0, 0.0, 0.0};
    knurl_loop *loop = NULL;
    memset(&v, 0, sizeof v);
    v.interrupted = &interrupted;
    v.simulated = 1;
    assert_int_equal(verify_open("fake", &v.device), KNURL_OK);
    const knurl_loop_desc desc = push_desc(v.device, none);
    assert_int_equal(knurl_loop_create(&desc, &loop), KNURL_OK);
    assert_non_null(strstr(verify_compare(&v, NULL, play_once, &measured, &expected), "in use by another loop"));
    knurl_loop_destroy(loop);
    knurl_device_close(v.device);
}

static const device_double *unhomed;

static knurl_device *open_after_a_fault(void) {
    knurl_device *device = unhomed->open();
    for (int fault = DOUBLE_UNHOMED; fault >= DOUBLE_WELL; fault -= DOUBLE_UNHOMED) {
        unhomed->inject(fault);
        knurl_system_sleep_until_ns(knurl_system_now_ns() + 50000000);
    }
    return device;
}

TEST(faults_from_before_a_step_are_not_its_own) {
    for (size_t i = 0; i < double_count; i++) {
        unhomed = strcmp(doubles[i]->name, "falcon") == 0 ? doubles[i] : unhomed;
    }
    assert_non_null(unhomed);
    device_double device = *unhomed;
    device.open = open_after_a_fault;
    planted_run(&v, NULL, &device, CLEAN, "noise", NULL, MASS);
    check_well("falcon", "", 1);
}

TEST(an_interruption_ends_all_steps_and_keeps_what_was_found) {
    planted_interrupts_at = 5000; /* in the second of the signs: 1.5 s before, 2.4 s each */
    planted_run(&v, EXACT, NULL, CLEAN, "signs,friction,wall,faults", NULL, MASS);
    planted_interrupts_at = 0;
    assert_int_equal(v.finding_count, 5);
    assert_int_equal(v.findings[0].verdict, VERIFY_PASS);
    for (int i = 1; i < v.finding_count; i++) {
        assert_int_equal(v.findings[i].verdict, VERIFY_NOT_MEASURED);
        assert_string_equal(v.findings[i].note, "stopped");
    }
}
