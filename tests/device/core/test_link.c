/* The I/O thread: the newest force out, the newest position in, on virtual time. Bounds are the promised ones plus an
 * exchange's period (1 ms). SPDX-License-Identifier: MIT */
#include "home.h"

#include "device/link.h"
#include "device/port.h"

#include <knurl/loop.h>

static home h; /* reset by each test */

#define PERIOD_NS 1000000

/* Reads and writes once a millisecond for `ms`, like a loop without its protections. */
static void tick_for(knurl_device *device, int ms, double force) {
    const double f[3] = {0.0, force, 0.0};
    int64_t next = now_ns();
    for (int k = 0; k < ms; k++) {
        knurl_device_sample sample;
        next += 1000000;
        knurl_system_sleep_until_ns(next);
        (void)knurl_device_read(device, &sample);
        (void)knurl_device_write(device, f);
    }
}

/* Removes all events. Returns the number of those with a code. */
static int count_events(knurl_device *device, int32_t code) {
    knurl_device_event event;
    int count = 0;
    while (knurl_device_next_event(device, &event)) {
        count += event.code == code;
    }
    return count;
}

/* --- forces --- */

TEST(only_the_newest_force_is_sent_and_no_older_one_after_it) {
    knurl_device *device = home_open(&h, 1);
    knurl_store_relaxed(&h.takes_ns, (int64_t)1500000); /* slower than they are written */
    int64_t next = now_ns();
    for (int k = 1; k <= 300; k++) {
        const double f[3] = {0.0, 0.001 * k, 0.0};
        assert_int_equal(knurl_device_write(device, f), KNURL_OK);
        next += 500000;
        knurl_system_sleep_until_ns(next);
    }
    knurl_device_close(device);
    double last = 0.0;
    int different = 0;
    for (uint64_t i = 0; i < h.writes; i++) {
        const double force = h.log[i].force[1];
        assert_true(force >= last || force == 0.0);
        different += force > last;
        last = fmax(force, last);
    }
    assert_true(different >= 20);
    assert_true(different <= 200); /* some were replaced by newer ones and never played */
}

TEST(a_force_that_is_written_between_two_exchanges_goes_out_with_the_next_one) {
    int64_t worst = 0;
    knurl_device *device = home_open(&h, 1);
    for (int k = 0; k < 40; k++) {
        const double f[3] = {0.0, 0.0, 1.0 + 0.01 * k};
        const int64_t written = now_ns();
        assert_int_equal(knurl_device_write(device, f), KNURL_OK);
        while (knurl_load_double(&h.motor[2]) != f[2] && now_ns() - written < 20000000) {
            sleep_ns(10000);
        }
        worst = now_ns() - written > worst ? now_ns() - written : worst;
        sleep_ns(370000); /* at any time in a period */
    }
    knurl_device_close(device);
    assert_true(worst <= PERIOD_NS + 10000);
}

TEST(a_force_that_is_not_renewed_is_played_for_10_ms_and_then_zeroed) {
    const double f[3] = {1.0, 0.0, 0.0};
    knurl_device *device = home_open(&h, 1);
    wait_for_count(&h.reads, 3);
    const int64_t written = now_ns();
    assert_int_equal(knurl_device_write(device, f), KNURL_OK);
    const knurl_device_event event = wait_for_event(device, KNURL_FAULT_LATE);
    sleep_ns(5000000);
    assert_true(event.value >= 0.01);
    assert_int_equal(knurl_port_is_halted(device), 1);
    const int64_t limp = knurl_load_acquire(&h.limp_since);
    assert_true(limp - written > 10000000 && limp - written <= 10000000 + PERIOD_NS);
    assert_true(limp - event.time_ns <= PERIOD_NS);
    assert_int_equal(next_code(device, 0), 0); /* reported once */
    knurl_device_close(device);
    uint64_t forces = 0;
    for (uint64_t i = 0; i < h.writes; i++) {
        assert_true(!(h.log[i].force[0] > 0.0) || h.log[i].at - written <= 10000000);
        forces += h.log[i].force[0] > 0.0;
    }
    assert_in_range(forces, 10, 11);
}

TEST(no_force_is_no_force_however_old_it_is) {
    const double none[3] = {0.0, 0.0, 0.0};
    SCOPED_DEVICE *device = home_open(&h, 1);
    assert_int_equal(knurl_device_write(device, none), KNURL_OK);
    sleep_ns(40000000);
    assert_int_equal(next_code(device, 0), 0);
    assert_int_equal(knurl_port_is_halted(device), 0);
}

TEST(a_halt_reaches_the_motors_with_the_next_exchange) {
    const double f[3] = {1.0, 0.0, 0.0};
    SCOPED_DEVICE *device = home_open(&h, 1);
    assert_int_equal(knurl_device_write(device, f), KNURL_OK);
    wait_for_count(&h.writes, knurl_load_acquire(&h.writes) + 2);
    knurl_device_halt(device);
    const int64_t halted = now_ns();
    wait_for_count(&h.writes, knurl_load_acquire(&h.writes) + 2);
    const int64_t limp = knurl_load_acquire(&h.limp_since);
    assert_true(limp > 0 && limp - halted <= PERIOD_NS);
}

/* --- pace --- */

static void tell_rate(void *user, knurl_device_info *info) {
    home_info(user, info);
    info->native_rate = 250.0;
}

TEST(exchanges_are_no_more_frequent_than_the_device_brings_positions) {
    for (int i = 0; i < 2; i++) {
        knurl_device *device = NULL;
        memset(&h, 0, sizeof h);
        knurl_device_functions f = home_functions(&h, 1);
        f.get_info = i ? tell_rate : home_info;
        const int64_t period = i ? 4000000 : 1000000;
        assert_int_equal(knurl_device_open_functions(&f, &device), KNURL_OK);
        sleep_ns(60 * period);
        knurl_device_close(device);
        const uint64_t writes = h.writes - 2; /* the last two come at once */
        for (uint64_t k = 9; k < writes; k++) {
            assert_true(h.log[k].at - h.log[k - 9].at >= 9 * period);
        }
        assert_true(writes >= 20);
    }
}

TEST(exchanges_that_take_longer_set_the_rhythm_and_make_no_burst) {
    knurl_device *device = home_open(&h, 1);
    knurl_store_relaxed(&h.takes_ns, (int64_t)3000000);
    sleep_ns(60000000);
    knurl_store_relaxed(&h.takes_ns, (int64_t)0);
    const uint64_t from = knurl_load_acquire(&h.writes) + 1;
    sleep_ns(20000000);
    knurl_device_close(device);
    for (uint64_t k = from + 9; k < h.writes - 2; k++) {
        assert_true(h.log[k].at - h.log[k - 9].at >= 8000000);
    }
}

/* --- silence --- */

TEST(a_mute_device_is_silent_after_10_ms_and_its_force_is_zeroed) {
    knurl_device_sample sample;
    SCOPED_DEVICE *device = home_open(&h, 1);
    tick_for(device, 20, 1.0);
    assert_int_equal(next_code(device, 0), 0);
    home_inject(&h, DOUBLE_MUTE);
    const int64_t injected = now_ns();
    tick_for(device, 30, 1.0);
    const knurl_device_event event = wait_for_event(device, KNURL_FAULT_SILENT);
    assert_true(event.value > 0.01);
    const int64_t limp = knurl_load_acquire(&h.limp_since);
    assert_true(limp > 0 && limp - injected <= 10000000 + h.mute_ns + PERIOD_NS); /* an exchange takes mute_ns */
    assert_int_equal(knurl_device_read(device, &sample), KNURL_ERROR_DEVICE_NOT_READY);
    assert_int_equal(count_events(device, KNURL_FAULT_SILENT), 0); /* reported once */
}

TEST(a_second_of_silence_is_a_loss) {
    knurl_device_sample sample;
    knurl_device *device = home_open(&h, 1);
    tick_for(device, 20, 1.0);
    home_inject(&h, DOUBLE_MUTE);
    const int64_t injected = now_ns();
    const knurl_device_event event = wait_for_event(device, KNURL_FAULT_LOST);
    assert_true(event.time_ns - injected >= 980000000);
    assert_int_equal(knurl_device_read(device, &sample), KNURL_ERROR_DEVICE_LOST);
    const uint64_t writes = h.writes;
    sleep_ns(10000000);
    assert_true(h.writes == writes); /* its thread has ended */
    knurl_device_close(device);
    assert_true(h.writes == writes && h.closes == 1);
}

TEST(a_device_that_is_heard_again_is_read_again) {
    knurl_device_sample sample;
    SCOPED_DEVICE *device = home_open(&h, 1);
    home_place(&h, 0.01, 0.0, 0.0);
    tick_for(device, 10, 1.0);
    home_inject(&h, DOUBLE_MUTE);
    (void)wait_for_event(device, KNURL_FAULT_SILENT);
    home_inject(&h, DOUBLE_WELL);
    wait_for_count(&h.reads, knurl_load_acquire(&h.reads) + 3);
    assert_int_equal(knurl_device_read(device, &sample), KNURL_OK);
    CHECK_SAME(sample.position[0], (long double)0.01);
    home_inject(&h, DOUBLE_MUTE); /* and its next silence is a new one */
    tick_for(device, 10, 0.0);
    (void)wait_for_event(device, KNURL_FAULT_SILENT);
}

TEST(an_unplugged_device_is_lost_at_once) {
    SCOPED_DEVICE *device = home_open(&h, 1);
    tick_for(device, 5, 1.0);
    home_inject(&h, DOUBLE_UNPLUG);
    const int64_t injected = now_ns();
    const knurl_device_event event = wait_for_event(device, KNURL_FAULT_LOST);
    assert_true(event.time_ns - injected <= PERIOD_NS);
}

/* Regression: the last position was still valid after the force was zeroed, so the loop resumed during the silence. */
TEST(a_loop_does_not_resume_while_the_device_is_silent) {
    for (int phase = 0; phase < 5; phase++) {
        double force[3] = {1.0, 0.0, 0.0};
        SCOPED_DEVICE *device = home_open(&h, 1);
        knurl_loop_desc desc = push_desc(device, force);
        desc.watchdog_s = 0.0;
        knurl_loop *loop = start_push(&desc);
        knurl_store_relaxed(&h.mute_ns, (int64_t)1000000); /* noticed as early as possible */
        sleep_ns(30000000 + 300000 * phase);
        (void)next_code(device, -1);
        home_inject(&h, DOUBLE_MUTE);
        (void)wait_for_event(device, KNURL_FAULT_SILENT);
        sleep_ns(20000000);
        assert_int_equal(count_events(device, KNURL_FAULT_RESUMED), 0);
        home_inject(&h, DOUBLE_WELL);
        (void)wait_for_event(device, KNURL_FAULT_RESUMED);
        knurl_loop_destroy(loop);
    }
}

TEST(a_status_reports_the_loss_without_a_read) {
    SCOPED_DEVICE *device = home_open(&h, 1);
    home_inject(&h, DOUBLE_UNPLUG);
    (void)wait_for_event(device, KNURL_FAULT_LOST);
    sleep_ns(2000000);
    const knurl_device_status status = device_status(device);
    assert_int_equal(status.lost, 1);
    assert_int_equal(status.halted, 1);
}

/* --- an exchange that hangs --- */

TEST(while_an_exchange_hangs_no_call_waits_and_the_reader_reports_it_once) {
    const double f[3] = {1.0, 0.0, 0.0};
    knurl_device_sample sample;
    int not_ready = 0;
    SCOPED_DEVICE *device = home_open(&h, 1);
    tick_for(device, 5, 1.0);
    home_inject(&h, DOUBLE_HANG);
    for (int ms = 0; ms < 100; ms++) {
        const int64_t before = now_ns();
        not_ready += knurl_device_read(device, &sample) == KNURL_ERROR_DEVICE_NOT_READY;
        assert_int_equal(knurl_device_write(device, f), KNURL_OK);
        assert_true(now_ns() == before); /* the exchange hangs for 300 ms */
        sleep_ns(1000000);
    }
    assert_in_range(not_ready, 88, 90); /* 100 reads, less 10 ms and two periods in which the last position is valid */
    assert_int_equal(count_events(device, KNURL_FAULT_SILENT), 1);
    assert_int_equal(knurl_port_is_halted(device), 1);
    home_inject(&h, DOUBLE_WELL);
    wait_for_count(&h.reads, knurl_load_acquire(&h.reads) + 3);
    assert_int_equal(knurl_device_read(device, &sample), KNURL_OK);
}

/* Reader and I/O thread both notice it, the reader while it lasts. */
TEST(a_hang_that_ends_without_an_answer_is_still_one_silence) {
    SCOPED_DEVICE *device = home_open(&h, 1);
    tick_for(device, 5, 1.0);
    knurl_store_relaxed(&h.hangs_for, (int64_t)60000000);
    home_inject(&h, DOUBLE_HANG);
    tick_for(device, 150, 1.0); /* it hangs two times and a half */
    assert_int_equal(count_events(device, KNURL_FAULT_SILENT), 1);
    home_inject(&h, DOUBLE_WELL);
}

/* A link without its thread, in the reader's view after the exchange following the last position was counted and the
 * next one hangs. */
TEST(a_hang_is_detected_after_any_count) {
    static knurl_link link;
    for (uint64_t counted = 0; counted < 4; counted++) {
        knurl_device_sample sample;
        knurl_device device;
        memset(&link, 0, sizeof link);
        memset(&device, 0, sizeof device);
        link.device = &device;
        link.native_rate = 1000.0;
        device.period = 0.001;
        knurl_mailbox_init(&link.positions);
        knurl_link_start(&link, 1000.0);
        knurl_mailbox_post(&link.positions);
        assert_int_equal(knurl_link_read(&link, &sample), KNURL_OK);
        for (int k = 0; k < 100; k++) {
            link.cycles += (uint64_t)k < counted;
            (void)knurl_link_read(&link, &sample);
        }
        assert_int_equal(knurl_link_read(&link, &sample), KNURL_ERROR_DEVICE_NOT_READY);
        knurl_device_event event;
        assert_int_equal(knurl_events_next(&device.events, &event), 1);
        assert_int_equal(event.code, KNURL_FAULT_SILENT);
        assert_int_equal(knurl_events_next(&device.events, &event), 0);
    }
}

/* --- the end --- */

TEST(the_last_exchange_carries_no_force) {
    for (int k = 0; k < 5; k++) {
        knurl_device *device = home_open(&h, 1);
        tick_for(device, 5 + k, 2.0);
        knurl_device_close(device);
        assert_true(h.writes >= 2);
        for (uint64_t i = h.writes - 2; i < h.writes; i++) {
            CHECK_SAME(h.log[i].force[1], 0.0L);
        }
        assert_int_equal(h.crowds, 0);
        assert_int_equal(h.strangers, 0);
    }
}

TEST(after_a_reconnect_no_force_from_before_is_played) {
    const double f[3] = {3.0, 0.0, 0.0};
    knurl_device_sample sample;
    SCOPED_DEVICE *device = home_open(&h, 1);
    for (int k = 0; k < 5; k++) {
        assert_int_equal(knurl_device_write(device, f), KNURL_OK);
        home_inject(&h, DOUBLE_UNPLUG);
        (void)wait_for_event(device, KNURL_FAULT_LOST);
        while (knurl_device_read(device, &sample) != KNURL_ERROR_DEVICE_LOST) {
            sleep_ns(100000);
        }
        home_inject(&h, DOUBLE_WELL);
        const uint64_t from = h.writes;
        assert_int_equal(knurl_device_reopen(device), KNURL_OK);
        knurl_port_release_halt(device);
        wait_for_count(&h.writes, from + 4);
        for (uint64_t i = from; i < from + 4; i++) {
            CHECK_SAME(h.log[i].force[0], 0.0L);
        }
        assert_int_equal(knurl_device_read(device, &sample), KNURL_OK);
    }
}
