/* Between two trials: no force. SPDX-License-Identifier: MIT */
#include "experiment.h"

#include <string.h>

#define BREAK_TICKS 60000 /* a minute after each block */

static const char *cue_rest(uint64_t tick, void *user) {
    (void)tick;
    return *(const uint64_t *)user > 0 ? "a break of at least a minute: let go of the stylus" : "";
}

static void no_force(exp_run *run, uint64_t tick, const knurl_device_sample *sample, double force[3]) {
    (void)run;
    (void)tick;
    (void)sample;
    (void)force;
}

int exp_rest(const exp_session *session, int is_break, int *stopped) {
    exp_run run;
    exp_outcome outcome;
    int code = TOOL_OK;
    memset(&run, 0, sizeof run);
    memset(&outcome, 0, sizeof outcome);
    run.force = no_force;
    run.cue = cue_rest;
    run.cue_user = &run.question_tick;
    run.ready = 1;
    run.question = "Rest as long as you like. 1 goes on, 2 stops here for today: ";
    run.question_tick = is_break ? BREAK_TICKS : 0;
    do {
        run.stopped = run.pressed = run.asking = 0;
        code = exp_drive(session, &run, &outcome);
    } while (code == TOOL_OK && outcome.stopped); /* pressing both buttons is no answer */
    *stopped = code == TOOL_OK && outcome.chosen == 1;
    return code;
}
