/* The protections of a HIP in its ticks: forces that they limit, and forces that they do not change by a bit.
 * SPDX-License-Identifier: MIT */
#include "scene/scene.h"

#include "guard/passivity.h"

#include "scene/ask.h"
#include "support/rig.h"

#define K     700.0
#define TICKS 600

/* HIP 0 with every protection but those of `without`, device axes the scene's, no quantum. */
static knurl_hip_desc guarded(uint32_t without) {
    knurl_hip_desc hip = hip_in_scene_axes();
    hip.resolution = 0.0;
    hip.protections = KNURL_PROTECT_ALL & ~without;
    return hip;
}

static surface_parts wall(double stiffness) {
    surface_parts parts = surface_plane();
    parts.material.stiffness = stiffness;
    return parts;
}

static knurl_scene *guarded_wall(double stiffness) {
    surface_parts parts = wall(stiffness);
    const knurl_hip_desc hip = guarded(0);
    return scene_with_hip(&parts, &hip);
}

/* 0.5 m/s is 0.5 mm a tick at 1 kHz: 9 mm take 18 of them. 100 N/m: 50 N/s, which no slew limit minds. */
TEST(a_first_tick_pressed_in_comes_in_as_a_ramp) {
    SCOPED_SCENE *scene = guarded_wall(100.0);
    for (int tick = 1; tick <= 30; tick++) {
        const knurl_tick_output out = tick_at(scene, 0.0, 0.0, -0.009);
        CHECK_CLOSE(out.force[2], 100.0 * fmin(0.009, 0.0005 * tick), 1e-12);
        CHECK_CLOSE(out.depth, 0.009, 1e-15); /* the reported depth is the true one */
        assert_int_equal((out.flags & KNURL_TICK_ENTRY) != 0, tick < 18);
        assert_int_equal(out.flags & KNURL_TICK_SLEW, 0);
    }
    assert_true(counts_of(scene).entry_ticks == 17);
}

TEST(friction_comes_in_with_the_depth_that_is_felt) {
    surface_parts parts = wall(100.0);
    parts.material.friction = 0.5;
    const knurl_hip_desc hip = guarded(0);
    SCOPED_SCENE *scene = scene_with_hip(&parts, &hip);
    for (int tick = 0; tick < 30; tick++) {
        const knurl_tick_output out = tick_at(scene, 0.001 * tick, 0.0, -0.009); /* it slips, or the spring is short */
        assert_true(fabs(out.force[0]) <= 0.5 * out.force[2] + 1e-12);
    }
}

/* A wall that jumps 6 mm up under a HIP that is 1 mm in. */
TEST(a_wall_that_jumps_comes_in_as_a_ramp) {
    SCOPED_SCENE *scene = guarded_wall(100.0);
    for (int tick = 0; tick < 10; tick++) {
        (void)tick_at(scene, 0.0, 0.0, 0.001 - 0.0002 * (tick + 1));
    }
    CHECK_CLOSE(tick_at(scene, 0.0, 0.0, -0.001).force[2], 0.1, 1e-12);
    glide_to(scene, 0.0, 0.0, 0.006, 0.0);
    for (int tick = 1; tick <= 20; tick++) {
        const knurl_tick_output out = tick_at(scene, 0.0, 0.0, -0.001);
        CHECK_CLOSE(out.force[2], 100.0 * fmin(0.007, 0.001 + 0.0005 * tick), 1e-12);
    }
}

/* 10,000 N/m: 5 N a tick by the ramp alone; 3.3 N within 5 ms is 0.66 N a tick. */
TEST(a_force_grows_no_faster_than_the_slew_rate) {
    static const double rates[] = {KNURL_DEFAULT, 200.0};
    for (size_t i = 0; i < COUNT_OF(rates); i++) {
        surface_parts parts = wall(10000.0);
        knurl_hip_desc hip = guarded(0);
        const double step = 0.001 * (rates[i] > 0.0 ? rates[i] : 3.3 / 0.005);
        hip.slew_rate = rates[i];
        SCOPED_SCENE *scene = scene_with_hip(&parts, &hip);
        for (int tick = 1; tick <= 30; tick++) {
            const knurl_tick_output out = tick_at(scene, 0.0, 0.0, -0.001);
            CHECK_CLOSE(out.force[2], fmin(3.3, step * tick), 1e-12);
        }
        assert_true(counts_of(scene).slew_ticks > 0);
    }
}

TEST(after_lift_off_the_force_is_zero_at_once) {
    SCOPED_SCENE *scene = guarded_wall(K);
    for (int tick = 0; tick < 40; tick++) {
        (void)tick_at(scene, 0.0, 0.0, -0.004);
    }
    CHECK_CLOSE(tick_at(scene, 0.0, 0.0, -0.004).force[2], 2.8, 1e-12);
    const knurl_tick_output out = tick_at(scene, 0.0, 0.0, 0.001);
    CHECK_VECTOR(out.force, 0.0, 0.0, 0.0, 0.0);
    assert_int_equal(out.flags & KNURL_TICK_SLEW, 0);
}

/* The same strokes with and without protections: 2.5, 3 and 5 ticks a cycle at the largest amplitude that keeps within
 * max_force, pressed in at 0.1 m/s, lifted, tapped. */
TEST(square_waves_at_full_amplitude_pass_every_limit_to_the_bit) {
    static const int32_t methods[] = {KNURL_METHOD_S1, KNURL_METHOD_S2, KNURL_METHOD_BANDLIMITED};
    static const double speeds[] = {0.4, 1.0 / 3.0, 0.2, 0.05, 0.01}; /* m/s; 1000 cycles/m */
    for (size_t m = 0; m < COUNT_OF(methods); m++) {
        for (size_t v = 0; v < COUNT_OF(speeds); v++) {
            knurl_scene *scenes[2];
            for (uint32_t i = 0; i < 2; i++) {
                surface_parts parts = wall(K);
                knurl_hip_desc hip = guarded(i ? KNURL_PROTECT_ALL : 0);
                hip.continuous_force = (double)INFINITY;
                set_grating(&parts, methods[m], 1000.0, 0.0, 3.3 / (2.8745 * K));
                scenes[i] = scene_with_hip(&parts, &hip);
            }
            for (int tick = 0; tick < TICKS; tick++) {
                const int p = tick % 150; /* a tap: 0.1 m/s down, 0.2 m/s up */
                const double down = p < 100 ? fmin(0.003, 1e-4 * p - 0.004) : 0.003 - 2e-4 * (p - 100);
                const double x = -0.04 + fmod(0.001 * speeds[v] * tick, 0.08);
                const knurl_tick_output a = tick_at(scenes[0], x, 0.0, -down);
                const knurl_tick_output b = tick_at(scenes[1], x, 0.0, -down);
                assert_memory_equal(a.force, b.force, sizeof a.force);
                assert_memory_equal(a.device_force, b.device_force, sizeof a.force);
                assert_int_equal(a.flags, b.flags);
            }
            knurl_scene_destroy(scenes[0]);
            knurl_scene_destroy(scenes[1]);
        }
    }
}

/* theta' = ((F/Fc)^2 - theta)/tau: theta is (F/Fc)^2 (1 - exp(-t/tau)) while F is held, and the limit has not come down
 * before theta is 0.9. Then at most continuous_force in the long run, and theta never above 1. */
TEST(motors_warm_up_as_the_closed_form_has_it_and_are_kept_from_more) {
    surface_parts parts = wall(1000.0);
    const double held = 2.0;
    const double tau = 2.0;
    knurl_hip_desc hip = guarded(KNURL_PROTECT_ENTRY | KNURL_PROTECT_SLEW);
    hip.heat_time = tau;
    hip.continuous_force = 0.88;
    SCOPED_SCENE *scene = scene_with_hip(&parts, &hip);
    const double ratio2 = held * held / (0.88 * 0.88);
    const double warm = -tau * log(1.0 - 0.9 / ratio2); /* s */
    double last = held;
    double sum2 = 0.0;
    for (int tick = 1; tick <= 30000; tick++) {
        const knurl_tick_output out = tick_at(scene, 0.0, 0.0, -0.002);
        const knurl_hip_counts counts = counts_of(scene);
        assert_true(counts.heat <= 1.0);
        if (tick < 1000.0 * warm - 1.0) {
            CHECK_CLOSE(out.force[2], held, 1e-12);
            CHECK_CLOSE(counts.heat, ratio2 * (1.0 - exp(-0.001 * tick / tau)), 1e-9);
            assert_int_equal(out.flags & KNURL_TICK_HEAT, 0);
        }
        assert_true(out.force[2] <= last + 1e-12 && out.force[2] >= last - 0.1); /* smoothly down */
        last = out.force[2];
        sum2 += tick > 20000 ? last * last : 0.0;
    }
    CHECK_CLOSE(sqrt(sum2 / 10000.0), 0.88, 0.005);
    assert_true(last >= 0.88 && counts_of(scene).heat_ticks > 20000);
    for (int tick = 0; tick < 10000; tick++) { /* five time constants off the wall */
        (void)tick_at(scene, 0.0, 0.0, 0.01);
    }
    CHECK_CLOSE(counts_of(scene).heat, exp(-5.0), 1e-3);
    CHECK_CLOSE(tick_at(scene, 0.0, 0.0, -0.002).force[2], held, 1e-12);
}

TEST(an_endless_continuous_force_is_no_limit) {
    surface_parts parts = wall(1000.0);
    knurl_hip_desc hip = guarded(KNURL_PROTECT_ENTRY | KNURL_PROTECT_SLEW);
    hip.continuous_force = (double)INFINITY;
    hip.heat_time = 0.1;
    SCOPED_SCENE *scene = scene_with_hip(&parts, &hip);
    for (int tick = 0; tick < 3000; tick++) {
        CHECK_CLOSE(tick_at(scene, 0.0, 0.0, -0.003).force[2], 3.0, 1e-12);
    }
}

/* A rig's device reports the Touch's 0.88 N and 60 s. 2 N: theta 0.9 after 11.5 s. */
TEST(a_callback_warms_the_same_motors) {
    const double ratio2 = 2.0 * 2.0 / (0.88 * 0.88);
    rig_init(&r);
    r.force[1] = 2.0;
    rig_create(&r);
    assert_int_equal(knurl_loop_step(r.loop, 9000), KNURL_OK);
    CHECK_CLOSE(rig_stats(&r).heat, ratio2 * (1.0 - exp(-0.15)), 1e-9);
    assert_true(rig_stats(&r).heat_ticks == 0);
    CHECK_CLOSE(r.written[(9000 - 1) % RIG_ROOM][1], 2.0, 1e-12);
    assert_int_equal(knurl_loop_step(r.loop, 360000), KNURL_OK);
    assert_true(rig_stats(&r).heat <= 1.0 && rig_stats(&r).heat_ticks > 300000);
    CHECK_CLOSE(r.written[(369000 - 1) % RIG_ROOM][1], 0.88, 0.01);
    rig_destroy(&r);
}

TEST(a_callback_may_leave_the_heat_to_its_device) {
    rig_init(&r);
    r.force[1] = 2.0;
    r.desc.protections = 0;
    rig_create(&r);
    assert_int_equal(knurl_loop_step(r.loop, 60000), KNURL_OK);
    assert_true(rig_stats(&r).heat_ticks == 0);
    CHECK_CLOSE(r.written[(60000 - 1) % RIG_ROOM][1], 2.0, 1e-12);
    rig_destroy(&r);
}

TEST(nothing_that_is_not_a_number_gets_past_the_protections) {
    SCOPED_SCENE *scene = guarded_wall(K);
    static const double wrong[] = {(double)NAN, (double)INFINITY};
    for (int tick = 0; tick < 60; tick++) {
        const int bad = tick % 10 == 9;
        const knurl_tick_output out = tick_at(scene, 0.0, 0.0, bad ? wrong[tick / 10 % 2] : -0.001);
        assert_true(isfinite(out.force[2]) && isfinite(counts_of(scene).heat));
        if (bad) {
            CHECK_VECTOR(out.force, 0.0, 0.0, 0.0, 0.0);
            assert_true((out.flags & KNURL_TICK_NOT_FINITE) != 0);
        } else if (tick % 10 == 0) {
            CHECK_CLOSE(out.force[2], K * 0.0005, 1e-12); /* again from nothing, as a ramp */
        }
    }
}

TEST(configuring_a_hip_begins_anew_and_cools_no_motor) {
    surface_parts parts = wall(K);
    knurl_hip_desc hip = guarded(0);
    hip.heat_time = 0.1;
    SCOPED_SCENE *scene = scene_with_hip(&parts, &hip);
    for (int tick = 0; tick < 1000; tick++) {
        (void)tick_at(scene, 0.0, 0.0, -0.004);
    }
    const double warm = counts_of(scene).heat;
    assert_true(warm > 0.9);
    assert_int_equal(knurl_scene_configure_hip(scene, 0, &hip), KNURL_OK);
    CHECK_CLOSE(tick_at(scene, 0.0, 0.0, -0.004).force[2], K * 0.0005, 1e-12);
    const double ratio2 = K * 0.0005 * K * 0.0005 / (0.88 * 0.88);
    CHECK_CLOSE(counts_of(scene).heat, ratio2 + (warm - ratio2) * exp(-0.001 / 0.1), 1e-12);
    hip.continuous_force = 1.76; /* of motors that hold twice as much it is a quarter */
    assert_int_equal(knurl_scene_configure_hip(scene, 0, &hip), KNURL_OK);
    const double before = counts_of(scene).heat;
    (void)tick_at(scene, 0.0, 0.0, 0.01);
    assert_true(before == 0.0); /* zero before the first tick */
    CHECK_CLOSE(counts_of(scene).heat, 0.25 * (ratio2 + (warm - ratio2) * exp(-0.01)) * exp(-0.01), 1e-12);
}

/* A HIP swings between 0 and `swing` (m) deep in a wall that could run away, `hz` times a second, each swing `keeps` of
 * the one before. Returns the tick at which the controller first acts, or -1. */
static int swing_in(knurl_scene *scene, double swing, double hz, double keeps) {
    int first = -1;
    for (int tick = 0; tick < 2000; tick++) {
        const double depth =
            0.5 * swing * pow(keeps, 0.002 * hz * tick) * (1.0 - cos(6.28318530717958648 * hz * 0.001 * tick));
        const knurl_tick_output out = tick_at(scene, 0.0, 0.0, -depth);
        first = first < 0 && (out.flags & KNURL_TICK_PASSIVITY) ? tick : first;
    }
    return first;
}

/* 4 swings of 2.5 mm at 20 Hz are over after 100 ms, 17 of 1.2 mm after 425 ms. A hand taps at less than 8 Hz; swings
 * that decay by a tenth each, or are small, are not a runaway; a wall within (b + 0.5 N s/m)/1.5 ms = 667 N/m is
 * passive. */
TEST(swings_that_go_on_are_stopped_and_nothing_else) {
    const struct {
        double stiffness, swing, hz, keeps;
        int after, before; /* ticks; 0: never */
    } rows[] = {{1020.0, 0.003, 20.0, 1.0, 75, 150},   {1020.0, 0.0012, 20.0, 1.0, 375, 475},
                {1020.0, 0.0012, 40.0, 1.0, 188, 238}, {1020.0, 0.003, 7.0, 1.0, 0, 0},
                {1020.0, 0.003, 20.0, 0.9, 0, 0},      {1020.0, 0.0006, 20.0, 1.0, 0, 0},
                {660.0, 0.003, 20.0, 1.0, 0, 0}};
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        SCOPED_SCENE *scene = guarded_wall(rows[i].stiffness);
        const int first = swing_in(scene, rows[i].swing, rows[i].hz, rows[i].keeps);
        if (rows[i].before) {
            assert_in_range(first, rows[i].after, rows[i].before);
        } else {
            assert_int_equal(first, -1);
        }
    }
}

/* Off all walls for half a second, and they are hard again. */
TEST(walls_are_hard_again_once_the_hip_has_been_off_them) {
    SCOPED_SCENE *scene = guarded_wall(1020.0);
    assert_true(swing_in(scene, 0.003, 20.0, 1.0) > 0);
    for (int round = 0; round < 2; round++) {
        for (int tick = 0; tick < (round ? 520 : 480); tick++) {
            (void)tick_at(scene, 0.0, 0.0, 0.001);
        }
        const knurl_tick_output out = tick_at(scene, 0.0, 0.0, -0.0004);
        assert_int_equal((out.flags & KNURL_TICK_PASSIVITY) != 0, round == 0);
        if (round == 1) {
            CHECK_CLOSE(out.force[2], 1020.0 * 0.0004, 1e-12);
        } else {
            assert_true(out.force[2] < 667.0 * 0.0004);
        }
    }
}

TEST(configuring_a_hip_or_giving_it_a_device_ends_an_alarm) {
    for (int adopts = 0; adopts < 2; adopts++) {
        const knurl_hip_desc hip = guarded(0);
        SCOPED_SCENE *scene = guarded_wall(1020.0);
        assert_true(swing_in(scene, 0.003, 20.0, 1.0) > 0);
        (void)tick_at(scene, 0.0, 0.0, -0.0004);
        assert_true(tick_at(scene, 0.0, 0.0, -0.0004).flags & KNURL_TICK_PASSIVITY);
        assert_int_equal(adopts ? knurl_scene_adopt_device(scene, 0, &knurl_touch)
                                : knurl_scene_configure_hip(scene, 0, &hip),
                         KNURL_OK);
        const knurl_tick_output out = tick_at(scene, 0.0, 0.0, -0.0004);
        CHECK_CLOSE(out.force[2], 1020.0 * 0.0004, 1e-12);
        assert_int_equal(out.flags & KNURL_TICK_PASSIVITY, 0);
        assert_int_equal(counts_of(scene).passivity_ticks, 0);
    }
}

TEST(unknown_protections_and_clamps_are_refused) {
    SCOPED_SCENE *scene = empty_scene(1);
    const knurl_hip_desc good = guarded(0);
    knurl_hip_desc bad = good;
    bad.protections = KNURL_PROTECT_ALL + 1;
    assert_int_equal(knurl_scene_configure_hip(scene, 0, &bad), KNURL_ERROR_ARGUMENT);
    bad = good;
    bad.clamp = 2;
    assert_int_equal(knurl_scene_configure_hip(scene, 0, &bad), KNURL_ERROR_ARGUMENT);
}

/* The rules tuned by test_protection_grids.c, one at a time: swings of 2 mm in a wall. */
static knurl_passivity swinging(void) {
    knurl_passivity p;
    memset(&p, 0, sizeof p);
    p.longest = 120;
    p.unit = 1.0;
    p.reversal = KNURL_PASSIVITY_REVERSAL;
    p.farthest = 2e-3;
    p.direction = -1.0;
    return p;
}

TEST(a_swing_smaller_than_the_largest_starts_the_row_again_and_keeps_half) {
    knurl_passivity p = swinging();
    p.row = 3;
    p.squares = 10e-6;
    p.largest = 5e-3;
    p.off = 7.0;
    knurl_passivity_end_swing(&p);
    assert_int_equal(p.row, 1);
    CHECK_CLOSE(p.squares, 5e-6 + 4e-6, 1e-15);
    CHECK_SAME(p.off, 0.0);
    assert_false(p.alarmed);
}

TEST(a_swing_ends_once_the_depth_is_back_by_a_fifth_of_a_millimetre_of_the_device) {
    for (double scale = 0.5; scale <= 2.0; scale *= 4.0) {
        knurl_passivity p;
        knurl_passivity_init(&p, &knurl_touch);
        knurl_passivity_set_scale(&p, 1, &knurl_touch, scale);
        p.farthest = 2e-3 * scale;
        for (int is_over = 0; is_over <= 1; is_over++) {
            p.depth = p.farthest - (is_over ? 0.21e-3 : 0.19e-3) * scale;
            knurl_passivity_follow(&p);
            assert_int_equal(p.direction > 0.0, is_over);
        }
    }
}

TEST(a_depth_at_rest_is_followed_and_none_outside_a_wall) {
    for (int is_inside = 0; is_inside <= 1; is_inside++) {
        knurl_passivity p = swinging();
        p.farthest = p.depth = is_inside ? 2e-3 : 0.0;
        p.ticks = 121; /* longer than a swing */
        p.busy = 1;
        knurl_passivity_follow(&p);
        assert_int_equal(p.busy, is_inside);
    }
}

TEST(a_row_is_over_when_nothing_turns_for_the_longest_swing) {
    knurl_passivity p = swinging();
    p.row = 3;
    p.squares = p.largest = p.moved = 1.0;
    p.crossings = 2;
    p.ticks = 120;
    p.busy = 1;
    p.depth = 2e-3; /* as far as ever */
    knurl_passivity_follow(&p);
    assert_true(p.busy == 1 && !knurl_passivity_counts(&p));
    knurl_passivity_follow(&p); /* from a depth of 0: the swing ends */
    assert_true(p.row == 0 && p.crossings == 0 && !p.alarmed);
    CHECK_SAME(p.squares + p.largest + p.moved, 0.0);
}
