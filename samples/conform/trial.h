/* A trial: a device, a scene and a loop, and random calls of a game, by one seed.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_CONFORM_TRIAL_H
#define KNURL_CONFORM_TRIAL_H

#include "judge.h"

/* The device under test. */
typedef struct subject {
    /* Opens it, for a trial of this seed. Null: see knurl_error_message(). */
    knurl_device *(*open)(uint64_t seed, judge *j);
    /* Injects fault `which`, 1 to `faults`; 0 ends it. Returns 1 if the motors must have no force until then. Null if
     * `faults` is 0. */
    int (*inject)(int which);
    int faults;
    int (*is_limp)(void);                /* 1: the motors have no force; null: unknown */
    void (*close)(knurl_device *device); /* knurl_device_close(), and any cleanup of its own */
    void (*closed)(void);                /* called once it is closed and its loop destroyed, or null */
    uint64_t (*reads)(void);             /* reads since the last call; null: unknown */
    double alone_s;                      /* s for which its firmware continues without the host */
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
    double slew_rate; /* N/s: the HIP's; or KNURL_DEFAULT */
    knurl_surface_id surfaces[TRIAL_SURFACES];
    int surface_count;
    int is_stepped;
    int skipped; /* 1: the last ticks were not judged; haptic thread only */
    uint64_t ticks;
    int64_t simulated_ns; /* the clock of stepped loops */
    int faults;           /* reported so far */
} trial;

/* Runs one trial (run.c): 0, or 1 if the device cannot be opened or the loop not made (knurl_error_message()).
 * tick_count: the trial's ticks are added. */
int trial_run(const subject *on, uint64_t seed, judge *j, uint64_t *tick_count);

/* --- random numbers (random.c) --- */

/* 0 to 1; uniform from low to high, and uniform in the logarithm; 0 to count - 1. */
double trial_uniform(trial *t);
double trial_between(trial *t, double low, double high);
double trial_scale(trial *t, double low, double high);
int trial_below(trial *t, int count);

/* A unit vector; a rotation by `angle` (rad) about a random axis, x, y, z, w; s: at once, within a frame, or slowly. */
void trial_direction(trial *t, double out[3]);
void trial_rotation(trial *t, double angle, double quaternion[4]);
double trial_duration(trial *t);

/* Hz: mostly 1000. */
double trial_rate(trial *t);

/* s: a ramp of 0, shorter than the slew limit's 5 ms, or longer. */
double trial_ramp(trial *t);

/* --- its loop (trial.c) --- */

/* Runs ticks: steps, or waits. */
void trial_advance(trial *t, int ticks);

int trial_make_loop(trial *t, double ramp_s);

/* --- faults and ends (ends.c) --- */

/* A fault of the device for a while; the loop ends and another starts. */
void trial_inject(trial *t);
void trial_change_loop(trial *t);

/* Checks that the device gets a held force if there is no fault. */
void trial_prove_alive(trial *t);

void trial_end(trial *t);

/* --- the game's calls (game.c) --- */

/* One random call. */
void trial_act(trial *t);

/* --- surfaces (surfaces.c) --- */

/* A scene of a few surfaces near the origin, committed: 0, or 1 if out of memory. */
int trial_make_scene(trial *t);

void trial_add_surface(trial *t);
void trial_replace_surface(trial *t);
void trial_remove_surface(trial *t);
void trial_move_surface(trial *t);
void trial_change_material(trial *t);

/* Another surface closes over the hand that presses one, until it releases it. */
void trial_close_over(trial *t);

/* --- a caller's functions (functions.c) --- */

extern const subject functions_subject;

#endif
