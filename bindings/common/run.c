/* A session's runs: open, start or play, close. SPDX-License-Identifier: MIT */
#include "parts.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static knurl_result check(const knurl_session_desc *d) {
    if (d->struct_size != sizeof *d) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "knurl_session_desc: expected one of %u bytes, found one of %u",
                          (unsigned)sizeof *d, (unsigned)d->struct_size);
    }
    if (d->reconnect > 1 || d->clamp > 1 || d->even > 1) {
        return knurl_fail(KNURL_ERROR_ARGUMENT,
                          "knurl_session_desc: expected reconnect, clamp and even of 0 or 1, found %u, %u and %u",
                          (unsigned)d->reconnect, (unsigned)d->clamp, (unsigned)d->even);
    }
    if (!(d->update_rate_hz >= KNURL_UPDATE_RATE_MIN && d->update_rate_hz <= KNURL_UPDATE_RATE_MAX)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "knurl_session_desc.update_rate_hz: expected %g to %g Hz, found %g Hz",
                          KNURL_UPDATE_RATE_MIN, KNURL_UPDATE_RATE_MAX, d->update_rate_hz);
    }
    if (!(d->heartbeat_s >= 0.0 && d->heartbeat_s <= 3600.0)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "knurl_session_desc.heartbeat_s: expected 0 to 3600 s, found %g s",
                          d->heartbeat_s);
    }
    return knurl_workspace_check(&d->workspace);
}

/* The first device that is connected and can be used. */
static knurl_result open_any(knurl_session *session) {
    enum { MOST = 16 };
    knurl_device_listing *found = calloc(MOST, sizeof *found);
    if (!found) {
        return knurl_fail(KNURL_ERROR_MEMORY, "no memory to list devices");
    }
    const uint32_t count = knurl_device_list(found, MOST);
    knurl_result result =
        knurl_fail(KNURL_ERROR_DEVICE_NOT_READY, "auto: expected a device that is connected, found none; %s",
                   count > 0 ? found[0].reason : "no driver is built in");
    for (uint32_t i = 0; i < count && i < MOST && result; i++) {
        if (!found[i].reason[0] && strncmp(found[i].uri, "fake", 4) != 0) {
            result = knurl_device_open(found[i].uri, &session->device);
        }
    }
    free(found);
    return result;
}

static knurl_result open_device(knurl_session *session, const char *device) {
    char unknown[512];
    if (strcmp(device, "auto") == 0) {
        return open_any(session);
    }
    if (strncmp(device, "touch", strlen("touch")) == 0 && strstr(device, "library=")) {
        return knurl_fail(
            KNURL_ERROR_ARGUMENT,
            "device 'touch': an engine's scene may come from anyone, so it must not name a library to load: expected "
            "no ?library=; set KNURL_HD_LIBRARY instead");
    }
    if (strcmp(device, "mouse") == 0) {
        return knurl_mouse_open(&session->mouse, &session->device);
    }
    const knurl_result result = knurl_device_open(device, &session->device);
    if (result == KNURL_ERROR_UNKNOWN) { /* knurl_device_open() does not know the names that sessions add */
        (void)snprintf(unknown, sizeof unknown, "%s", knurl_error_message());
        return knurl_fail(result, "%s; or mouse, which the game moves; or auto", unknown);
    }
    return result;
}

/* The gains of even sensation; off for a mouse and for other devices whose mass is not known. */
static knurl_result set_gains(const knurl_session *session, const knurl_session_desc *desc) {
    knurl_gain gains[KNURL_GAINS];
    knurl_device_info info;
    knurl_device_info_init(&info, sizeof info);
    knurl_result result = knurl_device_get_info(session->device, &info);
    const int is_on = desc->even && (desc->response || info.mass > 0.0);
    if (!result && is_on) {
        result = desc->response ? knurl_gains_from_response(desc->response, desc->response_size, gains)
                                : knurl_gains_from_plant(info.mass, info.viscous, desc->update_rate_hz, gains);
        result = result ? knurl_fail(result, "response: %s", knurl_error_message()) : KNURL_OK;
    }
    return result ? result : knurl_scene_set_gains(session->scene, 0, gains, is_on ? KNURL_GAINS : 0);
}

knurl_result knurl_session_open(knurl_session *session, const knurl_session_desc *desc) {
    if (KNURL_BAD_HANDLE(session, SESSION) || KNURL_IS_NULL(desc)) {
        return KNURL_ERROR_ARGUMENT;
    }
    if (session->device) {
        return knurl_fail(KNURL_ERROR_STATE, "session: expected one that is closed, found one that is open");
    }
    knurl_result result = check(desc);
    if (result) {
        return result;
    }
    const char *device = desc->device ? desc->device : "fake";
    const uint32_t is_fake = strncmp(device, "fake", strlen("fake")) == 0;
    int32_t stroke = 0;
    if (is_fake && desc->stroke && desc->stroke[0]) {
        result = knurl_stroke_from_name(desc->stroke, &stroke);
    }
    (void)knurl_device_zero_on_exit(1); /* 1: C# recovers from SIGSEGV, for null references */
    result = result ? result : open_device(session, device);
    result = result ? result : set_gains(session, desc);
    if (result) {
        knurl_device_close(session->device);
        session->device = NULL;
        session->mouse = NULL;
    } else {
        session->desc = *desc;
        session->desc.device = session->desc.stroke = session->desc.response = NULL; /* the caller's: already used */
        memcpy(session->way.position, desc->workspace.origin, sizeof session->way.position);
        session->is_fake = is_fake;
        session->stroke = stroke;
    }
    return result;
}

/* The common part of start and play: everything but the hand. */
static knurl_result prepare(knurl_session *session) {
    if (!session->device || session->loop) {
        return knurl_fail(KNURL_ERROR_STATE, "session: expected one that is open and has not run, found one that %s",
                          session->device ? "has been started" : "is closed");
    }
    knurl_hip_desc desc;
    knurl_hip_desc_init(&desc, sizeof desc);
    desc.workspace = &session->desc.workspace;
    desc.clamp = session->desc.clamp;
    knurl_result result = knurl_scene_commit(session->scene);
    result = result == KNURL_ERROR_STATE ? KNURL_OK : result; /* committed already */
    return result ? result : knurl_scene_configure_hip(session->scene, 0, &desc);
}

static knurl_result make_loop(knurl_session *session, double heartbeat_s) {
    knurl_loop_desc desc;
    knurl_loop_desc_init(&desc, sizeof desc);
    desc.device = session->device;
    desc.scene = session->scene;
    desc.update_rate_hz = session->desc.update_rate_hz;
    desc.tick_callback = knurl_session_take;
    desc.user = session;
    session->board.period = 1.0 / desc.update_rate_hz;
    desc.reconnect = session->desc.reconnect;
    desc.heartbeat_s = heartbeat_s;
    return knurl_loop_create(&desc, &session->loop);
}

static void warn(const knurl_session *session, knurl_surface_id outside, char *warning, uint32_t size) {
    char name[KNURL_NAME_SIZE] = "";
    if (outside && !knurl_scene_get_surface_name(session->scene, outside, name)) {
        knurl_session_add_line(
            warning, size,
            "surface '%s' lies outside of the workspace, so the stroke over it is cut short: move the "
            "device to it",
            name);
    }
}

knurl_result knurl_session_start(knurl_session *session, char *warning, uint32_t size) {
    if (KNURL_BAD_HANDLE(session, SESSION)) {
        return KNURL_ERROR_ARGUMENT;
    }
    knurl_surface_id outside = 0;
    knurl_result result = prepare(session);
    result = result || !session->is_fake ? result : knurl_session_lay_stroke(session, &outside);
    result = result ? result : make_loop(session, session->desc.heartbeat_s);
    if (!result) {
        knurl_session_set_paused(session, session->paused);
        (void)knurl_loop_set_gain(session->loop, session->gain);
        result = knurl_loop_start(session->loop);
        if (result) {
            knurl_loop_destroy(session->loop);
            session->loop = NULL;
        }
    }
    if (!result) {
        session->runs = 1;
        knurl_session_clear_text(warning, size);
        warn(session, outside, warning, size);
    }
    return result;
}

void knurl_session_set_paused(knurl_session *session, uint32_t paused) {
    if (KNURL_BAD_HANDLE(session, SESSION)) {
        return;
    }
    session->paused = paused != 0;
    if (session->loop && (session->paused || session->is_clutched)) {
        knurl_loop_pause(session->loop);
    } else if (session->loop) {
        knurl_loop_resume(session->loop);
    }
}

/* The rows in device coordinates. */
static knurl_result lay_trace(const knurl_session *session, const double *rows, uint64_t count) {
    if (count == 0 || count > SIZE_MAX / (4 * sizeof *rows)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "rows: expected t, x, y, z of one tick or more, found %llu",
                          (unsigned long long)count);
    }
    double *moved = malloc((size_t)count * 4 * sizeof *moved);
    if (!moved) {
        return knurl_fail(KNURL_ERROR_MEMORY, "no memory for a trace of %llu rows", (unsigned long long)count);
    }
    for (uint64_t i = 0; i < count; i++) {
        moved[4 * i] = rows[4 * i];
        knurl_workspace_to_device(&session->desc.workspace, rows + 4 * i + 1, moved + 4 * i + 1);
    }
    const knurl_result result = knurl_fake_set_trace(session->device, moved, count);
    free(moved);
    return result;
}

knurl_result knurl_session_play(knurl_session *session, const double *rows, uint64_t row_count, uint64_t ticks,
                                double *forces, uint64_t *played) {
    if (KNURL_BAD_HANDLE(session, SESSION) || KNURL_IS_NULL(rows) || KNURL_IS_NULL(forces) || KNURL_IS_NULL(played)) {
        return KNURL_ERROR_ARGUMENT;
    }
    if (ticks < 1 || ticks > 100000000) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "ticks: expected 1 to 1e8, found %llu", (unsigned long long)ticks);
    }
    knurl_result result = prepare(session);
    result = result ? result : lay_trace(session, rows, row_count);
    result = result ? result : make_loop(session, 0.0);
    if (result) {
        return result;
    }
    knurl_board *b = &session->board;
    b->forces = forces;
    b->force_capacity = ticks;
    result = knurl_loop_step(session->loop, ticks);
    *played = b->force_count;
    b->forces = NULL;
    b->force_capacity = b->force_count = 0;
    return result;
}

void knurl_session_close(knurl_session *session) {
    if (KNURL_BAD_HANDLE(session, SESSION)) {
        return;
    }
    knurl_loop_destroy(session->loop);
    knurl_device_close(session->device);
    knurl_sound_release(session->sound);
    session->sound = NULL;
    session->loop = NULL;
    session->device = NULL;
    session->runs = session->is_fake = 0;
    memset(&session->board, 0, sizeof session->board);
    memset(session->clocks, 0, sizeof session->clocks);
    memset(&session->way, 0, sizeof session->way);
    memset(session->shift, 0, sizeof session->shift);
    session->is_clutched = 0;
    session->clutch_tick = 0;
    session->mouse = NULL;
    knurl_session_drop_events(session);
}
