/* One tick except rendering: workspaces, limits, lift-off, bad numbers, several surfaces and several HIPs,
 * snapshots for other threads. SPDX-License-Identifier: MIT */
#include "scene/ask.h"

#include <pthread.h>

#define K   400.0 /* N/m, the default */
#define A   0.0005
#define TOL 1e-9L

static surface_parts s2_plane(void) {
    surface_parts parts = surface_plane();
    set_grating(&parts, KNURL_METHOD_S2, 1000.0, 0.0, A);
    return parts;
}

/* Device x, y, z are the scene's y, z, x, half a metre off, a tenth the size. */
static knurl_scene *scene_of_small_device(surface_parts *parts, double resolution) {
    static const double rotation[9] = {0, 0, 1, 1, 0, 0, 0, 1, 0};
    knurl_hip_desc desc;
    knurl_workspace workspace;
    knurl_workspace_set_identity(&workspace);
    memcpy(workspace.rotation, rotation, sizeof rotation);
    workspace.origin[0] = 0.5;
    workspace.scale = 10.0;
    knurl_hip_desc_init(&desc, sizeof desc);
    desc.resolution = resolution;
    desc.max_force = 1e6;
    desc.workspace = &workspace;
    return scene_with_hip(parts, &desc);
}

TEST(workspace_turns_and_scales_what_a_device_feels) {
    surface_parts parts = surface_plane();
    parts.desc.position[0] = 0.5;
    SCOPED_SCENE *scene = scene_of_small_device(&parts, 0.0);
    (void)tick_at(scene, 0.0, 0.001, 0.0);
    for (int k = 1; k <= 10; k++) { /* pressed down the scene's z, the device's y: a wall of K x scale */
        const knurl_tick_output out = tick_at(scene, 0.0002, -1e-5 * k, 0.0001);
        CHECK_VECTOR(out.hip, 0.501, 0.002, -1e-4 * k, 1e-15L);
        CHECK_VECTOR(out.force, 0.0, 0.0, K * 10.0 * 1e-5 * k, TOL);
        CHECK_VECTOR(out.device_force, 0.0, K * 10.0 * 1e-5 * k, 0.0, TOL);
        CHECK_CLOSE(out.depth, 1e-4 * k, 1e-15L);
    }
}

TEST(workspace_scales_velocities_given_and_estimated) {
    static const double resolutions[] = {0.0, 1e-6}; /* differences, FOAW */
    surface_parts parts = surface_plane();
    parts.desc.position[0] = 0.5;
    for (size_t i = 0; i < COUNT_OF(resolutions); i++) {
        SCOPED_SCENE *scene = scene_of_small_device(&parts, resolutions[i]);
        knurl_tick_output out;
        for (int k = 0; k < 20; k++) { /* 0.01, -0.02 and 0.03 m/s of the device */
            out = tick_at(scene, 1e-5 * k, -0.0001 - 2e-5 * k, 3e-5 * k);
        }
        CHECK_VECTOR(out.hip_velocity, 0.3, 0.1, -0.2, 1e-9L);
        CHECK_CLOSE(out.surface_velocity[0], 0.3, 1e-9L);
        CHECK_CLOSE(out.surface_velocity[1], 0.1, 1e-9L);
        out = tick_moving(scene, (const double[3]){0.0, -0.0001, 0.0}, (const double[3]){0.01, -0.02, 0.03});
        CHECK_VECTOR(out.hip_velocity, 0.3, 0.1, -0.2, 1e-15L);
    }
}

TEST(lift_off_ends_force_and_event_at_once) {
    surface_parts parts = s2_plane();
    SCOPED_SCENE *scene = scene_of(&parts);
    const double velocity[3] = {0.1, 0.0, 0.0}; /* 10 ticks a cycle: 5 up, 5 down */
    const double pressed[3] = {0.0, 0.0, -0.002};
    const double lifted[3] = {0.0, 0.0, 0.001};
    for (int round = 0; round < 3; round++) {
        for (int k = 0; k < 13; k++) {
            const knurl_tick_output out = tick_moving(scene, pressed, velocity);
            CHECK_CLOSE(out.height, k % 10 < 5 ? A : -A, 1e-15L);
            assert_int_equal(out.event, k / 10);
        }
        const knurl_tick_output out = tick_moving(scene, lifted, velocity);
        CHECK_VECTOR(out.force, 0.0, 0.0, 0.0, 0.0L);
        CHECK_VECTOR(out.normal, 0.0, 0.0, 0.0, 0.0L);
        CHECK_VECTOR(out.proxy, 0.0, 0.0, 0.001, 0.0L);
        assert_int_equal(out.event, KNURL_NO_EVENT);
        assert_int_equal(out.flags, 0);
        assert_true(out.surface == 0);
    }
    const knurl_hip_counts counts = counts_of(scene);
    assert_true(counts.ticks == 42 && counts.contact_ticks == 39 && counts.events == 6);
    CHECK_CLOSE(counts.force_max, K * 0.0025, TOL);
}

TEST(force_limit_shortens_and_keeps_the_direction) {
    surface_parts parts = surface_plane();
    SCOPED_SCENE *scene = empty_scene(1); /* max_force left open: 3.3 N */
    knurl_hip_desc hip;
    knurl_hip_desc_init(&hip, sizeof hip);
    hip.protections = 0; /* it jumps into the walls */
    assert_int_equal(knurl_scene_configure_hip(scene, 0, &hip), KNURL_OK);
    (void)add_surface(scene, &parts);
    parts.desc.normal[1] = -1.0; /* a wall facing -y */
    (void)add_surface(scene, &parts);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    (void)tick_at(scene, 0.0, -0.001, 0.001);
    knurl_tick_output out = tick_at(scene, 0.0, 0.004, -0.003); /* 1.6 N and 1.2 N: 2 N */
    CHECK_VECTOR(out.force, 0.0, -1.6, 1.2, TOL);
    assert_int_equal(out.flags, KNURL_TICK_CONTACT);
    out = tick_at(scene, 0.0, 0.008, -0.006); /* 4 N */
    CHECK_VECTOR(out.force, 0.0, -0.8 * 3.3, 0.6 * 3.3, TOL);
    CHECK_VECTOR(out.device_force, 0.0, -0.8 * 3.3, 0.6 * 3.3, TOL);
    assert_int_equal(out.flags, KNURL_TICK_CONTACT | KNURL_TICK_FORCE_LIMIT);
    CHECK_CLOSE(out.depth, 0.008, 1e-15L); /* the reported depth is not limited */
    (void)tick_at(scene, 0.0, 0.008, -0.006);
    const knurl_hip_counts counts = counts_of(scene);
    assert_true(counts.force_limit_ticks == 2);
    CHECK_CLOSE(counts.force_max, 3.3, TOL);
}

TEST(numbers_that_are_not_finite_zero_the_force_and_are_survived) {
    static const double wrong[] = {(double)NAN, (double)INFINITY, (double)-INFINITY};
    surface_parts parts = s2_plane();
    SCOPED_SCENE *scene = scene_of(&parts);
    const double pressed[3] = {0.0, 0.0, -0.002};
    const double velocity[3] = {0.1, 0.0, 0.0};
    for (size_t i = 0; i < 6 * COUNT_OF(wrong); i++) {
        double bad[2][3] = {{0.0, 0.0, -0.002}, {0.1, 0.0, 0.0}};
        bad[i / 3 % 2][i % 3] = wrong[i / 6];
        for (int k = 0; k < 3; k++) {
            assert_int_equal(tick_moving(scene, pressed, velocity).flags, KNURL_TICK_CONTACT);
        }
        const knurl_tick_output out = tick_moving(scene, bad[0], bad[1]);
        CHECK_VECTOR(out.device_force, 0.0, 0.0, 0.0, 0.0L);
        CHECK_VECTOR(out.force, 0.0, 0.0, 0.0, 0.0L);
        CHECK_VECTOR(out.hip, 0.0, 0.0, 0.0, 0.0L);
        assert_int_equal(out.flags, KNURL_TICK_NOT_FINITE);
        assert_int_equal(out.contacts, 0);
        const knurl_tick_output next = tick_moving(scene, pressed, velocity);
        CHECK_VECTOR(next.force, 0.0, 0.0, K * 0.0025, TOL); /* a first tick again: pressed in, a first event */
        assert_int_equal(next.event, 0);
        assert_int_equal(next.tick, out.tick + 1);
    }
    const knurl_hip_counts counts = counts_of(scene);
    assert_true(counts.non_finite_ticks == 18 && counts.ticks == 18 * 5);
}

TEST(velocity_starts_anew_after_numbers_that_are_not_finite) {
    static const double resolutions[] = {0.0, 1e-6}; /* differences, FOAW */
    surface_parts parts = surface_plane();
    parts.desc.position[0] = 0.5;
    for (size_t i = 0; i < COUNT_OF(resolutions); i++) {
        SCOPED_SCENE *scene = scene_of_small_device(&parts, resolutions[i]);
        for (int k = 0; k < 20; k++) {
            (void)tick_at(scene, 1e-5 * k, 0.0, 0.0);
        }
        (void)tick_at(scene, (double)NAN, 0.0, 0.0);
        knurl_tick_output out = tick_at(scene, 0.001, 0.0, 0.0);
        CHECK_VECTOR(out.hip_velocity, 0.0, 0.0, 0.0, 0.0L);
        out = tick_at(scene, 0.00101, 0.0, 0.0);
        /* FOAW's backlash takes half a count, 0.5 um of the device, of the first move */
        CHECK_VECTOR(out.hip_velocity, 0.0, resolutions[i] > 0.0 ? 0.095 : 0.1, 0.0, 1e-9L);
    }
}

TEST(velocity_that_is_not_used_need_not_be_finite) {
    SCOPED_SCENE *scene = scene_of_plane();
    const knurl_tick_input input = {{0.0, 0.0, -0.001}, {(double)NAN, (double)INFINITY, 0.0}, 0, 0, 0.0, 0, {0}};
    knurl_tick_output out;
    assert_int_equal(knurl_scene_tick(scene, 0, &input, &out), KNURL_OK);
    CHECK_VECTOR(out.force, 0.0, 0.0, K * 0.001, TOL);
    CHECK_VECTOR(out.hip_velocity, 0.0, 0.0, 0.0, 0.0L);
}

TEST(numbers_that_overflow_give_no_force) {
    surface_parts parts = surface_plane();
    parts.material.stiffness = 1e308;
    SCOPED_SCENE *scene = scene_of(&parts);
    (void)tick_at(scene, 0.0, 0.0, 1.0);
    const knurl_tick_output out = tick_at(scene, 0.0, 0.0, -100.0);
    CHECK_VECTOR(out.device_force, 0.0, 0.0, 0.0, 0.0L);
    assert_int_equal(out.flags, KNURL_TICK_NOT_FINITE);
    const double huge[3] = {1e308, -1e308, 1e308};
    for (int k = 0; k < 3; k++) {
        const knurl_tick_output far_out = tick_moving(scene, huge, huge);
        CHECK_VECTOR(far_out.device_force, 0.0, 0.0, 0.0, 0.0L);
    }
}

TEST(forces_of_several_surfaces_add_and_the_deepest_is_reported) {
    surface_parts parts = surface_plane();
    SCOPED_SCENE *scene = empty_scene(1);
    const knurl_surface_id floor_id = add_surface(scene, &parts);
    parts.desc.normal[1] = -1.0;
    parts.material.stiffness = 100.0;
    const knurl_surface_id wall_id = add_surface(scene, &parts); /* at y = 0, looking to -y */
    (void)commit_plainly(scene);
    (void)tick_at(scene, 0.0, -0.001, 0.001);
    for (int k = 1; k < 20; k++) {
        const double in_floor = 0.0001 * k;
        const double in_wall = 0.00205 - in_floor;
        const knurl_tick_output out = tick_at(scene, 0.01, in_wall, -in_floor);
        CHECK_VECTOR(out.force, 0.0, -100.0 * in_wall, K * in_floor, TOL);
        assert_int_equal(out.contacts, 2);
        CHECK_CLOSE(out.depth, fmax(in_floor, in_wall), 1e-15L);
        assert_true(out.surface == (in_floor > in_wall ? floor_id : wall_id));
        CHECK_CLOSE(out.normal[2], in_floor > in_wall ? 1.0 : 0.0, 1e-12L);
    }
}

/* With crests that reach 1 mm, a HIP above them all is in contact with each. */
static knurl_scene *stack_of_planes(int count, int double_sided, double amplitude) {
    surface_parts parts = surface_plane();
    knurl_scene *scene = empty_scene(1);
    set_grating(&parts, KNURL_METHOD_S1, 100.0, 0.0, amplitude);
    parts.desc.double_sided = (uint32_t)double_sided;
    for (int i = 0; i < count; i++) { /* 0.1 mm apart, the uppermost last */
        parts.desc.position[2] = -0.0001 * (count - 1 - i);
        (void)add_surface(scene, &parts);
    }
    return commit_plainly(scene);
}

TEST(more_surfaces_than_slots_are_flagged) {
    for (int count = 1; count <= 6; count++) {
        SCOPED_SCENE *scene = stack_of_planes(count, 0, 0.001);
        (void)tick_at(scene, 0.0, 0.0, 0.003);
        const knurl_tick_output out = tick_at(scene, 0.0, 0.0, 0.0001);
        const int touched = count < KNURL_CONTACTS_MAX ? count : KNURL_CONTACTS_MAX;
        assert_int_equal(out.contacts, touched);
        assert_int_equal((out.flags & KNURL_TICK_CONTACTS_FULL) != 0, count > KNURL_CONTACTS_MAX);
        assert_int_equal(tick_at(scene, 0.0, 0.0, 0.003).flags, 0);
    }
}

/* A HIP outside of a surface stays outside of it: below the topmost plane it touches no other one. */
TEST(of_planes_on_top_of_each_other_the_topmost_holds) {
    for (int count = 1; count <= 6; count++) {
        SCOPED_SCENE *scene = stack_of_planes(count, 0, 0.0);
        (void)tick_at(scene, 0.0, 0.0, 0.001);
        const knurl_tick_output out = tick_at(scene, 0.0, 0.0, -0.002);
        assert_int_equal(out.contacts, 1);
        CHECK_CLOSE(out.depth, 0.002, 1e-15L);
        assert_true(out.surface == knurl_scene_get_surface(scene, (uint32_t)count - 1));
    }
}

/* A fifth surface whose bounds hold the HIP, but which it does not touch: the inside of a box. */
TEST(surface_that_is_only_near_is_not_one_too_many) {
    SCOPED_SHAPE room = shape_box((const double[3]){0.1, 0.1, 0.1}, 1);
    surface_parts parts = surface_along_x(&room);
    surface_parts plane = surface_plane();
    SCOPED_SCENE *scene = empty_scene(1);
    set_grating(&plane, KNURL_METHOD_S1, 100.0, 0.0, 0.001);
    for (int i = 0; i < 4; i++) {
        (void)add_surface(scene, &plane);
    }
    (void)add_surface(scene, &parts);
    (void)commit_plainly(scene);
    (void)tick_at(scene, 0.0, 0.0, 0.002);
    const knurl_tick_output out = tick_at(scene, 0.0, 0.0, 0.0005);
    assert_int_equal(out.contacts, 4);
    assert_int_equal(out.flags, KNURL_TICK_CONTACT);
}

TEST(surfaces_left_in_the_same_tick_are_all_left) {
    for (int count = 1; count <= KNURL_CONTACTS_MAX; count++) {
        SCOPED_SCENE *scene = stack_of_planes(count, 1, 0.001);
        (void)tick_at(scene, 0.0, 0.0, 0.003);
        assert_int_equal(tick_at(scene, 0.0, 0.0, 0.0005).contacts, count);
        (void)tick_at(scene, 0.0, 0.0, -0.001);
        for (int k = 0; k < 2; k++) { /* lifted off: nothing pulls it back down from behind */
            const knurl_tick_output out = tick_at(scene, 0.0, 0.0, 0.003);
            assert_int_equal(out.contacts, 0);
            CHECK_VECTOR(out.force, 0.0, 0.0, 0.0, 0.0L);
        }
    }
}

TEST(hips_are_independent) {
    surface_parts parts = s2_plane();
    SCOPED_SCENE *both = empty_scene(2);
    (void)add_surface(both, &parts);
    configure_plainly(both, 0);
    configure_plainly(both, 1);
    assert_int_equal(knurl_scene_commit(both), KNURL_OK);
    knurl_scene *alone[2] = {scene_of(&parts), scene_of(&parts)};
    for (int k = 0; k < 2000; k++) {
        for (uint32_t hip = 0; hip < 2; hip++) {
            const double phase = (hip ? 0.037 : 0.023) * k;
            const knurl_tick_input input = {
                {0.03 * sin(phase), 0.0, 0.003 * cos(0.7 * phase)}, {0.0, 0.0, 0.0}, 0, 0, 0.0, 0, {0}};
            knurl_tick_output expected;
            knurl_tick_output out;
            assert_int_equal(knurl_scene_tick(alone[hip], 0, &input, &expected), KNURL_OK);
            assert_int_equal(knurl_scene_tick(both, hip, &input, &out), KNURL_OK);
            check_same_output(&out, &expected);
        }
    }
    knurl_scene_destroy(alone[0]);
    knurl_scene_destroy(alone[1]);
}

TEST(a_batch_is_its_ticks_one_by_one) {
    enum { TICKS = 500 };
    static knurl_tick_input inputs[TICKS];
    static knurl_tick_output outputs[TICKS];
    surface_parts parts = s2_plane();
    SCOPED_SCENE *single = scene_of(&parts);
    SCOPED_SCENE *batched = scene_of(&parts);
    for (int k = 0; k < TICKS; k++) {
        inputs[k].position[0] = 0.03 * sin(0.023 * k);
        inputs[k].position[2] = 0.003 * cos(0.016 * k);
        inputs[k].absent = k == 100;
    }
    assert_int_equal(knurl_scene_tick_batch(batched, 0, inputs, TICKS, outputs), KNURL_OK);
    for (int k = 0; k < TICKS; k++) {
        knurl_tick_output expected;
        assert_int_equal(knurl_scene_tick(single, 0, &inputs[k], &expected), KNURL_OK);
        assert_true(outputs[k].tick == (uint64_t)k);
        check_same_output(&outputs[k], &expected);
    }
    inputs[1].reserved[0] = 1;
    assert_int_equal(knurl_scene_tick_batch(batched, 0, inputs, 3, outputs), KNURL_ERROR_ARGUMENT);
    assert_true(outputs[2].tick == TICKS + 1); /* the one in the middle was not a tick */
    assert_int_equal(knurl_scene_tick_batch(batched, 0, inputs, 0, outputs), KNURL_OK);
}

TEST(configuring_a_hip_forgets_what_it_did) {
    surface_parts parts = s2_plane();
    SCOPED_SCENE *scene = scene_of(&parts);
    knurl_hip_counts counts;
    knurl_tick_output out;
    (void)tick_at(scene, 0.0, 0.0, 0.001);
    (void)tick_at(scene, 0.0, 0.0, -0.001);
    configure_plainly(scene, 0);
    assert_int_equal(knurl_scene_get_tick(scene, 0, &out, &counts), KNURL_OK);
    const knurl_tick_output zero = {.tick = 0};
    const knurl_hip_counts none = {.ticks = 0};
    assert_memory_equal(&out, &zero, sizeof out);
    assert_memory_equal(&counts, &none, sizeof counts);
    out = tick_at(scene, 0.0, 0.0, -0.001);
    assert_true(out.tick == 0 && out.contacts == 1);
    CHECK_VECTOR(out.hip_velocity, 0.0, 0.0, 0.0, 0.0L);
}

static void check_refused_tick(knurl_scene *scene, uint32_t hip, knurl_result expected) {
    const knurl_tick_input input = {{0.0, 0.0, -0.001}, {0.0, 0.0, 0.0}, 0, 0, 0.0, 0, {0}};
    knurl_tick_output zero;
    knurl_tick_output out;
    memset(&zero, 0, sizeof zero);
    zero.event = KNURL_NO_EVENT;
    memset(&out, 0x77, sizeof out);
    (void)knurl_fail(KNURL_ERROR_IO, "an older sentence");
    assert_int_equal(knurl_scene_tick(scene, hip, &input, &out), expected);
    check_message(expected == KNURL_ERROR_STATE ? "knurl_scene_tick: expected a scene that is committed"
                                                : "knurl_scene_tick: hip:");
    assert_memory_equal(&out, &zero, sizeof out);
}

TEST(ticks_that_cannot_be_have_a_zero_output) {
    surface_parts parts = surface_plane();
    SCOPED_SCENE *scene = empty_scene(2);
    knurl_tick_output out;
    (void)add_surface(scene, &parts);
    check_refused_tick(scene, 0, KNURL_ERROR_STATE);
    check_refused_tick(scene, 2, KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    check_refused_tick(scene, 2, KNURL_ERROR_ARGUMENT);
    check_refused_tick(scene, UINT32_MAX, KNURL_ERROR_ARGUMENT);
    CHECK_REFUSED(knurl_scene_get_tick(scene, 2, &out, NULL), KNURL_ERROR_ARGUMENT, parts);
    assert_int_equal(knurl_scene_get_tick(scene, 1, &out, NULL), KNURL_OK);
    assert_true(out.tick == 0 && out.flags == 0);
}

TEST(snapshot_is_the_latest_tick) {
    surface_parts parts = s2_plane();
    SCOPED_SCENE *scene = scene_of(&parts);
    knurl_hip_counts counts;
    uint64_t contact_ticks = 0;
    for (int k = 0; k < 1000; k++) {
        const knurl_tick_output out = tick_at(scene, 0.03 * sin(0.02 * k), 0.0, 0.002 * cos(0.03 * k));
        knurl_tick_output snapshot;
        assert_int_equal(knurl_scene_get_tick(scene, 0, &snapshot, &counts), KNURL_OK);
        assert_memory_equal(&snapshot, &out, sizeof out);
        contact_ticks += (out.flags & KNURL_TICK_CONTACT) != 0;
        assert_true(counts.ticks == (uint64_t)k + 1 && counts.contact_ticks == contact_ticks);
    }
}

typedef struct reader {
    const knurl_scene *scene;
    uint32_t stop;
    uint64_t seen;
    uint64_t torn;
} reader;

/* No assertions on another thread: torn reads are counted. */
static void *read_snapshots(void *argument) {
    reader *r = argument;
    uint64_t last = 0;
    while (!__atomic_load_n(&r->stop, __ATOMIC_ACQUIRE)) {
        knurl_tick_output out;
        knurl_hip_counts counts;
        (void)knurl_scene_get_tick(r->scene, 0, &out, &counts);
        const double expected = out.contacts ? fmax(0.0, K * (out.height + out.depth)) : 0.0;
        const int sound = out.force[2] == expected && out.device_force[2] == expected &&
                          counts.ticks == out.tick + (counts.ticks > 0) && out.tick >= last;
        r->torn += !sound;
        __atomic_store_n(&r->seen, r->seen + (out.tick != last), __ATOMIC_RELAXED);
        last = out.tick;
    }
    return NULL;
}

TEST(snapshots_read_by_another_thread_are_whole) {
    surface_parts parts = surface_plane();
    set_grating(&parts, KNURL_METHOD_S1, 1000.0, 0.0, A);
    SCOPED_SCENE *scene = scene_of(&parts);
    reader r = {scene, 0, 0, 0};
    pthread_t thread;
    assert_int_equal(pthread_create(&thread, NULL, read_snapshots, &r), 0);
    const uint64_t enough = 100;
    for (int k = 0; k < 200000 || (k < 5000000 && __atomic_load_n(&r.seen, __ATOMIC_RELAXED) < enough); k++) {
        const double x = 1.1e-4 * (k % 700 - 350);
        (void)tick_moving(scene, (const double[3]){x, 0.0, 1e-5 * (k % 173) - 0.001}, (const double[3]){0.1, 0.0, 0.0});
    }
    __atomic_store_n(&r.stop, 1, __ATOMIC_RELEASE);
    assert_int_equal(pthread_join(thread, NULL), 0);
    assert_int_equal(r.torn, 0);
    assert_true(r.seen > 0);
}
