/* Limits and protections depend on a device's information: each number must be in its range, or the device is not
 * opened. Ranges are from the comments in device.h. SPDX-License-Identifier: MIT */
#include "support/fake.h"
#include "support/idle_device.h"

#include <knurl/hip.h>
#include <knurl/loop.h>
#include <knurl/query.h>

#include <stdio.h>

enum { ZERO = 1, ENDLESS = 2 };

static const struct number {
    const char *name;
    size_t at;
    double least, most, typical;
    int or_else;
    const char *range;
} numbers[] = {
#define NUMBER(field) #field, offsetof(knurl_device_info, field)
    {NUMBER(workspace_min[0]), -1e9, 0.0, -0.1, 0, "-1000000000 to 1000000000 m"},
    {NUMBER(workspace_max[2]), 0.0, 1e9, 0.1, 0, "-1000000000 to 1000000000 m"},
    {NUMBER(resolution), 1e-9, 0.01, 1e-5, ZERO, "0 or 1e-09 to 0.01 m"},
    {NUMBER(max_force), 0.01, 1000.0, 3.0, 0, "0.01 to 1000 N"},
    {NUMBER(delay), 0.0, 16.0, 2.5, 0, "0 to 16 ticks"},
    {NUMBER(continuous_force), 0.01, 1000.0, 0.9, ENDLESS, "INFINITY or 0.01 to 1000 N"},
    {NUMBER(heat_time), 0.001, 1e6, 60.0, 0, "0.001 to 1000000 s"},
    {NUMBER(mass), 0.001, 10.0, 0.1, ZERO, "0 or 0.001 to 10 kg"},
    {NUMBER(viscous), 0.0, 1000.0, 0.5, 0, "0 to 1000 N s/m"},
    {NUMBER(coulomb), 0.0, 10.0, 0.3, 0, "0 to 10 N"},
    {NUMBER(max_stiffness), 1.0, 1e9, 1e3, ENDLESS, "INFINITY or 1 to 1000000000 N/m"},
    {NUMBER(native_rate), 1.0, 1e5, 1e3, ZERO, "0 or 1 to 100000 Hz"},
};

static const struct number *told;
static double told_value;

static void tell(void *user, knurl_device_info *info) {
    (void)user;
    info->max_force = 3.0;
    if (told) {
        memcpy((char *)info + told->at, &told_value, sizeof told_value);
    }
}

static knurl_result open_told(knurl_device **device) {
    knurl_device_functions f = idle_functions();
    f.get_info = tell;
    return knurl_device_open_functions(&f, device);
}

static void check_taken(const struct number *number, double value) {
    SCOPED_DEVICE *device = NULL;
    told = number;
    told_value = value;
    if (open_told(&device)) {
        fail_msg("%s = %g: %s", number->name, value, knurl_error_message());
    }
    knurl_device_info info = device_info(device);
    assert_memory_equal((char *)&info + number->at, &value, sizeof value);
}

static void check_told_is_refused(const struct number *number, double value) {
    knurl_device *device = NULL;
    told = number;
    told_value = value;
    CHECK_REFUSED(open_told(&device), KNURL_ERROR_ARGUMENT, device);
    check_message("device 'custom': knurl_device_info");
    check_message(number->name);
    check_message("found ");
}

TEST(every_number_of_a_device_is_in_its_range_or_the_device_is_not_opened) {
    for (size_t i = 0; i < COUNT_OF(numbers); i++) {
        const struct number *n = &numbers[i];
        const double below = n->least - 1e-3 * (fabs(n->least) + 1e-3), above = n->most + 1e-3 * (fabs(n->most) + 1e-3);
        const double wrong[] = {below, above, -1e300, 1e300, (double)NAN, -(double)INFINITY};
        check_taken(n, n->least);
        check_taken(n, n->typical);
        check_taken(n, n->most);
        for (size_t k = 0; k < COUNT_OF(wrong); k++) {
            check_told_is_refused(n, wrong[k]);
        }
        if (n->or_else != ENDLESS) {
            check_told_is_refused(n, (double)INFINITY);
        } else {
            check_taken(n, (double)INFINITY);
        }
        if (n->or_else == ZERO) {
            check_taken(n, 0.0);
        } else if (n->least > 0.0) {
            check_told_is_refused(n, 0.0);
            check_told_is_refused(n, 5e-324);
        }
        check_told_is_refused(n, (double)NAN);
        check_message(n->range);
    }
}

TEST(the_sentence_says_what_was_expected_and_found) {
    knurl_device *device = NULL;
    for (size_t i = 0; i < COUNT_OF(numbers); i++) {
        if (strcmp(numbers[i].name, "continuous_force") == 0) {
            told = &numbers[i];
        }
    }
    told_value = 5e-324;
    CHECK_REFUSED(open_told(&device), KNURL_ERROR_ARGUMENT, device);
    assert_string_equal(knurl_error_message(),
                        "device 'custom': knurl_device_info.continuous_force: expected INFINITY or "
                        "0.01 to 1000 N, found 4.94066e-324");
}

TEST(a_workspace_is_not_inside_out) {
    knurl_device *device = NULL;
    told = &numbers[0];
    told_value = 0.5;
    CHECK_REFUSED(open_told(&device), KNURL_ERROR_ARGUMENT, device);
    check_message("expected workspace_min[0] up to workspace_max[0], found 0.5 and 0 m");
}

/* Valid at the opening and invalid later: it is not started, and no loop accepts it; valid again, it works. */
TEST(later_changes_of_a_devices_info_are_checked_too) {
    SCOPED_DEVICE *device = NULL;
    knurl_device_info info;
    knurl_loop *loop = NULL;
    knurl_loop_desc desc;
    SCOPED_SCENE *scene = NULL;
    knurl_loop_desc_init(&desc, sizeof desc);
    knurl_device_info_init(&info, sizeof info);
    assert_int_equal(knurl_scene_create(NULL, &scene), KNURL_OK);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    told = NULL;
    assert_int_equal(open_told(&device), KNURL_OK);
    desc.device = device;
    desc.scene = scene;
    for (size_t i = 0; i < COUNT_OF(numbers); i++) {
        told = &numbers[i];
        told_value = (double)NAN;
        CHECK_REFUSED(knurl_loop_create(&desc, &loop), KNURL_ERROR_ARGUMENT, loop);
        check_message(numbers[i].name);
        CHECK_REFUSED(knurl_device_get_info(device, &info), KNURL_ERROR_ARGUMENT, info);
        assert_int_equal(knurl_device_start(device, 1000.0), KNURL_ERROR_ARGUMENT);
    }
    told = NULL;
    assert_int_equal(knurl_loop_create(&desc, &loop), KNURL_OK);
    knurl_loop_destroy(loop);
}

/* --- the fake's keys of the same numbers --- */

TEST(a_fake_device_takes_the_same_ranges) {
    static const struct {
        const char *key, *good, *bad, *range;
    } keys[] = {{"mass", "10", "10.01", "0.001 to 10 kg"},
                {"viscous", "1000", "1001", "0 to 1000 N s/m"},
                {"coulomb", "0", "-0.001", "0 to 10 N"},
                {"resolution", "0", "1e-10", "0 or 1e-09 to 0.01 m"},
                {"max_force", "0.01", "0.009", "0.01 to 1000 N"},
                {"continuous_force", "0", "0.009", "0 or 0.01 to 1000 N"},
                {"continuous_force", "0.01", "1e-22", "0 or 0.01 to 1000 N"},
                {"heat_time", "0.001", "0", "0.001 to 1000000 s"},
                {"max_stiffness", "0", "0.9", "0 or 1 to 1000000000 N/m"},
                {"delay", "16", "1.5", "a whole number from 0 to 16 ticks"},
                {"seed", "4294967295", "4294967296", "a whole number from 0 to 4294967295, "}};
    for (size_t i = 0; i < COUNT_OF(keys); i++) {
        char uri[64];
        knurl_device *device = NULL;
        (void)snprintf(uri, sizeof uri, "fake:?%s=%s", keys[i].key, keys[i].bad);
        CHECK_REFUSED(knurl_device_open(uri, &device), KNURL_ERROR_ARGUMENT, device);
        check_message(keys[i].key);
        check_message(keys[i].range);
        check_message(keys[i].bad);
        (void)snprintf(uri, sizeof uri, "fake:?%s=%s", keys[i].key, keys[i].good);
        knurl_device_close(open_device(uri));
    }
}

TEST(every_preset_of_the_fake_device_is_within_them) {
    static const char *const presets[] = {"touch", "falcon", "woodenhaptics", "omega", "inverse3", "ideal"};
    for (size_t i = 0; i < COUNT_OF(presets); i++) {
        char uri[64];
        (void)snprintf(uri, sizeof uri, "fake:?preset=%s", presets[i]);
        knurl_device_close(open_device(uri));
    }
}
