/* A device of a caller's functions: required functions, failures, and its information. Its operation: test_functions.c.
 * SPDX-License-Identifier: MIT */
#include "home.h"

#include "device/driver.h"

#include <pthread.h>

static home h; /* reset by each test */

/* --- failures of the system; linked with --wrap --- */

static int refuse_memory;
static int refuse_threads;

void *__real_calloc(size_t count, size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_calloc(size_t count, size_t size) {
    return refuse_memory ? NULL : __real_calloc(count, size);
}

int __real_pthread_create(pthread_t *thread, const pthread_attr_t *how, void *(*entry)(void *), void *argument);
int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *how, void *(*entry)(void *), void *argument);
int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *how, void *(*entry)(void *), void *argument) {
    return refuse_threads ? 11 /* EAGAIN */ : __real_pthread_create(thread, how, entry, argument);
}

/* --- required functions --- */

TEST(a_function_that_is_required_and_missing_is_named) {
    static const char *const names[] = {"get_info", "read", "write"};
    for (size_t i = 0; i < COUNT_OF(names); i++) {
        knurl_device *device = NULL;
        memset(&h, 0, sizeof h);
        knurl_device_functions f = home_functions(&h, (uint32_t)i % 2);
        f.get_info = i == 0 ? NULL : f.get_info;
        f.read = i == 1 ? NULL : f.read;
        f.write = i == 2 ? NULL : f.write;
        CHECK_REFUSED(knurl_device_open_functions(&f, &device), KNURL_ERROR_ARGUMENT, device);
        check_message(names[i]);
        assert_int_equal(h.order, 0); /* nothing was called */
    }
}

/* A force is played for 10 ms at most, which must span two ticks. */
TEST(blocking_devices_need_200_ticks_a_second) {
    knurl_device *device = home_open(&h, 1);
    char nothing = 0;
    CHECK_REFUSED(knurl_device_start(device, 199.0), KNURL_ERROR_UNSUPPORTED, nothing);
    check_message("200");
    assert_int_equal(h.starts, 1); /* the refused start was not passed on */
    assert_int_equal(knurl_device_start(device, 200.0), KNURL_OK);
    knurl_device_close(device);
    device = home_open(&h, 0);
    assert_int_equal(knurl_device_start(device, 100.0), KNURL_OK);
    knurl_device_close(device);
}

static double told_force; /* the max_force of the next one */

static void tell_force(void *user, knurl_device_info *info) {
    (void)user;
    info->max_force = told_force;
}

TEST(a_force_must_be_promised) {
    static const double wrong[] = {0.0, -1.0, (double)NAN, (double)INFINITY};
    for (size_t i = 0; i < COUNT_OF(wrong); i++) {
        knurl_device *device = NULL;
        memset(&h, 0, sizeof h);
        knurl_device_functions f = home_functions(&h, 1);
        f.get_info = tell_force;
        told_force = wrong[i];
        CHECK_REFUSED(knurl_device_open_functions(&f, &device), KNURL_ERROR_ARGUMENT, device);
        check_message("max_force");
        assert_int_equal(h.order, 0);
    }
}

TEST(an_uninitialised_struct_is_refused) {
    knurl_device *device = NULL;
    struct {
        knurl_device_functions functions;
        uint64_t beyond;
    } newer;
    memset(&h, 0, sizeof h);
    memset(&newer, 0, sizeof newer);
    CHECK_REFUSED(knurl_device_open_functions(NULL, &device), KNURL_ERROR_ARGUMENT, device);
    CHECK_REFUSED(knurl_device_open_functions(&newer.functions, &device), KNURL_ERROR_ARGUMENT, device);
    newer.functions = home_functions(&h, 0);
    newer.functions.struct_size = sizeof newer;
    newer.beyond = 1;
    CHECK_REFUSED(knurl_device_open_functions(&newer.functions, &device), KNURL_ERROR_UNSUPPORTED, device);
}

TEST(without_memory_or_threads_it_is_an_error_and_nothing_is_left_behind) {
    for (int i = 0; i < 2; i++) {
        knurl_device *device = NULL;
        memset(&h, 0, sizeof h);
        const knurl_device_functions f = home_functions(&h, 1);
        refuse_memory = i == 0;
        refuse_threads = i == 1;
        const knurl_result result = knurl_device_open_functions(&f, &device);
        refuse_memory = refuse_threads = 0;
        assert_int_equal(result, i == 0 ? KNURL_ERROR_MEMORY : KNURL_ERROR_SYSTEM);
        assert_null(device);
        assert_int_equal(h.reads + h.writes + h.closes, 0); /* the functions stay the caller's */
    }
}

TEST(a_start_that_fails_is_passed_on) {
    for (uint32_t blocking = 0; blocking < 2; blocking++) {
        knurl_device *device = NULL;
        memset(&h, 0, sizeof h);
        h.start_gives = KNURL_ERROR_UNSUPPORTED;
        const knurl_device_functions f = home_functions(&h, blocking);
        assert_int_equal(knurl_device_open_functions(&f, &device), KNURL_ERROR_UNSUPPORTED);
        assert_null(device);
        assert_int_equal(h.starts, 1);
        const uint64_t order = h.order;
        sleep_ns(5000000);
        assert_int_equal(knurl_load_acquire(&h.order), order); /* no thread still uses it */
        device = home_open(&h, blocking);
        h.start_gives = KNURL_ERROR_UNSUPPORTED;
        assert_int_equal(knurl_device_start(device, 3000.0), KNURL_ERROR_UNSUPPORTED);
        CHECK_SAME(h.rate, 3000.0L);
        knurl_device_close(device);
    }
}

/* --- the end of a driver's open() --- */

static int closes;

static knurl_result refuse_to_start(knurl_device *device, double update_rate_hz) {
    (void)device;
    return knurl_fail(KNURL_ERROR_DEVICE_LOST, "unplugged before its start at %g Hz", update_rate_hz);
}

static void count_close(knurl_device *device) {
    (void)device;
    closes++;
}

static void tell_one_newton(const knurl_device *device, knurl_device_info *info) {
    (void)device;
    info->max_force = 1.0;
}

static void open_by(const knurl_driver *driver, knurl_result result, knurl_result expected) {
    knurl_device device;
    knurl_device *opened = NULL;
    memset(&device, 0, sizeof device);
    knurl_device_init(&device, driver);
    closes = 0;
    assert_int_equal(knurl_device_finish_open(&device, result, &opened), expected);
    assert_int_equal(closes, expected != KNURL_OK);
    assert_ptr_equal(opened, expected ? NULL : &device);
}

/* Its thread runs and its port is open by then. */
TEST(a_driver_whose_device_cannot_be_opened_or_started_closes_it) {
    static const knurl_driver starts = {.uri = "starts", .close = count_close, .get_info = tell_one_newton};
    static const knurl_driver fails = {
        .uri = "fails", .close = count_close, .get_info = tell_one_newton, .start = refuse_to_start};
    open_by(&starts, KNURL_OK, KNURL_OK);
    open_by(&starts, KNURL_ERROR_ARGUMENT, KNURL_ERROR_ARGUMENT);
    open_by(&fails, KNURL_OK, KNURL_ERROR_DEVICE_LOST);
    assert_string_equal(knurl_error_message(), "unplugged before its start at 1000 Hz");
}

/* --- its information --- */

static void tell_little(void *user, knurl_device_info *info) {
    (void)user;
    memset(info->name, 'x', sizeof info->name); /* not terminated */
    info->max_force = 1.0;
}

TEST(unset_limits_promise_nothing) {
    for (uint32_t blocking = 0; blocking < 2; blocking++) {
        SCOPED_DEVICE *device = NULL;
        memset(&h, 0, sizeof h);
        knurl_device_functions f = home_functions(&h, blocking);
        f.get_info = tell_little;
        assert_int_equal(knurl_device_open_functions(&f, &device), KNURL_OK);
        const knurl_device_info info = device_info(device);
        assert_int_equal(strlen(info.name), sizeof info.name - 1);
        CHECK_SAME(info.max_force, 1.0L);
        assert_true(isinf(info.continuous_force) && isinf(info.max_stiffness));
        assert_true(info.heat_time > 0.0);
        CHECK_SAME(info.resolution, 0.0L);
        CHECK_SAME(info.native_rate, blocking ? 1000.0L : 0.0L);
    }
}

static void tell_much(void *user, knurl_device_info *info) {
    tell_little(user, info);
    (void)strcpy(info->name, "ours");
    info->native_rate = 500.0;
    info->resolution = 0.001;
    info->continuous_force = 0.5;
    info->delay = 3.0;
    info->workspace_min[2] = -0.25;
    info->max_torque = 0.1;
    info->max_grip = 1.0;
}

TEST(the_owners_description_is_passed_on) {
    SCOPED_DEVICE *device = NULL;
    memset(&h, 0, sizeof h);
    knurl_device_functions f = home_functions(&h, 1);
    f.get_info = tell_much;
    assert_int_equal(knurl_device_open_functions(&f, &device), KNURL_OK);
    const knurl_device_info info = device_info(device);
    assert_string_equal(info.name, "ours");
    CHECK_SAME(info.native_rate, 500.0L);
    CHECK_SAME(info.resolution, (long double)0.001);
    CHECK_SAME(info.continuous_force, 0.5L);
    CHECK_SAME(info.delay, 3.0L);
    CHECK_SAME(info.workspace_min[2], -0.25L);
    CHECK_SAME(info.max_torque, 0.0L); /* `write` gets no torque */
    CHECK_SAME(info.max_grip, 0.0L);
    assert_int_equal(info.struct_size, sizeof info);
}

TEST(outputs_without_a_struct_size_are_refused_and_untouched) {
    SCOPED_DEVICE *device = home_open(&h, 0);
    knurl_device_info info;
    knurl_device_status status;
    memset(&info, 0, sizeof info);
    memset(&status, 0, sizeof status);
    CHECK_REFUSED(knurl_device_get_info(device, &info), KNURL_ERROR_ARGUMENT, info);
    CHECK_REFUSED(knurl_device_get_status(device, &status), KNURL_ERROR_ARGUMENT, status);
}
