/* Lives of sessions, in every order that a game can think of. SPDX-License-Identifier: MIT */
#define _DEFAULT_SOURCE 1 /* opendir() */

#include "session_rig.h"

#include <dirent.h>

static const uint8_t zeros[sizeof(knurl_session_state)];

static int thread_count(void) {
    int count = 0;
    DIR *folder = opendir("/proc/self/task");
    if (!folder) {
        fail_msg("there is no /proc");
        return 0;
    }
    while (readdir(folder)) {
        count++;
    }
    (void)closedir(folder);
    return count - 2; /* . and .. */
}

static int others_than_ours; /* threads, before the first session */

/* The system lists a thread for a while after it was joined. */
static void check_nobody_runs(void) {
    WAIT_FOR(thread_count() <= others_than_ours);
}

static void open_fake(knurl_session *s) {
    open_with(s, "fake", "rest");
}

static void start(knurl_session *s) {
    assert_int_equal(knurl_session_start(s, NULL, 0), KNURL_OK);
}

static void check_closed(knurl_session *s) {
    const knurl_session_state now = state_of(s);
    float rows[2];
    assert_null(knurl_session_get_device(s));
    assert_null(knurl_session_get_loop(s));
    assert_memory_equal(&now, zeros, sizeof now);
    assert_int_equal(knurl_session_get_history(s, 1, rows), 0);
    check_no_event(s);
}

TEST(a_new_session_is_closed_and_its_scene_is_empty) {
    knurl_session *s = make_session();
    check_closed(s);
    assert_non_null(knurl_session_get_scene(s));
    assert_int_equal(knurl_scene_get_surface_count(knurl_session_get_scene(s)), 0);
    knurl_session_update(s);
    knurl_session_close(s);
    knurl_session_close(s);
    check_closed(s);
    knurl_session_destroy(s);
    knurl_session_destroy(NULL);
}

TEST(the_defaults_are_a_fake_device_at_1_khz) {
    knurl_session_desc desc;
    knurl_session_desc_init(&desc, sizeof desc);
    assert_string_equal(desc.device, "fake");
    assert_string_equal(desc.stroke, "");
    CHECK_SAME(desc.update_rate_hz, 1000.0);
    CHECK_SAME(desc.heartbeat_s, 0.25);
    CHECK_SAME(desc.workspace.scale, 1.0);
    assert_true(desc.struct_size == sizeof desc && desc.reconnect == 1 && desc.clamp == 1 && desc.even == 0);
}

TEST(nothing_starts_that_is_closed) {
    char warning[8] = "as was";
    SCOPED_SESSION *s = make_session();
    CHECK_REFUSED(knurl_session_start(s, warning, sizeof warning), KNURL_ERROR_STATE, warning);
    check_message("closed");
    check_closed(s);
}

TEST(nothing_is_opened_or_started_twice) {
    const knurl_session_desc desc = describe("mouse", "");
    char warning[8] = "as was";
    SCOPED_SESSION *s = make_session();
    open_fake(s);
    const knurl_device *device = knurl_session_get_device(s);
    assert_int_equal(knurl_session_open(s, &desc), KNURL_ERROR_STATE);
    check_message("open");
    assert_ptr_equal(knurl_session_get_device(s), device);
    start(s);
    const knurl_loop *loop = knurl_session_get_loop(s);
    CHECK_REFUSED(knurl_session_start(s, warning, sizeof warning), KNURL_ERROR_STATE, warning);
    check_message("started");
    assert_int_equal(knurl_session_open(s, &desc), KNURL_ERROR_STATE);
    assert_true(knurl_session_get_loop(s) == loop && state_of(s).running);
}

TEST(a_device_that_cannot_be_opened_is_named_and_leaves_it_closed) {
    const double nan = NAN;
    const knurl_session_desc good = describe("fake", "");
    knurl_session_desc bad[10];
    const knurl_result codes[10] = {[5] = KNURL_ERROR_UNKNOWN, [6] = KNURL_ERROR_UNKNOWN};
    const char *words[10] = {"update_rate_hz",       "update_rate_hz", "heartbeat_s", "reconnect", "clamp",
                             "'nonsense'; or mouse", "wiggle",         "scale",       "bytes",     "speed"};
    SCOPED_SESSION *s = make_session();
    for (int i = 0; i < 10; i++) {
        bad[i] = good;
    }
    bad[0].update_rate_hz = 99.0;
    bad[1].update_rate_hz = nan;
    bad[2].heartbeat_s = -1.0;
    bad[3].reconnect = 2;
    bad[4].clamp = 2;
    bad[5].device = "nonsense";
    bad[6].stroke = "wiggle";
    bad[7].workspace.scale = 0.0;
    bad[8].struct_size = 8;
    bad[9].device = "fake:?speed=1";
    for (int i = 0; i < 10; i++) {
        (void)knurl_fail(KNURL_ERROR_STATE, "stale message");
        check_refusal(knurl_session_open(s, &bad[i]), codes[i] ? codes[i] : KNURL_ERROR_ARGUMENT, __FILE__, __LINE__);
        check_message(words[i]);
        check_closed(s);
    }
    assert_int_equal(knurl_session_open(s, NULL), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_session_open(s, &good), KNURL_OK);
}

/* The library is one that a program may name. */
TEST(a_scene_cannot_name_a_library_to_run) {
    static const char *const uris[] = {"touch:?library=" KNURL_TEST_HD, "touch:Default Device?library=" KNURL_TEST_HD,
                                       "touch?library=" KNURL_TEST_HD,
                                       "touch:?library=/nowhere.so&library=" KNURL_TEST_HD};
    knurl_session *s = make_session();
    for (size_t i = 0; i < COUNT_OF(uris); i++) {
        const knurl_session_desc desc = describe(uris[i], "");
        (void)knurl_fail(KNURL_ERROR_STATE, "stale message");
        assert_int_equal(knurl_session_open(s, &desc), KNURL_ERROR_ARGUMENT);
        check_message("must not name a library to load");
        assert_null(knurl_session_get_device(s));
    }
    knurl_session_destroy(s);
    SCOPED_DEVICE *device = NULL;
    assert_int_equal(knurl_device_open("touch:?library=" KNURL_TEST_HD, &device), KNURL_OK);
}

TEST(strings_are_not_kept) {
    char device[] = "fake:?press_at=0.001";
    char stroke[] = "line";
    knurl_session_desc desc = describe(device, stroke);
    SCOPED_SESSION *s = make_session();
    const knurl_surface_id plate = add_plate(s, 0.0, 0.0, 0.0);
    open_session(s, &desc);
    memset(device, 'x', sizeof device);
    memset(stroke, 'x', sizeof stroke);
    memset(&desc, 0x5a, sizeof desc);
    begin(s);
    step(s, 1000);
    knurl_session_update(s);
    check_event(s, KNURL_SESSION_CONTACT_STARTED, plate);
}

TEST(no_strings_are_a_fake_device_that_stands_still) {
    knurl_session_desc desc = describe(NULL, NULL);
    SCOPED_SESSION *s = make_session();
    open_session(s, &desc);
    const knurl_device_info info = device_info(knurl_session_get_device(s));
    assert_non_null(strstr(info.name, "fake"));
    begin(s);
    step(s, 500);
    const knurl_session_state now = state_of(s);
    CHECK_VECTOR(now.hip, 0.0, 0.0, 0.0, 0.001); /* a hand trembles, a joint sticks: 0.26 N / 700 N/m */
}

TEST(surfaces_outlive_runs) {
    SCOPED_SESSION *s = make_session();
    knurl_scene *scene = knurl_session_get_scene(s);
    const knurl_surface_id plate = add_plate(s, 0.0, 0.0, 0.0);
    for (int round = 0; round < 3; round++) {
        open_fake(s);
        begin(s);
        press(s, 0.0, 0.0);
        knurl_session_update(s);
        check_event(s, KNURL_SESSION_CONTACT_STARTED, plate);
        CHECK_CLOSE(state_of(s).force[2], STIFFNESS * 0.001, 1e-9);
        assert_true(state_of(s).ticks == 12); /* since the start */
        knurl_session_close(s);
        check_event(s, KNURL_SESSION_CONTACT_ENDED, plate);
        check_closed(s);
        assert_ptr_equal(knurl_session_get_scene(s), scene);
        assert_int_equal(knurl_scene_get_surface_count(scene), 1);
    }
}

TEST(surfaces_may_come_before_between_and_during_runs) {
    SCOPED_SESSION *s = make_session();
    for (int round = 0; round < 3; round++) {
        (void)add_plate(s, 0.2 * (3 * round), 0.0, 0.0);
        open_fake(s);
        (void)add_plate(s, 0.2 * (3 * round + 1), 0.0, 0.0);
        begin(s);
        (void)add_plate(s, 0.2 * (3 * round + 2), 0.0, 0.0);
        for (int i = 0; i < 3 * round + 3; i++) {
            press(s, 0.2 * i, 0.0);
            knurl_session_update(s);
            assert_int_equal(state_of(s).in_contact, 1);
        }
        knurl_session_close(s);
    }
}

TEST(a_scene_that_the_caller_committed_is_fine) {
    SCOPED_SESSION *s = make_session();
    assert_int_equal(knurl_scene_commit(knurl_session_get_scene(s)), KNURL_OK);
    open_fake(s);
    start(s);
}

TEST(destroying_what_runs_ends_its_threads) {
    check_nobody_runs();
    knurl_session *s = make_session();
    open_fake(s);
    start(s);
    assert_true(thread_count() > others_than_ours);
    knurl_session_destroy(s);
    check_nobody_runs();
    s = make_session();
    open_fake(s);
    knurl_session_destroy(s); /* open */
    s = make_session();
    open_fake(s);
    start(s);
    knurl_session_close(s);
    check_nobody_runs();
    knurl_session_destroy(s); /* closed */
}

TEST(all_are_closed_and_those_that_ran_are_counted) {
    knurl_session *s[4];
    for (int i = 0; i < 4; i++) {
        s[i] = make_session();
    }
    for (int i = 0; i < 3; i++) {
        open_fake(s[i]);
    }
    start(s[0]);
    start(s[2]);
    assert_int_equal(knurl_session_close_all(), 2);
    check_nobody_runs();
    for (int i = 0; i < 4; i++) {
        check_closed(s[i]);
    }
    assert_int_equal(knurl_session_close_all(), 0);
    open_fake(s[3]);
    start(s[3]);
    assert_int_equal(knurl_session_close_all(), 1);
    for (int i = 0; i < 4; i++) {
        knurl_session_destroy(s[i]);
    }
    assert_int_equal(knurl_session_close_all(), 0);
}

TEST(those_that_were_destroyed_are_not_among_all) {
    static const int orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    for (size_t i = 0; i < COUNT_OF(orders); i++) {
        knurl_session *s[3];
        for (int j = 0; j < 3; j++) {
            s[j] = make_session();
            open_fake(s[j]);
            s[j]->runs = 1; /* to be counted */
        }
        for (int j = 0; j < 3; j++) {
            knurl_session_destroy(s[orders[i][j]]);
            for (int k = j + 1; k < 3; k++) {
                s[orders[i][k]]->runs = 1;
            }
            assert_int_equal(knurl_session_close_all(), 2 - j);
        }
    }
}

static void destroy_one(void *session) {
    knurl_session_destroy(session);
}

/* As a runtime's finalisers do. */
TEST(sessions_are_destroyed_on_another_thread_while_all_are_closed) {
    for (int round = 0; round < 10; round++) {
        knurl_session *s[4];
        knurl_thread *threads[4];
        for (int i = 0; i < 4; i++) {
            s[i] = make_session();
            open_fake(s[i]);
            if (i % 2 == 0) {
                start(s[i]);
            }
        }
        for (int i = 0; i < 4; i++) {
            threads[i] = knurl_system_start_thread(destroy_one, s[i], (size_t)256 * 1024);
            assert_non_null(threads[i]);
        }
        assert_in_range(knurl_session_close_all(), 0, 2);
        SCOPED_SESSION *one = make_session();
        for (int i = 0; i < 4; i++) {
            knurl_system_join_thread(threads[i]);
        }
    }
}

static void do_nothing(void *argument) {
    (void)argument;
}

int main(void) {
    knurl_thread *first = knurl_system_start_thread(do_nothing, NULL, (size_t)256 * 1024);
    if (first) { /* the thread sanitizer brings one of its own along */
        knurl_system_join_thread(first);
    }
    sleep_ms(20.0);
    others_than_ours = thread_count();
    return suite_run("session_life");
}

/* A host may give a session's scene and device to a loop of its own, and finalise that last. */
TEST(objects_in_use_by_the_hosts_loop_outlive_the_session) {
    static const double there[3] = {0.0, 0.0, -0.001};
    for (int turn = 0; turn < 20; turn++) {
        knurl_loop_desc desc;
        knurl_loop *loop = NULL;
        knurl_session *s = make_session();
        open_with(s, "mouse", "");
        (void)add_plate(s, 0.0, 0.0, 0.0);
        assert_int_equal(knurl_scene_commit(knurl_session_get_scene(s)), KNURL_OK);
        assert_int_equal(knurl_session_move_hip(s, there), KNURL_OK);
        knurl_loop_desc_init(&desc, sizeof desc);
        desc.scene = knurl_session_get_scene(s);
        desc.device = knurl_session_get_device(s);
        desc.update_rate_hz = 10000.0;
        desc.watchdog_s = 0.0;
        assert_int_equal(knurl_loop_create(&desc, &loop), KNURL_OK);
        assert_int_equal(knurl_session_start(s, NULL, 0), KNURL_ERROR_STATE); /* the HIP is that loop's */
        assert_int_equal(knurl_loop_start(loop), KNURL_OK);
        WAIT_FOR(loop_stats(loop).ticks >= 20);
        knurl_session_destroy(s);
        assert_int_equal(knurl_loop_wait(loop, 10.0), 1);
        assert_int_equal(loop_stats(loop).state, KNURL_LOOP_DONE);
        knurl_loop_destroy(loop);
    }
}
