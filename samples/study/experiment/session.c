/* A session: all trials of one experiment with one subject, and its CSV. SPDX-License-Identifier: MIT */
#include "experiment.h"

#include "out.h"
#include "say.h"

#include <stdlib.h>
#include <string.h>

/* A session, and the rows of its file: the text of earlier rows, and the outcomes of those from `first` on. */
typedef struct session_rows {
    const exp_session *session;
    exp_trial *trials;
    exp_outcome *outcomes;
    uint32_t first;
    char *text; /* null: no earlier rows */
} session_rows;

/* Totals of a session, for its last lines. */
typedef struct totals {
    uint64_t ticks, force_limit_ticks, above_nyquist_ticks, overruns;
    uint32_t trials, force_limit_trials, restarts;
} totals;

static void add(totals *t, const exp_outcome *o) {
    t->trials++;
    t->ticks += o->ticks;
    t->force_limit_ticks += o->force_limit_ticks;
    t->force_limit_trials += o->force_limit_ticks > 0;
    t->above_nyquist_ticks += o->above_nyquist_ticks;
    t->overruns += o->overruns;
    t->restarts += o->restarts;
}

static void show_trial(uint32_t number, uint32_t count, const exp_session *session) {
    if (session->answers != EXP_SIMULATED) {
        say(stderr, "Trial %u of %u\n", (unsigned)number, (unsigned)count);
    } else {
        say_progress("trial %u of %u", (unsigned)number, (unsigned)count);
    }
}

/* Writes all rows so far to a file that replaces the old one. */
static int save(const session_rows *s, uint32_t count) {
    out_file file;
    if (out_open(&file, s->session->out)) {
        return TOOL_FAILURE;
    }
    if (s->text) {
        fputs(s->text, file.stream);
    } else {
        fprintf(file.stream, "%s\n", exp_csv_header);
    }
    for (uint32_t i = s->first; i < count; i++) {
        exp_write_record(file.stream, s->session, i + 1, &s->trials[i], &s->outcomes[i]);
    }
    return out_update(&file, s->session->answers != EXP_SIMULATED) ? TOOL_FAILURE : TOOL_OK;
}

/* Checks that the file can be written, before anyone answers. */
static int try_to_write(const char *path) {
    out_file file;
    const int code = out_open(&file, path) ? TOOL_FAILURE : TOOL_OK;
    if (code == TOOL_OK) {
        out_discard(&file);
    }
    return code;
}

/* Plays one trial until its answer; if the subject stops it, it is played again after a rest. *stopped: as for
 * exp_rest(). */
static int play_trial(const exp_session *session, const exp_trial *trial, uint32_t number, exp_outcome *outcome,
                      int *stopped) {
    uint64_t noise = ~session->seed + 0x9e3779b97f4a7c15u * number; /* the same answers if it is resumed */
    uint32_t restarts = 0;
    int code = TOOL_OK;
    do {
        code = exp_has_gratings(session->design) ? exp_play_gratings(session, trial, outcome)
                                                 : exp_play_temporal(session, trial, outcome);
        if (code == TOOL_OK && outcome->stopped) {
            restarts++;
            say(stderr, "Stopped: no force. This trial begins anew.\n");
            code = exp_rest(session, 0, stopped);
        }
    } while (code == TOOL_OK && outcome->stopped && !*stopped);
    outcome->restarts += restarts;
    if (session->answers == EXP_SIMULATED) {
        outcome->chosen = exp_simulated_answer(session->design, trial, &noise);
        outcome->rt_s = 0.0;
    }
    return code;
}

static int play(session_rows *s, uint32_t count, totals *sum, int *stopped) {
    const exp_session *session = s->session;
    int code = TOOL_OK;
    for (uint32_t i = s->first; i < count && code == TOOL_OK && !*stopped; i++) {
        if (i == 0 && session->training) {
            code = exp_demonstrate(session, stopped);
        }
        if (session->answers != EXP_SIMULATED && code == TOOL_OK && !*stopped) {
            code = exp_rest(session, i > s->first && s->trials[i].block != s->trials[i - 1].block, stopped);
        }
        if (code != TOOL_OK || *stopped) {
            break;
        }
        show_trial(i + 1, count, session);
        code = play_trial(session, &s->trials[i], i + 1, &s->outcomes[i], stopped);
        code = code || *stopped ? code : save(s, i + 1);
        if (code == TOOL_OK && !*stopped) {
            add(sum, &s->outcomes[i]);
        }
    }
    return code;
}

static void report(const exp_session *session, const totals *t) {
    const exp_design *d = session->design;
    if (session->answers == EXP_SIMULATED) {
        say(stdout, "%s\n", EXP_SIMULATION);
    }
    say(stdout, "experiment %d (%s against %s), subject %s, sound %s, seed %llu: %u trials, %.0f s played on %s\n",
        (int)d->experiment, d->names[0], d->names[1], session->subject, session->sound ? "yes" : "no",
        (unsigned long long)session->seed, (unsigned)t->trials, (double)t->ticks / EXP_RATE, session->info.name);
    printf("force above the device's %.3g N: %llu ticks in %u trials, shortened to it\n", session->info.max_force,
           (unsigned long long)t->force_limit_ticks, (unsigned)t->force_limit_trials);
    if (exp_has_gratings(d)) {
        printf("temporal frequency above half the update rate: %llu ticks\n",
               (unsigned long long)t->above_nyquist_ticks);
    }
    printf("overruns: %llu; trials begun anew: %u\n", (unsigned long long)t->overruns, (unsigned)t->restarts);
    say(stdout, "written: %s\n", session->out);
}

/* The session ended early: the answers so far are in the file. */
static void tell_rest(const session_rows *s, const totals *t, uint32_t count) {
    const uint32_t done = s->first + t->trials;
    if (done > 0 && done < count) {
        tool_tell("note", "%s has %u of %u trials; the same command goes on with the next", s->session->out,
                  (unsigned)done, (unsigned)count);
    }
}

int exp_run_session(exp_session *session) {
    exp_trial trials[EXP_MAX_TRIALS];
    exp_outcome outcomes[EXP_MAX_TRIALS];
    totals sum;
    session_rows s = {session, trials, outcomes, 0, NULL};
    const uint32_t count = exp_plan(session->design, session->seed, session->reduced, session->training, trials);
    int stopped = 0;
    memset(&sum, 0, sizeof sum);
    int code = exp_resume(session, trials, count, &s.first, &s.text);
    if (code == TOOL_OK && s.first > 0) {
        tool_tell("note", "going on with trial %u of %u of %s", (unsigned)s.first + 1, (unsigned)count, session->out);
    }
    code = code ? code : try_to_write(session->out);
    code = code ? code : play(&s, count, &sum, &stopped);
    free(s.text);
    if (code == TOOL_OK && !stopped) {
        report(session, &sum);
    } else {
        tell_rest(&s, &sum, count);
    }
    return code ? code : stopped ? TOOL_FAILURE : TOOL_OK;
}
