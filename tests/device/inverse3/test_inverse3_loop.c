/* The Inverse3 in a loop, over a simulated service: motors that are off, the emergency brake, states without the
 * device. SPDX-License-Identifier: MIT */
#include "device/inverse3/inverse3_double.h"
#include "support/close.h"
#include "support/wait.h"

#include <knurl/device.h>
#include <knurl/loop.h>

static inverse3_sim look(void) {
    const inverse3_sim now = *inverse3_double_take();
    inverse3_double_give_back();
    return now;
}

static void make_ready(int is_ready) {
    inverse3_double_take()->is_not_ready = !is_ready;
    inverse3_double_sim()->greatest_rise = 0.0;
    inverse3_double_give_back();
}

static void leave_out(int states) {
    inverse3_double_take()->is_left_out = states;
    inverse3_double_give_back();
}

static knurl_device *device;
static knurl_loop *loop;

static int end(void **state) {
    (void)state;
    knurl_loop_destroy(loop);
    loop = NULL;
    knurl_device_close(device);
    device = NULL;
    return 0;
}

/* A device in a loop that pulls with 2 N. */
static void open_in_loop(void) {
    static double force[3] = {0.0, 2.0, 0.0};
    (void)end(NULL);
    device = inverse3_double_open("");
    const knurl_loop_desc desc = push_desc(device, force);
    loop = start_push(&desc);
    sleep_ms(300.0);
    CHECK_CLOSE(look().force[2], 2.0, 1e-12);
}

/* Removes all events. Returns the count of this one, and its last value. */
static int count_events(int32_t code, double *value) {
    knurl_device_event event;
    int count = 0;
    while (knurl_device_next_event(device, &event)) {
        if (event.code == code) {
            count++;
            *value = event.value;
        }
    }
    return count;
}

/* Of the ramp's 2 N in 20 ms: two ticks may fall between two exchanges. */
TEST_WITH(without_power_or_not_ready_it_gets_zero_force_and_the_force_comes_back_by_a_ramp, NULL, end) {
    static const int causes[] = {KNURL_FORCE_OFF_POWER, KNURL_FORCE_OFF_NOT_READY};
    for (size_t i = 0; i < COUNT_OF(causes); i++) {
        double value = -1.0;
        open_in_loop();
        (void)count_events(0, &value);
        inverse3_double.inject(i == 0 ? DOUBLE_OFF : DOUBLE_WELL);
        make_ready(i == 0);
        sleep_ms(500.0);
        assert_int_equal(count_events(KNURL_FAULT_FORCE_OFF, &value), 1);
        CHECK_SAME(value, (long double)causes[i]);
        assert_in_range(look().told_while_off, 0, 2);
        make_ready(1);
        inverse3_double.inject(DOUBLE_WELL);
        sleep_ms(200.0);
        assert_int_equal(count_events(KNURL_FAULT_RESUMED, &value), 1);
        CHECK_CLOSE(look().force[2], 2.0, 1e-12);
        if (look().greatest_rise > 0.2) {
            fail_msg("came back by %g N in one exchange", look().greatest_rise);
        }
    }
}

#define SAFETY(id, type)                                                                                               \
    "{\"name\":\"device-safety-triggered\",\"category\":\"device\",\"level\":\"error\",\"data\":{\"device_family\":"   \
    "\"inverse\",\"device_id\":\"" id "\",\"safety_type\":\"" type "\"},\"message\":\"\"}"

/* As https://docs.haply.co/inverseSDK/service/events has it; another device's brake, and other events, do nothing. */
TEST_WITH(its_emergency_brake_is_an_event_and_the_force_comes_back_by_a_ramp, NULL, end) {
    double value = -1.0;
    open_in_loop();
    (void)count_events(0, &value);
    inverse3_double_tell(SAFETY("0A11", "ebrake_triggered"));
    sleep_ms(20.0);
    inverse3_double_tell(SAFETY("049D", "stall_detected"));
    sleep_ms(20.0);
    inverse3_double_tell("{\"name\":7");
    sleep_ms(20.0);
    CHECK_CLOSE(look().force[2], 2.0, 1e-12);
    inverse3_double_tell(SAFETY("049D", "ebrake_triggered"));
    inverse3_double_tell(SAFETY("0A11", "ebrake_released")); /* within the same exchange */
    sleep_ms(100.0);
    assert_int_equal(count_events(KNURL_FAULT_FORCE_OFF, &value), 1);
    CHECK_SAME(value, (long double)KNURL_FORCE_OFF_BRAKE);
    CHECK_SAME(look().told[2], 0.0L);
    make_ready(1); /* forgets the rise at the start */
    inverse3_double_tell(SAFETY("049D", "ebrake_released"));
    sleep_ms(200.0);
    assert_int_equal(count_events(KNURL_FAULT_RESUMED, &value), 1);
    CHECK_CLOSE(look().force[2], 2.0, 1e-12);
    assert_true(look().greatest_rise <= 0.2);
}

TEST_WITH(a_state_that_leaves_the_device_out_once_changes_nothing, NULL, end) {
    double value = 0.0;
    open_in_loop();
    (void)count_events(0, &value);
    leave_out(1);
    sleep_ms(100.0);
    assert_int_equal(count_events(KNURL_FAULT_LOST, &value), 0);
    CHECK_CLOSE(look().told[2], 2.0, 1e-12);
}

/* It may still be connected, and play its last force. */
TEST_WITH(a_skipped_device_gets_zero_force_before_it_counts_as_lost, NULL, end) {
    double value = 0.0;
    open_in_loop();
    leave_out(1000000);
    sleep_ms(100.0);
    assert_int_equal(count_events(KNURL_FAULT_LOST, &value), 1);
    CHECK_SAME(look().told[2], 0.0);
}
