/* A KnurlDevice's life: open, run, stop. SPDX-License-Identifier: MIT */
#include "device.h"

#include "effect.h"
#include "explain.h"
#include "follow.h"
#include "rumble.h"
#include "signals.h"
#include "sound.h"
#include "surface_node.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int64_t error_of(knurl_result result) {
    enum {
        FAILED = 1,
        UNAVAILABLE = 2,
        UNCONFIGURED = 3,
        UNAUTHORIZED = 4,
        OUT_OF_MEMORY = 6,
        FILE_CANT_READ = 14,
        FILE_CORRUPT = 16,
        CANT_CONNECT = 25,
        INVALID_PARAMETER = 31
    };
    switch (result) {
    case KNURL_ERROR_ARGUMENT:
    case KNURL_ERROR_UNKNOWN:
        return INVALID_PARAMETER;
    case KNURL_ERROR_STATE:
        return UNCONFIGURED;
    case KNURL_ERROR_MEMORY:
        return OUT_OF_MEMORY;
    case KNURL_ERROR_UNSUPPORTED:
        return UNAVAILABLE;
    case KNURL_ERROR_IO:
        return FILE_CANT_READ;
    case KNURL_ERROR_FORMAT:
        return FILE_CORRUPT;
    case KNURL_ERROR_DEVICE_LOST:
    case KNURL_ERROR_DEVICE_NOT_READY:
        return CANT_CONNECT;
    case KNURL_ERROR_SYSTEM:
        return UNAUTHORIZED;
    default:
        return FAILED;
    }
}

int64_t device_fail(const char *where, knurl_result result) {
    gd_error(where, "%s: %s", where, knurl_error_message());
    return error_of(result);
}

static knurl_result take_slot(device *d) {
    for (int i = 0; i < DEVICE_SLOTS; i++) {
        if (!devices[i]) {
            devices[i] = d;
            d->slot = i;
            return KNURL_OK;
        }
    }
    return knurl_fail(KNURL_ERROR_FULL, "expected at most %d devices that run at once", DEVICE_SLOTS);
}

/* The workspace has the node's pose, but its own scale: the property workspace_scale. */
static knurl_result place(const device *d, knurl_workspace *to) {
    knurl_session_pose at;
    if (!node_pose(d->base.object, &at)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "expected a transform with axes, found one that is scaled to nothing");
    }
    knurl_workspace_set_identity(to);
    memcpy(to->origin, at.position, sizeof at.position);
    memcpy(to->rotation, at.rotation, sizeof at.rotation);
    to->scale = d->workspace_scale;
    return KNURL_OK;
}

knurl_result device_make_session(device *d) {
    return d->session ? KNURL_OK : knurl_session_create(&d->session);
}

/* The contents of a file of the project, or outside; to be freed. Null: it cannot be read. */
static char *read_file(const char *path) {
    gd_string name, contents;
    gd.string_new_with_utf8_chars(&name, path);
    gd.string_new_with_utf8_chars(&contents, "");
    gd_call(gd_method.FileAccess_get_file_as_string, NULL, &name, &contents);
    char *text = gd_string_copy(&contents);
    gd_types[GDEXTENSION_VARIANT_TYPE_STRING].end(&contents);
    gd_types[GDEXTENSION_VARIANT_TYPE_STRING].end(&name);
    if (text && text[0] == '\0') {
        free(text);
        text = NULL;
    }
    return text;
}

static knurl_result open_session(device *d) {
    knurl_session_desc desc;
    char *response = NULL;
    knurl_session_desc_init(&desc, sizeof desc);
    desc.device = d->uri ? d->uri : "";
    desc.stroke = d->stroke;
    desc.update_rate_hz = d->rate;
    desc.reconnect = d->reconnect;
    desc.clamp = d->clamp;
    desc.workspace = d->workspace;
    desc.even = d->even;
    if (d->even && d->response && d->response[0]) {
        response = read_file(d->response);
        if (!response) {
            return knurl_fail(KNURL_ERROR_IO, "response_file: expected a file that can be read, found '%s'",
                              d->response);
        }
        desc.response = response;
        desc.response_size = strlen(response);
    }
    const knurl_result result = knurl_session_open(d->session, &desc);
    free(response);
    return result;
}

void device_put_surfaces(device *d) {
    for (surface *s = surfaces; s; s = s->next) {
        follow_put(d, s);
    }
    follow_count_failures(d);
}

knurl_result device_prepare(device *d) {
    uint8_t is_inside = 0;
    gd_call(gd_method.Node_is_inside_tree, d->base.object, NULL, &is_inside);
    if (!is_inside) {
        return knurl_fail(KNURL_ERROR_STATE, "expected a node inside a scene tree, found one outside");
    }
    knurl_result result = take_slot(d);
    result = result ? result : place(d, &d->workspace);
    result = result ? result : device_make_session(d);
    result = result ? result : open_session(d);
    if (!result) {
        device_put_surfaces(d);
    }
    d->gratings_seen = grating_changes;
    return result;
}

void device_release(device *d) {
    d->runs = 0;
    rumble_stop(d);
    if (d->session) {
        knurl_session_close(d->session);
    }
    if (d->slot >= 0) {
        effects_take_off(d);
        for (surface *s = surfaces, *next; s; s = next) {
            next = s->next;
            follow_remove(d, s);
            if (s->is_leaving && !follow_is_felt(s)) {
                surface_unlist(s);
            }
        }
        devices[d->slot] = NULL;
        d->slot = -1;
    }
    if (d->session) { /* only surfaces of load_gltf() are left */
        knurl_scene_collect(knurl_session_get_scene(d->session));
    }
}

void device_apply_force(const device *d) {
    const double force[3] = {(double)d->added_force[0], (double)d->added_force[1], (double)d->added_force[2]};
    if (d->runs && knurl_session_set_force(d->session, force)) {
        (void)device_fail("KnurlDevice.added_force", KNURL_ERROR_ARGUMENT);
    }
}

void device_apply_sound(const device *d) {
    const knurl_result result = sound_start(d);
    if (result) {
        (void)device_fail("KnurlDevice.sound", result);
    }
}

/* Opens and runs. warning: 512 bytes. */
static knurl_result run(device *d, char *warning) {
    knurl_result result = device_prepare(d);
    if (!result) {
        knurl_session_set_paused(d->session, d->paused || d->tree_paused);
        (void)knurl_session_set_gain(d->session, d->gain);
    }
    result = result ? result : knurl_session_start(d->session, warning, 512);
    if (!result) {
        d->runs = 1;
        d->moved = 0;
        device_apply_force(d);
        (void)knurl_session_set_clutch(d->session, d->clutch);
        d->ridges = 0.0;
        memset(d->impulse, 0, sizeof d->impulse);
        explain_start(d);
        device_apply_sound(d);
    }
    return result;
}

int64_t device_start(device *d) {
    enum { OK = 0, UNAVAILABLE = 2 };
    char warning[512] = "";
    d->wants_start = 0;
    if (d->is_leaving) { /* not device_stop(), whose handlers may free it */
        device_end(d);
        signals_tell_later(0);
    }
    if (d->runs) {
        return OK;
    }
    if (gd_is_in_editor()) {
        gd_error("KnurlDevice.start", "KnurlDevice.start: devices run in a running game, not in the editor");
        return UNAVAILABLE;
    }
    const knurl_result result = run(d, warning);
    if (result) {
        const int64_t error = device_fail("KnurlDevice.start", result);
        device_release(d);
        return error;
    }
    if (warning[0]) {
        gd_warning("KnurlDevice.start", "KnurlDevice: %s", warning);
    }
    return OK;
}

/* A start by autostart. Only the first of several failures in a row is reported, as an error and a signal. */
static void start_by_itself(device *d) {
    char text[1024];
    char warning[512] = "";
    const uint8_t had_failed = d->has_failed;
    d->wants_start = 0;
    const knurl_result result = d->runs ? KNURL_OK : run(d, warning);
    d->has_failed = result != KNURL_OK;
    if (!result) {
        if (warning[0]) {
            gd_warning("KnurlDevice", "KnurlDevice: %s", warning);
        }
        return;
    }
    (void)snprintf(text, sizeof text, "%s", knurl_error_message());
    device_release(d);
    d->wants_start = d->retry > 0.0;
    d->retries_in = d->retry;
    if (!had_failed) {
        gd_error("KnurlDevice", "KnurlDevice: %s", text);
        signals_tell_failure(d, error_of(result), text);
    }
}

void device_end(device *d) {
    d->wants_start = d->is_leaving = 0;
    if (d->runs) {
        sound_stop(d);
        device_release(d);
        signals_end_contact(d);
    }
}

void device_leave(device *d) {
    d->wants_start = 0;
    d->is_leaving = d->runs;
    if (d->runs) {
        signals_tell_later(gd.object_get_instance_id(d->base.object));
    }
}

void device_stop(device *d) {
    device_end(d);
    signals_tell_ends(); /* last: handlers find a stopped device, and may start or free it */
}

/* The engine's clocks; delta: s of the game's time since the last frame. A time scale changes the game time of a frame
 * or a step, not the moment when it happens. */
static void set_clocks(device *d, double delta) {
    double scale = 1.0;
    int64_t steps = 0;
    int64_t rate = 0;
    gd_call(gd_method.Engine_get_time_scale, gd_engine, NULL, &scale);
    gd_call(gd_method.Engine_get_physics_frames, gd_engine, NULL, &steps);
    gd_call(gd_method.Engine_get_physics_ticks_per_second, gd_engine, NULL, &rate);
    d->frames_time += scale > 0.0 ? delta / scale : 0.0;
    d->steps_time += (double)((uint64_t)steps - d->steps_seen) / (double)rate;
    d->steps_seen = (uint64_t)steps;
    (void)knurl_session_tell_time(d->session, KNURL_SESSION_FRAMES, d->frames_time);
    (void)knurl_session_tell_time(d->session, KNURL_SESSION_STEPS, d->steps_time);
}

/* Applies the opposite of the hand's impulse since the last frame to the body of the touched surface. */
static void react(device *d, const knurl_session_state *state) {
    const surface *s = surface_of(d->touched_node);
    GDExtensionObjectPtr body = s && s->reaction ? surface_parent(s) : NULL;
    float impulse[3];
    float arm[3];
    knurl_session_pose at;
    while (body && !gd_cast(body, "RigidBody3D")) {
        GDExtensionObjectPtr parent = NULL;
        gd_call(gd_method.Node_get_parent, body, NULL, &parent);
        body = parent;
    }
    if (body && node_pose(body, &at)) {
        for (int i = 0; i < 3; i++) {
            impulse[i] = (float)(d->impulse[i] - state->impulse[i]);
            arm[i] = (float)(state->proxy[i] - at.position[i]);
        }
        const gd_variant arguments[2] = {gd_wrap(GDEXTENSION_VARIANT_TYPE_VECTOR3, impulse),
                                         gd_wrap(GDEXTENSION_VARIANT_TYPE_VECTOR3, arm)};
        gd_variant result = gd_call_named(body, "apply_impulse", arguments, 2);
        gd.variant_destroy(&result);
    }
    memcpy(d->impulse, state->impulse, sizeof d->impulse);
}

/* If the node's scale is zero, the workspace stays in place. */
void device_move_workspace(device *d) {
    knurl_workspace to;
    if (d->moved && !place(d, &to) &&
        !knurl_session_move_workspace(d->session, d->by_physics ? KNURL_SESSION_STEPS : KNURL_SESSION_FRAMES, &to)) {
        d->workspace = to;
    }
    d->moved = 0;
}

void device_process(device *d) {
    double delta = 0.0;
    gd_call(gd_method.Node_get_process_delta_time, d->base.object, NULL, &delta);
    d->retries_in -= delta;
    if (d->runs) {
        set_clocks(d, delta);
        device_move_workspace(d);
        follow_all(d);
        effects_follow(d, delta);
        knurl_session_update(d->session);
        rumble_play(d);
    }
    if (d->runs || (d->wants_start && d->retries_in <= 0.0)) {
        signals_tell_later(gd.object_get_instance_id(d->base.object));
    }
}

static void tell_state(device *d) {
    knurl_session_state state;
    knurl_session_get_state(d->session, &state);
    if (state.ticks > 0) {
        react(d, &state);
        signals_tell_ridges(d, state.ridges);
    }
}

void device_tell(GDObjectInstanceID id) {
    device *d = device_of(id);
    if (d && d->is_leaving) {
        device_stop(d);
        return;
    }
    if (d && d->wants_start && d->retries_in <= 0.0) {
        start_by_itself(d);
    } else if (d && d->runs) {
        tell_state(d);
    }
    while (signals_tell(id)) {
        device_stop(device_of(id));
    }
}
