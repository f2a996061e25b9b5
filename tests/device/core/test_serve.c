/* A device that owns the servo thread, as the Touch's scheduler does: it calls the loop, and only there is it read and
 * written. SPDX-License-Identifier: MIT */
#include "home.h"

#include "device/driver.h"
#include "device/port.h"

#include <knurl/loop.h>

/* Calls a tick every millisecond; after a loss, it calls once more, then only after a reopening. */
typedef struct servo {
    knurl_device device; /* first */
    knurl_thread *thread;
    uint32_t (*tick)(void *argument);
    void *argument;
    /* atomics */
    uint32_t calls_it; /* 1: the tick is to be called */
    uint32_t quit;
    uint32_t unplugged;

    int64_t stall_ns; /* before the next tick */
    uint64_t closes;
    uint64_t generation, ticks, reads, writes, strangers, reopens, refuse_reopens;
    int64_t reopen_takes_ns;
    int64_t lingers_ns;      /* in the tick that detects the loss */
    uint32_t changes_thread; /* 1: reopened, it has another one */
    uintptr_t inside;        /* the thread in a tick */
    uintptr_t served_by;     /* the last thread in a tick */
    double motor;
    uint32_t tells_loss; /* 1: called once more since it was unplugged */
} servo;

static servo s; /* reset by each test */

int __wrap_knurl_system_make_realtime(void);

static servo *servo_of(void *device) {
    return device;
}

static void serve_once(servo *self) {
    const int64_t stall = __atomic_exchange_n(&self->stall_ns, 0, __ATOMIC_ACQ_REL);
    if (stall > 0) {
        sleep_ns(stall);
    }
    if (knurl_load_acquire(&self->unplugged) && self->tells_loss) {
        return;
    }
    self->served_by = knurl_system_thread_id();
    knurl_store_release(&self->inside, self->served_by);
    self->tells_loss = knurl_load_acquire(&self->unplugged);
    knurl_count_up(&self->ticks);
    if (!self->tick(self->argument)) {
        knurl_store_release(&self->calls_it, 0u);
    }
    knurl_store_release(&self->inside, (uintptr_t)0);
}

static void scheduler(void *argument) {
    servo *self = argument;
    const uint64_t mine = knurl_load_acquire(&self->generation);
    int64_t next = now_ns();
    while (!knurl_load_acquire(&self->quit) && knurl_load_acquire(&self->generation) == mine) {
        if (knurl_load_acquire(&self->calls_it)) {
            serve_once(self);
        }
        next = next + 1000000 > now_ns() ? next + 1000000 : now_ns();
        knurl_system_sleep_until_ns(next);
    }
}

static knurl_thread *start_scheduler(servo *self) {
    return knurl_system_start_thread(scheduler, self, (size_t)256 * 1024);
}

static knurl_result servo_serve(knurl_device *device, uint32_t (*tick)(void *argument), void *argument) {
    servo *self = servo_of(device);
    self->tick = tick;
    self->argument = argument;
    self->tells_loss = 0;
    knurl_store_release(&self->calls_it, 1u);
    return KNURL_OK;
}

static void servo_info(const knurl_device *device, knurl_device_info *info) {
    info->max_force = device->max_force;
    info->native_rate = 1000.0;
}

static knurl_result servo_start(knurl_device *device, double rate) {
    (void)device;
    return rate == 1000.0 ? KNURL_OK : knurl_fail(KNURL_ERROR_UNSUPPORTED, "servo: expected 1000 Hz, found %g", rate);
}

static knurl_result servo_read(knurl_device *device, knurl_device_sample *sample) {
    servo *self = servo_of(device);
    self->strangers += knurl_load_acquire(&self->inside) != knurl_system_thread_id();
    knurl_count_up(&self->reads);
    memset(sample, 0, sizeof *sample);
    if (knurl_load_acquire(&self->unplugged) && self->lingers_ns > 0) {
        knurl_store_release(&device->lost, 1u); /* as its caller would next; then the thread is held up */
        sleep_ns(self->lingers_ns);
    }
    return knurl_load_acquire(&self->unplugged) ? KNURL_ERROR_DEVICE_LOST : KNURL_OK;
}

static knurl_result servo_write(knurl_device *device, const double force[3]) {
    servo *self = servo_of(device);
    self->strangers += knurl_load_acquire(&self->inside) != knurl_system_thread_id();
    knurl_count_up(&self->writes);
    knurl_store_double(&self->motor, force[1]);
    return knurl_load_acquire(&self->unplugged) ? KNURL_ERROR_DEVICE_LOST : KNURL_OK;
}

static knurl_result servo_reopen(knurl_device *device) {
    servo *self = servo_of(device);
    knurl_count_up(&self->reopens);
    sleep_ns(knurl_load_relaxed(&self->reopen_takes_ns));
    if (self->reopens <= self->refuse_reopens) {
        return KNURL_ERROR_DEVICE_LOST;
    }
    if (self->changes_thread) { /* both exist for a moment: otherwise they could have the same id */
        knurl_thread *old = self->thread;
        knurl_count_up(&self->generation);
        self->thread = start_scheduler(self);
        knurl_system_join_thread(old);
    }
    knurl_store_release(&self->unplugged, 0u);
    return KNURL_OK;
}

static void servo_close(knurl_device *device) {
    servo_of(device)->closes++;
}

static const knurl_driver servo_driver = {
    .uri = "servo",
    .close = servo_close,
    .get_info = servo_info,
    .start = servo_start,
    .read = servo_read,
    .write = servo_write,
    .reopen = servo_reopen,
    .serve = servo_serve,
};

static struct {
    knurl_loop_desc desc;
    knurl_loop *loop;
    uint64_t stop_at; /* calls stop from the callback at this tick */
} t;

static void force(uint64_t tick, const knurl_device_sample *sample, double f[3], void *user) {
    (void)sample;
    (void)user;
    f[1] = 1.0;
    if (tick == t.stop_at) {
        knurl_loop_stop(t.loop);
    }
}

static int begin(void **state) {
    (void)state;
    memset(&s, 0, sizeof s);
    memset(&t, 0, sizeof t);
    knurl_device_init(&s.device, &servo_driver);
    s.device.max_force = 2.0;
    knurl_loop_desc_init(&t.desc, sizeof t.desc);
    t.desc.device = &s.device;
    t.desc.force_callback = force;
    t.desc.watchdog_s = 0.0;
    t.stop_at = UINT64_MAX;
    s.thread = start_scheduler(&s);
    return 0;
}

static int end(void **state) {
    (void)state;
    knurl_loop_destroy(t.loop);
    t.loop = NULL;
    knurl_store_release(&s.quit, 1u);
    knurl_system_join_thread(s.thread);
    return s.strangers != 0;
}

/* For a test's next case. */
static void restart(void) {
    assert_int_equal(end(NULL), 0);
    (void)begin(NULL);
}

static void start(void) {
    assert_int_equal(knurl_loop_create(&t.desc, &t.loop), KNURL_OK);
    assert_int_equal(knurl_loop_start(t.loop), KNURL_OK);
}

static knurl_loop_stats stats(void) {
    return loop_stats(t.loop);
}

static void wait_for_ticks(uint64_t ticks) {
    WAIT_FOR(stats().ticks >= ticks);
}

/* After the loop's end its tick is not called any more. */
static void check_silence(void) {
    const uint64_t ticks = knurl_load_acquire(&s.ticks);
    sleep_ns(10000000);
    assert_int_equal(knurl_load_acquire(&s.ticks), ticks);
}

TEST_WITH(a_device_with_a_servo_thread_runs_the_loop_on_it, begin, end) {
    t.desc.tick_limit = 200;
    start();
    assert_int_equal(knurl_loop_wait(t.loop, 10.0), 1);
    assert_int_equal(stats().state, KNURL_LOOP_DONE);
    assert_int_equal(stats().ticks, 200);
    check_silence();
    CHECK_SAME(knurl_load_double(&s.motor), 0.0L);
    assert_int_equal(knurl_port_is_halted(&s.device), 1);
    assert_in_range(s.ticks, 219, 222);
}

static uintptr_t asked_for; /* the thread that requested real-time priority */

int __wrap_knurl_system_make_realtime(void) {
    asked_for = knurl_system_thread_id();
    return 1;
}

TEST_WITH(real_time_rights_are_asked_for_the_servo_thread, begin, end) {
    asked_for = 0;
    t.desc.tick_limit = 20;
    start();
    assert_int_equal(knurl_loop_wait(t.loop, 10.0), 1);
    assert_int_equal(stats().realtime, 1);
    assert_true(asked_for != 0 && asked_for == s.served_by);
}

TEST_WITH(it_cannot_be_stepped_and_only_at_its_own_rate, begin, end) {
    knurl_loop *none = NULL;
    t.desc.update_rate_hz = 500.0;
    CHECK_REFUSED(knurl_loop_create(&t.desc, &none), KNURL_ERROR_UNSUPPORTED, none);
    t.desc.update_rate_hz = 1000.0;
    assert_int_equal(knurl_loop_create(&t.desc, &t.loop), KNURL_OK);
    char nothing = 0;
    CHECK_REFUSED(knurl_loop_step(t.loop, 1), KNURL_ERROR_UNSUPPORTED, nothing);
    assert_int_equal(s.ticks, 0);
}

TEST_WITH(calls_that_come_late_are_counted_and_told, begin, end) {
    start();
    wait_for_ticks(20);
    const uint64_t before = stats().overruns;
    knurl_store_release(&s.stall_ns, INT64_C(30000000));
    const knurl_device_event event = wait_for_event(&s.device, KNURL_FAULT_OVERRUN);
    CHECK_CLOSE(event.value, 0.030, 1e-9);
    assert_int_equal(stats().overruns, before + 1);
    CHECK_CLOSE(stats().jitter_ns.max, 30e6, 1.0);
}

TEST_WITH(a_stop_from_outside_and_one_from_the_callback_both_end_it, begin, end) {
    for (int i = 0; i < 2; i++) {
        t.stop_at = i ? 30 : UINT64_MAX;
        start();
        if (i) {
            assert_int_equal(knurl_loop_wait(t.loop, 10.0), 1);
            assert_int_equal(stats().ticks, 31);
        } else {
            wait_for_ticks(30);
            knurl_loop_stop(t.loop);
        }
        assert_int_equal(stats().state, KNURL_LOOP_DONE);
        check_silence();
        CHECK_SAME(knurl_load_double(&s.motor), 0.0L);
        restart();
    }
}

TEST_WITH(a_loss_without_reconnect_ends_it, begin, end) {
    start();
    wait_for_ticks(20);
    knurl_store_release(&s.unplugged, 1u);
    assert_int_equal(knurl_loop_wait(t.loop, 10.0), 1);
    assert_int_equal(stats().state, KNURL_LOOP_LOST);
    check_silence();
    CHECK_CODES(&s.device, KNURL_FAULT_OVERRUN, KNURL_FAULT_LOST);
}

TEST_WITH(a_loss_with_reconnect_is_waited_out, begin, end) {
    t.desc.reconnect = 1;
    s.refuse_reopens = 1;
    start();
    wait_for_ticks(20);
    knurl_store_release(&s.unplugged, 1u);
    WAIT_FOR(stats().absent);
    const uint64_t before = stats().ticks;
    wait_for_ticks(before + 50);
    assert_int_equal(stats().state, KNURL_LOOP_RUNNING);
    assert_int_equal(knurl_load_acquire(&s.reopens), 2);
    CHECK_CODES(&s.device, KNURL_FAULT_OVERRUN, KNURL_FAULT_LOST, KNURL_FAULT_RECONNECTED, KNURL_FAULT_RESUMED);
    knurl_loop_stop(t.loop);
    check_silence();
}

/* The time without a device does not count as lateness, and a long reopening does not count as a stall of the haptic
 * thread. */
TEST_WITH(the_time_that_it_was_away_is_no_fault_of_the_loops, begin, end) {
    knurl_device_event event;
    t.desc.reconnect = 1;
    t.desc.watchdog_s = 0.1;
    s.reopen_takes_ns = 300000000;
    start();
    wait_for_ticks(20);
    knurl_store_release(&s.unplugged, 1u);
    WAIT_FOR(stats().absent);
    wait_for_ticks(stats().ticks + 50);
    knurl_loop_stop(t.loop);
    while (knurl_device_next_event(&s.device, &event)) {
        assert_int_not_equal(event.code, KNURL_FAULT_WATCHDOG);
        assert_true(event.code != KNURL_FAULT_OVERRUN || event.value < 0.25);
    }
    assert_true(stats().jitter_ns.max < 0.25e9);
}

TEST_WITH(a_stop_from_the_callback_only_asks_also_when_the_servo_thread_is_another_one_by_then, begin, end) {
    t.desc.reconnect = 1;
    s.changes_thread = 1;
    t.stop_at = 60;
    start();
    wait_for_ticks(20);
    knurl_store_release(&s.unplugged, 1u);
    assert_int_equal(knurl_loop_wait(t.loop, 5.0), 1);
    assert_int_equal(stats().ticks, 61);
    assert_int_equal(knurl_load_acquire(&s.reopens), 1);
}

TEST_WITH(a_stop_while_it_is_lost_ends_it_though_nobody_calls_the_tick, begin, end) {
    for (int i = 0; i < 6; i++) {
        t.desc.reconnect = 1;
        s.refuse_reopens = UINT64_MAX;
        start();
        wait_for_ticks(10);
        knurl_store_release(&s.unplugged, 1u);
        if (i % 3 == 0) {
            WAIT_FOR(stats().absent); /* otherwise the two race */
        } else if (i % 3 == 1) {
            sleep_ns(1000000);
        }
        const int64_t asked = now_ns();
        if (i < 3) {
            knurl_loop_stop(t.loop);
            assert_true(now_ns() - asked < 2000000000);
            assert_int_equal(stats().state, KNURL_LOOP_DONE);
        }
        restart(); /* destroys it */
        assert_true(now_ns() - asked < 2000000000);
    }
}

/* A caller that waited for the end may destroy the loop. */
TEST_WITH(a_loop_is_not_over_while_its_device_is_still_in_a_tick, begin, end) {
    t.desc.reconnect = 1;
    s.refuse_reopens = UINT64_MAX;
    s.lingers_ns = 300000000;
    start();
    wait_for_ticks(20);
    knurl_store_release(&s.unplugged, 1u);
    WAIT_FOR(knurl_load_acquire(&s.device.lost));
    knurl_loop_stop(t.loop);
    assert_true(knurl_load_acquire(&s.inside) == 0);
    check_silence();
}

TEST_WITH(destroying_it_at_once_is_fine_and_so_is_another_loop_after_it, begin, end) {
    for (int turn = 0; turn < 10; turn++) {
        start();
        knurl_loop_destroy(t.loop);
        t.loop = NULL;
        check_silence();
    }
    start();
    wait_for_ticks(5);
}

/* Also while the device is lost and the tick is not called. */
TEST_WITH(a_close_ends_the_loop_and_its_destroy_closes, begin, end) {
    for (int lost = 0; lost < 2; lost++) {
        t.desc.reconnect = 1;
        s.refuse_reopens = UINT64_MAX;
        start();
        wait_for_ticks(20);
        if (lost) {
            knurl_store_release(&s.unplugged, 1u);
            WAIT_FOR(stats().absent);
        }
        knurl_device_close(&s.device);
        assert_int_equal(knurl_loop_wait(t.loop, 10.0), 1);
        assert_int_equal(stats().state, KNURL_LOOP_DONE);
        check_silence();
        assert_true(lost || knurl_load_double(&s.motor) == 0.0);
        assert_int_equal(s.closes, 0);
        assert_int_equal(end(NULL), 0); /* destroys it */
        assert_int_equal(s.closes, 1);
        (void)begin(NULL);
    }
}
