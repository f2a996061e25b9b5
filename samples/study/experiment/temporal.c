/* A trial of experiment 1 or 2 on a device: a lead, the two progressions, then silence until an answer comes.
 * SPDX-License-Identifier: MIT */
#include "experiment.h"

#include "say.h"

#include <math.h>
#include <string.h>

#define LEAD_TICKS     1000  /* 1 s to grasp the stylus; the paper's subjects move into a sphere without a time limit */
#define SPHERE         0.020 /* m: leaving it stops the trial, as in the paper, which gives no radius */
#define FORGIVEN       10    /* restarts after which a simulated hand is assumed unable to hold still */
#define QUESTION_TICKS (LEAD_TICKS + EXP_TRIAL_TICKS)

typedef struct player {
    const exp_stimulus *stimulus;
    const char *(*cue)(uint64_t tick, void *cue_user);
    void *cue_user;
    double max_force;
    double centre[3]; /* of the sphere: the hand's position at the start of the first vibration */
    uint64_t force_limit_ticks;
} player;

/* Forces go up and down (IV-A2). They are passed on as in the paper: the device's layer limits them. */
static void play(exp_run *run, uint64_t tick, const knurl_device_sample *sample, double force[3]) {
    player *p = run->user;
    if (tick <= LEAD_TICKS) {
        memcpy(p->centre, sample->position, sizeof p->centre);
    }
    if (tick < LEAD_TICKS || tick >= QUESTION_TICKS) {
        return;
    }
    const double d[3] = {sample->position[0] - p->centre[0], sample->position[1] - p->centre[1],
                         sample->position[2] - p->centre[2]};
    if (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] > SPHERE * SPHERE) {
        __atomic_store_n(&run->left, 1u, __ATOMIC_RELEASE);
    }
    if (!__atomic_load_n(&run->left, __ATOMIC_RELAXED)) {
        force[1] = exp_stimulus_force(p->stimulus, tick - LEAD_TICKS);
        p->force_limit_ticks += fabs(force[1]) > p->max_force;
    }
}

static const char *cue_trial(uint64_t t, void *user) {
    (void)user;
    if (t < EXP_PROGRESSION) {
        return "first (blue)";
    }
    return t < EXP_PROGRESSION + EXP_BETWEEN_TICKS ? "..." : t < EXP_TRIAL_TICKS ? "second (green)" : "";
}

/* Text for the subject during the progressions, and before. */
static const char *cue(uint64_t tick, void *user) {
    const player *p = user;
    return tick < LEAD_TICKS ? "hold still" : p->cue(tick - LEAD_TICKS, p->cue_user);
}
/* Sets the fake device's hand to stand still. */
static int hold(const exp_session *session) {
    knurl_stroke_desc stroke;
    knurl_stroke_desc_init(&stroke, sizeof stroke);
    stroke.stroke = KNURL_STROKE_REST;
    if (strncmp(session->uri, "fake", 4) == 0 && knurl_fake_set_stroke(session->device, &stroke)) {
        return tool_error(TOOL_FAILURE, "%s", knurl_error_message());
    }
    return TOOL_OK;
}

int exp_play_stimulus(const exp_session *session, const exp_stimulus *stimulus, const char *(*words)(uint64_t, void *),
                      void *user, const char *question, exp_outcome *outcome) {
    player p;
    exp_run run;
    uint32_t restarts = 0;
    int code = hold(session);
    do {
        memset(&p, 0, sizeof p);
        memset(&run, 0, sizeof run);
        memset(outcome, 0, sizeof *outcome);
        p.stimulus = stimulus;
        p.cue = words;
        p.cue_user = user;
        p.max_force = session->info.max_force;
        run.force = play;
        run.cue = cue;
        run.cue_user = run.user = &p;
        run.question = question;
        run.ready = 1;
        run.question_tick = QUESTION_TICKS;
        run.end_tick = QUESTION_TICKS + 1; /* the loop's final ramp starts from zero force */
        code = code ? code : exp_drive(session, &run, outcome);
        outcome->force_limit_ticks = p.force_limit_ticks;
        outcome->restarts = restarts;
        if (code == TOOL_OK && run.left && session->answers != EXP_SIMULATED) {
            say(stderr, "The hand left the sphere: this begins anew.\n");
        }
        restarts += code == TOOL_OK && run.left;
        if (session->answers == EXP_SIMULATED && restarts > FORGIVEN) {
            return tool_error(TOOL_FAILURE, "the simulated hand left the sphere %u times; it is too soft to hold still",
                              (unsigned)restarts);
        }
    } while (code == TOOL_OK && run.left && !run.stopped);
    return code;
}

int exp_play_temporal(const exp_session *session, const exp_trial *trial, exp_outcome *outcome) {
    exp_stimulus stimulus;
    const int code = exp_stimulus_init(trial, &stimulus);
    return code ? code
                : exp_play_stimulus(
                      session, &stimulus, cue_trial, NULL,
                      "Which was the better progression from low to high frequency? 1 the first, 2 the second: ",
                      outcome);
}
