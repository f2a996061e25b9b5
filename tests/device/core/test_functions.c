/* A device of a caller's functions: the order of calls, and the results in a loop.
 * SPDX-License-Identifier: MIT */
#include "home.h"

#include "device/port.h"

#include <knurl/loop.h>

static home h; /* reset by each test */

/* --- not blocking --- */

TEST(nonblocking_functions_are_called_by_the_tick) {
    SCOPED_DEVICE *device = home_open(&h, 0);
    knurl_device_sample sample;
    const double force[3] = {0.5, -1.0, 2.0};
    for (int i = 0; i < 20; i++) {
        home_place(&h, 0.001 * i, 0.0, -0.002 * i);
        h.buttons = (uint32_t)i;
        assert_int_equal(knurl_device_read(device, &sample), KNURL_OK);
        CHECK_SAME(sample.position[0], (long double)(0.001 * i));
        CHECK_SAME(sample.position[2], (long double)(-0.002 * i));
        assert_int_equal(sample.buttons, i);
        assert_int_equal(knurl_device_write(device, force), KNURL_OK);
        assert_memory_equal(h.motor, force, sizeof force);
    }
    assert_int_equal(h.reads, 20);
    assert_int_equal(h.writes, 20);
    assert_int_equal(h.strangers, 0);
}

TEST(forces_are_finite_and_at_most_what_it_can_play) {
    static const struct {
        double written[3], played[3];
    } cases[] = {
        {{3.0, 0.0, 4.0}, {3.0, 0.0, 4.0}},        {{6.0, 0.0, -8.0}, {3.0, 0.0, -4.0}},
        {{0.0, 1e6, 0.0}, {0.0, HOME_FORCE, 0.0}}, {{NAN, 1.0, 0.0}, {0.0, 0.0, 0.0}},
        {{0.0, INFINITY, 0.0}, {0.0, 0.0, 0.0}},   {{1.0, -INFINITY, NAN}, {0.0, 0.0, 0.0}},
    };
    SCOPED_DEVICE *device = home_open(&h, 0);
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        assert_int_equal(knurl_device_write(device, cases[i].written), KNURL_OK);
        for (int axis = 0; axis < 3; axis++) {
            CHECK_CLOSE(h.motor[axis], cases[i].played[axis], 1e-12);
        }
    }
}

TEST(halted_it_gets_no_force_until_the_halt_is_released) {
    SCOPED_DEVICE *device = home_open(&h, 0);
    const double force[3] = {1.0, 0.0, 0.0};
    knurl_device_halt(device);
    assert_int_equal(knurl_port_is_halted(device), 1);
    assert_int_equal(knurl_device_write(device, force), KNURL_OK);
    CHECK_SAME(h.motor[0], 0.0L);
    knurl_port_release_halt(device);
    assert_int_equal(knurl_device_write(device, force), KNURL_OK);
    CHECK_SAME(h.motor[0], 1.0L);
}

/* A device may be read faster than it measures: the last position stays valid for 10 ms. Then it is silent, which is
 * reported once, until it answers again. */
TEST(without_a_new_position_the_latest_holds_for_10_ms_and_then_the_device_is_silent) {
    for (int i = 0; i < 2; i++) {
        knurl_device_event event;
        knurl_device_sample sample;
        SCOPED_DEVICE *device = home_open(&h, 0);
        home_place(&h, 0.01, 0.0, 0.0);
        assert_int_equal(knurl_device_read(device, &sample), KNURL_OK);
        h.read_gives = i == 0 ? KNURL_ERROR_DEVICE_NOT_READY : KNURL_ERROR_IO; /* any other error is the same */
        home_place(&h, 0.02, 0.0, 0.0);
        for (int k = 0; k < 10; k++) {
            assert_int_equal(knurl_device_read(device, &sample), KNURL_OK);
            CHECK_SAME(sample.position[0], (long double)0.01);
        }
        assert_int_equal(knurl_device_next_event(device, &event), 0);
        memset(&sample, 0x55, sizeof sample);
        const knurl_device_sample before = sample;
        for (int k = 0; k < 100; k++) {
            assert_int_equal(knurl_device_read(device, &sample), KNURL_ERROR_DEVICE_NOT_READY);
            assert_memory_equal(&sample, &before, sizeof sample);
            assert_int_equal(knurl_port_is_halted(device), 1);
        }
        assert_int_equal(knurl_device_next_event(device, &event), 1);
        assert_int_equal(event.code, KNURL_FAULT_SILENT);
        CHECK_CLOSE(event.value, 0.0105, 0.00051);
        assert_int_equal(knurl_device_next_event(device, &event), 0);
        h.read_gives = KNURL_OK;
        assert_int_equal(knurl_device_read(device, &sample), KNURL_OK);
        CHECK_SAME(sample.position[0], (long double)0.02);
    }
}

TEST(no_position_is_held_before_the_first_one) {
    knurl_device_sample sample;
    SCOPED_DEVICE *device = home_open(&h, 0);
    h.read_gives = KNURL_ERROR_DEVICE_NOT_READY;
    assert_int_equal(knurl_device_read(device, &sample), KNURL_ERROR_DEVICE_NOT_READY);
    h.read_gives = KNURL_OK;
    assert_int_equal(knurl_device_read(device, &sample), KNURL_OK);
    assert_int_equal(next_code(device, 0), 0);
}

/* --- blocking --- */

TEST(blocking_functions_are_called_in_turn_on_another_thread) {
    const double force[3] = {0.5, -1.0, 2.0};
    knurl_device_sample sample;
    knurl_device *device = home_open(&h, 1);
    home_place(&h, 0.01, 0.02, 0.03);
    knurl_store_relaxed(&h.buttons, 5u);
    wait_for_count(&h.reads, knurl_load_acquire(&h.reads) + 3); /* there may have been some before it was placed */
    assert_int_equal(knurl_device_read(device, &sample), KNURL_OK);
    CHECK_SAME(sample.position[1], (long double)0.02);
    assert_int_equal(sample.buttons, 5);
    assert_int_equal(knurl_device_write(device, force), KNURL_OK);
    wait_for_count(&h.writes, knurl_load_acquire(&h.writes) + 2);
    assert_true(knurl_load_relaxed(&h.thread) != knurl_system_thread_id());
    knurl_device_close(device);
    int played = 0;
    for (uint64_t i = 0; i < h.writes; i++) {
        played += h.log[i].force[0] == 0.5 && h.log[i].force[1] == -1.0 && h.log[i].force[2] == 2.0;
    }
    assert_true(played >= 1);
    assert_int_equal(h.strangers, 0);
    assert_int_equal(h.crowds, 0);
    assert_in_range(h.reads, h.writes - 1, h.writes);
}

TEST(statuses_count_what_an_io_thread_does_and_are_zero_without_one) {
    for (uint32_t blocking = 0; blocking < 2; blocking++) {
        knurl_device_sample sample;
        SCOPED_DEVICE *device = home_open(&h, blocking);
        if (blocking) {
            knurl_store_relaxed(&h.takes_ns, (int64_t)300000);
            wait_for_count(&h.reads, 60);
        }
        (void)knurl_device_read(device, &sample);
        const knurl_device_status status = device_status(device);
        assert_int_equal(status.lost, 0);
        assert_int_equal(status.events, 0);
        if (blocking) {
            assert_in_range(status.exchanges, 58, knurl_load_acquire(&h.reads));
            assert_true(status.exchange_ns_p50 >= 0.97 * 300000.0);
            assert_true(status.exchange_ns_p99 >= status.exchange_ns_p50);
        } else {
            assert_int_equal(status.exchanges, 0);
            CHECK_SAME(status.exchange_ns_p50, 0.0L);
        }
    }
}

/* --- the end --- */

TEST(closing_zeroes_the_force_and_then_closes_once) {
    const double force[3] = {1.0, 1.0, 1.0};
    for (uint32_t blocking = 0; blocking < 2; blocking++) {
        knurl_device *device = home_open(&h, blocking);
        assert_int_equal(knurl_device_write(device, force), KNURL_OK);
        knurl_device_close(device);
        assert_int_equal(h.closes, 1);
        assert_true(h.write_order > 0 && h.write_order < h.close_order);
        assert_true(h.order == h.close_order); /* it is the last call */
        assert_true(h.limp_since > 0);
    }
    knurl_device_close(NULL);
}

TEST(of_a_lost_device_nothing_is_asked_but_to_close) {
    for (uint32_t blocking = 0; blocking < 2; blocking++) {
        knurl_device_sample sample;
        knurl_device *device = home_open(&h, blocking);
        const double force[3] = {1.0, 0.0, 0.0};
        home_inject(&h, DOUBLE_UNPLUG);
        if (blocking) {
            (void)wait_for_event(device, KNURL_FAULT_LOST);
        }
        memset(&sample, 0x55, sizeof sample);
        const knurl_device_sample before = sample;
        assert_int_equal(knurl_device_read(device, &sample), KNURL_ERROR_DEVICE_LOST);
        assert_memory_equal(&sample, &before, sizeof sample);
        const uint64_t order = h.order;
        assert_int_equal(knurl_device_read(device, &sample), KNURL_ERROR_DEVICE_LOST);
        assert_int_equal(knurl_device_write(device, force), KNURL_ERROR_DEVICE_LOST);
        assert_true(h.order == order);
        assert_int_equal(knurl_port_is_halted(device), 1);
        assert_int_equal(next_code(device, 0), blocking ? 0 : KNURL_FAULT_LOST); /* reported once */
        assert_int_equal(next_code(device, 0), 0);
        knurl_device_close(device);
        assert_true(h.order == order + 1 && h.closes == 1);
    }
}

TEST(a_lost_device_comes_back_only_by_being_reopened) {
    for (uint32_t blocking = 0; blocking < 2; blocking++) {
        knurl_device_sample sample;
        knurl_device *device = home_open(&h, blocking);
        home_inject(&h, DOUBLE_UNPLUG);
        if (blocking) {
            (void)wait_for_event(device, KNURL_FAULT_LOST);
        }
        assert_int_equal(knurl_device_read(device, &sample), KNURL_ERROR_DEVICE_LOST);
        assert_int_equal(knurl_device_reopen(device), KNURL_ERROR_DEVICE_LOST);
        home_inject(&h, DOUBLE_WELL);
        assert_int_equal(knurl_device_read(device, &sample), KNURL_ERROR_DEVICE_LOST);
        assert_int_equal(knurl_device_reopen(device), KNURL_OK);
        (void)wait_for_event(device, KNURL_FAULT_RECONNECTED);
        wait_for_count(&h.reads, knurl_load_acquire(&h.reads) + 3 * blocking);
        assert_int_equal(knurl_device_read(device, &sample), KNURL_OK);
        assert_int_equal(h.reopens, 2);
        knurl_device_close(device);
        assert_int_equal(h.crowds, 0);
    }
}

TEST(a_device_that_cannot_be_reopened_stays_lost) {
    SCOPED_DEVICE *device = NULL;
    knurl_device_sample sample;
    memset(&h, 0, sizeof h);
    knurl_device_functions f = home_functions(&h, 0);
    f.reopen = NULL;
    f.close = NULL;
    f.start = NULL;
    assert_int_equal(knurl_device_open_functions(&f, &device), KNURL_OK);
    assert_int_equal(knurl_device_start(device, 500.0), KNURL_OK);
    home_inject(&h, DOUBLE_UNPLUG);
    assert_int_equal(knurl_device_read(device, &sample), KNURL_ERROR_DEVICE_LOST);
    home_inject(&h, DOUBLE_WELL);
    assert_int_equal(knurl_device_reopen(device), KNURL_ERROR_DEVICE_LOST);
    assert_int_equal(knurl_device_read(device, &sample), KNURL_ERROR_DEVICE_LOST);
}

TEST(it_is_started_before_it_is_read) {
    for (int turn = 0; turn < 20; turn++) { /* the order of threads is undefined */
        knurl_device *device = NULL;
        memset(&h, 0, sizeof h);
        const knurl_device_functions f = home_functions(&h, 1);
        h.start_gives = KNURL_ERROR_UNSUPPORTED;
        assert_int_equal(knurl_device_open_functions(&f, &device), KNURL_ERROR_UNSUPPORTED);
        assert_int_equal(h.reads + h.writes, 0);
    }
}

/* --- a loop over it --- */

TEST(a_loop_plays_its_forces_on_it) {
    for (uint32_t blocking = 0; blocking < 2; blocking++) {
        double wanted[3] = {0.0, 9.0, 0.0}; /* of 5 */
        knurl_loop *loop = NULL;
        knurl_device *device = home_open(&h, blocking);
        knurl_loop_desc desc = push_desc(device, wanted);
        desc.tick_limit = 200;
        desc.update_rate_hz = 2000.0;
        assert_int_equal(knurl_loop_create(&desc, &loop), KNURL_OK);
        CHECK_SAME(knurl_load_double(&h.rate), 2000.0L);
        if (blocking) {
            wait_for_count(&h.reads, 2);
        }
        assert_int_equal(knurl_loop_start(loop), KNURL_OK);
        assert_int_equal(knurl_loop_wait(loop, 10.0), 1);
        knurl_loop_destroy(loop);
        knurl_device_close(device);
        CHECK_CLOSE(h.strongest, HOME_FORCE, 1e-9);
        assert_true(h.limp_since > 0);
        assert_int_equal(h.crowds, 0);
    }
}

TEST(only_nonblocking_devices_can_be_stepped) {
    for (uint32_t blocking = 0; blocking < 2; blocking++) {
        double wanted[3] = {0.0, 1.0, 0.0};
        knurl_loop *loop = NULL;
        SCOPED_DEVICE *device = home_open(&h, blocking);
        const knurl_loop_desc desc = push_desc(device, wanted);
        assert_int_equal(knurl_loop_create(&desc, &loop), KNURL_OK);
        assert_int_equal(knurl_loop_step(loop, 50), blocking ? KNURL_ERROR_UNSUPPORTED : KNURL_OK);
        assert_true(blocking || (h.reads == 50 && h.writes == 50));
        knurl_loop_destroy(loop);
    }
}
