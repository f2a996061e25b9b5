/* knurl verify's last steps: the stiffest wall, the response, and faults on purpose. SPDX-License-Identifier: MIT */
#include "os.h"
#include "tool.h"
#include "verify.h"
#include "watch.h"

#include <knurl/hip.h>
#include <knurl/scene.h>

#include <math.h>

#define FIRST_WALL 100.0 /* N/m */
#define STEEPER    1.25
#define LEVEL      300 /* ticks at a stiffness */
#define BLOCK      50  /* of these, whose deviation tells a vibration from a hand that moves */

/* A spring to the first position, on both sides, with a kick at each stiffness. state: the place, the block's sum and
 * sum of squares, the level's sum of variances, the last stiffness that was calm. */
static void wall(verify *v, uint64_t tick, double force[3]) {
    double *s = v->state;
    const double y = v->rows[v->count - 1].position[1];
    const uint64_t k = tick % LEVEL;
    const uint64_t level = tick / LEVEL;
    const double stiffness = FIRST_WALL * pow(STEEPER, (double)level);
    s[0] = tick == 0 ? y : s[0];
    const double newtons = fmin(v->newtons, fmax(-v->newtons, stiffness * (s[0] - y)));
    force[1] = newtons + (k < 5 ? 0.5 * v->newtons : 0.0);
    s[1] = newtons + (k % BLOCK == 0 ? 0.0 : s[1]);
    s[2] = newtons * newtons + (k % BLOCK == 0 ? 0.0 : s[2]);
    s[3] = k == 0 ? 0.0 : s[3];
    if (k % BLOCK == BLOCK - 1 && k >= LEVEL / 2) {
        s[3] += (s[2] - s[1] * s[1] / BLOCK) / BLOCK;
    }
    if (k == LEVEL - 1) {
        if (sqrt(s[3] / (0.5 * LEVEL / BLOCK)) > 0.25 * v->newtons) {
            knurl_loop_request_stop(v->loop);
        } else {
            s[4] = stiffness;
        }
    }
}

/* The stiffest wall without a vibration, up to the one at which three counts of its encoders are the whole force. N/m
 */
static double measure_wall(verify *v) {
    const double most = v->newtons / (3.0 * fmax(v->info.resolution, 1e-5));
    const double levels = fmax(1.0, floor(log(most / FIRST_WALL) / log(STEEPER)));
    return verify_play(v, levels * LEVEL / VERIFY_RATE, wall) ? NAN : v->state[4];
}

const char *verify_wall(verify *v) {
    double stiffest;
    double expected;
    const char *why = verify_compare(v, verify_ask_to_hold(v), measure_wall, &stiffest, &expected);
    if (!why) {
        (void)verify_find(v, "stiffest calm wall", stiffest, "N/m", 0.5 * expected, HUGE_VAL,
                          "half of a simulation with its data, in " VERIFY_HAND,
                          "it shakes at %.3g N/m, predicted was %.3g: more delay or mass, or less friction, than Knurl "
                          "knows, or a very loose hand",
                          fmax(FIRST_WALL, stiffest * STEEPER), expected);
    }
    return why;
}

/* --- response --- */

/* The file of another measurement. */
static const char *check_file(verify *v) {
    knurl_gain gains[KNURL_GAINS];
    double lowest = 1.0;
    if (tool_read_response(v->response_path, gains) != TOOL_OK) {
        return "the response's file cannot be used";
    }
    for (int i = 0; i < KNURL_GAINS; i++) {
        lowest = fmin(lowest, gains[i].gain);
    }
    (void)verify_find(v, "lowest gain from the given file", lowest, "", 0.01, 1.0,
                      "a hundredth: below, ridges are not felt", "a resonance or noise in the file");
    return NULL;
}

/* The frequency up to which motions stand out from noise. Hz */
static double measure_response(verify *v) {
    if (sweep_run(v->device, VERIFY_RATE, v->simulated, v->interrupted, &v->response)) {
        v->response.row_count = 0;
        return NAN;
    }
    v->response.row_count = sweep_count_clear(&v->response);
    return v->response.row_count > 0 ? v->response.rows[v->response.row_count - 1].hz : 0.0;
}

const char *verify_response(verify *v) {
    if (v->response_path) {
        return check_file(v);
    }
    const char *why = verify_ask(v, VERIFY_HOLD, "Hold the grip as when you feel a surface: it hums for two minutes");
    const double hz = why ? NAN : measure_response(v);
    if (isnan(hz)) {
        return why ? why : knurl_error_message();
    }
    (void)verify_find(v, "motion stands out from noise up to", hz, "Hz",
                      fmin(VERIFY_LAST_HZ, 0.7 * verify_predict(v, measure_response)), 500.0,
                      "300 Hz, which --response needs; less if a simulation with its data reaches less",
                      "positions are too coarse or noisy, or the hand moved too much");
    return NULL;
}

/* --- faults --- */

#define PUSH_N   0.4
#define BEFORE_S 0.3
#define TOLD_S   200 /* to do as asked */
#define POLL     20  /* ticks */

/* A fault on purpose, as the force that is sent shows it. */
typedef struct cut {
    int is_away;   /* atomic: 1 from the event on */
    double push;   /* N: the force while all is well */
    double first;  /* N: the first force from the event on */
    uint64_t ramp; /* ticks from there to nine tenths of the push */
    int is_full;   /* atomic: 1: `first` and `ramp` no longer change */
} cut;

static int is_full(const cut *c) {
    return __atomic_load_n(&c->is_full, __ATOMIC_ACQUIRE);
}

static void watch_force(const knurl_tick_output *output, void *user) {
    cut *c = user;
    const double newtons = fabs(output->device_force[1]);
    if (__atomic_load_n(&c->is_away, __ATOMIC_ACQUIRE) && newtons > 0.0 && !is_full(c)) {
        c->first = c->ramp == 0 ? newtons : c->first;
        c->ramp++;
        __atomic_store_n(&c->is_full, newtons >= 0.9 * c->push, __ATOMIC_RELEASE);
    }
}

/* Steps or waits, until a fault (wanted 0) or an event of that code is told. Returns its code, or 0 after `seconds`. */
static int32_t await_event(verify *v, double seconds, int32_t wanted) {
    knurl_device_event event;
    for (int left = (int)(seconds * VERIFY_RATE / POLL); left > 0 && !*v->interrupted; left--) {
        if (v->simulated) {
            (void)knurl_loop_step(v->loop, POLL);
        } else {
            (void)knurl_loop_wait(v->loop, POLL / VERIFY_RATE);
        }
        if (!v->simulated) {
            watch_key(v->interrupted);
        }
        while (knurl_device_next_event(v->device, &event)) {
            const int is_fault = event.code < KNURL_FAULT_RESUMED && event.code != KNURL_FAULT_OVERRUN;
            if (wanted ? event.code == wanted : is_fault) {
                return event.code;
            }
        }
    }
    return 0;
}

/* A loop with nothing but a push upwards, which looks for a lost device. */
static knurl_result push_up(verify *v, cut *c, knurl_scene **scene) {
    const double up[3] = {0.0, c->push, 0.0};
    knurl_workspace workspace;
    knurl_hip_desc hip;
    knurl_loop_desc desc;
    knurl_hip_desc_init(&hip, sizeof hip);
    knurl_workspace_set_identity(&workspace);
    knurl_loop_desc_init(&desc, sizeof desc);
    hip.workspace = &workspace;
    knurl_result failed = knurl_scene_create(NULL, scene);
    failed = failed ? failed : knurl_scene_configure_hip(*scene, 0, &hip);
    failed = failed ? failed : knurl_scene_commit(*scene);
    desc.device = v->device;
    desc.scene = *scene;
    desc.tick_callback = watch_force;
    desc.user = c;
    desc.update_rate_hz = VERIFY_RATE;
    desc.reconnect = 1;
    failed = failed ? failed : knurl_loop_create(&desc, &v->loop);
    failed = failed ? failed : knurl_loop_set_force(v->loop, up);
    return failed || v->simulated ? failed : knurl_loop_start(v->loop);
}

static const char *follow(verify *v, cut *c, const char *what, const verify_wish wishes[2],
                          const char *const sentences[2]) {
    os_forget_keys();
    (void)await_event(v, BEFORE_S, KNURL_FAULT_RESUMED);
    const char *why = verify_ask(v, wishes[0], sentences[0]);
    const int32_t code = why ? 0 : await_event(v, TOLD_S, 0);
    __atomic_store_n(&c->is_away, 1, __ATOMIC_RELEASE);
    if (!code) {
        return why ? why : "no fault was told: it was not done, or the device does not tell it";
    }
    (void)verify_ask(v, wishes[1], sentences[1]);
    for (int tenths = 0; !is_full(c) && tenths < TOLD_S * 10 && !*v->interrupted; tenths++) {
        (void)await_event(v, 0.1, KNURL_FAULT_RESUMED);
    }
    if (!is_full(c)) {
        return "a fault was told, but the force did not come back";
    }
    (void)verify_find(v, what, c->first, "N", 0.0, 0.3 * c->push, "the first force after its event: a ramp from zero",
                      "%s: force went on", knurl_fault_name(code));
    (void)verify_find(v, "its ramp afterwards", (double)c->ramp, "ms", 10.0, 500.0, "the loop's, 20 ms",
                      "the force jumped, or hardly came back");
    return NULL;
}

static const char *cut_once(verify *v, const char *what, const verify_wish wishes[2], const char *const sentences[2]) {
    cut c = {.push = fmin(PUSH_N, v->newtons)};
    knurl_scene *scene = NULL;
    v->loop = NULL;
    const char *why = push_up(v, &c, &scene) ? knurl_error_message() : follow(v, &c, what, wishes, sentences);
    knurl_loop_destroy(v->loop);
    knurl_scene_destroy(scene);
    v->loop = NULL;
    return why;
}

const char *verify_faults(verify *v) {
    static const verify_wish pull[] = {VERIFY_PULL, VERIFY_PLUG};
    static const verify_wish press[] = {VERIFY_STOP, VERIFY_GO};
    static const char *const cable[] = {"Pull its cable now, while it pushes upwards a little", "Plug it in again"};
    static const char *const stop[] = {"Press its stop or force button now, while it pushes upwards a little",
                                       "Switch its forces on again"};
    const char *why = verify_ask(v, VERIFY_HOLD, "Hold the grip, and be ready to pull the device's cable");
    why = why ? why : cut_once(v, "first force after the cable was pulled", pull, cable);
    why =
        why ? why : verify_ask(v, VERIFY_HOLD, "Hold the grip, and be ready to press the device's stop, if it has one");
    return why ? why : cut_once(v, "first force after it was stopped", press, stop);
}
