/* The scene and the recorder report the force that a loop sends: with the heartbeat lost, after a halt, at every end. A
 * force that was not sent warms no motor. By stepping, without waiting. SPDX-License-Identifier: MIT */
#include "loop/bench.h"

/* 9 mm deep in a wall of 400 N/m: 3.6 N, of which the motors can play 3.3 N. */
#define DEPTH 0.009

/* The recorder's and the scene's force of a tick is the one sent to the driver. */
static void check_told(void) {
    const knurl_tick_output now = bench_tick();
    const double *sent = written(0);
    CHECK_VECTOR(now.device_force, sent[0], sent[1], sent[2], 0.0);
    CHECK_VECTOR(now.force, sent[0], sent[1], sent[2], 0.0); /* this workspace is not turned */
    CHECK_VECTOR(b.seen.device_force, sent[0], sent[1], sent[2], 0.0);
    CHECK_VECTOR(b.seen.force, sent[0], sent[1], sent[2], 0.0);
}

static void step_and_check(int ticks) {
    for (int i = 0; i < ticks; i++) {
        step(1);
        check_told();
    }
}

/* theta' = -theta/60 s while nothing is sent. */
TEST_WITH(without_a_heartbeat_the_scene_tells_no_force_and_its_motors_cool, NULL, end_bench) {
    bench_open(DEPTH);
    b.desc.heartbeat_s = 0.05;
    step_and_check(40);
    CHECK_CLOSE(written_now(), 3.3, 1e-12);
    step_and_check(60);
    CHECK_CLOSE(written_now(), 0.0, 0.0);
    const double warm = bench_counts().heat;
    step(60000);
    print_message("a minute without a heartbeat: motors %.2f N, told %.2f N, heat %.3f\n", written_now(),
                  vec3_length(bench_tick().force), bench_counts().heat);
    check_told();
    CHECK_CLOSE(bench_counts().heat, warm * exp(-1.0), 1e-9);
    assert_int_equal(bench_tick().contacts, 1); /* the HIP's position is still reported */
    CHECK_CLOSE(bench_tick().depth, DEPTH, 1e-6);
}

/* The wall is felt from no depth on: 0.5 mm more a tick, beside the ramp of 21 steps. */
TEST_WITH(a_force_that_comes_back_is_told_as_it_is_sent_and_comes_back_whole, NULL, end_bench) {
    bench_open(DEPTH);
    b.desc.heartbeat_s = 0.05;
    step(60000);
    for (int k = 0; k < 30; k++) {
        const double before = written_now();
        knurl_loop_heartbeat(b.loop);
        step_and_check(1);
        assert_true(written_now() >= before && written_now() - before <= 3.3 / 5.0 + 1e-12);
        assert_true(written_now() <= 400.0 * 0.0005 * (k + 1) + 1e-12);
    }
    print_message("back after a minute: %.2f N\n", written_now());
    CHECK_CLOSE(written_now(), 3.3, 1e-12);
}

TEST_WITH(after_a_halt_what_is_told_climbs_with_what_is_sent, NULL, end_bench) {
    bench_open(DEPTH);
    step_and_check(40);
    knurl_device_halt(&b.device);
    step_and_check(1);
    CHECK_SAME(written_now(), 0.0L);
    step_and_check(40);
    CHECK_CLOSE(written_now(), 3.3, 1e-12);
}

/* After any end, the reported force is zero. */
TEST_WITH(after_the_end_the_scene_tells_no_force, NULL, end_bench) {
    enum { STOPPED, LIMIT, NO_RAMP, DESTROYED, LOST, LOST_IN_RAMP, ENDS };
    for (int end = 0; end < ENDS; end++) {
        bench_open(DEPTH);
        b.desc.tick_limit = end == LIMIT || end == NO_RAMP || end == LOST_IN_RAMP ? 40 : 0;
        b.desc.ramp_s = end == NO_RAMP ? 0.0 : 0.02;
        b.writes_left = end == LOST ? 40 : end == LOST_IN_RAMP ? 45 : UINT64_MAX;
        step(39);
        CHECK_CLOSE(vec3_length(bench_tick().force), 3.3, 1e-12);
        if (end == STOPPED) {
            knurl_loop_stop(b.loop);
        }
        if (end != DESTROYED) {
            step(100);
        }
        knurl_loop_destroy(b.loop);
        b.loop = NULL;
        const knurl_tick_output last = bench_tick();
        CHECK_VECTOR(last.force, 0.0, 0.0, 0.0, 0.0);
        CHECK_VECTOR(last.device_force, 0.0, 0.0, 0.0, 0.0);
        bench_close();
    }
}

TEST_WITH(the_ramp_at_the_end_is_told_step_by_step_and_is_no_tick, NULL, end_bench) {
    bench_open(DEPTH);
    b.watches_writes = 1;
    b.desc.tick_limit = 40;
    step(40);
    assert_int_equal(bench_counts().ticks, 40);
    assert_int_equal(bench_counts().contact_ticks, 40);
    assert_in_range(b.writes, 60, 61);
    for (uint64_t k = 40; k < 60; k++) {
        CHECK_CLOSE(b.written[k][1], 3.3 * (double)(59 - k) / 20.0, 1e-12);
        CHECK_VECTOR(b.told[k], b.written[k][0], b.written[k][1], b.written[k][2], 0.0);
    }
}

TEST_WITH(a_halt_in_the_ramp_at_the_end_is_reported_as_zero, NULL, end_bench) {
    bench_open(DEPTH);
    b.watches_writes = 1;
    step(39);
    knurl_loop_stop(b.loop);
    knurl_device_halt(&b.device);
    step(100);
    assert_true(b.writes > 45);
    for (uint64_t k = 39; k < b.writes; k++) {
        CHECK_VECTOR(b.written[k], 0.0, 0.0, 0.0, 0.0);
        CHECK_VECTOR(b.told[k], 0.0, 0.0, 0.0, 0.0);
    }
}

/* A HIP's maximum is at most its device's. */
TEST_WITH(what_is_told_is_never_more_than_the_device_can_play, NULL, end_bench) {
    knurl_hip_desc hip;
    knurl_workspace workspace;
    bench_open(DEPTH);
    knurl_hip_desc_init(&hip, sizeof hip);
    knurl_workspace_set_identity(&workspace);
    hip.workspace = &workspace;
    hip.max_force = 20.0;
    assert_int_equal(knurl_scene_configure_hip(b.scene, 0, &hip), KNURL_OK);
    bench_create();
    for (int k = 0; k < 80; k++) { /* down to 29 mm: 11.6 N */
        b.position[1] -= 0.00025;
        step_and_check(1);
    }
    CHECK_CLOSE(written_now(), 3.3, 1e-12);
}

/* To the bit, if a limited force has three components: down to 24 mm in a wall that is turned about x and z. */
TEST_WITH(a_force_that_was_limited_is_sent_as_it_is_told, NULL, end_bench) {
    static const double here[3] = {0.0, 0.0, 0.0};
    for (int i = 1; i <= 20; i++) {
        bench_open(0.004);
        const double tilt[4] = {-0.70710678118654752, 0.0, 0.01 * i, 0.70710678118654752 + 0.007 * i};
        const double size = sqrt(tilt[0] * tilt[0] + tilt[2] * tilt[2] + tilt[3] * tilt[3]);
        const double unit[4] = {tilt[0] / size, 0.0, tilt[2] / size, tilt[3] / size};
        assert_int_equal(knurl_scene_set_transform(b.scene, knurl_scene_get_surface(b.scene, 0), here, unit, 0.0),
                         KNURL_OK);
        bench_create();
        for (int k = 0; k < 40; k++) {
            b.position[1] -= 0.0005;
            step_and_check(1);
        }
        assert_true(bench_counts().force_limit_ticks > 10);
        bench_close();
    }
}

TEST_WITH(what_a_callback_asked_for_and_did_not_get_warms_nothing, NULL, end_bench) {
    static double most[3] = {0.0, 3.3, 0.0};
    bench_open(DEPTH);
    b.desc.heartbeat_s = 0.05;
    bench_create_callback(push_force, most);
    step(60000);
    const knurl_loop_stats stats = loop_stats(b.loop);
    CHECK_SAME(written_now(), 0.0L);
    /* 51 ticks of 3.3 N and a ramp warm by 3.3^2/0.88^2 (51 + 7) ms/60 s at most */
    assert_true(stats.heat < 14.1 * 0.075 / 60.0);
}
