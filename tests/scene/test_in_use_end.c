/* Device, scene and loop may end in any order, on any thread: a garbage-collected host finalises them so.
 * SPDX-License-Identifier: MIT */
#include "device/port.h"
#include "in_use.h"

enum { IDLE, RUNNING, STEPPED, ENDED, STATES };

static void bring_to(int state) {
    if (state == RUNNING || state == ENDED) {
        start_and_push();
    }
    if (state == STEPPED) {
        assert_int_equal(knurl_loop_step(s.loop, 100), KNURL_OK);
        CHECK_CLOSE(motor(), 0.4, 0.01);
    }
    if (state == ENDED) {
        knurl_loop_stop(s.loop);
    }
}

static void end(char what) {
    if (what == 'd') {
        knurl_device_close(s.device);
        if (s.loop) { /* whose memory it still is */
            knurl_device_close(s.device);
        }
    } else if (what == 's') {
        knurl_scene_destroy(s.scene);
    } else {
        knurl_loop_destroy(s.loop);
        s.loop = NULL;
    }
}

/* An I/O thread writes it within its next exchange. */
static void wait_for_no_force(void) {
    const int64_t until = now_ns() + INT64_C(10000000000);
    while (motor() != 0.0 && now_ns() < until) {
        sleep_ns(200000);
    }
    assert_true(motor() == 0.0);
}

/* A loop whose device or scene was destroyed ends by itself, and its force is 0 as soon as it has. */
static void check_loop_ended(int state) {
    if (state == RUNNING) {
        wait_for_no_force();
        assert_int_equal(knurl_loop_wait(s.loop, 10.0), 1);
        assert_int_equal(loop_stats(s.loop).state, KNURL_LOOP_DONE);
        assert_true(motor() == 0.0);
    }
    if (state == STEPPED) { /* its next step is its last */
        const uint64_t ticks = loop_stats(s.loop).ticks;
        assert_int_equal(knurl_loop_step(s.loop, 10), KNURL_OK);
        assert_int_equal(loop_stats(s.loop).state, KNURL_LOOP_DONE);
        assert_true(loop_stats(s.loop).ticks == ticks);
        assert_true(motor() == 0.0);
    }
    if (state == IDLE) {
        assert_int_equal(knurl_loop_start(s.loop), KNURL_ERROR_STATE);
    }
}

static void check_order(const char *order, int state, uint32_t blocking) {
    set_up(blocking);
    bring_to(state);
    for (const char *what = order; *what; what++) {
        const int loop_is_left = s.loop && *what != 'l';
        end(*what);
        if (loop_is_left) {
            assert_int_equal(s.home.closes, 0); /* not before its loop's */
            assert_true(s.books.blocks > 0);
            check_loop_ended(state);
        }
    }
    check_all_gone();
}

TEST(device_scene_and_loop_may_be_destroyed_in_any_order) {
    static const char *const orders[] = {"lds", "lsd", "dls", "sld", "dsl", "sdl"};
    for (size_t i = 0; i < COUNT_OF(orders); i++) {
        for (int at = 0; at < STATES; at++) {
            check_order(orders[i], at, 0);
        }
    }
}

TEST(a_device_with_an_io_thread_likewise) {
    check_order("dls", RUNNING, 1);
    check_order("sdl", RUNNING, 1);
    check_order("dsl", IDLE, 1);
}

TEST(a_closed_device_gets_no_force_from_its_loop) {
    set_up(0);
    start_and_push();
    knurl_device_close(s.device);
    assert_int_equal(knurl_port_is_halted(s.device), 1); /* memory that its loop still keeps */
    knurl_port_release_halt(s.device);
    assert_int_equal(knurl_port_is_halted(s.device), 1); /* for good */
    assert_int_equal(knurl_loop_wait(s.loop, 10.0), 1);
    assert_true(motor() == 0.0);
    assert_int_equal(next_code(s.device, KNURL_FAULT_OVERRUN), 0); /* a close is no fault, and nothing resumed */
    end_loop_and_scene();
}

/* Not only by the loop's next cycle, or the I/O thread's next exchange. */
TEST(a_close_returns_once_the_force_is_zero) {
    static const struct {
        int state;
        uint32_t blocking;
    } table[] = {{IDLE, 0}, {STEPPED, 0}, {RUNNING, 0}, {RUNNING, 1}, {ENDED, 0}, {ENDED, 1}};
    for (size_t i = 0; i < COUNT_OF(table); i++) {
        for (int turn = 0; turn < (table[i].state == RUNNING ? 10 : 1); turn++) {
            set_up(table[i].blocking);
            bring_to(table[i].state);
            knurl_device_close(s.device);
            assert_true(motor() == 0.0);
            for (int k = 0; k < 5; k++) {
                sleep_ns(1000000);
                assert_true(motor() == 0.0);
            }
            end_loop_and_scene();
        }
    }
}

static void close_at_50(const knurl_tick_output *output, void *user) {
    double *left = user;
    if (output->tick == 50) {
        *left = motor();
        knurl_device_close(s.device);
        left[1] = motor();
    }
}

/* No other thread could zero the force meanwhile. */
TEST(a_close_on_the_haptic_thread_as_well) {
    for (uint32_t blocking = 0; blocking < 2; blocking++) {
        double forces[2] = {0.0, 1.0};
        knurl_loop_desc desc;
        set_up(blocking);
        knurl_loop_destroy(s.loop);
        knurl_loop_desc_init(&desc, sizeof desc);
        desc.device = s.device;
        desc.scene = s.scene;
        desc.watchdog_s = 0.0;
        desc.tick_callback = close_at_50;
        desc.user = forces;
        assert_int_equal(knurl_loop_create(&desc, &s.loop), KNURL_OK);
        assert_int_equal(knurl_loop_start(s.loop), KNURL_OK);
        assert_int_equal(knurl_loop_wait(s.loop, 10.0), 1);
        CHECK_CLOSE(forces[0], 0.4, 0.01);
        CHECK_SAME(forces[1], 0.0L);
        end_loop_and_scene();
    }
}

TEST(of_two_loops_on_a_destroyed_scene_the_last_one_frees_it) {
    static home other;
    knurl_loop *second = NULL;
    knurl_device *device = home_open(&other, 0);
    home_place(&other, 0.0, 0.0, -0.001);
    set_up(0);
    assert_int_equal(make_loop(device, s.scene, 1, &second), KNURL_OK);
    start_and_push();
    assert_int_equal(knurl_loop_start(second), KNURL_OK);
    knurl_scene_destroy(s.scene);
    knurl_loop_destroy(s.loop);
    assert_true(s.books.blocks > 0);
    assert_int_equal(knurl_loop_wait(second, 10.0), 1);
    knurl_loop_destroy(second);
    assert_int_equal(s.books.blocks, 0);
    knurl_device_close(s.device);
    knurl_device_close(device);
    check_all_gone();
}

TEST(a_loop_that_looks_for_its_lost_device_ends_when_that_is_closed) {
    knurl_loop_desc desc;
    set_up_without_loop(1);
    knurl_loop_desc_init(&desc, sizeof desc);
    desc.device = s.device;
    desc.scene = s.scene;
    desc.reconnect = 1;
    desc.watchdog_s = 0.0;
    assert_int_equal(knurl_loop_create(&desc, &s.loop), KNURL_OK);
    start_and_push();
    home_inject(&s.home, DOUBLE_UNPLUG);
    wait_for_count(&s.home.reopens, 1);
    knurl_device_close(s.device);
    assert_int_equal(knurl_loop_wait(s.loop, 10.0), 1);
    knurl_loop_destroy(s.loop);
    knurl_scene_destroy(s.scene);
    assert_int_equal(s.home.closes, 1);
    assert_int_equal(s.books.blocks, 0);
}

/* Each on a thread of its own, once `go` is set. */
typedef struct finaliser {
    char what;
    uint32_t *go; /* atomic */
} finaliser;

static void *finalise(void *user) {
    finaliser *f = user;
    while (!knurl_load_acquire(f->go)) {}
    if (f->what == 'd') {
        knurl_device_close(s.device);
    } else if (f->what == 's') {
        knurl_scene_destroy(s.scene);
    } else {
        knurl_loop_destroy(s.loop);
    }
    return NULL;
}

/* Finalises the object `which` on another thread, while `meanwhile` (or null) runs here. */
static void finalise_at_once(const char *which, void (*meanwhile)(void)) {
    uint32_t go = 0;
    pthread_t threads[3];
    finaliser finalisers[3];
    const size_t count = strlen(which);
    for (size_t i = 0; i < count; i++) {
        finalisers[i].what = which[i];
        finalisers[i].go = &go;
        assert_int_equal(pthread_create(&threads[i], NULL, finalise, &finalisers[i]), 0);
    }
    knurl_store_release(&go, 1u);
    if (meanwhile) {
        meanwhile();
    }
    for (size_t i = 0; i < count; i++) {
        assert_int_equal(pthread_join(threads[i], NULL), 0);
    }
}

TEST(device_scene_and_loop_may_be_destroyed_at_once_on_three_threads) {
    for (int turn = 0; turn < 40; turn++) {
        set_up(turn % 4 == 3);
        if (turn % 2) {
            start_and_push();
        }
        finalise_at_once("dsl", NULL);
        check_all_gone();
    }
}

static void start_or_be_refused(void) {
    const knurl_result result = knurl_loop_start(s.loop);
    assert_true(result == KNURL_OK || result == KNURL_ERROR_STATE);
}

TEST(a_start_that_races_with_a_close_is_refused_or_ends) {
    for (int turn = 0; turn < 40; turn++) {
        set_up(0);
        finalise_at_once("ds", start_or_be_refused);
        assert_int_equal(knurl_loop_wait(s.loop, 10.0), 1);
        knurl_loop_destroy(s.loop);
        check_all_gone();
    }
}

/* --- from a callback --- */

/* Called by a callback at its 50th call. */
static void (*at_fifty)(void);
static uint32_t calls; /* atomic */

static void count_tick(const knurl_tick_output *output, void *user) {
    (void)output;
    (void)user;
    if (__atomic_add_fetch(&calls, 1, __ATOMIC_ACQ_REL) == 50) {
        at_fifty();
    }
}

static void set_up_callback(void (*what)(void)) {
    knurl_loop_desc desc;
    set_up_without_loop(0);
    at_fifty = what;
    calls = 0;
    knurl_loop_desc_init(&desc, sizeof desc);
    desc.device = s.device;
    desc.scene = s.scene;
    desc.tick_callback = count_tick;
    assert_int_equal(knurl_loop_create(&desc, &s.loop), KNURL_OK);
}

static void destroy_all(void) {
    knurl_scene_destroy(s.scene);
    knurl_device_close(s.device);
    knurl_loop_destroy(s.loop);
}

static void destroy_loop(void) {
    knurl_loop_destroy(s.loop);
}

/* To the end, on its own thread or stepped. */
static void run_to_fifty(int is_stepped) {
    if (is_stepped) {
        assert_int_equal(knurl_loop_step(s.loop, 1000), KNURL_OK);
    } else {
        assert_int_equal(knurl_loop_start(s.loop), KNURL_OK);
        assert_int_equal(knurl_loop_wait(s.loop, 10.0), 1);
    }
    assert_int_equal(loop_stats(s.loop).ticks, 50);
    assert_true(motor() == 0.0);
}

TEST(a_loop_that_is_destroyed_in_its_callback_only_ends) {
    for (int turn = 0; turn < 2; turn++) {
        set_up_callback(destroy_loop);
        run_to_fifty(turn);
        assert_int_equal(loop_stats(s.loop).state, KNURL_LOOP_DONE); /* it is still there */
        knurl_loop_destroy(s.loop);                                  /* outside of it */
        end_device_and_scene();
    }
}

TEST(all_three_destroyed_in_a_callback_are_gone_with_the_loop) {
    for (int turn = 0; turn < 2; turn++) {
        set_up_callback(destroy_all);
        run_to_fifty(turn);
        assert_int_equal(s.home.closes, 0);
        knurl_loop_destroy(s.loop);
        check_all_gone();
    }
}
