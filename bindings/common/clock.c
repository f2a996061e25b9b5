/* Smooth motion for surfaces that an engine moves. Engines move objects in physics steps or in frames, which do not
 * arrive at even times. Each move is therefore delayed a little and ends at its own step's time plus that delay, so
 * that a constant motion stays constant at any pair of rates.
 * SPDX-License-Identifier: MIT */
#include "parts.h"

#include <math.h>

/* s: after a longer gap between steps, the clock restarts. */
#define LONGEST 0.1

/* s: the lag of a clock whose rate is not known yet: a frame at 60 Hz. */
#define FIRST_LAG (1.0 / 60.0)

/* s: the lag is the longest that was needed in the last one to two windows. */
#define WINDOW 1.0

/* The lag grows and shrinks by at most these shares of the time, which change a speed by as much: less than the just
 * noticeable difference of a vibration's frequency, some 10 %. */
#define GROWTH    0.05
#define SHRINKING 0.02

/* The share of a step by which the lag exceeds the needed one, so that it rarely has to grow. */
#define MARGIN 0.1

/* A speed's changes are summed up over some five moves, and the sum from which a clock may be the wrong one: at 144
 * frames and 50 steps a second it reaches 0.36, the least of the usual pairs of rates. */
#define KEPT   0.8
#define UNEVEN 0.1

static double now_of(const knurl_session *s) {
    return (double)knurl_board_get_tick(&s->board) / s->desc.update_rate_hz;
}

/* Adapts the lag to a step of `elapsed` (s) that needed a lag of `needed`. */
static void adapt_lag(knurl_session_clock *c, double needed, double elapsed) {
    if (c->time - c->window > WINDOW) {
        c->window = c->time;
        c->needs[1] = c->needs[0];
        c->needs[0] = needed;
    }
    c->needs[0] = fmax(c->needs[0], needed);
    const double wanted = fmax(c->needs[0], c->needs[1]) + MARGIN * elapsed;
    const double change = fmin(fmax(wanted - c->lag, -SHRINKING * elapsed), GROWTH * elapsed);
    c->lag = fmin(fmax(c->lag + change, needed), needed + LONGEST);
}

static void begin(knurl_session_clock *c, double time, double now) {
    c->time = c->window = time;
    c->lag = now - time + FIRST_LAG;
    c->needs[0] = c->needs[1] = -HUGE_VAL;
    c->is_told = 1;
}

knurl_result knurl_session_tell_time(knurl_session *session, uint32_t clock, double seconds) {
    if (KNURL_BAD_HANDLE(session, SESSION)) {
        return KNURL_ERROR_ARGUMENT;
    }
    if (clock >= KNURL_SESSION_CLOCKS || !isfinite(seconds)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT,
                          "session: expected a clock of 0 (frames) or 1 (steps) and finite seconds, found %u and %g",
                          (unsigned)clock, seconds);
    }
    if (!session->runs) {
        return KNURL_OK;
    }
    knurl_session_clock *c = &session->clocks[clock];
    const double elapsed = seconds - c->time;
    if (!c->is_told || elapsed < 0.0 || elapsed > LONGEST) {
        begin(c, seconds, now_of(session));
    } else if (elapsed > 0.0) { /* the previous move had to last until now */
        const double needed = now_of(session) - c->time + 1.0 / session->desc.update_rate_hz;
        c->time = seconds;
        adapt_lag(c, needed, elapsed);
    }
    return KNURL_OK;
}

int knurl_session_find_pace(const knurl_session *session, const knurl_session_way *way, knurl_session_pace *pace) {
    const knurl_session_clock *c = &session->clocks[way->clock];
    if (!c->is_told) {
        return 0;
    }
    const double now = now_of(session);
    const double tick = 1.0 / session->desc.update_rate_hz;
    pace->step = way->moved ? c->time - way->times[way->clock] : HUGE_VAL;
    pace->lag = c->lag;
    if (pace->step >= 0.0 && pace->step < LONGEST) { /* the surface may move less often than its clock */
        const double needed = now - way->times[way->clock] + tick;
        const double own = fmin(way->lag - SHRINKING * pace->step, needed + LONGEST);
        pace->lag = fmax(c->lag, fmax(own, needed));
    }
    pace->seconds = fmax(c->time + pace->lag - now, tick);
    return 1;
}

/* m: how far a turn moves a surface's ridges per unit of its quaternion's change. Any size will do: only the changes of
 * a speed from move to move are compared. */
#define LEVER 0.1

static double length_of_move(const knurl_session_way *way, const double position[3], const double rotation[4]) {
    double moved2 = 0.0, turned2 = 0.0, alike = 0.0;
    for (int i = 0; i < 4; i++) {
        alike += rotation[i] * way->rotation[i];
    }
    for (int i = 0; i < 4; i++) {
        const double by = rotation[i] - (alike < 0.0 ? -way->rotation[i] : way->rotation[i]);
        turned2 += by * by;
    }
    for (int i = 0; i < 3; i++) {
        moved2 += (position[i] - way->position[i]) * (position[i] - way->position[i]);
    }
    return sqrt(moved2) + LEVER * sqrt(turned2);
}

/* By a script's clock a constant speed is constant, by the other one it goes up and down: at 60 frames and 50 steps a
 * second by a third, five times a second. A hand's own speed changes by both alike. */
void knurl_session_correct_clock(const knurl_session *session, knurl_session_way *way, const double position[3],
                                 const double rotation[4]) {
    const knurl_session_clock *clocks = session->clocks;
    if (!clocks[0].is_told || !clocks[1].is_told || !way->moved) {
        return;
    }
    const double length = length_of_move(way, position, rotation);
    const int is_first = clocks[0].time - way->times[0] > LONGEST || /* after a rest, or a clock that was set back */
                         clocks[0].time < way->times[0] || clocks[1].time < way->times[1];
    for (int i = 0; i < KNURL_SESSION_CLOCKS; i++) {
        const double elapsed = clocks[i].time - way->times[i];
        const double speed = elapsed > 0.0 ? length / elapsed : 0.0, sum = speed + way->speeds[i];
        double change = elapsed > 0.0 ? 0.0 : 1.0; /* moved although its clock stood still */
        if (elapsed > 0.0 && way->speeds[i] > 0.0 && sum > 0.0) {
            change = fabs(speed - way->speeds[i]) / sum;
        }
        way->changes[i] = is_first ? way->changes[i] : KEPT * way->changes[i] + change;
        way->speeds[i] = is_first ? 0.0 : elapsed > 0.0 ? speed : way->speeds[i];
    }
    const uint32_t other = 1 - way->clock;
    if (way->changes[way->clock] > UNEVEN && way->changes[other] < 0.5 * way->changes[way->clock]) {
        way->clock = other;
        way->lag = -HUGE_VAL; /* it was of the other clock */
    }
}
