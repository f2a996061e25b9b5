/* Private parts of a session. Only the game thread uses them, except the board and the mouse, which the haptic thread
 * uses too.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_COMMON_PARTS_H
#define KNURL_COMMON_PARTS_H

#include "base/handle.h"
#include "board.h"
#include "mouse.h"
#include "session.h"

/* Room for contact changes that the game has not fetched: twice what one update can add. */
enum { KNURL_SESSION_TOUCHES = 128 };

/* One of the engine's clocks, and its relation to the ticks. */
typedef struct knurl_session_clock {
    double time;     /* s: as last set */
    double lag;      /* s: the ticks' time at which moves arrive, less this clock's */
    double needs[2]; /* s: the longest lag needed in this window and in the previous one */
    double window;   /* s: the start of this window */
    uint32_t is_told;
} knurl_session_clock;

struct knurl_session {
    uint32_t handle;                /* KNURL_HANDLE_SESSION, first */
    knurl_session *next, *previous; /* list of the process's sessions, see life.c */
    knurl_scene *scene;
    knurl_device *device; /* or null: closed */
    knurl_loop *loop;     /* or null: neither started nor played */
    knurl_session_desc desc;
    int32_t stroke; /* KNURL_STROKE_, or 0: none */
    uint32_t is_fake;
    uint32_t paused;
    double gain;
    uint32_t is_clutched;
    double clutched_at[3]; /* m, scene: where the HIP stays while clutched */
    uint64_t clutch_tick;  /* up to this tick the HIP is reported there */
    double clutch_scale;   /* of the workspace after the clutch */
    double shift[3];       /* m, workspace axes: the workspace's offset from its node, by clutches */
    knurl_session_way way; /* the workspace's; its position is its node's */
    uint32_t runs;         /* 1: the haptic thread was started, and its end was not seen by an update yet */
    /* collected by the last update, for knurl_session_next_event() */
    knurl_surface_id
        touches[KNURL_SESSION_TOUCHES]; /* a ring of the surfaces touched one after another; 0: no surface */
    uint32_t first_touch, touch_count;
    knurl_surface_id latest;  /* of the ring */
    knurl_surface_id touched; /* as reported */
    uint32_t buttons, told_buttons;
    double orientation[4];         /* of the stylus, device axes */
    uint32_t faults_due;           /* number that may still be reported before the next update */
    uint32_t has_ended;            /* 1: the run ended by itself, not reported yet */
    uint64_t overruns, counted_at; /* counted_at: the tick at which they were counted */
    knurl_session_clock clocks[KNURL_SESSION_CLOCKS];
    knurl_board board;
    knurl_sound *sound; /* atomic: of this run; null until knurl_session_get_sound() */
    knurl_mouse *mouse; /* the device's; null if the device is no mouse */
};

/* hand.c: sets the fake device's stroke over the scene's first surface. *outside: that surface if it lies outside the
 * workspace, else untouched. */
knurl_result knurl_session_lay_stroke(const knurl_session *session, knurl_surface_id *outside);

/* The timing of a move. */
typedef struct knurl_session_pace {
    double seconds; /* from now until it is over */
    double step;    /* s: of the engine's time that it covers */
    double lag;     /* s: the surface's delay from now on */
} knurl_session_pace;

/* KNURL_OK, or KNURL_ERROR_STATE if the session was neither started nor played. */
static inline knurl_result knurl_session_check_run(const knurl_session *session) {
    return session->loop ? KNURL_OK
                         : knurl_fail(KNURL_ERROR_STATE, "session: expected one that runs, found one that does not");
}

/* clock.c: the timing of a move by the clock of `way`. Returns 0 if the engine has not set that clock in this run. */
int knurl_session_find_pace(const knurl_session *session, const knurl_session_way *way, knurl_session_pace *pace);

/* clock.c: changes the clock of `way`, which is a guess, if its moves, the next one included, are more even by the
 * other one. */
void knurl_session_correct_clock(const knurl_session *session, knurl_session_way *way, const double position[3],
                                 const double rotation[4]);

/* sound.c: a knurl_tick_callback; user: the session. */
void knurl_session_take(const knurl_tick_output *output, void *user) KNURL_NONBLOCKING;

/* pose.c: the quaternion x, y, z, w of a right-handed rotation, row-major. */
void knurl_session_to_quaternion(const double rotation[9], double quaternion[4]);

/* text.c: empty a caller's text; append a line to it. Both accept null; what does not fit is cut after a whole
 * character. */
void knurl_session_clear_text(char *text, uint32_t size);
void knurl_session_add_line(char *text, uint32_t size, const char *format, ...) KNURL_PRINTF(3, 4);

/* collect.c: drops all events that are not reported yet, except the end of the current contact. */
void knurl_session_drop_events(knurl_session *session);

#endif
