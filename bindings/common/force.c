/* The game's control of the force: gain, force, vibrations, clutch. SPDX-License-Identifier: MIT */
#include "parts.h"

#include <string.h>

knurl_result knurl_session_set_gain(knurl_session *session, double gain) {
    if (KNURL_BAD_HANDLE(session, SESSION)) {
        return KNURL_ERROR_ARGUMENT;
    }
    if (!(gain >= 0.0 && gain <= 1.0)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "gain: expected 0 to 1, found %g", gain);
    }
    session->gain = gain;
    return session->loop ? knurl_loop_set_gain(session->loop, gain) : KNURL_OK;
}

knurl_result knurl_session_set_force(knurl_session *session, const double force[3]) {
    if (KNURL_BAD_HANDLE(session, SESSION) || KNURL_IS_NULL(force)) {
        return KNURL_ERROR_ARGUMENT;
    }
    const knurl_result result = knurl_session_check_run(session);
    return result ? result : knurl_loop_set_force(session->loop, force);
}

knurl_result knurl_session_vibrate(knurl_session *session, int32_t method, double frequency_hz, double amplitude,
                                   const double direction[3], double seconds) {
    if (KNURL_BAD_HANDLE(session, SESSION) || KNURL_IS_NULL(direction)) {
        return KNURL_ERROR_ARGUMENT;
    }
    const knurl_result result = knurl_session_check_run(session);
    return result ? result : knurl_loop_vibrate(session->loop, method, frequency_hz, amplitude, direction, seconds);
}

/* Ends a clutch: moves the workspace so that the HIP is where the clutch began, and applies the new scale. */
static knurl_result end_clutch(knurl_session *session) {
    knurl_workspace *w = &session->desc.workspace;
    knurl_workspace to = *w;
    knurl_board_tick sent;
    double way[3];
    double hip[3];
    knurl_board_read(&session->board, &sent);
    to.scale = session->clutch_scale;
    knurl_workspace_to_device(w, sent.hip, hip);
    knurl_workspace_to_scene(&to, hip, hip);
    for (int i = 0; i < 3; i++) {
        way[i] = session->clutched_at[i] - hip[i];
        to.origin[i] += way[i];
    }
    const knurl_result result = knurl_scene_set_workspace(session->scene, 0, &to, 0.0);
    for (int i = 0; i < 3 && !result; i++) {
        session->shift[i] += w->rotation[i] * way[0] + w->rotation[3 + i] * way[1] + w->rotation[6 + i] * way[2];
    }
    *w = result ? *w : to;
    session->clutch_tick = sent.tick + 1; /* one that runs now may still use the old workspace */
    return result;
}

knurl_result knurl_session_set_clutch(knurl_session *session, uint32_t on) {
    if (KNURL_BAD_HANDLE(session, SESSION)) {
        return KNURL_ERROR_ARGUMENT;
    }
    knurl_result result = knurl_session_check_run(session);
    if (result || !on == !session->is_clutched) {
        return result;
    }
    if (on) {
        knurl_session_state state;
        knurl_session_get_state(session, &state);
        memcpy(session->clutched_at, state.ticks > 0 ? state.hip : session->desc.workspace.origin,
               sizeof session->clutched_at);
        session->clutch_tick = UINT64_MAX;
        session->clutch_scale = session->desc.workspace.scale;
    } else {
        result = end_clutch(session);
    }
    session->is_clutched = on != 0;
    knurl_session_set_paused(session, session->paused);
    return result;
}
