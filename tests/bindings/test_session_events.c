/* Events of a session: touches, buttons and faults, their order, and those after its end.
 * SPDX-License-Identifier: MIT */
#include "session_rig.h"

#include "device/driver.h"

enum { STARTED = KNURL_SESSION_CONTACT_STARTED, ENDED = KNURL_SESSION_CONTACT_ENDED };

/* Three plates side by side, the first under the origin; open, with a loop to step. */
typedef struct three {
    knurl_session *s;
    knurl_surface_id plate[3];
} three;

static three t; /* begun by set_up() */

static int end(void **state) {
    (void)state;
    knurl_session_destroy(t.s);
    memset(&t, 0, sizeof t);
    return 0;
}

static void set_up(const char *device) {
    (void)end(NULL);
    t.s = make_session();
    for (int i = 0; i < 3; i++) {
        t.plate[i] = add_plate(t.s, 0.2 * i, 0.0, 0.0);
    }
    begin_with(t.s, device, "");
}

/* The same without plates. */
static knurl_session *set_up_nothing(const char *device) {
    t.s = make_session();
    begin_with(t.s, device, "");
    return t.s;
}

static void press_on(int i) {
    press(t.s, 0.2 * i, 0.0);
}

/* The first plate is touched, and that was reported. */
static void set_up_touching(const char *device) {
    set_up(device);
    press_on(0);
    knurl_session_update(t.s);
    check_event(t.s, STARTED, t.plate[0]);
}

TEST_WITH(a_touch_is_reported_at_its_beginning_and_end, NULL, end) {
    set_up("fake");
    lift(t.s);
    knurl_session_update(t.s);
    check_no_event(t.s);
    press_on(0);
    check_no_event(t.s); /* before an update */
    knurl_session_update(t.s);
    assert_true(state_of(t.s).surface == 0 && state_of(t.s).in_contact == 1);
    check_event(t.s, STARTED, t.plate[0]);
    assert_true(state_of(t.s).surface == t.plate[0]);
    check_no_event(t.s);
    lift(t.s);
    knurl_session_update(t.s);
    assert_true(state_of(t.s).surface == t.plate[0] && state_of(t.s).in_contact == 0);
    check_event(t.s, ENDED, t.plate[0]);
    assert_true(state_of(t.s).surface == 0);
    check_no_event(t.s);
}

/* "+1-1": the second plate was touched and left. */
static void check_touches(const char *told) {
    for (; *told; told += 2) {
        check_event(t.s, told[0] == '+' ? STARTED : ENDED, t.plate[told[1] - '0']);
    }
    check_no_event(t.s);
}

/* Moves within a frame: a digit presses on that plate, '^' lifts. A plate that is touched again in the same frame was
 * never left, and each plate gets one event of a kind. */
TEST_WITH(touches_of_a_frame_are_reported_once_and_in_their_order, NULL, end) {
    static const struct {
        int is_touching; /* the first plate, and its event was read */
        const char *frames[2], *told[2];
    } cases[] = {
        {0, {"0^", ""}, {"+0-0", ""}},
        {1, {"^0^0", ""}, {"", ""}},
        {1, {"21", ""}, {"-0+2-2+1", ""}},
        {1, {"212", "01010^"}, {"-0+1-1+2", "-2+0-0+1-1"}},
    };
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        (cases[i].is_touching ? set_up_touching : set_up)("fake");
        for (int frame = 0; frame < 2; frame++) {
            for (const char *move = cases[i].frames[frame]; *move; move++) {
                if (*move == '^') {
                    lift(t.s);
                } else {
                    press_on(*move - '0');
                }
            }
            knurl_session_update(t.s);
            check_touches(cases[i].told[frame]);
        }
    }
}

TEST_WITH(removing_a_surface_ends_its_contact, NULL, end) {
    set_up_touching("fake");
    assert_int_equal(knurl_scene_remove_surface(t.s->scene, t.plate[0]), KNURL_OK);
    knurl_session_update(t.s); /* the last tick still has it */
    check_event(t.s, ENDED, t.plate[0]);
    step(t.s, 1);
    knurl_session_update(t.s);
    check_no_event(t.s);
}

TEST_WITH(a_touch_of_a_removed_surface_is_not_reported, NULL, end) {
    set_up("fake");
    press_on(0);
    press_on(1);
    knurl_session_update(t.s);
    assert_int_equal(knurl_scene_remove_surface(t.s->scene, t.plate[0]), KNURL_OK);
    check_event(t.s, STARTED, t.plate[1]);
    assert_int_equal(knurl_scene_remove_surface(t.s->scene, t.plate[1]), KNURL_OK);
    press_on(2);
    knurl_session_update(t.s);
    check_touches("-1+2");
}

TEST_WITH(each_start_has_its_end_even_if_fetched_late, NULL, end) {
    knurl_session_event event;
    knurl_surface_id touched = 0;
    uint32_t count = 0;
    set_up("fake");
    for (int i = 0; i < 1000; i++) {
        press_on(i % 3);
        knurl_session_update(t.s);
    }
    while (knurl_session_next_event(t.s, &event)) {
        assert_int_equal(event.kind, touched ? ENDED : STARTED);
        assert_true(!touched || event.surface == touched);
        touched = touched ? 0 : event.surface;
        assert_true(++count <= 2 * KNURL_SESSION_TOUCHES);
    }
    assert_true(count > KNURL_SESSION_TOUCHES && touched == t.plate[999 % 3]);
}

TEST_WITH(closing_in_the_middle_of_fetching_leaves_one_end, NULL, end) {
    set_up("fake:?press_at=0.001");
    press_on(0);
    press_on(1);
    press_on(2);
    knurl_session_update(t.s);
    check_event(t.s, STARTED, t.plate[0]);
    knurl_session_close(t.s);
    assert_true(state_of(t.s).surface == 0);
    check_event(t.s, ENDED, t.plate[0]);
    check_no_event(t.s);
}

TEST_WITH(closing_before_anything_was_fetched_leaves_nothing, NULL, end) {
    set_up("fake:?press_at=0.001");
    press_on(0);
    knurl_session_update(t.s);
    knurl_session_close(t.s);
    check_no_event(t.s);
}

TEST_WITH(opened_again_it_tells_the_old_end_first, NULL, end) {
    const knurl_session_desc desc = describe("fake", "");
    set_up_touching("fake");
    knurl_session_close(t.s);
    open_session(t.s, &desc);
    begin(t.s);
    press_on(0);
    knurl_session_update(t.s);
    check_touches("-0+0");
}

static void check_button(knurl_session *s, int32_t button, double pressed) {
    knurl_session_event event;
    assert_int_equal(knurl_session_next_event(s, &event), 1);
    assert_int_equal(event.kind, KNURL_SESSION_BUTTON);
    assert_int_equal(event.code, button);
    CHECK_SAME(event.value, pressed);
}

TEST_WITH(a_button_is_reported_when_it_goes_down_and_when_it_comes_up, NULL, end) {
    knurl_session *s = set_up_nothing("fake:?press_at=0.05"); /* for 0.1 s */
    step(s, 50);
    knurl_session_update(s);
    check_no_event(s);
    step(s, 1);
    knurl_session_update(s);
    assert_int_equal(state_of(s).buttons, 1);
    check_button(s, 0, 1.0);
    check_no_event(s);
    step(s, 101);
    knurl_session_update(s);
    assert_int_equal(state_of(s).buttons, 0);
    check_button(s, 0, 0.0);
    check_no_event(s);
}

TEST_WITH(every_button_has_its_number, NULL, end) {
    knurl_session *s = set_up_nothing("fake");
    step(s, 1);
    s->device->buttons = 0x80000005u;
    knurl_session_update(s);
    check_button(s, 0, 1.0);
    check_button(s, 2, 1.0);
    check_button(s, 31, 1.0);
    s->device->buttons = 0x00000004u;
    knurl_session_update(s);
    check_button(s, 0, 0.0);
    check_button(s, 31, 0.0);
    check_no_event(s);
}

static void check_fault(knurl_session *s, int32_t code, double value) {
    knurl_session_event event;
    assert_int_equal(knurl_session_next_event(s, &event), 1);
    assert_int_equal(event.kind, KNURL_SESSION_FAULT);
    assert_int_equal(event.code, code);
    CHECK_SAME(event.value, value);
}

TEST(a_lost_device_is_reported_and_then_the_end) {
    knurl_session_desc desc = describe("fake:?lose_at=0.1", "");
    SCOPED_SESSION *s = make_session();
    const knurl_surface_id plate = add_plate(s, 0.0, 0.0, 0.0);
    desc.reconnect = 0;
    open_session(s, &desc);
    begin(s);
    press(s, 0.0, 0.0);
    knurl_session_update(s);
    check_event(s, STARTED, plate);
    step(s, 1000);
    knurl_session_update(s);
    check_event(s, ENDED, plate); /* without a position nothing is felt */
    check_fault(s, KNURL_FAULT_LOST, 0.0);
    assert_int_equal(state_of(s).running, 0);
    assert_true(state_of(s).ticks == 0);
    check_event(s, KNURL_SESSION_ENDED, 0);
    check_no_event(s);
    knurl_session_update(s);
    check_no_event(s); /* once */
    knurl_session_close(s);
    check_no_event(s);
}

TEST_WITH(a_device_that_comes_back_is_reported_and_goes_on, NULL, end) {
    knurl_session *s = set_up_nothing("fake:?lose_at=0.1");
    step(s, 300);
    knurl_session_update(s);
    check_fault(s, KNURL_FAULT_LOST, 0.0);
    knurl_session_event event;
    int is_back = 0;
    while (knurl_session_next_event(s, &event)) {
        assert_int_equal(event.kind, KNURL_SESSION_FAULT);
        is_back = is_back || event.code == KNURL_FAULT_RECONNECTED;
    }
    assert_true(is_back && state_of(s).running);
}

TEST(a_device_without_a_position_plays_nothing) {
    knurl_session_desc desc = describe("fake:?lose_at=0.1", "");
    SCOPED_SESSION *s = make_session();
    (void)add_plate(s, 0.0, 0.0, 0.0);
    desc.reconnect = 0;
    open_session(s, &desc);
    begin(s);
    press(s, 0.0, 0.0);
    CHECK_CLOSE(state_of(s).force[2], STIFFNESS * 0.001, 1e-9);
    assert_int_equal(state_of(s).in_contact, 1);
    step(s, 100);
    const knurl_session_state now = state_of(s); /* before an update has seen the end */
    assert_true(now.running == 1 && now.in_contact == 0 && now.ticks == 100);
    CHECK_VECTOR(now.force, 0.0, 0.0, 0.0, 0.0);
    CHECK_VECTOR(now.proxy, now.hip[0], now.hip[1], now.hip[2], 0.0);
    CHECK_SAME(now.hip[2], -0.001);
}

TEST_WITH(faults_come_with_their_values_after_touches_and_buttons, NULL, end) {
    set_up("fake:?press_at=0.001");
    press_on(0);
    knurl_events_report(&t.s->device->events, KNURL_FAULT_SILENT, 0.012);
    knurl_session_update(t.s);
    check_event(t.s, STARTED, t.plate[0]);
    check_button(t.s, 0, 1.0);
    check_fault(t.s, KNURL_FAULT_SILENT, 0.012);
    check_no_event(t.s);
}

/* A handler that takes longer than a device that fails in every tick. */
TEST_WITH(a_frame_ends_however_many_faults_there_are, NULL, end) {
    knurl_session_event event;
    knurl_session *s = set_up_nothing("fake");
    step(s, 1);
    knurl_events_report(&s->device->events, KNURL_FAULT_CORRUPT, 1.0);
    knurl_session_update(s);
    int count = 0;
    while (knurl_session_next_event(s, &event)) {
        knurl_events_report(&s->device->events, KNURL_FAULT_CORRUPT, 1.0);
        assert_true(++count <= KNURL_EVENT_ROOM);
    }
    knurl_session_update(s);
    assert_int_equal(knurl_session_next_event(s, &event), 1);
}

/* 0.4 N for 0.1 s, and a hand that slides at 50 mm/s: the impulse on a touched body, and the state for a game. */
TEST(state_tells_impulse_velocity_and_depth) {
    static const double rows[8] = {0.0, 0.0, 0.0, -0.001, 1.0, 0.05, 0.0, -0.001};
    SCOPED_SESSION *s = make_session();
    (void)add_plate(s, 0.0, 0.0, 0.0);
    begin_with(s, "fake", "");
    s->board.period = 1e-3;
    press(s, 0.0, 0.0);
    step(s, 300);
    const knurl_session_state before = state_of(s);
    CHECK_CLOSE(before.depth, 0.001, 1e-4);
    step(s, 100);
    const knurl_session_state after = state_of(s);
    CHECK_CLOSE(after.impulse[2] - before.impulse[2], 0.001 * STIFFNESS * 0.1, 1e-4);
    CHECK_CLOSE(after.impulse[0] - before.impulse[0], 0.0, 1e-9);
    assert_int_equal(knurl_fake_set_trace(s->device, rows, 2), KNURL_OK);
    step(s, 500);
    CHECK_CLOSE(state_of(s).velocity[0], 0.05, 0.005);
}

/* Depends on the devices connected to the test machine. */
TEST(auto_is_what_is_connected_or_says_that_nothing_is) {
    const knurl_session_desc desc = describe("auto", "");
    SCOPED_SESSION *s = make_session();
    if (knurl_session_open(s, &desc)) {
        check_message("auto: expected a device that is connected");
    } else {
        assert_non_null(knurl_session_get_device(s));
    }
}
