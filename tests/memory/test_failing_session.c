/* The shared code of the engines' bindings when memory runs out. SPDX-License-Identifier: MIT */
#include "memory/failing.h"

#include "session.h"

#include <string.h>

static knurl_session *session;
static knurl_surface_id plate; /* in it */
static knurl_sound *sound;

static void make(void) {
    failing_need(knurl_session_create(&session));
}

static void make_with_plate(void) {
    knurl_surface_desc desc;
    knurl_material_desc material;
    knurl_plane_desc plane;
    knurl_surface_desc_init(&desc, sizeof desc);
    knurl_material_desc_init(&material, sizeof material);
    knurl_plane_desc_init(&plane, sizeof plane);
    material.stiffness = 400.0;
    desc.material = &material;
    desc.plane = &plane;
    desc.name = "plate";
    make();
    failing_need(knurl_scene_add_surface(knurl_session_get_scene(session), &desc, &plate));
}

static knurl_result open_as(const char *device, const char *stroke) {
    knurl_session_desc desc;
    knurl_session_desc_init(&desc, sizeof desc);
    desc.device = device;
    desc.stroke = stroke;
    return knurl_session_open(session, &desc);
}

static knurl_result open_fake(void) {
    return open_as("fake", "line");
}

static knurl_result open_mouse(void) {
    return open_as("mouse", "");
}

static knurl_result open_first(void) {
    return open_as("auto", "");
}

static void make_open(void) {
    make_with_plate();
    failing_need(open_fake());
}

static knurl_result start(void) {
    char warning[64] = "as was";
    const knurl_result result = knurl_session_start(session, warning, sizeof warning);
    failing_need(result && strcmp(warning, "as was") != 0 ? KNURL_ERROR_STATE : KNURL_OK);
    return result;
}

static void make_started(void) {
    make_open();
    failing_need(start());
}

static void make_started_mouse(void) {
    make_with_plate();
    failing_need(open_mouse());
    failing_need(start());
}

static void finish(void) {
    knurl_sound_release(sound);
    knurl_session_destroy(session);
    session = NULL;
    sound = NULL;
}

static void session_state(char *text, size_t size) {
    knurl_session_state now;
    memset(&now, 0, sizeof now);
    if (session) {
        knurl_session_get_state(session, &now);
    }
    (void)snprintf(text, size, "%s, device %d, loop %d, runs %u", session ? "a session" : "none",
                   session && knurl_session_get_device(session), session && knurl_session_get_loop(session),
                   (unsigned)now.running);
}

static knurl_result call_create(void) {
    return knurl_session_create(&session);
}

static knurl_result call_play(void) {
    const double rows[8] = {0.0, 0.0, 0.0, 0.005, 0.01, 0.0, 0.0, -0.001};
    double forces[60];
    uint64_t played = 0;
    return knurl_session_play(session, rows, 2, 20, forces, &played);
}

static knurl_result call_get_sound(void) {
    float samples[32];
    double rumble[2];
    const knurl_result result = knurl_session_get_sound(session, 48000.0, &sound);
    knurl_sound_fill(sound, samples, 32);
    return result ? result : knurl_sound_get_rumble(sound, rumble);
}

/* A frame of a game, with all queries. */
static knurl_result call_frame(void) {
    const double force[3] = {0.0, 0.1, 0.0};
    const double position[3] = {0.0, 0.0, 0.001};
    const double rotation[4] = {0.0, 0.0, 0.0, 1.0};
    const double matrix[12] = {1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0};
    float history[64];
    char text[128];
    knurl_session_pose pose;
    knurl_session_event event;
    knurl_session_state now;
    knurl_workspace workspace;
    knurl_session_way way;
    memset(&way, 0, sizeof way);
    knurl_workspace_set_identity(&workspace);
    knurl_session_update(session);
    (void)knurl_session_next_event(session, &event);
    knurl_session_get_state(session, &now);
    (void)knurl_session_get_history(session, 32, history);
    knurl_session_fault_text(KNURL_FAULT_LOST, 0.1, text, sizeof text);
    knurl_session_explain(session, plate, text, sizeof text);
    (void)knurl_session_split_pose(matrix, &pose);
    (void)knurl_session_same_rest(pose.rest, pose.rest);
    knurl_session_set_paused(session, 1);
    knurl_session_set_paused(session, 0);
    (void)knurl_session_tell_time(session, KNURL_SESSION_FRAMES, 0.01);
    (void)knurl_session_move_hip(session, position);
    (void)knurl_session_set_clutch(session, 1);
    (void)knurl_session_set_clutch(session, 0);
    knurl_result result = knurl_session_set_gain(session, 0.5);
    result = result ? result : knurl_session_set_force(session, force);
    result = result ? result : knurl_session_vibrate(session, KNURL_WAVE_T3, 100.0, 0.1, force, 0.1);
    result = result ? result : knurl_session_move_workspace(session, KNURL_SESSION_FRAMES, &workspace);
    return result ? result : knurl_session_move_surface(session, plate, &way, position, rotation);
}

static knurl_result call_end(void) {
    knurl_session_close(session);
    (void)knurl_session_close_all();
    knurl_session_destroy(session);
    session = NULL;
    return KNURL_OK;
}

TEST(a_session_goes_on_or_is_as_it_was_wherever_memory_runs_out) {
    const failing_call calls[] = {
        {"knurl_session_create()", NULL, call_create, finish, session_state, 0, 0},
        {"knurl_session_open(fake)", make_with_plate, open_fake, finish, session_state, 0, 0},
        {"... of the mouse", make_with_plate, open_mouse, finish, session_state, 0, 0},
        {"... of the first that is connected: none is", make_with_plate, open_first, finish, session_state, 1, 1},
        {"knurl_session_start()", make_open, start, finish, session_state, 0, 0},
        {"knurl_session_play()", make_open, call_play, finish, session_state, 0, 0},
        {"knurl_session_get_sound()", make_started, call_get_sound, finish, session_state, 0, 0},
        {"knurl_session_update(), ...", make_started, call_frame, finish, session_state, 0, 0},
        {"... with the mouse", make_started_mouse, call_frame, finish, session_state, 0, 0},
        {"knurl_session_close(), _destroy()", make_started, call_end, finish, NULL, 0, 0},
    };
    failing_run(calls, COUNT_OF(calls));
}
