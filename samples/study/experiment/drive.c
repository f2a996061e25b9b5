/* Runs one loop until it ends. SPDX-License-Identifier: MIT */
#include "experiment.h"

#include "os.h"
#include "say.h"

volatile sig_atomic_t exp_interrupted;

/* Ticks from a press to an answer: two buttons that go down within them stop the trial. */
#define TOGETHER 50

/* Every tick: checks both buttons, sets the force, then checks whether a question is open, then a button. [haptic
 * thread] */
static void on_tick(uint64_t tick, const knurl_device_sample *sample, double force[3], void *user) {
    exp_run *run = user;
    if ((sample->buttons & 3u) == 3u) {
        __atomic_store_n(&run->stopped, 1u, __ATOMIC_RELEASE);
    }
    if (__atomic_load_n(&run->stopped, __ATOMIC_RELAXED)) {
        return; /* the force stays zero */
    }
    run->force(run, tick, sample, force);
    const uint32_t fresh = sample->buttons & ~run->buttons; /* buttons that were already down do not count */
    run->buttons = sample->buttons;
    if (tick < run->question_tick || !__atomic_load_n(&run->ready, __ATOMIC_ACQUIRE)) {
        return;
    }
    if (run->asking && !run->pressing && (fresh & 3u) != 0) {
        run->pressing = fresh & 1u ? 1u : 2u;
        run->pressed_tick = tick;
    }
    if (run->pressing && tick - run->pressed_tick >= TOGETHER) {
        __atomic_store_n(&run->pressed, run->pressing, __ATOMIC_RELEASE);
    }
    run->asked_tick = run->asking ? run->asked_tick : tick;
    __atomic_store_n(&run->asking, 1u, __ATOMIC_RELEASE);
}

static uint64_t ticks_of(const knurl_loop *loop) {
    knurl_loop_stats stats;
    knurl_loop_stats_init(&stats, sizeof stats);
    (void)knurl_loop_get_stats(loop, &stats);
    return stats.ticks;
}

static void show_cue(const exp_session *session, const exp_run *run, uint64_t ticks, const char **shown) {
    const char *now = run->cue(ticks, run->cue_user);
    if (now != *shown && session->answers != EXP_SIMULATED) {
        say_progress("%s ", now);
    }
    *shown = now;
}

/* Asks the question once, then polls for the answer. Returns 1 or 2, 0 if there is no answer yet, -1 at the end of
 * input. */
static int ask(const exp_session *session, exp_run *run, int *asked) {
    if (!*asked) {
        os_forget_keys(); /* keys typed before the question are no answer */
        say(stderr, "%s", run->question);
        *asked = 1;
    }
    if (session->answers == EXP_KEYBOARD) {
        const int typed = os_wait_for_key();
        return typed == '1' || typed == '2' ? typed - '0' : typed < 0 ? -1 : 0;
    }
    return (int)__atomic_load_n(&run->pressed, __ATOMIC_ACQUIRE);
}

/* Waits in real time for an answer or another end. */
static int wait_for_end(const exp_session *session, exp_run *run, knurl_loop *loop, exp_outcome *outcome) {
    const char *shown = NULL;
    int asked = 0;
    int answer = 0;
    while (!knurl_loop_wait(loop, asked ? 0.0 : 0.005) && !exp_interrupted && answer == 0 &&
           !__atomic_load_n(&run->left, __ATOMIC_ACQUIRE) && !__atomic_load_n(&run->stopped, __ATOMIC_ACQUIRE)) {
        if (session->answers != EXP_SIMULATED && run->question && __atomic_load_n(&run->asking, __ATOMIC_ACQUIRE)) {
            answer = ask(session, run, &asked);
            if (asked && session->answers == EXP_BUTTONS) {
                (void)knurl_loop_wait(loop, 0.005);
            }
        } else {
            show_cue(session, run, ticks_of(loop), &shown);
        }
    }
    if (answer > 0) {
        outcome->chosen = answer - 1;
        const uint64_t at = session->answers == EXP_BUTTONS ? run->pressed_tick : ticks_of(loop);
        outcome->rt_s = ((double)at - (double)run->asked_tick) / EXP_RATE;
    }
    knurl_loop_stop(loop);
    if (asked) {
        say(stderr, "\n");
    }
    return answer < 0 ? tool_error(TOOL_FAILURE, "standard input ended before an answer") : TOOL_OK;
}

static void step_to_end(const exp_run *run, knurl_loop *loop) {
    while (ticks_of(loop) < run->end_tick && !exp_interrupted && !run->left && !run->stopped) {
        const uint64_t before = ticks_of(loop);
        (void)knurl_loop_step(loop, 1000);
        if (ticks_of(loop) == before) {
            break; /* lost */
        }
    }
    knurl_loop_request_stop(loop);
    (void)knurl_loop_step(loop, 1);
}

static knurl_result make_loop(const exp_session *session, exp_run *run, knurl_loop **loop) {
    knurl_loop_desc desc;
    knurl_loop_desc_init(&desc, sizeof desc);
    desc.device = session->device;
    desc.force_callback = on_tick;
    desc.user = run;
    desc.update_rate_hz = EXP_RATE;
    /* 0: the paper's 2.1 N without protections; a real device's own protection still applies */
    desc.protections = session->design->protections & KNURL_PROTECT_HEAT;
    desc.tick_limit = session->answers == EXP_SIMULATED || !run->question ? run->end_tick : 0;
    const knurl_result result = knurl_loop_create(&desc, loop);
    return result || session->fast ? result : knurl_loop_start(*loop);
}

int exp_drive(const exp_session *session, exp_run *run, exp_outcome *outcome) {
    knurl_loop *loop = NULL;
    knurl_loop_stats stats;
    int code = TOOL_OK;
    knurl_loop_stats_init(&stats, sizeof stats);
    if (make_loop(session, run, &loop)) {
        code = tool_error(TOOL_FAILURE, "%s", knurl_error_message());
    } else if (session->fast) {
        step_to_end(run, loop);
    } else {
        code = wait_for_end(session, run, loop, outcome);
    }
    if (loop) {
        (void)knurl_loop_get_stats(loop, &stats);
    }
    knurl_loop_destroy(loop);
    outcome->ticks = stats.ticks;
    outcome->overruns = stats.overruns;
    outcome->stopped = run->stopped;
    if (code == TOOL_OK && stats.state == KNURL_LOOP_LOST) {
        code = tool_error(TOOL_FAILURE, "the device was lost after %llu ticks of a trial",
                          (unsigned long long)stats.ticks);
    }
    return code == TOOL_OK && exp_interrupted ? TOOL_INTERRUPTED + exp_interrupted : code;
}
