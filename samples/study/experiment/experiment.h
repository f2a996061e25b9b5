/* The paper's experiments 1, 2 and 3 (section IV), and 4, which compares any two methods of gratings: design, stimuli,
 * records and analysis. README.md is the plan for a laboratory.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_EXPERIMENT_H
#define KNURL_EXPERIMENT_H

#include "options.h"

#include <knurl/knurl.h>

#include <signal.h>
#include <stdio.h>

/* Sources of answers. */
enum { EXP_KEYBOARD = 0, EXP_BUTTONS = 1, EXP_SIMULATED = 2 };

#define EXP_PERIODS     12                  /* at most, in one experiment */
#define EXP_TRAINING    6                   /* trials of the training session (IV-A4) */
#define EXP_MAX_TRIALS  (EXP_TRAINING + 72) /* 3 blocks x 2 intensities x 12 periods */
#define EXP_TEXT_MAX    (1 << 20)           /* bytes of a session's file: each row names the device's URI */
#define EXP_TRAINING_MM 4.0                 /* the gratings' period in experiment 4's training */
#define EXP_SIMULATION "SIMULATED answers: a formula of this program's own, not a person; they say nothing about people"

/* --- protocol.c: the design; plan.c: a session's trials --- */

/* One experiment: two methods, compared at periods x amplitudes. In the paper's, a rival and its proposal. */
typedef struct exp_design {
    int32_t experiment;      /* 1, 2, 3 or EXP_COMPARE */
    int32_t methods[2];      /* KNURL_WAVE_ in 1 and 2, else KNURL_METHOD_; the second's answers are counted */
    const char *names[2];    /* "T1", "T3" */
    const double *periods;   /* ms; in experiment 3 the spatial periods, mm */
    uint32_t period_count;   /* 12, 12, 3, 3 */
    double amplitudes[2];    /* N: low, high; with gratings mm: reduced, as in the paper */
    uint32_t blocks;         /* each has every cell once */
    uint32_t family;         /* comparisons that Bonferroni's correction divides 0.05 by: 48, 48, 3, 6 */
    const char *period_unit; /* "ms" or "mm" */
    const char *force_unit;  /* "N" or "mm" */
    uint32_t scan_ticks;     /* with gratings: the least time of a trial */
    uint32_t protections;    /* KNURL_PROTECT_; 0: as in the paper */
} exp_design;

#define EXP_COMPARE 4

/* 1, 2, 3; null for any other. */
const exp_design *exp_design_of(int32_t experiment);

/* Experiment 4 for two of the library's methods, in either order. TOOL_USAGE, after printing the reason, if they are
 * the same. */
int exp_compare(int32_t one, int32_t other, exp_design *design);

/* 1: two gratings are compared, not two vibrations. */
int exp_has_gratings(const exp_design *design);

/* Figure 3's neighbours of a medium period (ms): out[0] the longer (low frequency), out[1] the medium, out[2] the
 * shorter. They include 2.5 ms, between 3 ms and 2 ms. */
void exp_neighbours(double medium_ms, double out[3]);

/* Faults of a grating in the training, the three that the paper's subjects are shown: a frequency that does not follow
 * the speed, a rough feeling, a net force. */
enum { EXP_GOOD = 0, EXP_STEADY = 1, EXP_ROUGH = 2, EXP_PUSH = 3 };

typedef struct exp_trial {
    uint32_t block;     /* 1, 2, ...; 0: training */
    double period;      /* the medium's, ms; with gratings the grating's, mm */
    double amplitude;   /* N; with gratings mm */
    int32_t methods[2]; /* of the first (with gratings: the left), and the second */
    int32_t faults[2];  /* EXP_GOOD; in experiment 4's training one has a fault */
} exp_trial;

/* A session's trials in order, at most EXP_MAX_TRIALS; the same for the same seed. training: 1: six trials of training
 * first: the worst three of each intensity, or each fault of a grating on either side. Blocks hold the intensities in
 * random order, each of those the periods in random order, the second method first in half of them. In experiment 4
 * blocks come in pairs, and the second has every cell in the opposite order to the first: each order occurs equally
 * often in each cell, for each subject. reduced: the gratings' amplitude. Returns their number. */
uint32_t exp_plan(const exp_design *design, uint64_t seed, int reduced, int training, exp_trial trials[EXP_MAX_TRIALS]);

/* 1: the answer to a trial of the training was the better one; methods[side] was chosen. */
int exp_is_right(const exp_design *design, const exp_trial *trial, int side);

/* The next random number (splitmix64), [0, 1). */
double exp_random(uint64_t *state);
void exp_shuffle(uint32_t *items, uint32_t count, uint64_t *state);

/* --- stimulus.c: a trial of experiment 1 or 2, tick by tick --- */

#define EXP_RATE            1000.0 /* Hz, the paper's */
#define EXP_VIBRATION_TICKS 1000   /* 1 s */
#define EXP_PAUSE_TICKS     500    /* within a progression */
#define EXP_BETWEEN_TICKS   1000   /* from one progression to the other */
#define EXP_PROGRESSION     (3 * EXP_VIBRATION_TICKS + 2 * EXP_PAUSE_TICKS)
#define EXP_TRIAL_TICKS     (2 * EXP_PROGRESSION + EXP_BETWEEN_TICKS)

typedef struct exp_stimulus {
    knurl_wave waves[2][3]; /* first and second progression: low, medium, high */
    double push[2];         /* N, added to the medium: a bad progression of the training */
} exp_stimulus;

/* 0, or TOOL_FAILURE after printing the reason. */
int exp_progression(int32_t method, const double periods_ms[3], double amplitude, knurl_wave waves[3]);
int exp_stimulus_init(const exp_trial *trial, exp_stimulus *stimulus);

/* N, upwards, at tick 0 to EXP_TRIAL_TICKS - 1; 0 in pauses and beyond. */
double exp_stimulus_force(const exp_stimulus *stimulus, uint64_t tick);

/* --- a session (session.c, resume.c) and its trials (drive.c, rest.c, temporal.c, training.c, grating.c) --- */

typedef struct exp_session {
    const exp_design *design;
    const char *uri, *subject, *out;
    uint64_t seed;
    int32_t answers; /* EXP_KEYBOARD, ... */
    int32_t fast, sound, reduced, training;
    knurl_device *device;
    knurl_device_info info;
} exp_session;

/* Result of a trial. */
typedef struct exp_outcome {
    int32_t chosen;               /* 0: the first (left), 1: the second (right) */
    double rt_s;                  /* from the question to the answer; 0 if simulated */
    uint64_t ticks;               /* played, restarts not counted */
    uint64_t force_limit_ticks;   /* ticks whose force the device could not give in full */
    uint64_t above_nyquist_ticks; /* ticks whose temporal frequency was above half the update rate */
    uint64_t overruns;
    uint32_t restarts;     /* the hand had left the sphere, or the subject stopped the trial */
    uint32_t stopped;      /* 1: the subject pressed both buttons; the trial does not count */
    double contact_s[2];   /* with gratings: with the left and the right surface */
    uint64_t softer_ticks; /* with gratings: ticks in which the passivity controller softened them */
} exp_outcome;

/* Plays all trials, asks, rewrites session->out after each (complete at any time), and prints a summary. If the file
 * has the first trials of this session, continues after them. Returns an exit code. */
int exp_run_session(exp_session *session);

/* Finds the number of a session's trials in its file, *done, and the file's text, *text (free it; null: no file).
 * TOOL_FAILURE, after printing the reason, if the file can neither be continued nor replaced. */
int exp_resume(const exp_session *session, const exp_trial *trials, uint32_t count, uint32_t *done, char **text);

/* A rest without force, as long as the subject likes, in a break at least a minute. *stopped: 1 if they end the
 * session. */
int exp_rest(const exp_session *session, int is_break, int *stopped);

/* Demonstrates good and bad stimuli before the training's trials. *stopped: as for exp_rest(). */
int exp_demonstrate(const exp_session *session, int *stopped);

/* The same with a stimulus of any kind; question null: asks nothing. */
int exp_play_stimulus(const exp_session *session, const exp_stimulus *stimulus,
                      const char *(*cue)(uint64_t tick, void *), void *user, const char *question,
                      exp_outcome *outcome);
int exp_play_temporal(const exp_session *session, const exp_trial *trial, exp_outcome *outcome);
int exp_play_gratings(const exp_session *session, const exp_trial *trial, exp_outcome *outcome);

/* Data shared by the haptic thread and the program while a loop runs. */
typedef struct exp_run {
    /* set before; `force` is called every tick and fills in N, device axes; user is the player's */
    void (*force)(struct exp_run *run, uint64_t tick, const knurl_device_sample *sample, double force[3]);
    const char *(*cue)(uint64_t tick, void *cue_user); /* text for the subject at a tick; "": no text */
    void *cue_user;
    const char *question; /* null: the loop ends at end_tick */
    void *user;
    uint64_t question_tick; /* answers count from here on, if `ready` */
    uint64_t end_tick;      /* simulated answers, or no question: the loop ends here */
    /* atomics, written by the haptic thread */
    uint32_t left;    /* 1: the trial must be restarted */
    uint32_t ready;   /* 1: `force` allows the question */
    uint32_t asking;  /* 1: the question is open */
    uint32_t pressed; /* 0, or the button that was pressed meanwhile, and not together with the other: 1, 2 */
    uint32_t stopped; /* 1: both buttons were down; the force is zero from then on */
    uint32_t buttons; /* the last state; haptic thread only, as the next */
    uint32_t pressing;
    uint64_t asked_tick;   /* the question was opened, read after `asking` */
    uint64_t pressed_tick; /* read after `pressed` */
} exp_run;

/* Runs a loop to its end: an answer, the hand's leaving, both buttons, or end_tick. TOOL_FAILURE after printing the
 * reason: lost device, end of input; TOOL_INTERRUPTED plus the signal's number. */
int exp_drive(const exp_session *session, exp_run *run, exp_outcome *outcome);

/* The signal's number after Ctrl-C. */
extern volatile sig_atomic_t exp_interrupted;

/* --- simulated.c --- */

/* The badness of a temporal signal for the simulated subject: |net force| (N) plus the spurious share of its power. */
double exp_badness(int32_t method, double period_ms, double amplitude);

/* The same for a progression around a medium period, the mean of its three. */
double exp_progression_badness(int32_t method, double medium_ms, double amplitude);

/* The same for a grating (mm) played at 1 kHz, the mean over steady speeds of 10 to 250 mm/s: its push over 0.1 s (N at
 * 0.7 N/mm), plus the share of its power that is more than 20 % of f_t from the ridges' tones, plus the drift (the
 * ratio of cycles played to crossed, less 1, at most 1). Works for every method of the library's table.
 */
double exp_grating_badness(int32_t method, double period_mm, double amplitude_mm);

/* The simulated answer, 0 or 1: the better one, with logistic noise; in training the right one. state: for
 * exp_random(). */
int32_t exp_simulated_answer(const exp_design *design, const exp_trial *trial, uint64_t *state);

/* --- records_out.c, records.c: the CSV --- */

typedef struct exp_record {
    uint64_t seed;
    double ticks, force_limit_ticks, overruns, softer_ticks, contact_s[2];
    exp_trial trial;
    int32_t experiment, simulated, sound;
    uint32_t number;  /* of the trial, from 1 */
    int32_t side;     /* preferred: 0 the first, 1 the second */
    int32_t excluded; /* 1: exp_exclude() found a reason */
    char subject[32];
    char device[256]; /* the beginning of its URI */
} exp_record;

typedef struct exp_records {
    exp_record *rows;
    size_t count, capacity;
} exp_records;

extern const char exp_csv_header[];
extern const char *const exp_answer_names[]; /* by EXP_KEYBOARD, ... */
extern const char *const exp_fault_names[4]; /* by EXP_GOOD, ... */

void exp_write_record(FILE *stream, const exp_session *session, uint32_t number, const exp_trial *trial,
                      const exp_outcome *outcome);

/* Adds a file's rows. 0, or TOOL_FAILURE after printing the line of the error. Free rows with free(). */
int exp_read_records(const char *path, exp_records *records);

/* Removes the line end. */
void exp_chop(char *line);

/* --- exclude.c: experiment 4's rules, fixed before there are data --- */

#define EXP_RIGHT_LEAST 5     /* of each six trials of training; otherwise the subject is excluded */
#define EXP_SIDE_MOST   0.9   /* share of the answers for one side; otherwise the subject is excluded */
#define EXP_CONTACT_S   3.0   /* with each grating; otherwise the trial is excluded, as for the next two */
#define EXP_LATE_SHARE  0.001 /* of late ticks in a trial */
#define EXP_LIMIT_SHARE 0.01  /* of a trial's ticks whose force was limited, or whose wall was softened */

/* Marks the rows that do not count and prints why. */
void exp_exclude(exp_records *records);

/* --- analyse.c, cells.c --- */

/* Reads the files, prints the analysis. Returns an exit code. */
int exp_analyse(int count, char *const *paths);

/* Prints the cells of one experiment and pair of methods. */
void exp_print_cells(const exp_records *records, const exp_design *design);

/* 1: the record is one of this experiment and pair of methods. */
int exp_is_of(const exp_record *record, const exp_design *design);

/* Prints the number of subjects needed for each effect. */
typedef struct exp_power {
    double repetitions, comparisons, correlation, power;
} exp_power;

int exp_print_power(const exp_power *options);

#endif
