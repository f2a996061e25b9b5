/* Internals of a loop. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_LOOP_H
#define KNURL_SRC_LOOP_H

#include "base/atomic.h"
#include "base/handle.h"
#include "base/histogram.h"
#include "base/system.h"
#include "device/port.h"
#include "hip/hip.h"

#include <knurl/loop.h>
#include <knurl/vibration.h>

#include <math.h>

/* A tick needs some kilobytes; callbacks get the rest. */
#define KNURL_LOOP_STACK_BYTES ((size_t)256 * 1024)

/* Periodic wake-ups by absolute deadlines (cycle.c). */
typedef struct knurl_pace {
    knurl_clock clock;
    int64_t start_ns;
    double period_ns;
    uint64_t cycle;  /* whole periods from the start to the last deadline */
    int64_t woke_at; /* ns */
} knurl_pace;

/* A vibration set by knurl_loop_vibrate(). */
typedef struct knurl_vibration {
    knurl_wave wave;     /* N */
    double direction[3]; /* unit, scene */
    uint64_t ticks;      /* duration */
} knurl_vibration;

/* The game's additions to its surfaces' forces (added.c). */
typedef struct knurl_loop_added {
    /* written by the game thread: an atomic and two seqlocks */
    double gain; /* 0 to 1 */
    uint64_t force_sequence, force_words[3];
    uint64_t cue_sequence, cue_words[sizeof(knurl_vibration) / sizeof(uint64_t)];
    /* used by the haptic thread only */
    uint64_t force_seen, cue_seen; /* the sequences of the copies below */
    double gain_now;               /* approaches `gain` */
    double force[3];               /* N, scene */
    int32_t has_force;
    knurl_vibration cue;
    uint64_t cue_tick; /* the vibration's next tick */
    double latest;     /* N: the vibration's value in the last tick */
} knurl_loop_added;

/* Used by the haptic thread only, and by others while it cannot run. */
typedef struct knurl_loop_haptic {
    knurl_pace pace;
    double force[3];            /* last force sent, device axes, N */
    double scene_force[3];      /* the same in scene axes; 0 without a scene */
    knurl_device_torque torque; /* of the last tick, before its gain; 0 without a callback */
    double torque_gain;         /* 0 to 1: its gain */
    double gain;                /* 0..1, for the next force; ramps up after a halt */
    knurl_last_stage *last;     /* final limits and motor heat: the HIP's, or `own` */
    knurl_last_stage own;       /* for a force callback */
    double per_force;           /* 1 / continuous_force^2, 1/N^2 */
    int64_t cycle_at;           /* ns: the last cycle on a thread; 0 before the first */
    uint64_t ramp_step;         /* steps done of the ramp at the end */
    int was_overrun;
    int was_halted;    /* 1: the device was halted when the last force was computed */
    int is_lost;       /* 1: lost, and not to be reopened */
    int64_t served_at; /* ns: the last call by a device that owns the servo thread; 0 before the first */
    uint64_t heartbeats_seen;
    uint64_t since_heartbeat; /* ticks */
    int game_was_alive;
    int wanted; /* 1: not paused, and the heartbeat is not overdue */
} knurl_loop_haptic;

/* Used by all threads. */
typedef struct knurl_loop_shared {
    /* constant once the loop is made */
    knurl_loop_desc desc;
    knurl_clock clock;
    knurl_hip *hip; /* the scene's; null without a scene */

    knurl_loop_added added; /* threads: see its fields */

    /* atomics */
    int32_t state;           /* KNURL_LOOP_ */
    uint32_t stop_requested; /* by anyone */
    uint32_t paused;         /* by anyone: 1 */
    uint32_t threaded;       /* 1: started, not stepped */
    uint32_t stepping;       /* 1: knurl_loop_step() runs */
    uint64_t ticks;
    uint64_t cycles; /* ticks, absences and steps of the ramp, for the watchdog */
    uint64_t overruns;
    uint64_t watchdog_trips;
    uint64_t heat_ticks;
    double theta;        /* heat of the motors */
    uint64_t heartbeats; /* of the game */
    uint64_t absences;
    uint32_t absent;
    uint32_t is_served; /* 1: a device that owns the servo thread is in a call */
    uint32_t realtime;
    uint32_t scene_locked; /* the scene's and the loop's own memory */
    uint32_t stack_locked;
    uintptr_t haptic_thread;
    uintptr_t watchdog_thread;
    uintptr_t process; /* the process that has these threads */
    knurl_histogram tick_ns;
    knurl_histogram jitter_ns;
} knurl_loop_shared;

/* Used by the game thread only, in knurl_loop_start() and knurl_loop_destroy(). */
typedef struct knurl_loop_game {
    knurl_thread *thread;
    knurl_thread *watchdog; /* also reopens a lost device */
} knurl_loop_game;

struct knurl_loop {
    uint32_t handle; /* KNURL_HANDLE_LOOP, first */
    knurl_loop_haptic haptic;
    knurl_loop_shared shared;
    knurl_loop_game game;
};

static inline int knurl_loop_is_running(const knurl_loop *loop) {
    return knurl_load_acquire(&loop->shared.state) == KNURL_LOOP_RUNNING;
}

/* loop_tick.c: sets up a loop that is zero except desc, hip and clock. */
void knurl_loop_init(knurl_loop *loop, const knurl_hip_facts *facts);

/* A tick: reads the device, computes a force, writes it. Returns 0 if the loop must end. [haptic thread] */
int knurl_loop_tick(knurl_loop *loop);

/* A loop begins with the motors' heat from the device's last loop, cooled by the time since. */
void knurl_loop_begin_heat(knurl_loop *loop);
void knurl_loop_end_heat(knurl_loop *loop);

/* Publishes the heat for knurl_loop_get_stats(), after a tick or a force sent without one. */
void knurl_loop_tell_heat(knurl_loop *loop);

/* Called when a cycle begins: advances the motors' heat by the missed periods. */
void knurl_loop_pass_time(knurl_loop *loop, int64_t now);

/* added.c: the force to add in this tick; null if zero. */
const knurl_added_force *knurl_loop_next_added(knurl_loop_added *added, knurl_added_force *sum);

/* 0: nothing to add, and nothing written since the last tick. */
static inline int knurl_loop_adds(const knurl_loop_added *a) {
    return knurl_load_acquire(&a->force_sequence) != a->force_seen ||
           knurl_load_acquire(&a->cue_sequence) != a->cue_seen || a->has_force || a->cue_tick < a->cue.ticks ||
           a->latest != 0.0;
}

/* A ramp's next value towards `to`. The 1e-9 absorbs rounding, which could cost an extra step, a tick too late. */
static inline double knurl_loop_approach(double value, double to, double step) {
    return fabs(to - value) <= step + 1e-9 ? to : value + copysign(step, to - value);
}

/* Moves the game's gain towards the one set, by at most `step`. Returns the gain for this tick. */
double knurl_loop_move_gain(knurl_loop_added *added, double step);

/* cycle.c */
int knurl_loop_at_end(const knurl_loop *loop);

/* 1 if its device was closed or its scene destroyed; their memory is kept until the loop is destroyed. */
int knurl_loop_is_abandoned(const knurl_loop *loop);

/* One cycle: a tick, a cycle without a position, or at the end a step of the ramp. Returns 0 after the last one. */
int knurl_loop_cycle(knurl_loop *loop);

/* Reports zero force to the scene. Only on the haptic thread, or while it cannot run. */
void knurl_loop_publish_zero_force(knurl_loop *loop);

/* Zeroes the motors and ends the loop, which may be freed from then on: the haptic thread's last call. */
void knurl_loop_end(knurl_loop *loop, int32_t state);

/* The haptic thread, and the function called instead by a device with a thread of its own. argument: the loop. */
void knurl_loop_haptic_thread(void *argument);
uint32_t knurl_loop_serve(void *argument);

/* watchdog.c: starts the loop's watchdog thread, if it needs one. Errors: KNURL_ERROR_SYSTEM. */
knurl_result knurl_loop_start_watchdog(knurl_loop *loop);

/* Waits for the thread to end, which it does once the loop does not run. */
void knurl_loop_end_watchdog(knurl_loop *loop);

#endif
