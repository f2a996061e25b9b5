/* A trial: a device, a scene and a loop, to which a game does random things, by one seed. SPDX-License-Identifier: MIT
 */
#ifndef KNURL_CONFORM_TRIAL_H
#define KNURL_CONFORM_TRIAL_H

#include "judge.h"

/* What is judged. */
typedef struct subject {
    /* Opens it, for a trial of this seed. Null: knurl_error_message() says why. */
    knurl_device *(*open)(uint64_t seed, judge *j);
    /* Does fault `which`, 1 to `faults`, or (0) all is well again. Returns 1 where the motors must have no force until
     * then. Null with `faults` 0. */
    int (*inject)(int which);
    int faults;
    int (*is_limp)(void);                /* 1: the motors have no force; null: nobody knows */
    void (*close)(knurl_device *device); /* knurl_device_close(), or more where nothing uses it any more */
    void (*closed)(void);                /* when it is closed and its loop destroyed, or null */
    uint64_t (*reads)(void);             /* reads since the last call; null: nobody knows */
    double alone_s;                      /* s that its firmware goes on for without the host */
} subject;

#define TRIAL_SURFACES 8

typedef struct trial {
    judge *j;
    const subject *on;
    knurl_device *device;
    knurl_scene *scene;
    knurl_loop *loop;
    knurl_device_info info;
    uint64_t random;
    double rate;      /* Hz: of ticks */
    double slew_rate; /* N/s: the HIP's, or 0: as the device says */
    knurl_surface_id surfaces[TRIAL_SURFACES];
    int surface_count;
    int is_stepped;
    int skipped; /* 1: the latest ticks were not judged; the haptic thread's */
    uint64_t ticks;
    int64_t simulated_ns; /* of the clock of loops that are stepped */
    int faults;           /* that it has reported */
} trial;

/* Runs one trial (run.c): 0, or 1 where the device cannot be opened or no loop made (knurl_error_message()).
 * tick_count: what it came to, is added to. */
int trial_run(const subject *on, uint64_t seed, judge *j, uint64_t *tick_count);

/* --- random numbers (random.c) --- */

/* 0 to 1; low to high evenly, and evenly in the exponent; below `count`. */
double trial_uniform(trial *t);
double trial_between(trial *t, double low, double high);
double trial_scale(trial *t, double low, double high);
int trial_below(trial *t, int count);

/* A unit vector; a turn by `angle` (rad) about a random axis, x, y, z, w; s: at once, within a frame, or slowly. */
void trial_direction(trial *t, double out[3]);
void trial_rotation(trial *t, double angle, double quaternion[4]);
double trial_duration(trial *t);

/* Hz: mostly 1000. */
double trial_rate(trial *t);

/* s: a ramp of none, shorter than the slew limit's 5 ms, or longer. */
double trial_ramp(trial *t);

/* --- its loop (trial.c) --- */

/* Runs ticks: steps, or waits. */
void trial_advance(trial *t, int ticks);

int trial_make_loop(trial *t, double ramp_s);

/* --- what it waits for (ends.c) --- */

/* A fault of the device for a while; the loop ends and another begins. */
void trial_inject(trial *t);
void trial_change_loop(trial *t);

/* With a force held and nothing wrong there is one. */
void trial_prove_alive(trial *t);

void trial_end(trial *t);

/* --- what a game does (game.c) --- */

/* One random thing. */
void trial_act(trial *t);

/* --- surfaces (surfaces.c) --- */

/* A scene of a few surfaces near the origin, committed: 0, or 1 where there is no memory. */
int trial_make_scene(trial *t);

void trial_add_surface(trial *t);
void trial_replace_surface(trial *t);
void trial_remove_surface(trial *t);
void trial_move_surface(trial *t);
void trial_change_material(trial *t);

/* Another surface comes down on the hand that presses one, until it is let go. */
void trial_close_over(trial *t);

/* --- a caller's functions (functions.c) --- */

extern const subject functions_subject;

#endif
