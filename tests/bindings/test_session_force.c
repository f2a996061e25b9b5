/* A game's control of the force, and a workspace that moves with its node.
 * SPDX-License-Identifier: MIT */
#include "session_rig.h"
#include "support/idle_device.h"

static knurl_workspace at(double x, double z, double scale) {
    knurl_workspace workspace;
    knurl_workspace_set_identity(&workspace);
    workspace.origin[0] = x;
    workspace.origin[2] = z;
    workspace.scale = scale;
    return workspace;
}

static void move(knurl_session *s, const knurl_workspace *to) {
    assert_int_equal(knurl_session_move_workspace(s, KNURL_SESSION_FRAMES, to), KNURL_OK);
}

/* A finger that the fake hand holds 5 mm deep in a plate at 0: 2 N. */
static knurl_session *pressed(void) {
    knurl_session *s = make_session();
    (void)add_plate(s, 0.0, 0.0, 0.0);
    begin_with(s, "fake", "");
    press(s, 0.0, 0.0);
    hold(s, 0.0, 0.0, -0.005, 100);
    return s;
}

TEST(a_gain_counts_for_this_run_and_for_later_ones) {
    SCOPED_SESSION *s = pressed();
    CHECK_CLOSE(state_of(s).force[2], 2.0, 1e-6);
    assert_int_equal(knurl_session_set_gain(s, 0.5), KNURL_OK);
    step(s, 40);
    CHECK_CLOSE(state_of(s).force[2], 1.0, 1e-6);
    knurl_session_close(s);
    CHECK_CLOSE(s->gain, 0.5, 0.0);
    assert_int_equal(knurl_session_set_gain(s, 1.5), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_session_set_gain(s, NAN), KNURL_ERROR_ARGUMENT);
    CHECK_CLOSE(s->gain, 0.5, 0.0);
}

TEST(forces_and_vibrations_are_a_runs_and_end_with_it) {
    static const double force[3] = {0.5, 0.0, 0.0};
    static const double along[3] = {0.0, 1.0, 0.0};
    SCOPED_SESSION *s = make_session();
    assert_int_equal(knurl_session_set_force(s, force), KNURL_ERROR_STATE);
    assert_int_equal(knurl_session_vibrate(s, KNURL_WAVE_T1, 100.0, 1.0, along, 1.0), KNURL_ERROR_STATE);
    begin_with(s, "fake", "");
    assert_int_equal(knurl_session_set_force(s, force), KNURL_OK);
    assert_int_equal(knurl_session_vibrate(s, KNURL_WAVE_T1, 100.0, 1.0, along, 1.0), KNURL_OK);
    step(s, 4);
    CHECK_VECTOR(state_of(s).force, 0.5, 1.0, 0.0, 1e-9);
    knurl_session_close(s);
    begin_with(s, "fake", "");
    step(s, 4);
    CHECK_VECTOR(state_of(s).force, 0.0, 0.0, 0.0, 0.0);
}

TEST(a_workspace_follows_its_node_by_the_engines_clock_and_is_where_it_stands) {
    const knurl_workspace to = at(0.0, 0.01, 1.0);
    SCOPED_SESSION *s = pressed();
    move(s, &to);
    step(s, 60);
    CHECK_CLOSE(state_of(s).hip[2], 0.005, 1e-9); /* out of the plate, with a hand that held still */
    assert_int_equal(state_of(s).in_contact, 0);
}

TEST(a_workspace_that_is_faster_than_10_m_per_s_leaps_through_a_wall) {
    const knurl_workspace to = at(0.0, -2.0, 1.0);
    SCOPED_SESSION *s = make_session();
    (void)add_plate(s, 0.0, 0.0, 0.0);
    begin_with(s, "fake", "");
    hold(s, 0.0, 0.0, 0.02, 100);
    move(s, &to);
    step(s, 1);
    CHECK_CLOSE(state_of(s).hip[2], -1.98, 1e-9);
    assert_int_equal(state_of(s).in_contact, 0);
}

TEST(the_mouse_goes_where_the_game_says_wherever_the_workspace_has_gone) {
    const knurl_workspace to = at(0.1, 0.0, 2.0);
    static const double there[3] = {0.03, 0.02, 0.01};
    SCOPED_SESSION *s = make_session();
    open_with(s, "mouse", "");
    assert_int_equal(knurl_session_start(s, NULL, 0), KNURL_OK);
    move(s, &to);
    assert_int_equal(knurl_session_move_hip(s, there), KNURL_OK);
    CHECK_UNTIL(s, fabs(state_of(s).hip[0] - 0.03) < 1e-6);
    CHECK_VECTOR(state_of(s).hip, 0.03, 0.02, 0.01, 1e-5);
}

/* 4 mm below the node, 1 mm above the plate: twice as far from the node is 3 mm deep in it. */
TEST(a_scale_that_changes_carries_the_hip_into_what_it_meets) {
    SCOPED_SESSION *s = make_session();
    const knurl_workspace start = at(0.0, 0.0, 1.0);
    const knurl_workspace to = at(0.0, 0.0, 2.0);
    (void)add_plate(s, 0.0, 0.0, -0.005);
    begin_with(s, "fake", "");
    hold(s, 0.0, 0.0, -0.004, 100);
    move(s, &start);
    move(s, &to);
    step(s, 140); /* 0.2 s times ln 2 */
    CHECK_CLOSE(state_of(s).hip[2], -0.008, 1e-9);
    CHECK_CLOSE(state_of(s).force[2], STIFFNESS * 0.003, 1e-6);
}

/* The hand moves from 20 mm to 10 mm meanwhile; then the HIP moves from its place, twice as far as the hand. */
TEST(a_scale_that_changes_with_the_clutch_leaves_the_hip) {
    SCOPED_SESSION *s = pressed();
    const knurl_workspace to = at(0.0, 0.0, 2.0);
    hold(s, 0.02, 0.0, -0.005, 100);
    assert_int_equal(knurl_session_set_clutch(s, 1), KNURL_OK);
    hold(s, 0.01, 0.0, -0.005, 100);
    move(s, &to);
    assert_int_equal(knurl_session_set_clutch(s, 0), KNURL_OK);
    hold(s, 0.01, 0.0, -0.005, 100);
    CHECK_VECTOR(state_of(s).hip, 0.02, 0.0, -0.005, 1e-9);
    CHECK_CLOSE(state_of(s).force[2], 2.0, 1e-6);
    hold(s, 0.015, 0.0, -0.005, 100);
    CHECK_VECTOR(state_of(s).hip, 0.03, 0.0, -0.005, 1e-9);
}

TEST(an_invalid_scale_is_refused) {
    SCOPED_SESSION *s = pressed();
    const knurl_workspace to = at(0.0, 0.0, 0.0);
    assert_int_equal(knurl_session_move_workspace(s, KNURL_SESSION_FRAMES, &to), KNURL_ERROR_ARGUMENT);
    step(s, 10);
    CHECK_VECTOR(state_of(s).hip, 0.0, 0.0, -0.005, 1e-9);
}

/* The hand moves 30 mm to the left with the clutch on; then as far to the right without it. */
TEST(a_clutch_lets_the_hand_go_back_while_the_hip_stays) {
    SCOPED_SESSION *s = pressed();
    hold(s, 0.02, 0.0, -0.005, 100);
    assert_int_equal(knurl_session_set_clutch(s, 1), KNURL_OK);
    hold(s, -0.01, 0.0, -0.005, 100);
    CHECK_VECTOR(state_of(s).hip, 0.02, 0.0, -0.005, 1e-9);
    CHECK_VECTOR(state_of(s).force, 0.0, 0.0, 0.0, 0.0);
    assert_int_equal(knurl_session_set_clutch(s, 0), KNURL_OK);
    hold(s, -0.01, 0.0, -0.005, 100);
    CHECK_VECTOR(state_of(s).hip, 0.02, 0.0, -0.005, 1e-9);
    CHECK_CLOSE(state_of(s).force[2], 2.0, 1e-6);
    hold(s, 0.01, 0.0, -0.005, 100);
    CHECK_VECTOR(state_of(s).hip, 0.04, 0.0, -0.005, 1e-9);
}

/* A quarter turn about z of the node: the clutch's offset of the workspace turns with it. */
TEST(the_clutchs_offset_moves_with_the_node) {
    static const double quarter[9] = {0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0};
    knurl_workspace to = at(0.0, 0.0, 1.0);
    SCOPED_SESSION *s = pressed();
    hold(s, 0.02, 0.0, 0.02, 100);
    assert_int_equal(knurl_session_set_clutch(s, 1), KNURL_OK);
    hold(s, 0.0, 0.0, 0.02, 100);
    assert_int_equal(knurl_session_set_clutch(s, 0), KNURL_OK);
    memcpy(to.rotation, quarter, sizeof quarter);
    move(s, &to);
    hold(s, 0.0, 0.0, 0.02, 200);
    CHECK_VECTOR(state_of(s).hip, 0.0, 0.02, 0.02, 1e-9);
}

/* A device whose stylus is turned by a quarter about its z, in a workspace that is turned by a quarter about x. */
static knurl_result read_turned(void *user, knurl_device_sample *sample) {
    (void)user;
    memset(sample, 0, sizeof *sample);
    sample->orientation[2] = sample->orientation[3] = 0.70710678118654752;
    return KNURL_OK;
}

TEST(a_styluss_orientation_is_reported_in_scene_axes) {
    static const double over[9] = {1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0};
    SCOPED_SESSION *s = make_session();
    knurl_session_desc desc = describe("fake", "");
    knurl_device_functions functions = idle_functions();
    memcpy(desc.workspace.rotation, over, sizeof over);
    open_session(s, &desc);
    knurl_device_close(s->device);
    functions.read = read_turned;
    assert_int_equal(knurl_device_open_functions(&functions, &s->device), KNURL_OK);
    s->is_fake = 0;
    assert_int_equal(knurl_session_start(s, NULL, 0), KNURL_OK);
    CHECK_UNTIL(s, state_of(s).stylus[3] != 0.0);
    const knurl_session_state now = state_of(s); /* (1, 0, 0; 1) (0, 0, 1; 1) / 2 = (1, -1, 1; 1) / 2 */
    CHECK_VECTOR(now.stylus, 0.5, -0.5, 0.5, 1e-12);
    CHECK_CLOSE(now.stylus[3], 0.5, 1e-12);
    knurl_session_close(s);
    CHECK_VECTOR(state_of(s).stylus, 0.0, 0.0, 0.0, 0.0);
}
