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
    pace->step = way->moved ? c->time - way->time : HUGE_VAL;
    pace->lag = c->lag;
    if (pace->step >= 0.0 && pace->step < LONGEST) { /* the surface may move less often than its clock */
        const double needed = now - way->time + tick;
        const double own = fmin(way->lag - SHRINKING * pace->step, needed + LONGEST);
        pace->lag = fmax(c->lag, fmax(own, needed));
    }
    pace->seconds = fmax(c->time + pace->lag - now, tick);
    return 1;
}
