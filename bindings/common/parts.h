/* The insides of a session. Everything belongs to the game thread except the board and the mouse, which both threads
 * use.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_COMMON_PARTS_H
#define KNURL_COMMON_PARTS_H

#include "base/handle.h"
#include "board.h"
#include "mouse.h"
#include "session.h"

/* Room for touches that the game has not fetched: twice what one update can bring. */
enum { KNURL_SESSION_TOUCHES = 128 };

/* An engine's clock against the ticks. */
typedef struct knurl_session_clock {
    double time;     /* s: as it was told last */
    double lag;      /* s of ticks after it when what moves by it arrives */
    double needs[2]; /* s: the longest lag that was needed in this window, and in the one before */
    double window;   /* when this window began */
    uint32_t is_told;
} knurl_session_clock;

struct knurl_session {
    uint32_t handle;                /* KNURL_HANDLE_SESSION, first */
    knurl_session *next, *previous; /* of the process's, see life.c */
    knurl_scene *scene;
    knurl_device *device; /* or null: closed */
    knurl_loop *loop;     /* or null: neither started nor played */
    knurl_session_desc desc;
    int32_t stroke; /* KNURL_STROKE_, or 0: none */
    uint32_t is_fake;
    uint32_t paused;
    double gain;
    uint32_t is_clutched;
    double clutched_at[3]; /* m, scene: where the HIP stays meanwhile */
    uint64_t clutch_tick;  /* up to this tick the HIP is told to be there */
    double clutch_scale;   /* the workspace's after the clutch */
    double shift[3];       /* m, workspace axes: how far clutches have moved the workspace off its node */
    knurl_session_way way; /* the workspace's; its position is the node's */
    uint32_t runs;         /* 1: the haptic thread was started, and was not seen to have ended */
    /* what the latest update found, for knurl_session_next_event() */
    knurl_surface_id
        touches[KNURL_SESSION_TOUCHES]; /* a ring: what was touched after one another, with 0 for nothing */
    uint32_t first_touch, touch_count;
    knurl_surface_id latest;  /* the touch after the ring's last */
    knurl_surface_id touched; /* as told */
    uint32_t buttons, told_buttons;
    double orientation[4]; /* of the stylus, device axes */
    uint32_t faults_due; /* how many more are reported before the next update, so that a slow handler gets to its end */
    uint32_t has_ended;  /* by itself, and it is to be told */
    uint64_t overruns, counted_at; /* and the tick when they were counted */
    knurl_session_clock clocks[KNURL_SESSION_CLOCKS];
    knurl_board board;
    knurl_sound *sound; /* atomic: of this run, or null: nobody has asked for it */
    knurl_mouse *mouse; /* the device's; null where that is no mouse */
};

/* hand.c: lays the fake device's stroke over the scene's first surface. *outside: that surface, where it lies outside
 * of the workspace, else untouched. */
knurl_result knurl_session_lay_stroke(const knurl_session *session, knurl_surface_id *outside);

/* How a move is played. */
typedef struct knurl_session_pace {
    double seconds; /* from now until it is over */
    double step;    /* s: what it is the motion of */
    double lag;     /* s: of the way from now on */
} knurl_session_pace;

/* force.c: KNURL_OK, or KNURL_ERROR_STATE where it was neither started nor played. */
knurl_result knurl_session_check_run(const knurl_session *session);

/* clock.c: the pace of a move by the way's clock. Returns 0 where the engine has not told that clock in this run. */
int knurl_session_find_pace(const knurl_session *session, const knurl_session_way *way, knurl_session_pace *pace);

/* sound.c: a knurl_tick_callback; user: the session. */
void knurl_session_take(const knurl_tick_output *output, void *user) KNURL_NONBLOCKING;

/* pose.c: of a right-handed rotation, row-major: x, y, z, w. */
void knurl_session_to_quaternion(const double rotation[9], double quaternion[4]);

/* text.c: makes a caller's text empty; adds a sentence to it, on a line of its own. Both do nothing where there is no
 * text, and what does not fit is cut off after a whole character. */
void knurl_session_hush(char *text, uint32_t size);
void knurl_session_say(char *text, uint32_t size, const char *format, ...) KNURL_PRINTF(3, 4);

/* collect.c: nothing waits to be told any more but that a touch is over. */
void knurl_session_forget(knurl_session *session);

#endif
