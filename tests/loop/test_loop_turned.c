/* Forces sent to a device, in its own axes: with a turning workspace, after a squeeze and a halt, from a callback. By
 * stepping, without waiting. SPDX-License-Identifier: MIT */
#include "loop/bench.h"

#define SLEW (3.3 / 5.0) /* N a tick: 3.3 N within 5 ms */

/* N: distance of the last force from the previous one, shortened to its length. */
static double change(void) {
    const double *now = written(0);
    const double *before = written(1);
    const double length = vec3_length(before);
    double from[3];
    double made[3];
    vec3_scale(length > 0.0 ? fmin(1.0, vec3_length(now) / length) : 0.0, before, from);
    vec3_sub(now, from, made);
    return vec3_length(made);
}

/* Half a turn about z, or back. */
static void turn(int over, double seconds) {
    knurl_workspace to;
    knurl_workspace_set_identity(&to);
    to.rotation[0] = to.rotation[4] = over ? -1.0 : 1.0;
    assert_int_equal(knurl_scene_set_workspace(b.scene, 0, &to, seconds), KNURL_OK);
}

/* --- turned --- */

/* 3.3 N along x, from +3.3 to -3.3 N in ten ticks. */
TEST_WITH(a_held_force_turns_round_at_the_slew_limit_when_the_workspace_jumps, NULL, end_bench) {
    static const double force[3] = {3.3, 0.0, 0.0};
    bench_open(-0.02);
    bench_create();
    assert_int_equal(knurl_loop_set_force(b.loop, force), KNURL_OK);
    step(20);
    turn(1, 0.0);
    for (int k = 1; k <= 12; k++) {
        step(1);
        CHECK_VECTOR(written(0), fmax(3.3 - SLEW * k, -3.3), 0.0, 0.0, 1e-12);
        CHECK_VECTOR(bench_tick().device_force, written(0)[0], 0.0, 0.0, 0.0);
        CHECK_VECTOR(bench_tick().force, -written(0)[0], 0.0, 0.0, 1e-12);
        assert_int_equal((bench_tick().flags & KNURL_TICK_SLEW) != 0, k < 10);
    }
}

TEST_WITH(a_games_force_turns_round_at_the_slew_limit, NULL, end_bench) {
    static const double forces[2][3] = {{0.0, 0.0, 3.0}, {0.0, 0.0, -3.0}};
    bench_open(-0.02);
    bench_create();
    assert_int_equal(knurl_loop_set_force(b.loop, forces[0]), KNURL_OK);
    step(20);
    assert_int_equal(knurl_loop_set_force(b.loop, forces[1]), KNURL_OK);
    for (int k = 1; k <= 12; k++) {
        step(1);
        CHECK_CLOSE(written(0)[2], fmax(3.0 - SLEW * k, -3.0), 1e-12);
    }
}

/* Held, or pressed into the wall, during the turn. A snap turn of an engine takes a frame. */
TEST_WITH(a_force_turns_no_faster_than_the_slew_limit_however_short_the_frame, NULL, end_bench) {
    static const double frames[] = {0.0, 0.001, 0.002, 0.004, 0.008, 0.016};
    static const double force[3] = {3.3, 0.0, 0.0};
    for (int pressed = 0; pressed < 2; pressed++) {
        for (size_t i = 0; i < COUNT_OF(frames); i++) {
            double most = 0.0;
            bench_open(pressed ? 0.008 : -0.02);
            bench_create();
            assert_int_equal(knurl_loop_set_force(b.loop, pressed ? (double[3]){0.0, 0.0, 0.0} : force), KNURL_OK);
            step(60);
            assert_true(written_now() > 3.0);
            for (int k = 0; k < 100; k++) {
                if (k % 25 == 0) {
                    turn(k % 50 == 0, frames[i]);
                }
                step(1);
                most = fmax(most, change());
            }
            if (!(most <= SLEW + 1e-9)) {
                fail_msg("%s, half a turn in %g s: a step of %.2f N", pressed ? "pressed" : "held", frames[i], most);
            }
            bench_close();
        }
    }
}

/* A vibration's steps are lengths, the same in any axes: 250 Hz of 1 N, 4 ticks a period, along x. */
TEST_WITH(a_vibration_passes_a_turned_workspace_to_the_bit, NULL, end_bench) {
    static const double along[3] = {1.0, 0.0, 0.0};
    bench_open(-0.02);
    bench_create();
    turn(1, 0.0);
    step(1);
    assert_int_equal(knurl_loop_vibrate(b.loop, KNURL_WAVE_T3, 250.0, 1.0, along, 0.02), KNURL_OK);
    for (int k = 0; k < 20; k++) {
        step(1);
        CHECK_VECTOR(written(0), k % 4 < 2 ? -1.0 : 1.0, 0.0, 0.0, 0.0);
    }
}

/* --- squeezed, then halted --- */

static knurl_surface_id lid; /* over the wall, facing it */

static void place_lid(double height, double seconds) {
    static const double over[4] = {0.70710678118654752, 0.0, 0.0, 0.70710678118654752};
    const double at[3] = {0.0, height, 0.0};
    assert_int_equal(knurl_scene_set_transform(b.scene, lid, at, over, seconds), KNURL_OK);
}

/* A loop whose lid has come down at 0.1 m/s until it squeezed the HIP, 4 mm above the wall. pause_at: the
 * tick at which it pauses; -1: never. Returns the tick of the squeeze. */
static int squeeze(double ramp_s, int pause_at) {
    surface_parts parts = surface_plane();
    bench_open(-0.004);
    parts.desc.position[1] = 0.005;
    parts.desc.normal[1] = -1.0;
    parts.material.stiffness = 1000.0;
    lid = add_surface(b.scene, &parts);
    b.desc.ramp_s = ramp_s;
    step(1);
    for (int tick = 0; tick < 100; tick++) {
        if (tick == pause_at) {
            knurl_loop_pause(b.loop);
        }
        place_lid(0.005 - 0.0001 * (tick + 1), 0.001);
        step(1);
        if (bench_tick().flags & KNURL_TICK_SQUEEZED) {
            return tick;
        }
    }
    fail_msg("never squeezed");
    return -1;
}

TEST_WITH(a_halt_a_pause_and_gain_0_zero_the_force_also_after_a_squeeze, NULL, end_bench) {
    enum { HALT, PAUSE, GAIN, WAYS };
    for (int way = 0; way < WAYS; way++) {
        (void)squeeze(0.0, -1);
        assert_true(written_now() > 2.6);
        if (way == HALT) {
            knurl_device_halt(&b.device);
        } else if (way == PAUSE) {
            knurl_loop_pause(b.loop);
        } else {
            assert_int_equal(knurl_loop_set_gain(b.loop, 0.0), KNURL_OK);
        }
        step(1);
        CHECK_VECTOR(written(0), 0.0, 0.0, 0.0, 0.0);
        CHECK_VECTOR(bench_tick().device_force, 0.0, 0.0, 0.0, 0.0);
        b.position[1] = -0.004; /* into the wall: 1.6 N, which come by the slew limit, if at all */
        for (int k = 0; k < 30; k++) {
            step(1);
            assert_true(change() <= SLEW + 1e-9);
        }
        assert_int_equal(written_now() > 1.0, way == HALT); /* which the loop has released */
        bench_close();
    }
}

TEST_WITH(a_squeeze_without_a_halt_is_released_by_the_slew_limit, NULL, end_bench) {
    (void)squeeze(0.02, -1);
    place_lid(0.1, 0.0);
    double before = written_now();
    step(1);
    CHECK_CLOSE(written_now(), before - SLEW, 1e-9);
}

/* Rounding left 1e-16 of the gain after as many steps as the ramp has (3 of 1/3, for one), and so the release of a
 * squeeze went on for another tick. */
TEST_WITH(a_pause_is_over_after_its_ramp_whatever_the_ramp_and_the_squeeze, NULL, end_bench) {
    const int at = squeeze(0.02, -1);
    bench_close();
    for (int ramp = 1; ramp <= 40; ramp++) {
        assert_int_equal(squeeze(0.001 * ramp, at + 1 - ramp), at);
        step(1); /* the ramp's last */
        CHECK_VECTOR(written(0), 0.0, 0.0, 0.0, 0.0);
        bench_close();
    }
}

/* --- by a callback --- */

static void begin_callback(double wanted[3], uint32_t protections) {
    bench_open(0.0);
    b.desc.protections = protections;
    bench_create_callback(push_force, wanted);
}

/* Its jumps may be a texture of its own. */
TEST_WITH(a_callbacks_force_grows_by_the_slew_limit_if_that_is_asked_for, NULL, end_bench) {
    for (uint32_t slews = 0; slews < 2; slews++) {
        double wanted[3] = {0.0, 0.0, 3.0};
        begin_callback(wanted, KNURL_PROTECT_HEAT | (slews ? KNURL_PROTECT_SLEW : 0u));
        for (int k = 1; k <= 6; k++) {
            step(1);
            CHECK_CLOSE(written(0)[2], slews ? fmin(3.0, SLEW * k) : 3.0, 1e-12);
        }
        wanted[2] = -3.0;
        step(1);
        CHECK_CLOSE(written(0)[2], slews ? 3.0 - SLEW : -3.0, 1e-12);
        wanted[2] = 0.0;
        step(1);
        CHECK_VECTOR(written(0), 0.0, 0.0, 0.0, 0.0);
        bench_close();
    }
}

TEST_WITH(a_callbacks_force_that_is_not_finite_is_none, NULL, end_bench) {
    static const double wrong[] = {(double)NAN, (double)INFINITY, -(double)INFINITY};
    for (size_t i = 0; i < COUNT_OF(wrong); i++) {
        double wanted[3] = {1.0, wrong[i], 0.0};
        begin_callback(wanted, KNURL_PROTECT_HEAT);
        step(3);
        CHECK_VECTOR(written(0), 0.0, 0.0, 0.0, 0.0);
        wanted[1] = 2.0;
        step(1);
        CHECK_VECTOR(written(0), 1.0, 2.0, 0.0, 0.0);
        bench_close();
    }
}

TEST_WITH(a_loop_has_two_protections_and_no_others, NULL, end_bench) {
    double wanted[3] = {0.0, 0.0, 0.0};
    for (uint32_t bits = 0; bits <= KNURL_PROTECT_ALL + 1; bits++) {
        begin_callback(wanted, 0);
        knurl_loop_destroy(b.loop);
        b.loop = NULL;
        b.desc.protections = bits;
        const int is_known = (bits & ~(uint32_t)(KNURL_PROTECT_HEAT | KNURL_PROTECT_SLEW)) == 0;
        assert_int_equal(knurl_loop_create(&b.desc, &b.loop), is_known ? KNURL_OK : KNURL_ERROR_ARGUMENT);
        bench_close();
    }
}
