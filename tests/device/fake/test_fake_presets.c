/* The fake device's presets, its information, and its true state. SPDX-License-Identifier: MIT */
#include "support/close.h"
#include "support/fake.h"

#include "device/rawhid/geometry.h"

#include <locale.h>
#include <stdio.h>

static knurl_device_info info_of(const char *uri) {
    knurl_device *device = open_device(uri);
    const knurl_device_info info = device_info(device);
    knurl_device_close(device);
    return info;
}

static knurl_fake_truth truth_of(const knurl_device *device) {
    knurl_fake_truth truth;
    assert_int_equal(knurl_fake_get_truth(device, &truth), KNURL_OK);
    return truth;
}

TEST(the_default_is_the_touch_and_says_so) {
    static const char *const uris[] = {"fake", "fake:?preset=touch", "fake:?mass=1&preset=touch", "fake:?hand_mass=1"};
    for (size_t i = 0; i < COUNT_OF(uris); i++) {
        const knurl_device_info info = info_of(uris[i]);
        assert_string_equal(info.name, "fake (a simulated Touch in a simulated hand)");
        CHECK_SAME(info.max_force, 3.3);
        CHECK_SAME(info.continuous_force, 0.88);
        CHECK_SAME(info.max_stiffness, 1020.0);
        CHECK_SAME(info.mass, 0.045); /* the device's alone */
        CHECK_SAME(info.viscous, 0.5);
        CHECK_SAME(info.coulomb, 0.26);
        assert_true(info.heat_time > 0.0);
    }
}

TEST(a_falcon_is_not_a_touch) {
    const knurl_device_info info = info_of("fake:?preset=falcon");
    assert_string_equal(info.name, "fake (a simulated Falcon in a simulated hand)");
    CHECK_SAME(info.max_force, 8.9);
    CHECK_SAME(info.resolution, 0.06e-3);
    CHECK_SAME(info.max_stiffness, 3000.0);
    CHECK_SAME(info.delay, 2.0);
    for (int axis = 0; axis < 3; axis++) {
        CHECK_CLOSE(info.workspace_max[axis] - info.workspace_min[axis], 4 * 0.0254, 1e-12);
    }
}

/* From CHAI3D's figures. The workspace is the cube in a sphere of that radius. */
TEST(a_wooden_haptics_and_an_omega_are_as_chai3d_has_them) {
    static const struct {
        const char *uri;
        double max_force, max_stiffness, radius;
    } table[] = {{"fake:?preset=woodenhaptics", 3.0, 1000.0, 0.1}, {"fake:?preset=omega", 12.0, 5000.0, 0.075}};
    for (size_t i = 0; i < COUNT_OF(table); i++) {
        const knurl_device_info info = info_of(table[i].uri);
        CHECK_SAME(info.max_force, table[i].max_force);
        CHECK_SAME(info.max_stiffness, table[i].max_stiffness);
        CHECK_CLOSE(info.workspace_max[0], table[i].radius / sqrt(3.0), 0.00006);
        assert_true(info.continuous_force < info.max_force);
    }
}

/* The same information as from the real driver of that device, so that results carry over. */
TEST(a_simulated_wooden_haptics_is_what_its_driver_tells) {
    knurl_rawhid_geometry g;
    knurl_rawhid_arm arm;
    const knurl_device_info info = info_of("fake:?preset=woodenhaptics");
    knurl_rawhid_geometry_init(&g);
    knurl_rawhid_arm_init(&arm, &g);
    CHECK_SAME(info.max_force, g.max_force);
    CHECK_SAME(info.continuous_force, g.continuous_force);
    CHECK_SAME(info.mass, g.mass);
    CHECK_SAME(info.viscous, g.viscous);
    CHECK_SAME(info.coulomb, g.coulomb);
    CHECK_CLOSE(info.resolution, knurl_rawhid_resolution(&arm), 0.000005);
}

TEST(an_ideal_device_has_no_friction_quantum_delay_or_limit_worth_the_name) {
    const knurl_device_info info = info_of("fake:?preset=ideal");
    CHECK_SAME(info.viscous, 0.0);
    CHECK_SAME(info.coulomb, 0.0);
    CHECK_SAME(info.resolution, 0.0);
    CHECK_SAME(info.delay, 0.0);
    assert_true(info.max_force >= 1000.0);
    assert_true(isinf(info.continuous_force) && isinf(info.max_stiffness));
}

TEST(keys_after_a_preset_count_and_keys_before_it_do_not) {
    CHECK_SAME(info_of("fake:?preset=falcon&mass=0.3").mass, 0.3);
    CHECK_SAME(info_of("fake:?mass=0.3&preset=falcon").mass, 0.2);
    CHECK_SAME(info_of("fake:?preset=falcon&preset=touch").max_force, 3.3);
    CHECK_SAME(info_of("fake:?preset=ideal&continuous_force=0.5&heat_time=3").continuous_force, 0.5);
    CHECK_SAME(info_of("fake:?heat_time=3").heat_time, 3.0);
}

TEST(every_preset_is_taken_and_named_by_the_help) {
    static const char *const names[] = {"touch", "falcon", "woodenhaptics", "omega", "inverse3", "ideal"};
    char uri[64];
    char listed[64];
    for (size_t i = 0; i < COUNT_OF(names); i++) {
        (void)snprintf(uri, sizeof uri, "fake:?preset=%s", names[i]);
        (void)snprintf(listed, sizeof listed, "%s, ", names[i]);
        (void)info_of(uri);
        assert_non_null(strstr(knurl_fake_keys(), listed));
    }
}

TEST(an_unknown_preset_is_refused) {
    static const char *const bad[] = {"fake:?preset=delta", "fake:?preset=", "fake:?preset",      "fake:?preset=Touch",
                                      "fake:?exact=0.5",    "fake:?exact=2", "fake:?hand_mass=-1"};
    struct {
        knurl_device *device;
    } out = {NULL};
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        CHECK_REFUSED(knurl_device_open(bad[i], &out.device), KNURL_ERROR_ARGUMENT, out);
    }
    CHECK_REFUSED(knurl_device_open("fake:?preset=delta", &out.device), KNURL_ERROR_ARGUMENT, out);
    check_message("expected one of touch, falcon, woodenhaptics, omega, inverse3, ideal, found 'delta'");
}

/* x = F t^2 / 2 (m + hand's m). */
TEST(the_hands_mass_moves_with_the_device) {
    SCOPED_DEVICE *device = open_device("fake:?preset=ideal&hand_stiffness=0&hand_damping=0&mass=0.05&hand_mass=0.15");
    static const double force[3] = {0.2, 0.0, 0.0};
    stand(device);
    for (int tick = 0; tick <= 200; tick++) {
        (void)read_one(device);
        CHECK_CLOSE(truth_of(device).position[0], 0.5 * 1e-6 * tick * tick, 1e-12);
        assert_int_equal(knurl_device_write(device, force), KNURL_OK);
    }
}

TEST(a_reading_is_the_true_position_to_the_nearest_quantum) {
    SCOPED_DEVICE *device = open_device("fake");
    for (int tick = 0; tick < 1000; tick++) {
        const knurl_device_sample sample = read_one(device);
        const knurl_fake_truth truth = truth_of(device);
        for (int axis = 0; axis < 3; axis++) {
            CHECK_CLOSE(sample.position[axis], truth.position[axis], 0.5 * 0.055e-3 * (1.0 + 1e-9));
        }
    }
}

/* Written at tick n, it acts from the reading n + 1 + delay on; limited. */
TEST(the_motors_force_is_the_one_that_acted_delayed_and_limited) {
    for (int delay = 0; delay <= 4; delay++) {
        char uri[100];
        (void)snprintf(uri, sizeof uri, "fake:?delay=%d&tremor=0", delay);
        SCOPED_DEVICE *device = open_device(uri);
        stand(device);
        for (int tick = 0; tick < 40; tick++) {
            (void)read_one(device);
            const double written = (tick - 1 - delay) % 7 == 3 ? 3.3 : 0.5;
            CHECK_CLOSE(truth_of(device).motor[1], tick > delay ? written : 0.0, 1e-12);
            const double force[3] = {0.0, tick % 7 == 3 ? 9.0 : 0.5, 0.0};
            assert_int_equal(knurl_device_write(device, force), KNURL_OK);
        }
    }
}

/* At rest the hand's force equals the motors', without dry friction exactly. */
TEST(the_hands_force_balances_the_motors_at_rest) {
    static const double force[3] = {0.3, 0.8, -0.2};
    SCOPED_DEVICE *device = open_device("fake:?coulomb=0&tremor=0&exact=1");
    stand(device);
    for (int tick = 0; tick < 3000; tick++) {
        (void)read_one(device);
        assert_int_equal(knurl_device_write(device, force), KNURL_OK);
    }
    const knurl_fake_truth truth = truth_of(device);
    for (int axis = 0; axis < 3; axis++) {
        CHECK_CLOSE(truth.hand[axis], -force[axis], 1e-9);
        CHECK_CLOSE(truth.velocity[axis], 0.0, 1e-12);
    }
}

/* The work of motors, hand and viscous friction equals the mass's energy, under an oscillating force. */
TEST(the_true_state_keeps_the_books_of_energy) {
    SCOPED_DEVICE *device = open_device("fake:?preset=ideal&viscous=0.4&mass=0.1");
    stand(device);
    assert_int_equal(knurl_device_start(device, 10000.0), KNURL_OK);
    (void)read_one(device);
    knurl_fake_truth last = truth_of(device);
    double motors = 0.0;
    double hand = 0.0;
    double taken = 0.0;
    for (int tick = 0; tick < 10000; tick++) {
        const double force[3] = {0.0, sin(2e-3 * tick), 0.0};
        assert_int_equal(knurl_device_write(device, force), KNURL_OK);
        (void)read_one(device);
        const knurl_fake_truth now = truth_of(device);
        motors += now.motor[1] * (now.position[1] - last.position[1]);
        hand += 0.5 * (now.hand[1] + last.hand[1]) * (now.position[1] - last.position[1]);
        taken += 0.4 * 0.5 * (now.velocity[1] * now.velocity[1] + last.velocity[1] * last.velocity[1]) / 10000.0;
        last = now;
    }
    CHECK_CLOSE(motors + hand, taken + 0.05 * last.velocity[1] * last.velocity[1], 3e-3 * taken); /* trapezia */
    assert_true(taken > 1e-4);
}

TEST(a_trace_has_no_true_state) {
    static const double rows[8] = {0.0, 0.0, 0.0, 0.0, 1.0, 0.1, 0.0, 0.0};
    SCOPED_DEVICE *device = open_device("fake");
    knurl_fake_truth truth;
    memset(&truth, 0x5a, sizeof truth);
    const knurl_fake_truth before = truth;
    assert_int_equal(knurl_fake_set_trace(device, rows, 2), KNURL_OK);
    assert_int_equal(knurl_fake_get_truth(device, &truth), KNURL_ERROR_UNSUPPORTED);
    assert_memory_equal(&truth, &before, sizeof truth);
}

/* Regression: it grew without bound. */
TEST(a_light_device_in_a_stiff_hand_stays_where_it_is_held) {
    SCOPED_DEVICE *device = open_device("fake:?mass=0.001&hand_damping=100&tremor=0&coulomb=0");
    stand(device);
    for (int tick = 0; tick < 2000; tick++) {
        (void)read_one(device);
    }
    CHECK_CLOSE(truth_of(device).position[1], -0.001, 1e-6);
}

/* A host may have set its user's locale, in which strtod() wants a comma. */
TEST(numbers_are_read_alike_in_every_locale) {
    static const char *const names[] = {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8", "ru_RU.UTF-8", "es_ES.UTF-8"};
    const char *taken = NULL;
    for (size_t i = 0; i < sizeof names / sizeof *names && !taken; i++) {
        taken = setlocale(LC_ALL, names[i]);
    }
    if (!taken) {
        print_message("skipped: no locale with a comma in its numbers is installed\n");
        skip();
    }
    SCOPED_DEVICE *device = NULL;
    const knurl_result result = knurl_device_open("fake:?preset=falcon&max_force=7.25", &device);
    (void)setlocale(LC_ALL, "C");
    assert_int_equal(result, KNURL_OK);
    const knurl_device_info info = device_info(device);
    assert_true(info.max_force == 7.25);
    assert_true(info.workspace_max[0] < 0.06); /* the Falcon's, not the Touch's 0.08 */
}
