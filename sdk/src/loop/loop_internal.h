/* What a loop is made of. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_LOOP_H
#define KNURL_SRC_LOOP_H

#include "base/histogram.h"
#include "base/system.h"
#include "scene/guard.h"

#include <knurl/loop.h>

/* An absolute-deadline rhythm (pace.c). */
typedef struct knurl_pace {
    knurl_clock clock;
    int64_t start_ns;
    double period_ns;
    uint64_t beat; /* whole periods since the start at the latest deadline */
} knurl_pace;

void knurl_pace_start(knurl_pace *pace, const knurl_clock *clock, double rate);

/* Sleeps until the next deadline. Returns how late it woke, ns; *overrun: 1 where that was more than half a period. The
 * rhythm skips what it missed: late ticks are not made up for by a burst. [haptic thread] */
int64_t knurl_pace_wait(knurl_pace *pace, int *overrun);

struct knurl_loop {
    knurl_loop_desc desc;
    knurl_clock clock;
    knurl_thread *thread;
    knurl_thread *watchdog;
    knurl_pace pace;
    double force[3];  /* the latest, device axes, N */
    double gain;      /* 0..1 on the force: climbs back after the watchdog let go */
    double max_force; /* N: the device's */
    knurl_heat heat;  /* of the motors that a callback drives; a scene's HIP keeps its own */

    /* atomics */
    int32_t state;           /* KNURL_LOOP_ */
    uint32_t stop_requested; /* by anyone */
    uint32_t threaded;       /* 1: started, not stepped */
    uint64_t ticks;
    uint64_t beats; /* ticks and steps of the ramp: what the watchdog looks at */
    uint64_t overruns;
    uint64_t watchdogs;
    uint64_t heats;
    double theta; /* heat's */
    uint32_t realtime;
    uint32_t scene_locked; /* the scene's and the loop's own memory */
    uint32_t stack_locked;
    uintptr_t haptic_thread;
    knurl_histogram tick_ns;
    knurl_histogram jitter_ns;
};

#endif
