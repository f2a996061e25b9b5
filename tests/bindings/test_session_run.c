/* Sessions with a running haptic thread, on virtual time: an awaited event comes, or never does.
 * SPDX-License-Identifier: MIT */
#include "session_rig.h"

static void run(knurl_session *s, const knurl_session_desc *desc) {
    open_session(s, desc);
    assert_int_equal(knurl_session_start(s, NULL, 0), KNURL_OK);
}

static void run_fake(knurl_session *s, const char *stroke) {
    const knurl_session_desc desc = describe("fake", stroke);
    run(s, &desc);
}

static int feels(const knurl_session *s) {
    const knurl_session_state state = state_of(s);
    return fabs(state.force[0]) + fabs(state.force[1]) + fabs(state.force[2]) > 0.05;
}

static int feels_nothing(const knurl_session *s) {
    const knurl_session_state state = state_of(s);
    return state.force[0] == 0.0 && state.force[1] == 0.0 && state.force[2] == 0.0;
}

/* 1 once the event was reported; earlier ones are dropped. */
static int is_told(knurl_session *s, int32_t kind, int32_t code) {
    knurl_session_event event;
    while (knurl_session_next_event(s, &event)) {
        if (event.kind == kind && event.code == code) {
            return 1;
        }
    }
    return 0;
}

TEST(a_stroke_over_the_first_surface_is_felt_and_reported) {
    static float rows[2 * KNURL_SESSION_HISTORY];
    knurl_session_event event;
    SCOPED_SESSION *s = make_session();
    const knurl_surface_id plate = add_plate(s, 0.02, 0.01, 0.005);
    run_fake(s, "press");
    assert_int_equal(state_of(s).running, 1);
    CHECK_UNTIL(s, feels(s));
    CHECK_UNTIL(s, knurl_session_next_event(s, &event) && event.kind == KNURL_SESSION_CONTACT_STARTED);
    assert_true(event.surface == plate && state_of(s).surface == plate);
    CHECK_UNTIL(s, state_of(s).ticks > 200);
    const uint32_t count = knurl_session_get_history(s, KNURL_SESSION_HISTORY, rows);
    float most = 0.0F;
    for (uint32_t i = 0; i < count; i++) {
        assert_true(rows[2 * i] == 0.0F && rows[2 * i + 1] >= 0.0F); /* smooth, and it never pulls */
        most = fmaxf(most, rows[2 * i + 1]);
    }
    assert_true(count > 190 && most > 0.05F);
    assert_int_equal(knurl_session_get_history(s, 10, rows), 10);
    assert_int_equal(knurl_session_get_history(s, 0, rows), 0);
    knurl_session_close(s);
    check_event(s, KNURL_SESSION_CONTACT_ENDED, plate);
    check_no_event(s);
}

/* No update is needed in a pause: a missing heartbeat is no fault then. */
TEST(a_pause_takes_the_force_away_and_its_end_brings_it_back) {
    knurl_session_desc desc = describe("fake", "rest");
    desc.heartbeat_s = 0.1;
    SCOPED_SESSION *s = make_session();
    const knurl_surface_id plate = add_plate(s, 0.0, 0.0, 0.005);
    run(s, &desc);
    assert_int_equal(state_of(s).paused, 0);
    CHECK_UNTIL(s, feels(s));
    CHECK_UNTIL(s, is_told(s, KNURL_SESSION_CONTACT_STARTED, 0));
    knurl_session_set_paused(s, 1);
    assert_int_equal(state_of(s).paused, 1);
    WAIT_FOR(feels_nothing(s) && state_of(s).in_contact == 0);
    for (const uint64_t ticks = state_of(s).ticks; state_of(s).ticks < ticks + 300; sleep_ms(1.0)) {
        assert_true(feels_nothing(s));
    }
    knurl_session_event event;
    knurl_session_update(s);
    assert_int_equal(knurl_session_next_event(s, &event), 1);
    assert_int_equal(event.kind, KNURL_SESSION_CONTACT_ENDED);
    assert_true(event.surface == plate);
    while (knurl_session_next_event(s, &event)) {
        assert_true(event.kind != KNURL_SESSION_FAULT || event.code != KNURL_FAULT_HEARTBEAT);
    }
    knurl_session_set_paused(s, 0);
    CHECK_UNTIL(s, feels(s));
}

TEST(a_session_can_start_paused) {
    SCOPED_SESSION *s = make_session();
    (void)add_plate(s, 0.0, 0.0, 0.005);
    knurl_session_set_paused(s, 1);
    run_fake(s, "rest");
    CHECK_UNTIL(s, state_of(s).ticks > 300);
    assert_true(feels_nothing(s) && state_of(s).paused == 1);
    knurl_session_close(s);
    knurl_session_set_paused(s, 0);
    run_fake(s, "rest");
    CHECK_UNTIL(s, feels(s));
}

TEST(while_a_game_hangs_its_device_has_no_force) {
    knurl_session_desc desc = describe("fake", "rest");
    SCOPED_SESSION *s = make_session();
    (void)add_plate(s, 0.0, 0.0, 0.0);
    desc.heartbeat_s = 0.05;
    run(s, &desc);
    for (int round = 0; round < 2; round++) {
        CHECK_UNTIL(s, feels(s));
        WAIT_FOR(feels_nothing(s)); /* no update */
        assert_int_equal(state_of(s).in_contact, 1);
        CHECK_UNTIL(s, is_told(s, KNURL_SESSION_FAULT, KNURL_FAULT_HEARTBEAT));
    }
}

TEST(without_a_heartbeat_a_game_may_be_silent) {
    knurl_session_desc desc = describe("fake", "rest");
    SCOPED_SESSION *s = make_session();
    (void)add_plate(s, 0.0, 0.0, 0.0);
    desc.heartbeat_s = 0.0;
    run(s, &desc);
    WAIT_FOR(feels(s) && state_of(s).ticks >= 800);
    knurl_session_update(s);
    assert_false(is_told(s, KNURL_SESSION_FAULT, KNURL_FAULT_HEARTBEAT));
}

/* A mouse that was not moved yet is not silent: it has no positions. */
TEST(a_mouse_is_nowhere_until_it_moves_and_then_feels) {
    static const double above[3] = {0.0, 0.0, 0.01};
    static const double below[3] = {0.0, 0.0, -0.001};
    const knurl_session_desc desc = describe("mouse", "line");
    SCOPED_SESSION *s = make_session();
    (void)add_plate(s, 0.0, 0.0, 0.0);
    run(s, &desc);
    WAIT_FOR(loop_stats(knurl_session_get_loop(s)).absences >= 30); /* silence is reported after 10 */
    assert_true(state_of(s).ticks == 0 && feels_nothing(s));
    knurl_session_update(s);
    assert_false(is_told(s, KNURL_SESSION_FAULT, KNURL_FAULT_SILENT));
    assert_int_equal(knurl_session_move_hip(s, above), KNURL_OK);
    CHECK_UNTIL(s, state_of(s).ticks > 10);
    assert_int_equal(knurl_session_move_hip(s, below), KNURL_OK);
    CHECK_UNTIL(s, fabs(state_of(s).force[2] - STIFFNESS * 0.001) < 1e-3);
}

TEST(losing_the_device_ends_the_run_where_it_is_not_looked_for) {
    knurl_session_desc desc = describe("fake:?lose_at=0.1", "");
    SCOPED_SESSION *s = make_session();
    desc.reconnect = 0;
    run(s, &desc);
    CHECK_UNTIL(s, is_told(s, KNURL_SESSION_FAULT, KNURL_FAULT_LOST));
    CHECK_UNTIL(s, is_told(s, KNURL_SESSION_ENDED, 0));
    assert_int_equal(state_of(s).running, 0);
    assert_int_equal(knurl_session_close_all(), 0);
}

TEST(else_it_is_found_again) {
    const knurl_session_desc desc = describe("fake:?lose_at=0.1", "");
    SCOPED_SESSION *s = make_session();
    run(s, &desc);
    CHECK_UNTIL(s, is_told(s, KNURL_SESSION_FAULT, KNURL_FAULT_RECONNECTED));
    CHECK_UNTIL(s, state_of(s).ticks > 200);
    assert_int_equal(state_of(s).running, 1);
}

/* Edits, closes and starts from the game's thread against the haptic one: for the thread sanitizer. */
TEST(a_game_does_what_it_likes_while_it_runs) {
    static const double upright[4] = {0.0, 0.0, 0.0, 1.0};
    knurl_session_event event;
    char text[512];
    static float rows[2 * 256];
    SCOPED_SESSION *s = make_session();
    for (int round = 0; round < 3; round++) {
        const knurl_surface_id plate = add_plate(s, 0.0, 0.0, 0.0);
        knurl_session_way way = {.clock = KNURL_SESSION_FRAMES};
        run_fake(s, "circle");
        for (int frame = 0; frame < 50; frame++) {
            const double position[3] = {0.0, 0.0, 1e-5 * frame};
            assert_int_equal(knurl_session_move_surface(s, plate, &way, position, upright), KNURL_OK);
            knurl_session_update(s);
            while (knurl_session_next_event(s, &event)) {}
            assert_in_range(knurl_session_get_history(s, 256, rows), 0, 256);
            knurl_session_explain(s, plate, text, sizeof text);
            assert_int_equal(state_of(s).running, 1);
            sleep_ms(2.0);
        }
        assert_int_equal(knurl_scene_remove_surface(knurl_session_get_scene(s), plate), KNURL_OK);
        knurl_session_update(s);
        while (knurl_session_next_event(s, &event)) {}
        assert_true(state_of(s).surface == 0);
        knurl_session_close(s);
        check_no_event(s);
    }
}
