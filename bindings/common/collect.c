/* Events of a session's run for the game. SPDX-License-Identifier: MIT */
#include "parts.h"

#include <string.h>

/* As many faults as a device stores. */
enum { MOST_FAULTS = 64, BUTTONS = 32 };

static void touch(knurl_session *s, knurl_surface_id id) {
    s->latest = id;
    s->touches[(s->first_touch + s->touch_count) % KNURL_SESSION_TOUCHES] = id;
    if (s->touch_count < KNURL_SESSION_TOUCHES) {
        s->touch_count++;
    } else { /* the queue is full: drop the oldest */
        s->first_touch = (s->first_touch + 1) % KNURL_SESSION_TOUCHES;
    }
}

/* Reads the last tick, with zeros if the device had no position. Returns 0 if there is none yet. */
static int read_tick(const knurl_session *s, knurl_board_tick *sent) {
    knurl_tick_output now;
    knurl_board_read(&s->board, sent);
    if (sent->tick > 0 && !knurl_scene_get_tick(s->scene, 0, &now, NULL) && now.flags & KNURL_TICK_ABSENT) {
        memset(sent->force, 0, sizeof sent->force);
        memcpy(sent->proxy, sent->hip, sizeof sent->proxy);
        sent->depth = sent->height = sent->temporal_frequency = 0.0;
        sent->surface = 0;
    }
    return sent->tick > 0;
}

/* Contacts shorter than a frame are reported too; one that is interrupted within a frame counts as one. */
static void collect_touches(knurl_session *s) {
    knurl_surface_id met[KNURL_BOARD_CHANGES];
    knurl_board_tick sent;
    const uint32_t count = knurl_board_changes(&s->board, met);
    (void)read_tick(s, &sent);
    const knurl_surface_id last =
        knurl_scene_has_surface(s->scene, sent.surface) ? sent.surface : 0; /* a tick may lag behind a removal */
    for (uint32_t i = 0; i < count; i++) {
        int is_new = met[i] != 0 && met[i] != s->latest && met[i] != last;
        for (uint32_t j = 0; j < i; j++) {
            is_new = is_new && met[j] != met[i];
        }
        if (is_new) {
            touch(s, met[i]);
        }
    }
    if (last != s->latest) {
        touch(s, last);
    }
}

static void collect_status(knurl_session *s) {
    knurl_device_status status;
    knurl_device_status_init(&status, sizeof status);
    if (!knurl_device_get_status(s->device, &status)) {
        s->buttons = status.buttons;
        memcpy(s->orientation, status.orientation, sizeof s->orientation);
    }
}

/* Ten times per second, because reading a loop's statistics takes some microseconds. */
static void collect_overruns(knurl_session *s) {
    knurl_loop_stats stats;
    const uint64_t written = __atomic_load_n(&s->board.written, __ATOMIC_ACQUIRE);
    if ((double)(written - s->counted_at) >= 0.1 * s->desc.update_rate_hz) {
        knurl_loop_stats_init(&stats, sizeof stats);
        (void)knurl_loop_get_stats(s->loop, &stats);
        s->overruns = stats.overruns;
        s->counted_at = written;
    }
}

void knurl_session_update(knurl_session *session) {
    if (KNURL_BAD_HANDLE(session, SESSION)) {
        return;
    }
    if (session->runs) {
        knurl_loop_heartbeat(session->loop);
        const uint32_t is_over = knurl_loop_wait(session->loop, 0.0); /* before its last events are collected */
        collect_touches(session);
        collect_status(session);
        collect_overruns(session);
        session->faults_due = MOST_FAULTS;
        session->has_ended = is_over;
        session->runs = !is_over;
    }
}

void knurl_session_drop_events(knurl_session *session) {
    session->first_touch = session->touch_count = 0;
    session->latest = 0;
    if (session->touched) {
        touch(session, 0);
    }
    session->buttons = session->told_buttons = 0;
    memset(session->orientation, 0, sizeof session->orientation);
    session->faults_due = session->has_ended = 0;
    session->overruns = session->counted_at = 0;
}

/* Reports a contact's end before the next one's start, even if changes in between were dropped. */
static int next_touch(knurl_session *s, knurl_session_event *event) {
    while (s->touch_count > 0) {
        const knurl_surface_id id = s->touches[s->first_touch];
        if (s->touched && s->touched != id) {
            event->kind = KNURL_SESSION_CONTACT_ENDED;
            event->surface = s->touched;
            s->touched = 0;
            return 1;
        }
        s->first_touch = (s->first_touch + 1) % KNURL_SESSION_TOUCHES;
        s->touch_count--;
        if (id != s->touched && knurl_scene_has_surface(s->scene, id)) {
            event->kind = KNURL_SESSION_CONTACT_STARTED;
            event->surface = s->touched = id;
            return 1;
        }
    }
    return 0;
}

static int next_button(knurl_session *s, knurl_session_event *event) {
    const uint32_t changed = s->buttons ^ s->told_buttons;
    for (int32_t i = 0; i < BUTTONS && changed; i++) {
        if (changed >> i & 1) {
            s->told_buttons ^= 1u << i;
            event->kind = KNURL_SESSION_BUTTON;
            event->code = i;
            event->value = s->buttons >> i & 1;
            return 1;
        }
    }
    return 0;
}

static int next_fault(knurl_session *s, knurl_session_event *event) {
    knurl_device_event fault;
    do {
        if (s->faults_due == 0 || !knurl_device_next_event(s->device, &fault)) {
            return 0;
        }
        s->faults_due--;
    } while (s->mouse && fault.code == KNURL_FAULT_SILENT); /* the game has not moved it yet: no fault */
    event->kind = KNURL_SESSION_FAULT;
    event->code = fault.code;
    event->value = fault.value;
    return 1;
}

uint32_t knurl_session_next_event(knurl_session *session, knurl_session_event *event) {
    if (KNURL_BAD_HANDLE(session, SESSION) || KNURL_IS_NULL(event)) {
        return 0;
    }
    knurl_session_event found = {0, 0, 0.0, 0};
    int is_found = next_touch(session, &found) || next_button(session, &found) || next_fault(session, &found);
    if (!is_found && session->has_ended) {
        session->has_ended = session->faults_due = 0;
        found.kind = KNURL_SESSION_ENDED;
        is_found = 1;
    }
    if (is_found) {
        *event = found;
    }
    return (uint32_t)is_found;
}

/* a * b, of quaternions x, y, z, w. */
static void multiply(const double a[4], const double b[4], double out[4]) {
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        out[i] = a[3] * b[i] + b[3] * a[i] + a[j] * b[k] - a[k] * b[j];
    }
    out[3] = a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2];
}

/* From device axes to the scene's; zeros stay zeros. */
static void turn_stylus(const knurl_session *s, double stylus[4]) {
    const double *q = s->orientation;
    double workspace[4];
    if (q[0] != 0.0 || q[1] != 0.0 || q[2] != 0.0 || q[3] != 0.0) {
        knurl_session_to_quaternion(s->desc.workspace.rotation, workspace);
        multiply(workspace, q, stylus);
    }
}

void knurl_session_get_state(const knurl_session *session, knurl_session_state *state) {
    if (KNURL_BAD_HANDLE(session, SESSION) || KNURL_IS_NULL(state)) {
        return;
    }
    knurl_board_tick sent;
    knurl_hip_counts counts;
    memset(state, 0, sizeof *state);
    if (!session->runs) {
        return;
    }
    state->running = 1;
    state->paused = session->paused;
    state->surface = session->touched;
    state->buttons = session->buttons;
    state->overruns = session->overruns;
    turn_stylus(session, state->stylus);
    memset(&counts, 0, sizeof counts);
    if (read_tick(session, &sent)) {
        (void)knurl_scene_get_tick(session->scene, 0, NULL, &counts);
        const int stays = sent.tick <= session->clutch_tick;
        memcpy(state->hip, stays ? session->clutched_at : sent.hip, sizeof state->hip);
        memcpy(state->proxy, stays ? session->clutched_at : sent.proxy, sizeof state->proxy);
        memcpy(state->force, sent.force, sizeof state->force);
        memcpy(state->velocity, sent.velocity, sizeof state->velocity);
        memcpy(state->impulse, sent.impulse, sizeof state->impulse);
        state->ridges = 0.5 * counts.half_cycles_crossed;
        state->depth = sent.depth;
        state->height = sent.height;
        state->temporal_frequency = sent.temporal_frequency;
        state->in_contact = sent.surface != 0;
        state->ticks = sent.sent;
    }
}

uint32_t knurl_session_get_history(const knurl_session *session, uint32_t count, float *rows) {
    if (KNURL_BAD_HANDLE(session, SESSION) || KNURL_IS_NULL(rows)) {
        return 0;
    }
    return knurl_board_history(&session->board, count, rows);
}
