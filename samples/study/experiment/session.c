/* A session: all trials of one experiment with one subject, and its CSV. SPDX-License-Identifier: MIT */
#include "experiment.h"

#include "out.h"
#include "say.h"

#include <string.h>

/* What a session adds up to, for its last lines. */
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

static int play(const exp_session *session, const exp_trial *trials, uint32_t count, FILE *stream, totals *sum) {
    uint64_t noise = ~session->seed; /* not the row of numbers that the order came from */
    int code = TOOL_OK;
    for (uint32_t i = 0; i < count && code == TOOL_OK; i++) {
        exp_outcome outcome;
        show_trial(i + 1, count, session);
        code = session->design->experiment == 3 ? exp_play_gratings(session, &trials[i], &outcome)
                                                : exp_play_temporal(session, &trials[i], &outcome);
        if (code == TOOL_OK) {
            if (session->answers == EXP_SIMULATED) {
                outcome.chosen = exp_simulated_answer(session->design, &trials[i], &noise);
                outcome.rt_s = 0.0;
            }
            exp_write_record(stream, session, i + 1, &trials[i], &outcome);
            (void)fflush(stream); /* what a person has answered outlives a power cut, in the temporary file */
            add(sum, &outcome);
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
    if (d->experiment == 3) {
        printf("temporal frequency above half the update rate: %llu ticks\n",
               (unsigned long long)t->above_nyquist_ticks);
    }
    printf("overruns: %llu; trials begun anew: %u\n", (unsigned long long)t->overruns, (unsigned)t->restarts);
    say(stdout, "written: %s\n", session->out);
}

/* The file is not kept; what people answered stays beside it. */
static void abandon(const exp_session *session, out_file *file, const totals *t) {
    if (session->answers != EXP_SIMULATED && t->trials > 0 && file->partial) {
        tool_tell("note", "what was answered (trials: %u) is in %s", (unsigned)t->trials, file->partial);
        out_leave(file);
    }
    out_discard(file);
}

int exp_run_session(exp_session *session) {
    exp_trial trials[EXP_MAX_TRIALS];
    totals sum;
    out_file file;
    const uint32_t count = exp_plan(session->design, session->seed, session->reduced, trials);
    memset(&sum, 0, sizeof sum);
    if (!exp_may_replace(session->out)) {
        return tool_error(TOOL_FAILURE,
                          "%s: is there already and not a file of simulated answers; choose another --out or --subject",
                          session->out);
    }
    if (out_open(&file, session->out)) {
        return TOOL_FAILURE;
    }
    fprintf(file.stream, "%s\n", exp_csv_header);
    int code = play(session, trials, count, file.stream, &sum);
    if (code == TOOL_OK) {
        code = out_keep(&file) ? TOOL_FAILURE : TOOL_OK;
    } else {
        abandon(session, &file, &sum);
    }
    if (code == TOOL_OK) {
        report(session, &sum);
    }
    return code;
}
