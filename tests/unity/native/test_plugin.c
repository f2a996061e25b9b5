/* The plugin's life in Unity: loaded, initialised, updated, unloaded, repeatedly.
 * SPDX-License-Identifier: MIT */
#define _DEFAULT_SOURCE 1 /* sigaction() */

#include "counts.h"
#include "engine.h"

#include <signal.h>
#include <stdlib.h>

static plugin p; /* opened by each test */

static int open_plugin(void **state) {
    (void)state;
    memset(&engine, 0, sizeof engine);
    p = plugin_open();
    return 0;
}

/* Also after a failed test: no thread may still run in an unloaded library. */
static int close_plugin(void **state) {
    (void)state;
    engine.at_event = NULL;
    p.UnityPluginUnload();
    plugin_close(&p);
    return 0;
}

/* Waits for the haptic thread; an engine that holds still gives no sign of life meanwhile. */
static void wait_for_ticks(knurl_session *session, uint64_t ticks, int with_updates) {
    const int64_t give_up = knurl_system_now_ns() + (int64_t)10000000000;
    while (plugin_state(&p, session).ticks < ticks && knurl_system_now_ns() < give_up) {
        if (with_updates) {
            p.knurl_unity_update(session);
        }
        knurl_system_sleep_until_ns(knurl_system_now_ns() + 1000000);
    }
    assert_true(plugin_state(&p, session).ticks >= ticks);
}

/* One update without a running device, to find the used interfaces. */
static void update_once(void) {
    knurl_session *session = NULL;
    assert_int_equal(p.knurl_session_create(&session), KNURL_OK);
    p.knurl_unity_update(session);
    p.knurl_session_destroy(session);
}

/* --- the profiler --- */

TEST_WITH(each_update_begins_and_ends_one_marker_on_the_thread_that_asked_for_it, open_plugin, close_plugin) {
    p.UnityPluginLoad(&engine_interfaces);
    assert_int_equal(engine.markers, 1);
    assert_string_equal(engine.marker.name, "Knurl.Update");
    assert_int_equal(engine.marker.category, 1); /* scripts */
    assert_int_equal(engine.marker.flags, 0);
    assert_int_equal(engine.event_count, 0);
    knurl_session *sessions[2] = {plugin_run(&p), plugin_run(&p)};
    wait_for_ticks(sessions[0], 20, 1); /* two haptic threads run meanwhile */
    wait_for_ticks(sessions[1], 20, 1);
    assert_true(engine.event_count > 0);
    assert_int_equal(engine.event_count % 2, 0);
    for (int i = 0; i < engine.event_count; i++) {
        assert_ptr_equal(engine.events[i].marker, &engine.marker);
        assert_int_equal(engine.events[i].event, i % 2); /* 0: start, 1: end */
        assert_true(engine.events[i].thread == knurl_system_thread_id());
    }
    p.knurl_session_destroy(sessions[0]);
    p.knurl_session_destroy(sessions[1]);
    p.UnityPluginUnload();
    assert_int_equal(engine.log_count, 0);
}

static knurl_session *watched;
static uint32_t known[2]; /* number of session events at each marker */

static void ask_for_events(int event) {
    knurl_session_event told;
    known[event] += p.knurl_session_next_event(watched, &told);
}

TEST_WITH(the_sessions_update_lies_between_the_marks, open_plugin, close_plugin) {
    p.UnityPluginLoad(&engine_interfaces);
    watched = plugin_run(&p);
    wait_for_ticks(watched, 200, 0); /* too long without a sign of life */
    known[0] = known[1] = 0;
    engine.at_event = ask_for_events;
    p.knurl_unity_update(watched);
    assert_int_equal(known[0], 0);
    assert_int_equal(known[1], 1); /* as the update found out */
    p.knurl_session_destroy(watched);
    p.UnityPluginUnload();
}

/* No profiler, a game that was built without it, and a marker that could not be made. */
TEST_WITH(without_a_marker_an_update_is_just_an_update, open_plugin, close_plugin) {
    int *const lacks[] = {&engine.without_profiler, &engine.unavailable, &engine.refuses_markers};
    for (size_t i = 0; i < COUNT_OF(lacks); i++) {
        *lacks[i] = 1;
        p.UnityPluginLoad(&engine_interfaces);
        update_once();
        assert_int_equal(engine.markers, lacks[i] == &engine.refuses_markers);
        assert_int_equal(engine.event_count, 0);
        p.UnityPluginUnload();
        *lacks[i] = 0;
    }
}

/* --- calls out of turn --- */

TEST_WITH(no_interfaces_are_as_good_as_no_engine, open_plugin, close_plugin) {
    static const unity_interfaces empty = {NULL, NULL, NULL, NULL};
    p.UnityPluginLoad(NULL);
    update_once();
    p.UnityPluginLoad(&empty);
    update_once();
    p.UnityPluginUnload();
    assert_int_equal(engine.event_count, 0);
}

TEST_WITH(without_being_told_of_an_engine_everything_works, open_plugin, close_plugin) {
    knurl_session *session = plugin_run(&p);
    wait_for_ticks(session, 5, 1);
    p.UnityPluginUnload();
    assert_int_equal(plugin_state(&p, session).running, 0);
    p.knurl_session_destroy(session);
    p.UnityPluginUnload();
}

TEST_WITH(loaded_twice_an_update_is_marked_once, open_plugin, close_plugin) {
    p.UnityPluginLoad(&engine_interfaces);
    p.UnityPluginLoad(&engine_interfaces);
    update_once();
    assert_int_equal(engine.event_count, 2);
    engine.without_profiler = 1;
    p.UnityPluginLoad(&engine_interfaces); /* the newest counts */
    update_once();
    assert_int_equal(engine.event_count, 2);
    p.UnityPluginUnload();
}

TEST_WITH(once_unloaded_the_engine_is_not_called_any_more, open_plugin, close_plugin) {
    p.UnityPluginLoad(&engine_interfaces);
    p.UnityPluginUnload();
    update_once();
    knurl_session *session = plugin_run(&p);
    p.UnityPluginUnload();
    assert_int_equal(engine.event_count, 0);
    assert_int_equal(engine.log_count, 0);
    p.knurl_session_destroy(session);
}

/* --- signals --- */

#ifndef _WIN32

static volatile int handled;

static void on_signal(int number) {
    (void)number;
    handled++;
}

/* Otherwise the next signal would run unloaded code on a freed stack. */
TEST(a_plugin_that_is_unloaded_gives_its_signals_and_its_stack_back) {
    static const int numbers[] = {SIGTERM, SIGSEGV, SIGTSTP, SIGPIPE};
    struct sigaction now;
    struct sigaction mine;
    memset(&mine, 0, sizeof mine);
    mine.sa_handler = on_signal;
    mine.sa_flags = SA_ONSTACK;
    for (int round = 0; round < 2; round++) {
        (void)open_plugin(NULL);
        knurl_session *session = plugin_run(&p);
        assert_int_equal(sigaction(SIGTERM, NULL, &now), 0);
        assert_true(now.sa_handler != SIG_DFL);
        p.knurl_session_destroy(session);
        (void)close_plugin(NULL);
        for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
            assert_int_equal(sigaction(numbers[i], NULL, &now), 0);
            assert_true(now.sa_handler == SIG_DFL || numbers[i] == SIGSEGV); /* a sanitizer's */
        }
        assert_int_equal(sigaction(SIGUSR1, &mine, NULL), 0);
        assert_int_equal(raise(SIGUSR1), 0);
        assert_int_equal(handled, round + 1);
        (void)signal(SIGUSR1, SIG_DFL);
    }
}

#endif

/* --- running sessions --- */

TEST_WITH(sessions_that_run_at_the_unloading_are_closed_and_warned_of, open_plugin, close_plugin) {
    p.UnityPluginLoad(&engine_interfaces);
    knurl_session *sessions[2] = {plugin_run(&p), plugin_run(&p)};
    wait_for_ticks(sessions[1], 5, 1);
    p.UnityPluginUnload();
    assert_int_equal(plugin_state(&p, sessions[0]).running, 0);
    assert_int_equal(plugin_state(&p, sessions[1]).running, 0);
    assert_int_equal(engine.log_count, 1);
    assert_int_equal(engine.log_type, 2); /* a warning */
    assert_non_null(strstr(engine.log_text, "Knurl"));
    assert_non_null(strstr(engine.log_text, "2"));
    p.knurl_session_destroy(sessions[0]);
    p.knurl_session_destroy(sessions[1]);
}

TEST_WITH(sessions_that_ended_before_are_no_reason_to_warn, open_plugin, close_plugin) {
    p.UnityPluginLoad(&engine_interfaces);
    knurl_session *session = plugin_run(&p);
    p.knurl_session_close(session);
    p.UnityPluginUnload();
    assert_int_equal(engine.log_count, 0);
    p.knurl_session_destroy(session);
}

TEST_WITH(without_a_log_what_runs_is_closed_all_the_same, open_plugin, close_plugin) {
    engine.without_log = 1;
    p.UnityPluginLoad(&engine_interfaces);
    knurl_session *session = plugin_run(&p);
    p.UnityPluginUnload();
    assert_int_equal(plugin_state(&p, session).running, 0);
    assert_int_equal(engine.log_count, 0);
    p.knurl_session_destroy(session);
}

/* --- rounds --- */

#define ROUNDS 100

/* Bytes that a load may leak. Windows: MinGW's runtime, in the library, does not free its thread-local storage and
 * locks (3131 bytes, including the thread's error message). Elsewhere: less than the smallest block. */
#if defined(_WIN32)
enum { BYTES_LEFT = 3584 };
#else
enum { BYTES_LEFT = 24 };
#endif

/* All that a project does with a plugin, an error of the loader's, which is C++, included. */
static void play_round(int with_engine) {
    p = plugin_open();
    engine.event_count = 0;
    p.UnityPluginLoad(with_engine ? &engine_interfaces : NULL);
    knurl_session *session = plugin_run(&p);
    p.knurl_unity_update(session);
    assert_int_equal(
        p.knurl_gltf_load_file(p.knurl_session_get_scene(session), KNURL_TEST_ASSETS "/none.glb", NULL, NULL),
        KNURL_ERROR_IO);
    p.UnityPluginUnload();
    p.knurl_session_destroy(session);
    plugin_close(&p);
}

TEST(a_hundred_rounds_leave_no_thread_no_handle_and_no_memory) {
    memset(&engine, 0, sizeof engine);
    for (int i = 0; i < 3; i++) { /* one-time allocations of the system */
        play_round(i % 2);
        (void)count_all();
    }
    const counts before = count_all();
    for (int i = 0; i < ROUNDS; i++) {
        play_round(i % 2);
    }
    const counts after = count_all();
    assert_int_equal(after.threads, before.threads);
    assert_int_equal(after.handles, before.handles);
    assert_true(after.bytes < before.bytes + (int64_t)ROUNDS * BYTES_LEFT);
#if !defined(__SANITIZE_ADDRESS__) /* which maps memory of its own */
    assert_true(after.maps <= before.maps + 5);
#endif
}
