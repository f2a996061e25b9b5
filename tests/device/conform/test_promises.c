/* Forces that a device's write() must never see: turned workspaces, halts, pauses and gains after a
 * squeeze, devices that are closed under their loops. SPDX-License-Identifier: MIT */
#include "stage.h"

#include <stdio.h>

static stage s; /* reset by each test */

/* --- a workspace that turns --- */

enum { HELD, PRESSED, BOTH, WAYS };
static const char *const ways[WAYS] = {"a force is held", "pressed into a wall", "both"};

static void turn_half(double seconds) {
    knurl_workspace turned;
    knurl_workspace_set_identity(&turned);
    turned.rotation[4] = turned.rotation[8] = -1.0; /* about x */
    judge_edits(&s.j);
    assert_int_equal(knurl_scene_set_workspace(s.scene, 0, &turned, seconds), KNURL_OK);
}

TEST(a_workspace_that_turns_over_turns_the_force_no_faster_than_the_slew_limit) {
    static const double held[3] = {0.0, 0.0, STAGE_FORCE};
    static const double seconds[] = {0.0, 0.001, 0.002, 0.004, 0.008, 0.016, 0.2};
    int well = 1;
    for (int way = 0; way < WAYS; way++) {
        for (size_t i = 0; i < COUNT_OF(seconds); i++) {
            char what[96];
            stage_open(&s, way == HELD ? 0.0 : 1000.0, 0.0, 0.02, 0, 0.0);
            stage_step(&s, 1);
            for (int k = 0; way != HELD && k < 100; k++) {
                s.position[2] -= 5e-5; /* to 5 mm under it */
                stage_step(&s, 1);
            }
            if (way != PRESSED) {
                assert_int_equal(knurl_loop_set_force(s.loop, held), KNURL_OK);
            }
            stage_step(&s, 20);
            assert_true(s.latest[2] > 3.0); /* there is something to turn */
            turn_half(seconds[i]);
            stage_step(&s, 300);
            assert_true(way != HELD || s.latest[2] < -3.0); /* and it was */
            (void)snprintf(what, sizeof what, "%s, half a turn within %g s", ways[way], seconds[i]);
            well &= stage_held(&s, what);
            stage_close(&s);
        }
    }
    assert_true(well);
}

/* --- after a squeeze --- */

/* The lid comes down through hand and plane until it releases it, the hand 4 mm over the plane. */
static void squeeze(double ramp_s, double heartbeat_s) {
    stage_open(&s, 1500.0, 0.005, ramp_s, 0, heartbeat_s);
    s.position[2] = 0.004;
    stage_step(&s, 2);
    double z = 0.005;
    s.flags = 0;
    for (int k = 0; k < 200 && !(s.flags & KNURL_TICK_SQUEEZED); k++) {
        static const double turned[4] = {1.0, 0.0, 0.0, 0.0};
        z -= 1e-4;
        const double at[3] = {0.0, 0.0, z};
        judge_edits(&s.j);
        assert_int_equal(knurl_scene_set_transform(s.scene, s.lid, at, turned, 0.001), KNURL_OK);
        knurl_loop_heartbeat(s.loop);
        stage_step(&s, 1);
    }
    assert_true(s.flags & KNURL_TICK_SQUEEZED);
    assert_true(stage_length(&s) > 2.0); /* it is held by the release */
}

TEST(a_squeeze_is_released_by_a_ramp) {
    squeeze(0.02, 0.0);
    stage_step(&s, 1);
    assert_true(stage_length(&s) > 1.0);
    stage_step(&s, 10);
    CHECK_SAME(stage_length(&s), 0.0L);
    assert_true(stage_held(&s, "a squeeze"));
    stage_close(&s);
}

TEST(a_halt_in_the_tick_after_a_squeeze_zeroes_the_force_and_it_comes_back_by_the_ramp) {
    squeeze(0.02, 0.0);
    s.j.halted = 1;
    knurl_device_halt(s.device);
    stage_step(&s, 1);
    CHECK_SAME(stage_length(&s), 0.0L);
    stage_step(&s, 30);
    assert_true(stage_held(&s, "a halt after a squeeze"));
    stage_close(&s);
}

TEST(a_game_that_is_gone_in_the_tick_after_a_squeeze_gets_no_force_without_a_ramp) {
    squeeze(0.0, 0.001);
    stage_step(&s, 1); /* a tick is within a heartbeat of 1 ms */
    assert_true(stage_length(&s) > 1.0);
    for (int k = 0; k < 10; k++) {
        stage_step(&s, 1);
        CHECK_SAME(stage_length(&s), 0.0L);
    }
    stage_close(&s);
}

/* --- a gain while there is no position --- */

TEST(a_gain_of_0_that_is_set_while_there_is_no_position_holds_when_there_is_one_again) {
    static const double held[3] = {0.0, 0.0, STAGE_FORCE};
    stage_open(&s, 0.0, 0.0, 0.02, 0, 0.0);
    assert_int_equal(knurl_loop_set_force(s.loop, held), KNURL_OK);
    stage_step(&s, 20);
    CHECK_CLOSE(stage_length(&s), STAGE_FORCE, 1e-12);
    s.position[1] = (double)NAN;
    s.j.gain = 0.0;
    assert_int_equal(knurl_loop_set_gain(s.loop, 0.0), KNURL_OK);
    for (int k = 0; k < 60; k++) {
        s.j.absent = 1;
        stage_step(&s, 1);
    }
    s.position[1] = 0.0;
    for (int k = 0; k < 60; k++) {
        s.j.absent = k < 20; /* positions must stay for 20 ms */
        stage_step(&s, 1);
    }
    assert_true(stage_held(&s, "a gain of 0"));
    stage_close(&s);
}

/* --- the end --- */

/* N: the force when the call returns. */
static double left_when_closed(int threaded, uint32_t blocking) {
    static const double held[3] = {0.0, 0.0, 3.0};
    stage_open(&s, 0.0, 0.0, 0.02, blocking, 0.0);
    assert_int_equal(knurl_loop_set_force(s.loop, held), KNURL_OK);
    if (threaded) {
        assert_int_equal(knurl_loop_start(s.loop), KNURL_OK);
        (void)knurl_loop_wait(s.loop, 0.1);
    } else {
        stage_step(&s, 30);
    }
    assert_true(stage_length(&s) > 2.0);
    knurl_device_close(s.device);
    const double left = stage_length(&s);
    s.device = NULL;
    stage_close(&s);
    return left;
}

TEST(a_device_that_is_closed_under_its_loop_has_no_force_when_the_call_returns) {
    static const struct {
        int threaded;
        uint32_t blocking;
        const char *name;
    } cases[] = {{0, 0, "stepped"}, {1, 0, "with a haptic thread"}, {1, 1, "with an I/O thread"}};
    int well = 1;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        const double left = left_when_closed(cases[i].threaded, cases[i].blocking);
        if (left > 0.0) {
            print_error("%s: %g N when knurl_device_close() returns\n", cases[i].name, left);
            well = 0;
        }
    }
    assert_true(well);
}
