/* Moves the surfaces of a session, and finds those out of reach. SPDX-License-Identifier: MIT */
#include "parts.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/* m/s: faster surfaces jump instead of moving through everything on the path. */
#define FASTEST 10.0

/* s: duration of the first move; later ones take the time between the last two. */
#define FIRST_MOVE (1.0 / 60.0)
#define LONGEST    0.1

knurl_result knurl_session_move_hip(knurl_session *session, const double position[3]) {
    if (KNURL_BAD_HANDLE(session, SESSION) || KNURL_IS_NULL(position)) {
        return KNURL_ERROR_ARGUMENT;
    }
    double at[3];
    if (!session->mouse) {
        return knurl_fail(KNURL_ERROR_STATE, "session: expected one whose device is the mouse, found %s",
                          session->device ? "another device" : "one that is closed");
    }
    if (!isfinite(position[0]) || !isfinite(position[1]) || !isfinite(position[2])) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "position: expected finite numbers, found (%g, %g, %g)", position[0],
                          position[1], position[2]);
    }
    knurl_workspace_to_device(&session->desc.workspace, position, at);
    knurl_mouse_move(session->mouse, at);
    return KNURL_OK;
}

static knurl_result fail_clock(const char *name, uint32_t clock) {
    return knurl_fail(KNURL_ERROR_ARGUMENT, "%s: expected 0 (frames) or 1 (steps), found %u", name, (unsigned)clock);
}

/* The duration of a move to a position, s; 0: a jump. *next: the state after it. */
static double plan_move(const knurl_session *session, const knurl_session_way *way, const double position[3],
                        knurl_session_way *next) {
    const uint64_t tick = knurl_board_get_tick(&session->board);
    knurl_session_pace pace = {0.0, 0.0, 0.0};
    double length = 0.0;
    const int is_paced = knurl_session_find_pace(session, way, &pace);
    if (!is_paced && session->device) { /* by ticks: the game's clock may run slow */
        pace.step = (double)(tick - way->tick) / session->desc.update_rate_hz;
        pace.seconds = pace.step > LONGEST ? FIRST_MOVE : pace.step;
    }
    for (int i = 0; i < 3; i++) {
        length += (position[i] - way->position[i]) * (position[i] - way->position[i]);
    }
    *next = *way;
    next->tick = tick;
    memcpy(next->position, position, sizeof next->position);
    for (int clock = 0; clock < KNURL_SESSION_CLOCKS; clock++) {
        next->times[clock] = session->clocks[clock].time;
    }
    next->lag = pace.lag;
    next->moved = (uint32_t)is_paced;
    const double step = pace.step > LONGEST ? FIRST_MOVE : fmax(pace.step, FIRST_MOVE);
    return sqrt(length) > FASTEST * step ? 0.0 : pace.seconds;
}

knurl_result knurl_session_move_surface(knurl_session *session, knurl_surface_id surface, knurl_session_way *way,
                                        const double position[3], const double rotation[4]) {
    if (KNURL_BAD_HANDLE(session, SESSION) || KNURL_IS_NULL(way) || KNURL_IS_NULL(position) ||
        KNURL_IS_NULL(rotation)) {
        return KNURL_ERROR_ARGUMENT;
    }
    if (way->clock >= KNURL_SESSION_CLOCKS) {
        return fail_clock("way.clock", way->clock);
    }
    knurl_session_way next, from = *way;
    if (way->is_guess) {
        knurl_session_correct_clock(session, &from, position, rotation);
    }
    const double seconds = plan_move(session, &from, position, &next);
    const knurl_result result = knurl_scene_set_transform(session->scene, surface, position, rotation, seconds);
    if (!result) {
        memcpy(next.rotation, rotation, sizeof next.rotation);
        *way = next;
    }
    return result;
}

knurl_result knurl_session_move_workspace(knurl_session *session, uint32_t clock, const knurl_workspace *workspace) {
    if (KNURL_BAD_HANDLE(session, SESSION) || KNURL_IS_NULL(workspace)) {
        return KNURL_ERROR_ARGUMENT;
    }
    if (clock >= KNURL_SESSION_CLOCKS) {
        return fail_clock("clock", clock);
    }
    knurl_result result = knurl_session_check_run(session);
    result = result ? result : knurl_workspace_check(workspace);
    if (result) {
        return result;
    }
    knurl_session_way next;
    knurl_workspace to = *workspace;
    session->way.clock = clock;
    const double seconds = plan_move(session, &session->way, workspace->origin, &next);
    for (int i = 0; i < 3; i++) {
        const double *row = workspace->rotation + (ptrdiff_t)3 * i;
        to.origin[i] += row[0] * session->shift[0] + row[1] * session->shift[1] + row[2] * session->shift[2];
    }
    if (session->mouse || session->is_clutched) { /* the game sets the mouse's HIP, at any scale */
        to.scale = session->desc.workspace.scale;
    }
    result = knurl_scene_set_workspace(session->scene, 0, &to, seconds);
    if (!result) {
        session->desc.workspace = to;
        session->clutch_scale = workspace->scale;
        session->way = next;
    }
    return result;
}

/* 1 if the device can reach some of the surface. */
static int is_in_reach(const knurl_session *s, const knurl_surface_info *info) {
    knurl_device_info limits;
    knurl_device_info_init(&limits, sizeof limits);
    if (knurl_device_get_info(s->device, &limits)) {
        return 1;
    }
    double least[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
    double most[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (int corner = 0; corner < 8; corner++) {
        double at[3];
        for (int i = 0; i < 3; i++) {
            at[i] = corner >> i & 1 ? info->bounds_max[i] : info->bounds_min[i];
        }
        knurl_workspace_to_device(&s->desc.workspace, at, at);
        for (int i = 0; i < 3; i++) {
            least[i] = fmin(least[i], at[i]);
            most[i] = fmax(most[i], at[i]);
        }
    }
    int is_near = 1;
    for (int i = 0; i < 3; i++) {
        is_near = is_near && least[i] <= limits.workspace_max[i] && most[i] >= limits.workspace_min[i];
    }
    return is_near;
}

void knurl_session_explain(knurl_session *session, knurl_surface_id surface, char *text, uint32_t size) {
    if (KNURL_BAD_HANDLE(session, SESSION)) {
        return;
    }
    knurl_surface_info info;
    knurl_surface_check check;
    knurl_surface_info_init(&info, sizeof info);
    knurl_surface_check_init(&check, sizeof check);
    knurl_session_clear_text(text, size);
    if (!session->device) {
        return;
    }
    if (!knurl_scene_get_surface_info(session->scene, surface, &info) && !is_in_reach(session, &info)) {
        knurl_session_add_line(text, size,
                               "It lies outside of the device's workspace: move the KnurlDevice there, or raise its "
                               "workspace scale.");
    }
    if (session->loop && !knurl_scene_check_surface(session->scene, 0, surface, &check) && check.exceeded) {
        check.message[sizeof check.message - 1] = '\0';
        knurl_session_add_line(text, size, "%s", check.message);
    }
}
