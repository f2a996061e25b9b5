/* The paper's experiments 1, 2 and 3 (section IV): design, stimuli, records and analysis.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_EXPERIMENT_H
#define KNURL_EXPERIMENT_H

#include "options.h"

#include <knurl/knurl.h>

#include <signal.h>
#include <stdio.h>

/* Who answers. */
enum { EXP_KEYBOARD = 0, EXP_BUTTONS = 1, EXP_SIMULATED = 2 };

#define EXP_PERIODS    12 /* at most, in one experiment */
#define EXP_MAX_TRIALS 72 /* 3 blocks x 2 intensities x 12 periods */
#define EXP_SIMULATION "SIMULATED answers: a formula of this program's own, not a person; they say nothing about people"

/* --- protocol.c: the paper's design --- */

/* One experiment: a rival and our method, compared at periods x amplitudes. */
typedef struct exp_design {
    int32_t experiment;      /* 1, 2 or 3 */
    int32_t methods[2];      /* the rival (KNURL_WAVE_T1, T2 or S1), then the paper's proposal (KNURL_WAVE_T3 or S2) */
    const char *names[2];    /* "T1", "T3" */
    const double *periods;   /* ms; in experiment 3 the spatial periods, mm */
    uint32_t period_count;   /* 12, 12, 3 */
    double amplitudes[2];    /* N: low, high; in experiment 3 mm: reduced, as printed */
    uint32_t blocks;         /* each cell comes once in each */
    uint32_t family;         /* comparisons that Bonferroni's correction divides 0.05 by: 48, 48, 3 */
    const char *period_unit; /* "ms" or "mm" */
    const char *force_unit;  /* "N" or "mm" */
} exp_design;

/* 1, 2, 3; null for any other. */
const exp_design *exp_design_of(int32_t experiment);

/* Figure 3's neighbours of a medium period (ms): out[0] the longer (low frequency), out[1] the medium, out[2] the
 * shorter. Among them is 2.5 ms: it is between 3 ms and 2 ms. */
void exp_neighbours(double medium_ms, double out[3]);

typedef struct exp_trial {
    uint32_t block;     /* 1, 2, 3 */
    double period;      /* the medium's, ms; in experiment 3 the grating's, mm */
    double amplitude;   /* N; in experiment 3 mm */
    int32_t methods[2]; /* what comes first (in experiment 3: lies left), and second */
} exp_trial;

/* A session's trials in order, at most EXP_MAX_TRIALS; the same for the same seed. Blocks hold the intensities in
 * random order, each of those the periods in random order, our method first in half of them. reduced: experiment 3's
 * amplitude. Returns how many. */
uint32_t exp_plan(const exp_design *design, uint64_t seed, int reduced, exp_trial trials[EXP_MAX_TRIALS]);

/* The next of a row of random numbers (splitmix64), [0, 1). */
double exp_random(uint64_t *state);

/* --- stimulus.c: a trial of experiment 1 or 2, tick by tick --- */

#define EXP_RATE            1000.0 /* Hz, the paper's */
#define EXP_VIBRATION_TICKS 1000   /* 1 s */
#define EXP_PAUSE_TICKS     500    /* within a progression */
#define EXP_BETWEEN_TICKS   1000   /* from one progression to the other */
#define EXP_PROGRESSION     (3 * EXP_VIBRATION_TICKS + 2 * EXP_PAUSE_TICKS)
#define EXP_TRIAL_TICKS     (2 * EXP_PROGRESSION + EXP_BETWEEN_TICKS)

typedef struct exp_stimulus {
    knurl_wave waves[2][3]; /* first and second progression: low, medium, high */
} exp_stimulus;

/* 0, or TOOL_FAILURE having said why. */
int exp_stimulus_init(const exp_trial *trial, exp_stimulus *stimulus);

/* N, upwards, at tick 0 to EXP_TRIAL_TICKS - 1; 0 in pauses and beyond. */
double exp_stimulus_force(const exp_stimulus *stimulus, uint64_t tick);

/* --- a session (session.c) and its trials (drive.c, temporal.c, grating.c) --- */

typedef struct exp_session {
    const exp_design *design;
    const char *uri, *subject, *out;
    uint64_t seed;
    int32_t answers; /* EXP_KEYBOARD, ... */
    int32_t fast, sound, reduced;
    knurl_device *device;
    knurl_device_info info;
} exp_session;

/* What a trial came to. */
typedef struct exp_outcome {
    int32_t chosen;               /* 0: the first (left), 1: the second (right) */
    double rt_s;                  /* from when the question was put; 0 where simulated */
    uint64_t ticks;               /* played, restarts not counted */
    uint64_t force_limit_ticks;   /* ticks whose force the device could not give in full */
    uint64_t above_nyquist_ticks; /* ticks whose temporal frequency was above half the update rate */
    uint64_t overruns;
    uint32_t restarts;   /* the hand had left the sphere */
    double contact_s[2]; /* experiment 3: with the left and the right surface */
} exp_outcome;

/* Plays all trials, asks, writes session->out (whole or not at all), says what was done. An exit code. */
int exp_run_session(exp_session *session);

int exp_play_temporal(const exp_session *session, const exp_trial *trial, exp_outcome *outcome);
int exp_play_gratings(const exp_session *session, const exp_trial *trial, exp_outcome *outcome);

/* What the haptic thread and the program share while a loop runs. */
typedef struct exp_run {
    /* set before; `force` is called every tick and fills in N, device axes; user is the player's */
    void (*force)(struct exp_run *run, uint64_t tick, const knurl_device_sample *sample, double force[3]);
    const char *(*cue)(uint64_t tick); /* what the subject reads at a tick; "" for nothing */
    const char *question;
    void *user;
    uint64_t question_tick; /* answers count from here on, where `ready` */
    uint64_t end_tick;      /* simulated answers: the loop ends here */
    /* atomics: the haptic thread's word */
    uint32_t left;    /* 1: the trial is to be begun anew */
    uint32_t ready;   /* 1: the question may be put as far as `force` is concerned */
    uint32_t asking;  /* 1: the question stands */
    uint32_t pressed; /* 0, or the button that was pressed while it did: 1, 2 */
    uint32_t buttons; /* the haptic thread's own: as last seen */
} exp_run;

/* Runs a loop to its end: an answer, the hand's leaving, or end_tick. TOOL_FAILURE having said why: interrupted, lost
 * device, end of input. */
int exp_drive(const exp_session *session, exp_run *run, exp_outcome *outcome);

/* 1 after Ctrl-C. */
extern volatile sig_atomic_t exp_interrupted;

/* --- simulated.c --- */

/* How bad a temporal signal is to the simulated answerer: |net force| (N) plus the spurious share of its power. */
double exp_badness(int32_t method, double period_ms, double amplitude);

/* The simulated answer, 0 or 1: the less bad one, with logistic noise. state: of exp_random(). */
int32_t exp_simulated_answer(const exp_design *design, const exp_trial *trial, uint64_t *state);

/* --- records_out.c, records.c: the CSV --- */

typedef struct exp_record {
    int32_t experiment;
    char subject[32];
    int32_t simulated, sound;
    exp_trial trial;
    int32_t preferred; /* the method */
    double force_limit_ticks;
} exp_record;

typedef struct exp_records {
    exp_record *rows;
    size_t count, capacity;
} exp_records;

extern const char exp_csv_header[];
extern const char *const exp_answer_names[]; /* by EXP_KEYBOARD, ... */

void exp_write_record(FILE *stream, const exp_session *session, uint32_t number, const exp_trial *trial,
                      const exp_outcome *outcome);

/* Adds a file's rows. 0, or TOOL_FAILURE having said which line holds what. Free rows with free(). */
int exp_read_records(const char *path, exp_records *records);

/* The line without its end. */
void exp_chop(char *line);

/* 1 where nothing would be lost: no such file, none that is regular, or one whose answers are all simulated. */
int exp_may_replace(const char *path);

/* --- analyse.c --- */

/* Reads the files, prints the analysis. An exit code. */
int exp_analyse(int count, char *const *paths);

#endif
