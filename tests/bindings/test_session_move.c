/* Surfaces that follow an engine's objects, and the HIP that a game moves. SPDX-License-Identifier: MIT */
#include "session_rig.h"

static const double upright[4] = {0.0, 0.0, 0.0, 1.0};

typedef struct rig {
    knurl_session *s;
    knurl_surface_id plate;
    knurl_session_way way;
} rig;

static rig r; /* reset by set_up() */

static int end(void **state) {
    (void)state;
    knurl_session_destroy(r.s);
    memset(&r, 0, sizeof r);
    return 0;
}

/* A finger 1 mm deep in a plate at 0 that is to move, after so many ticks. */
static void set_up(uint64_t ticks) {
    (void)end(NULL);
    r.s = make_session();
    r.plate = add_plate(r.s, 0.0, 0.0, 0.0);
    begin_with(r.s, "fake", "");
    press(r.s, 0.0, 0.0);
    step(r.s, ticks - state_of(r.s).ticks);
}

static void move_to(double x, double z) {
    const double position[3] = {x, 0.0, z};
    assert_int_equal(knurl_session_move_surface(r.s, r.plate, &r.way, position, upright), KNURL_OK);
}

/* z of the plate, after so many more ticks. */
static double plate_after(uint64_t ticks) {
    step(r.s, ticks);
    return state_of(r.s).proxy[2];
}

/* The plate rises evenly, and arrives after `ticks`: checked half way, where an error of one tick is visible. */
static void check_way(double from, double to, double ticks) {
    const uint64_t half = (uint64_t)(0.5 * ticks);
    const double share = (double)half / ticks;
    const double tick = (to - from) / ticks;
    CHECK_CLOSE(plate_after(half), from + share * (to - from), 0.51 * tick);
    CHECK_CLOSE(plate_after((uint64_t)ticks - half + 2), to, 1e-12);
}

/* A sixtieth of a second, or the time since the last move, unless that was long ago. */
TEST_WITH(a_move_takes_a_sixtieth_of_a_second_or_the_time_since_the_last, NULL, end) {
    static const struct {
        uint64_t since; /* ticks; 0: there was no other */
        double ticks;
    } cases[] = {{0, 1000.0 / 60.0}, {50, 50.0}, {101, 1000.0 / 60.0}};
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        const double from = cases[i].since > 0 ? 0.0002 : 0.0;
        set_up(200);
        if (cases[i].since > 0) {
            move_to(0.0, from);
            step(r.s, cases[i].since);
        }
        move_to(0.0, 0.0005);
        check_way(from, 0.0005, cases[i].ticks);
    }
}

TEST_WITH(two_moves_of_a_tick_are_a_place, NULL, end) {
    set_up(200);
    move_to(0.0, 0.0002);
    move_to(0.0, 0.0005);
    (void)plate_after(1);
    CHECK_CLOSE(plate_after(1), 0.0005, 1e-12);
}

/* 10 m/s over a sixtieth: 0.1667 m. The plate reaches 0.05 m: dragged, it is still under the finger a tick later. */
TEST_WITH(surfaces_faster_than_10_m_per_s_jump, NULL, end) {
    set_up(200);
    move_to(0.166, 0.0);
    step(r.s, 1);
    assert_int_equal(state_of(r.s).in_contact, 1);
    set_up(200);
    move_to(0.168, 0.0);
    step(r.s, 1);
    assert_int_equal(state_of(r.s).in_contact, 0);
}

TEST_WITH(a_slow_frame_leaps_further, NULL, end) {
    set_up(200);
    move_to(0.0, 0.0001);
    step(r.s, 50); /* at 10 m/s: 0.5 m */
    move_to(0.49, 0.0001);
    step(r.s, 1);
    assert_int_equal(state_of(r.s).in_contact, 1);
}

TEST_WITH(a_way_begins_where_the_surface_was_added, NULL, end) {
    r.s = make_session();
    r.plate = add_plate(r.s, 0.5, 0.0, 0.0);
    r.way.position[0] = 0.5;
    begin_with(r.s, "fake", "");
    press(r.s, 0.5, 0.0);
    step(r.s, 200);
    move_to(0.5, 0.0005);
    check_way(0.0, 0.0005, 1000.0 / 60.0);
}

TEST_WITH(a_move_that_is_refused_leaves_the_way, NULL, end) {
    static const double no_rotation[4] = {0.0, 0.0, 0.0, 2.0};
    static const double far[3] = {0.0, 0.0, NAN};
    static const double near[3] = {0.0, 0.0, 0.001};
    set_up(20);
    CHECK_REFUSED(knurl_session_move_surface(r.s, r.plate, &r.way, far, upright), KNURL_ERROR_ARGUMENT, r.way);
    CHECK_REFUSED(knurl_session_move_surface(r.s, r.plate, &r.way, near, no_rotation), KNURL_ERROR_ARGUMENT, r.way);
    assert_int_equal(knurl_scene_remove_surface(r.s->scene, r.plate), KNURL_OK);
    CHECK_REFUSED(knurl_session_move_surface(r.s, r.plate, &r.way, near, upright), KNURL_ERROR_STALE_ID, r.way);
}

TEST_WITH(surfaces_moved_while_stopped_are_placed_at_once, NULL, end) {
    r.s = make_session();
    r.plate = add_plate(r.s, 0.0, 0.0, 0.0);
    move_to(0.0, 0.01); /* closed */
    open_with(r.s, "fake", "");
    move_to(0.0, 0.02);
    begin(r.s);
    hold(r.s, 0.0, 0.0, 0.021, 2);
    hold(r.s, 0.0, 0.0, 0.019, 5);
    CHECK_CLOSE(state_of(r.s).proxy[2], 0.02, 1e-12);
}

TEST(the_game_moves_the_mouse_alone) {
    static const double here[3] = {0.0, 0.0, 0.0};
    static const double nowhere[3] = {0.0, INFINITY, 0.0};
    SCOPED_SESSION *s = make_session();
    assert_int_equal(knurl_session_move_hip(s, here), KNURL_ERROR_STATE);
    check_message("closed");
    open_with(s, "fake", "");
    assert_int_equal(knurl_session_move_hip(s, here), KNURL_ERROR_STATE);
    check_message("another device");
    knurl_session_close(s);
    open_with(s, "mouse", "");
    assert_int_equal(knurl_session_move_hip(s, nowhere), KNURL_ERROR_ARGUMENT);
    check_message("finite");
    assert_int_equal(knurl_session_move_hip(s, here), KNURL_OK);
}

TEST(the_mouse_is_moved_in_the_scene) {
    static const double there[3] = {0.3, 0.2, 0.1};
    knurl_session_desc desc = describe("mouse", "");
    knurl_device_sample sample;
    double expected[3];
    SCOPED_SESSION *s = make_session();
    desc.workspace.origin[0] = 1.0;
    desc.workspace.scale = 2.0;
    open_session(s, &desc);
    assert_int_equal(knurl_session_move_hip(s, there), KNURL_OK);
    assert_int_equal(knurl_device_read(knurl_session_get_device(s), &sample), KNURL_OK);
    knurl_workspace_to_device(&desc.workspace, there, expected);
    CHECK_VECTOR(sample.position, expected[0], expected[1], expected[2], 0.0);
}
