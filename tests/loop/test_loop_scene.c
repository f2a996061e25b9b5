/* The loop with a scene: settings from its description, a HIP's and a device's; equal forces by stepping and by a
 * thread; a recorder's output. By the tests' own clock. SPDX-License-Identifier: MIT */
#include "support/close.h"
#include "support/rig.h"
#include "support/scenes.h"

/* A plate of 100 x 100 mm at y = 0, front up, 1 mm period along x, 0.2 mm, 400 N/m. */
static knurl_scene *make_scene(int committed) {
    knurl_scene *scene = empty_scene(1);
    surface_parts parts = surface_plane();
    set_grating(&parts, KNURL_METHOD_DEFAULT, 1000.0, 0.0, 0.0002);
    parts.desc.normal[1] = 1.0;
    (void)add_surface(scene, &parts);
    if (committed) {
        assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    }
    return scene;
}

#define TICKS 1500

typedef struct record {
    knurl_tick_output outputs[TICKS];
    uint64_t count;
} record;

static void take(const knurl_tick_output *output, void *user) {
    record *into = user;
    if (into->count < TICKS) {
        into->outputs[into->count] = *output;
    }
    into->count++;
}

/* The rig's loop plays that scene. */
static void use_scene(knurl_scene *scene, knurl_tick_callback callback, void *user) {
    r.desc.scene = scene;
    r.desc.force_callback = NULL;
    r.desc.tick_callback = callback;
    r.desc.user = user;
}

/* A stroke of the fake hand on the plate, in steps of a size, or (0) on a thread by a clock that oversleeps. */
static void play(record *into, uint64_t steps) {
    static int64_t late[TICKS];
    uint64_t random = 3;
    SCOPED_SCENE *scene = make_scene(1);
    SCOPED_DEVICE *device = NULL;
    for (size_t i = 0; i < COUNT_OF(late); i++) {
        late[i] = random_integer(&random, 0, i % 40 == 0 ? 5000000 : 300000);
    }
    memset(into, 0, sizeof *into);
    assert_int_equal(knurl_device_open("fake:?seed=5", &device), KNURL_OK);
    rig_init(&r);
    r.late = late;
    r.late_count = COUNT_OF(late);
    r.desc.device = device;
    use_scene(scene, take, into);
    r.desc.tick_limit = TICKS;
    rig_create(&r);
    while (steps > 0 && rig_stats(&r).state != KNURL_LOOP_DONE) {
        rig_step(&r, steps);
    }
    if (steps == 0) {
        rig_run(&r);
        assert_true(rig_stats(&r).overruns > 10);
    }
    assert_int_equal(into->count, TICKS);
    rig_destroy(&r);
}

static void check_same_record(const record *a, const record *b) {
    assert_int_equal(a->count, b->count);
    for (size_t i = 0; i < TICKS; i++) {
        check_same_output(&a->outputs[i], &b->outputs[i]);
    }
}

TEST_WITH(stepping_and_a_thread_give_the_same_forces_tick_for_tick, NULL, end_rig) {
    static record stepped;
    static record other;
    play(&stepped, TICKS);
    uint64_t touched = 0;
    for (size_t i = 0; i < TICKS; i++) {
        touched += stepped.outputs[i].force[1] > 0.1;
    }
    assert_true(touched > TICKS / 2); /* there is something to compare */
    play(&other, 0);
    check_same_record(&stepped, &other);
    play(&other, 7);
    check_same_record(&stepped, &other);
}

TEST_WITH(the_tick_callback_sees_each_tick_once_with_the_force_that_is_written, begin_rig, end_rig) {
    static record seen;
    memset(&seen, 0, sizeof seen);
    SCOPED_SCENE *scene = make_scene(1);
    use_scene(scene, take, &seen);
    rig_step(&r, 50); /* x = 1 mm a tick, y = 0: on the plate */
    assert_int_equal(seen.count, 50);
    for (size_t i = 0; i < 50; i++) {
        assert_int_equal(seen.outputs[i].tick, i);
        assert_memory_equal(seen.outputs[i].device_force, r.written[i], sizeof r.written[i]);
    }
    rig_destroy(&r);
    assert_int_equal(seen.count, 50);
}

static void count_writes(const knurl_tick_output *output, void *user) {
    uint64_t *late = user;
    *late += r.writes <= output->tick;
}

TEST_WITH(a_recorder_delays_no_force, begin_rig, end_rig) {
    uint64_t late = 0;
    SCOPED_SCENE *scene = make_scene(1);
    use_scene(scene, count_writes, &late);
    rig_step(&r, 50);
    rig_destroy(&r);
    assert_int_equal(late, 0); /* each tick's force had been written before */
}

/* After a halt the force ramps up, and so does the recorded one. */
TEST_WITH(after_a_halt_the_force_climbs_back_over_the_ramp, begin_rig, end_rig) {
    rig_step(&r, 5);
    knurl_device_halt(&r.device);
    rig_step(&r, 40);
    CHECK_SAME(r.written[5][1], 0.0L);
    for (int tick = 6; tick < 45; tick++) {
        const double rise = r.written[tick][1] - r.written[tick - 1][1];
        assert_true(rise >= 0.0 && rise <= 1.0 / 20.0 + 1e-12);
    }
    CHECK_SAME(r.written[5 + 22][1], 1.0L); /* 20 ms and the ticks at its ends */
    CHECK_SAME(r.written[44][1], 1.0L);
    assert_int_equal(knurl_port_is_halted(&r.device), 0);
}

TEST_WITH(a_force_beyond_the_motors_climbs_back_over_the_ramp_as_well, begin_rig, end_rig) {
    r.force[1] = 40.0; /* of 2 N */
    rig_step(&r, 5);
    knurl_device_halt(&r.device);
    rig_step(&r, 40);
    for (int tick = 6; tick < 45; tick++) {
        assert_true(r.written[tick][1] - r.written[tick - 1][1] <= 2.0 / 20.0 + 1e-12);
    }
    CHECK_CLOSE(r.written[44][1], 2.0, 1e-12);
}

TEST_WITH(while_it_climbs_back_the_record_tells_what_is_written, begin_rig, end_rig) {
    static record seen;
    memset(&seen, 0, sizeof seen);
    SCOPED_SCENE *scene = make_scene(1);
    SCOPED_DEVICE *device = NULL;
    assert_int_equal(knurl_device_open("fake", &device), KNURL_OK);
    r.desc.device = device;
    use_scene(scene, take, &seen);
    rig_step(&r, 1000);
    knurl_device_halt(device);
    rig_step(&r, 100);
    for (int axis = 0; axis < 3; axis++) {
        CHECK_SAME(seen.outputs[1000].force[axis], 0.0L);
        CHECK_SAME(seen.outputs[1000].device_force[axis], 0.0L);
    }
    assert_true(seen.outputs[999].force[1] > 0.1);
    assert_true(seen.outputs[1002].force[1] < 0.25 * seen.outputs[999].force[1]);
    assert_true(seen.outputs[1090].force[1] > 0.1);
    rig_destroy(&r);
}

/* --- descriptions --- */

TEST_WITH(defaults_are_those_of_the_header, NULL, end_rig) {
    knurl_loop_desc desc;
    memset(&desc, 0xaa, sizeof desc);
    knurl_loop_desc_init(&desc, sizeof desc);
    assert_int_equal(desc.struct_size, sizeof desc);
    assert_int_equal(desc.hip, 0);
    assert_null(desc.device);
    assert_null(desc.scene);
    assert_null(desc.force_callback);
    assert_null(desc.tick_callback);
    assert_null(desc.clock);
    CHECK_SAME(desc.update_rate_hz, 1000.0L);
    assert_int_equal(desc.tick_limit, 0);
    CHECK_SAME(desc.ramp_s, 0.02);
    CHECK_SAME(desc.watchdog_s, 0.05);
}

/* Refused, with a sentence that names the field. */
static void refuse(knurl_result code, const char *named) {
    knurl_loop *loop = NULL;
    CHECK_REFUSED(knurl_loop_create(&r.desc, &loop), code, loop);
    check_message(named);
    rig_init(&r); /* for the next one */
}

TEST_WITH(a_bad_number_is_refused_and_named, begin_rig, end_rig) {
    static const double rates[] = {0.0, -1000.0, 99.99, 10000.1, 1e9, NAN, HUGE_VAL};
    static const double ramps[] = {-0.001, 1.001, NAN, HUGE_VAL};
    static const double watchdogs[] = {-0.001, 10.001, NAN, HUGE_VAL};
    for (size_t i = 0; i < COUNT_OF(rates); i++) {
        r.desc.update_rate_hz = rates[i];
        refuse(KNURL_ERROR_ARGUMENT, "rate");
    }
    for (size_t i = 0; i < COUNT_OF(ramps); i++) {
        r.desc.ramp_s = ramps[i];
        refuse(KNURL_ERROR_ARGUMENT, "ramp_s");
    }
    for (size_t i = 0; i < COUNT_OF(watchdogs); i++) {
        r.desc.watchdog_s = watchdogs[i];
        refuse(KNURL_ERROR_ARGUMENT, "watchdog_s");
    }
}

TEST_WITH(a_missing_or_contradictory_part_is_refused_and_named, begin_rig, end_rig) {
    SCOPED_SCENE *scene = make_scene(1);
    r.desc.device = NULL;
    refuse(KNURL_ERROR_ARGUMENT, "device");
    r.desc.force_callback = NULL;
    refuse(KNURL_ERROR_ARGUMENT, "scene");
    r.desc.scene = scene; /* and the callback */
    refuse(KNURL_ERROR_ARGUMENT, "scene");
    r.clock.now_ns = NULL;
    refuse(KNURL_ERROR_ARGUMENT, "clock");
    r.clock.sleep_until_ns = NULL;
    refuse(KNURL_ERROR_ARGUMENT, "clock");
    r.desc.struct_size = 0;
    refuse(KNURL_ERROR_ARGUMENT, "struct_size");
    use_scene(scene, NULL, NULL);
    r.desc.hip = 1; /* it has one */
    refuse(KNURL_ERROR_ARGUMENT, "hip");
    knurl_loop *loop = NULL;
    CHECK_REFUSED(knurl_loop_create(NULL, &loop), KNURL_ERROR_ARGUMENT, loop);
}

TEST_WITH(a_scene_that_is_not_committed_is_refused, begin_rig, end_rig) {
    SCOPED_SCENE *scene = make_scene(0);
    use_scene(scene, NULL, NULL);
    refuse(KNURL_ERROR_STATE, "committed");
}

TEST_WITH(the_hips_rate_must_be_the_loops_where_it_is_given, begin_rig, end_rig) {
    SCOPED_SCENE *scene = make_scene(1);
    knurl_hip_desc hip;
    knurl_hip_desc_init(&hip, sizeof hip);
    hip.update_rate_hz = 2000.0;
    assert_int_equal(knurl_scene_configure_hip(scene, 0, &hip), KNURL_OK);
    use_scene(scene, NULL, NULL);
    refuse(KNURL_ERROR_ARGUMENT, "2000");
    use_scene(scene, NULL, NULL);
    r.desc.update_rate_hz = 2000.0;
    rig_create(&r);
    rig_destroy(&r);
}

/* K z = 400 N/m x 20 mm = 8 N: limited to the device's maximum, or to the HIP's. */
TEST_WITH(a_hip_takes_its_force_limit_from_its_device_unless_it_has_one, NULL, end_rig) {
    static const double limits[][2] = {{KNURL_DEFAULT, 2.0}, {0.5, 0.5}}; /* given, expected */
    for (size_t i = 0; i < COUNT_OF(limits); i++) {
        SCOPED_SCENE *scene = make_scene(1);
        knurl_hip_desc hip;
        knurl_workspace workspace;
        knurl_tick_output output;
        knurl_hip_desc_init(&hip, sizeof hip);
        knurl_workspace_set_identity(&workspace);
        hip.max_force = limits[i][0];
        hip.protections = 0; /* it jumps 9 mm into the wall */
        hip.workspace = &workspace;
        assert_int_equal(knurl_scene_configure_hip(scene, 0, &hip), KNURL_OK);
        rig_init(&r);
        use_scene(scene, NULL, NULL);
        rig_step(&r, 2);
        assert_int_equal(knurl_scene_get_tick(scene, 0, &output, NULL), KNURL_OK);
        assert_int_equal(output.tick, 1);
        rig_destroy(&r);
        const knurl_tick_input deep = {{0.0, -0.009, 0.0}, {0.0, 0.0, 0.0}, 1, 0, 0.0, 0, {0}}; /* 3.6 N */
        assert_int_equal(knurl_scene_tick(scene, 0, &deep, &output), KNURL_OK);
        CHECK_CLOSE(output.force[1], limits[i][1], 1e-12);
        assert_true((output.flags & KNURL_TICK_FORCE_LIMIT) != 0);
    }
}

TEST_WITH(stats_of_a_struct_whose_size_was_never_set_are_refused, begin_rig, end_rig) {
    knurl_loop_stats stats;
    memset(&stats, 0, sizeof stats);
    rig_create(&r);
    CHECK_REFUSED(knurl_loop_get_stats(r.loop, &stats), KNURL_ERROR_ARGUMENT, stats);
    knurl_loop_stats_init(&stats, 16); /* an older caller's: two fields */
    memset((char *)&stats + 16, 0x77, sizeof stats - 16);
    rig_step(&r, 3);
    assert_int_equal(knurl_loop_get_stats(r.loop, &stats), KNURL_OK);
    assert_int_equal(stats.ticks, 3);
    assert_int_equal(*((unsigned char *)&stats + 16), 0x77);
}

TEST_WITH(a_driver_is_never_told_more_than_its_motors_can_do, begin_rig, end_rig) {
    static const double far_too_much[3] = {-30.0, 0.0, 40.0};
    static const double nonsense[3] = {1.0, NAN, 0.0};
    assert_int_equal(knurl_device_write(&r.device, far_too_much), KNURL_OK);
    assert_int_equal(knurl_device_write(&r.device, nonsense), KNURL_OK);
    CHECK_CLOSE(r.written[0][0], -1.2, 1e-12);
    CHECK_CLOSE(r.written[0][1], 0.0, 1e-12);
    CHECK_CLOSE(r.written[0][2], 1.6, 1e-12);
    for (int axis = 0; axis < 3; axis++) {
        CHECK_SAME(r.written[1][axis], 0.0L);
    }
}

TEST_WITH(only_the_fake_device_takes_strokes_and_traces, begin_rig, end_rig) {
    static const double row[4] = {0.0, 0.0, 0.0, 0.0};
    knurl_stroke_desc stroke;
    knurl_stroke_desc_init(&stroke, sizeof stroke);
    CHECK_REFUSED(knurl_fake_set_stroke(&r.device, &stroke), KNURL_ERROR_UNSUPPORTED, stroke);
    CHECK_REFUSED(knurl_fake_set_trace(&r.device, row, 1), KNURL_ERROR_UNSUPPORTED, row);
}
