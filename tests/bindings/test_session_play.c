/* A session plays the same forces along a path as a loop that is stepped by hand. SPDX-License-Identifier: MIT */
#include "session_rig.h"

enum { TICKS = 600 };

/* Down into the plate, 40 mm along it, out: t, x, y, z. */
static const double path[] = {0.0, -0.02, 0.0,   0.004,   0.1, -0.02, 0.0, -0.001,
                              0.5, 0.02,  0.003, -0.0012, 0.6, 0.02,  0.0, 0.004};

enum { ROWS = sizeof path / sizeof *path / 4 };

static knurl_surface_id add_rough_plate(knurl_scene *scene) {
    surface_parts parts = surface_plane();
    set_grating(&parts, KNURL_METHOD_DEFAULT, 1000.0, 0.0, 0.0002);
    parts.material.stiffness = 1500.0; /* a Touch promises 1020: clamped, it is another plate */
    parts.material.damping = 0.5;
    parts.material.friction = 0.3;
    return add_surface(scene, &parts);
}

static knurl_workspace turned(void) {
    const double s = sin(0.4);
    const double c = cos(0.4);
    const double rotation[9] = {c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0};
    knurl_workspace workspace;
    knurl_workspace_set_identity(&workspace);
    workspace.origin[0] = 0.01;
    workspace.origin[2] = -0.003;
    memcpy(workspace.rotation, rotation, sizeof rotation);
    workspace.scale = 2.0;
    return workspace;
}

/* The same by knurl.h alone. */
typedef struct recording {
    double forces[3 * TICKS];
    uint64_t count;
} recording;

static void record(const knurl_tick_output *output, void *user) {
    recording *r = user;
    memcpy(r->forces + 3 * r->count++, output->force, sizeof output->force);
}

static void play_by_hand(const knurl_session_desc *how, recording *r) {
    double rows[4 * ROWS];
    SCOPED_DEVICE *device = NULL;
    knurl_loop *loop = NULL;
    knurl_loop_desc desc;
    knurl_hip_desc hip;
    SCOPED_SCENE *scene = empty_scene(1);
    (void)add_rough_plate(scene);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    for (int i = 0; i < ROWS; i++) {
        rows[4 * i] = path[4 * i];
        knurl_workspace_to_device(&how->workspace, path + 4 * i + 1, rows + 4 * i + 1);
    }
    knurl_hip_desc_init(&hip, sizeof hip);
    hip.workspace = &how->workspace;
    hip.clamp = how->clamp;
    assert_int_equal(knurl_scene_configure_hip(scene, 0, &hip), KNURL_OK);
    assert_int_equal(knurl_device_open(how->device, &device), KNURL_OK);
    assert_int_equal(knurl_fake_set_trace(device, rows, ROWS), KNURL_OK);
    knurl_loop_desc_init(&desc, sizeof desc);
    desc.device = device;
    desc.scene = scene;
    desc.update_rate_hz = how->update_rate_hz;
    desc.tick_callback = record;
    desc.user = r;
    assert_int_equal(knurl_loop_create(&desc, &loop), KNURL_OK);
    assert_int_equal(knurl_loop_step(loop, TICKS), KNURL_OK);
    knurl_loop_destroy(loop);
}

static void check_same_forces(const knurl_session_desc *how) {
    static recording expected;
    static double forces[3 * TICKS];
    SCOPED_SESSION *s = make_session();
    uint64_t played = 0;
    double largest = 0.0;
    (void)add_rough_plate(knurl_session_get_scene(s));
    memset(&expected, 0, sizeof expected);
    play_by_hand(how, &expected);
    assert_int_equal(expected.count, TICKS);
    for (int round = 0; round < 2; round++) { /* and again: a run forgets the one before */
        memset(forces, 0, sizeof forces);
        open_session(s, how);
        assert_int_equal(knurl_session_play(s, path, ROWS, TICKS, forces, &played), KNURL_OK);
        knurl_session_close(s);
        assert_int_equal(played, TICKS);
        assert_memory_equal(forces, expected.forces, sizeof forces);
    }
    for (int i = 0; i < 3 * TICKS; i++) {
        largest = fmax(largest, fabs(forces[i]));
    }
    assert_true(largest > 0.3); /* something is felt */
}

TEST(a_path_gives_the_bits_of_a_loop_that_is_stepped) {
    const knurl_session_desc desc = describe("fake", "");
    check_same_forces(&desc);
}

TEST(so_it_does_turned_scaled_unclamped_and_at_another_rate) {
    knurl_session_desc desc = describe("fake:?max_force=9", "line");
    desc.workspace = turned();
    desc.clamp = 0;
    desc.update_rate_hz = 2000.0;
    check_same_forces(&desc);
}

TEST(rows_and_forces_are_the_scenes) {
    static double forces[3 * TICKS];
    const double rows[8] = {0.0, 0.0, 0.0, 0.005, 0.2, 0.0, 0.0, -0.001};
    knurl_session_desc desc = describe("fake", "");
    SCOPED_SESSION *s = make_session();
    uint64_t played = 0;
    (void)add_plate(s, 0.0, 0.0, 0.0);
    desc.workspace = turned();
    open_session(s, &desc);
    assert_int_equal(knurl_session_play(s, rows, 2, TICKS, forces, &played), KNURL_OK);
    CHECK_VECTOR(forces + 3 * (TICKS - 1), 0.0, 0.0, STIFFNESS * 0.001, 1e-6);
}

TEST(a_device_that_gets_lost_plays_fewer_ticks) {
    static double forces[3 * TICKS];
    knurl_session_desc desc = describe("fake:?lose_at=0.1", "");
    SCOPED_SESSION *s = make_session();
    uint64_t played = 0;
    desc.reconnect = 0;
    open_session(s, &desc);
    assert_int_equal(knurl_session_play(s, path, ROWS, TICKS, forces, &played), KNURL_OK);
    assert_int_equal(played, 100);
}

TEST(an_unplayable_grating_is_refused) {
    const double descending[8] = {0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0};
    const double nan[4] = {0.0, NAN, 0.0, 0.0};
    SCOPED_SESSION *s = make_session();
    struct {
        double forces[3];
        uint64_t played;
    } out = {{1.0, 2.0, 3.0}, 4};
    CHECK_REFUSED(knurl_session_play(s, path, ROWS, 1, out.forces, &out.played), KNURL_ERROR_STATE, out);
    check_message("closed");
    open_with(s, "mouse", "");
    CHECK_REFUSED(knurl_session_play(s, path, ROWS, 1, out.forces, &out.played), KNURL_ERROR_UNSUPPORTED, out);
    check_message("fake");
    knurl_session_close(s);
    open_with(s, "fake", "");
    CHECK_REFUSED(knurl_session_play(s, path, ROWS, 0, out.forces, &out.played), KNURL_ERROR_ARGUMENT, out);
    check_message("ticks");
    CHECK_REFUSED(knurl_session_play(s, path, ROWS, 100000001, out.forces, &out.played), KNURL_ERROR_ARGUMENT, out);
    CHECK_REFUSED(knurl_session_play(s, path, ROWS, 1, NULL, &out.played), KNURL_ERROR_ARGUMENT, out);
    CHECK_REFUSED(knurl_session_play(s, NULL, ROWS, 1, out.forces, &out.played), KNURL_ERROR_ARGUMENT, out);
    CHECK_REFUSED(knurl_session_play(s, path, 0, 1, out.forces, &out.played), KNURL_ERROR_ARGUMENT, out);
    check_message("rows");
    CHECK_REFUSED(knurl_session_play(s, path, UINT64_MAX, 1, out.forces, &out.played), KNURL_ERROR_ARGUMENT, out);
    CHECK_REFUSED(knurl_session_play(s, descending, 2, 1, out.forces, &out.played), KNURL_ERROR_ARGUMENT, out);
    check_message("row 2");
    CHECK_REFUSED(knurl_session_play(s, nan, 1, 1, out.forces, &out.played), KNURL_ERROR_ARGUMENT, out);
    check_message("row 1");
    assert_int_equal(knurl_session_play(s, path, ROWS, 1, out.forces, &out.played), KNURL_OK); /* nothing is spoilt */
    assert_int_equal(out.played, 1);
    CHECK_REFUSED(knurl_session_play(s, path, ROWS, 1, out.forces, &out.played), KNURL_ERROR_STATE, out);
    check_message("started");
    CHECK_REFUSED(knurl_session_start(s, NULL, 0), KNURL_ERROR_STATE, out);
    assert_int_equal(state_of(s).running, 0);
}
