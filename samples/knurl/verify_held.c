/* knurl verify's steps without a force: rate, noise, axes, buttons, orientation. SPDX-License-Identifier: MIT */
#include "verify.h"

#include <math.h>
#include <string.h>

#define REST_S  2.0
#define TOLD_S  12.0  /* to do as asked */
#define STILL_S 0.8   /* of stillness after it was done */
#define STILL_M 0.003 /* m */
#define MOVED_M 0.02  /* m: a direction is judged from here on */
#define DEGREE  57.29577951308232

const char *verify_rate(verify *v) {
    knurl_device_status status;
    knurl_device_status_init(&status, sizeof status);
    const char *why = verify_play(v, REST_S, NULL);
    if (why) {
        return why;
    }
    (void)knurl_device_get_status(v->device, &status);
    const double took = v->times[1] - v->times[0];
    const double ticks = (double)v->stats.ticks;
    const int is_realtime = v->stats.realtime && (v->stats.io_realtime || status.exchanges == 0);
    const char *priority = is_realtime ? "" : "; it lacks real-time priority";
    (void)verify_find(v, "ticks a second", v->seconds ? (ticks - 1.0) / took : NAN, "Hz", 999.0, 1001.0,
                      "the rate that the loop was asked for",
                      v->seconds ? "the loop cannot keep its rate" : "time is simulated");
    (void)verify_find(v, "late ticks", 100.0 * (double)v->stats.overruns / ticks, "%", 0.0, 0.1,
                      "half a period late or more: one in a thousand", "the machine delays the loop%s", priority);
    (void)verify_find(v, "lateness, 99 % of ticks", 1e-3 * v->stats.jitter_ns.p99, "us", 0.0, 200.0,
                      "a fifth of a tick", "other programs delay the loop%s", priority);
    if (status.exchanges > 0) {
        (void)verify_find(v, "a transfer, 99 % of them", 1e-3 * status.exchange_ns_p99, "us", 0.0, 1000.0,
                          "one fits into a tick", "the cable, hub or driver is too slow for 1 kHz");
    }
    return NULL;
}

const char *verify_noise(verify *v) {
    double worst = 0.0;
    const char *why = verify_ask(v, VERIFY_LET_GO, "Lay the handle down so that it rests, and take your hand away");
    why = why ? why : verify_play(v, REST_S, NULL);
    for (int axis = 0; axis < 3 && !why; axis++) {
        double sum = 0.0;
        double squares = 0.0;
        const uint64_t from = v->count / 4;
        for (uint64_t i = from; i < v->count; i++) {
            const double x = v->rows[i].position[axis] - v->rows[from].position[axis];
            sum += x;
            squares += x * x;
        }
        const double mean = sum / (double)(v->count - from);
        worst = fmax(worst, sqrt(fmax(0.0, squares / (double)(v->count - from) - mean * mean)));
    }
    if (!why && !verify_find(v, "noise at rest, rms", 1e3 * worst, "mm", 0.0, 1e3 * fmax(v->info.resolution, 1e-5),
                             "one step of its encoders, 0.01 mm at least",
                             "noisy encoder: positions move though the handle rests; look at cables and supply")) {
        v->is_unclear = "positions are noisy, which comes first";
    }
    return why;
}

/* Ends the step once the grip has been elsewhere and is still again. */
static void await_motion(verify *v, uint64_t tick, double force[3]) {
    const verify_row *now = &v->rows[v->count - 1];
    double shift = 0.0;
    (void)force;
    for (int axis = 0; axis < 3; axis++) {
        v->state[3] = fmax(v->state[3], fabs(now->position[axis] - v->rows[0].position[axis]));
        shift = fmax(shift, fabs(now->position[axis] - v->state[axis]));
    }
    if (shift > STILL_M) {
        memcpy(v->state, now->position, sizeof now->position);
        v->state[4] = (double)tick;
    }
    if (v->state[3] > MOVED_M && (double)tick > v->state[4] + STILL_S * VERIFY_RATE) {
        knurl_loop_request_stop(v->loop);
    }
}

/* The first motion of MOVED_M, how far it went along the axis, and the least distance between two readings. m */
static void survey(const verify *v, int axis, double d[3], double *reach, double *step) {
    const double *start = v->rows[0].position;
    double low = start[axis];
    double high = start[axis];
    int is_away = 0;
    for (uint64_t i = 1; i < v->count; i++) {
        const double *p = v->rows[i].position;
        const double *q = v->rows[i - 1].position;
        const double apart = hypot(hypot(p[0] - q[0], p[1] - q[1]), p[2] - q[2]);
        *step = apart > 1e-9 ? fmin(*step, apart) : *step;
        low = fmin(low, p[axis]);
        high = fmax(high, p[axis]);
        for (int k = 0; k < 3 && !is_away; k++) {
            d[k] = p[k] - start[k];
        }
        is_away |= verify_length(d) > MOVED_M;
    }
    *reach = high - low;
}

static const char *judge_axis(verify *v, int axis, double *step) {
    static const char *const names[] = {"right is +x", "up is +y", "towards you is +z"};
    static const char *const reaches[] = {"reach along x", "reach along y", "reach along z"};
    const double nominal = 1e3 * (v->info.workspace_max[axis] - v->info.workspace_min[axis]);
    double d[3] = {0.0, 0.0, 0.0};
    double reach = 0.0;
    survey(v, axis, d, &reach, step);
    const int most = verify_largest(d);
    if (verify_length(d) < MOVED_M) {
        return "the grip did not move";
    }
    (void)verify_find(v, names[axis], d[axis] / verify_length(d), "", 0.7, 1.0,
                      "cosine of the motion and its axis: x right, y up, z to the user", "%s: it reads as %c%c",
                      most != axis    ? "swapped axis"
                      : d[axis] < 0.0 ? "reversed axis"
                                      : "askew",
                      d[most] < 0.0 ? '-' : '+', "xyz"[most]);
    if (nominal > 0.0 && most == axis) {
        (void)verify_find(v, reaches[axis], 1e3 * reach, "mm", 0.8 * nominal, 3.0 * nominal,
                          "its workspace as Knurl knows it, 0.8 to 3 times",
                          "a wrong scale of positions, or it was not moved to both ends");
    }
    return NULL;
}

const char *verify_axes(verify *v) {
    static const char *const sentences[] = {
        "Move the grip right, then left, each as far as it goes, back to the middle, and hold it still",
        "Move the grip up, then down, each as far as it goes, back to the middle, and hold it still",
        "Move the grip towards you, then away, each as far as it goes, back to the middle, and hold it still"};
    const double quantum = 1e3 * v->info.resolution;
    double step = HUGE_VAL;
    const char *why = NULL;
    for (int axis = 0; axis < 3 && !why; axis++) {
        why = verify_ask(v, (verify_wish)(VERIFY_RIGHT + axis), sentences[axis]);
        why = why ? why : verify_play(v, TOLD_S, await_motion);
        why = why ? why : judge_axis(v, axis, &step);
    }
    if (!why && quantum > 0.0) {
        (void)verify_find(v, "least step between positions", 1e3 * step, "mm", 0.3 * quantum, 2.0 * quantum,
                          "its resolution as Knurl knows it, 0.3 to 2 times",
                          "another resolution: the limits of walls, and velocities, depend on it");
    }
    return why;
}

/* Ends the step a while after the last change. */
static void await_press(verify *v, uint64_t tick, double force[3]) {
    (void)force;
    v->state[0] = v->rows[v->count - 1].buttons != v->rows[0].buttons ? (double)tick : v->state[0];
    if (v->state[0] > 0.0 && (double)tick > v->state[0] + 1.5 * VERIFY_RATE) {
        knurl_loop_request_stop(v->loop);
    }
}

const char *verify_buttons(verify *v) {
    uint32_t changed = 0;
    int count = 0;
    const char *why = verify_ask(v, VERIFY_PRESS, "Press and release each button, one after the other");
    why = why ? why : verify_play(v, TOLD_S, await_press);
    for (uint64_t i = 0; i < v->count && !why; i++) {
        changed |= v->rows[i].buttons ^ v->rows[0].buttons;
    }
    for (uint32_t bits = changed; bits; bits &= bits - 1) {
        count++;
    }
    if (count == 0) {
        return why ? why : "no press was seen: it has no button, or it does not reach the driver";
    }
    const int is_back = v->rows[v->count - 1].buttons == v->rows[0].buttons;
    (void)verify_find(v, "buttons that change", is_back ? count : 0.0, "", 1.0, 32.0, "a press is seen, and its end",
                      "a button that stays pressed");
    return NULL;
}

/* The turn of the present row about y since the first, degrees; positive: counter-clockwise, seen from above. */
static double turned(const verify *v, uint64_t row) {
    const double *a = v->rows[0].orientation;
    const double *b = v->rows[row].orientation;
    const double y = b[1] * a[3] - b[3] * a[1] + b[0] * a[2] - b[2] * a[0]; /* of b times a's inverse */
    const double w = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
    return 2.0 * DEGREE * atan2(w < 0.0 ? -y : y, fabs(w));
}

/* Ends the step after a turn to and fro, or if no orientation comes. */
static void await_turn(verify *v, uint64_t tick, double force[3]) {
    const double *q = v->rows[0].orientation;
    const double now = turned(v, v->count - 1);
    (void)force;
    (void)tick;
    v->state[0] = fabs(now) > fabs(v->state[0]) ? now : v->state[0];
    if ((q[0] == 0.0 && q[1] == 0.0 && q[2] == 0.0 && q[3] == 0.0) || (fabs(v->state[0]) > 45.0 && fabs(now) < 15.0)) {
        knurl_loop_request_stop(v->loop);
    }
}

const char *verify_orientation(verify *v) {
    const char *why = verify_ask(v, VERIFY_TURN,
                                 "Turn the stylus to the left about a vertical axis, by a quarter of a turn, and back");
    why = why ? why : verify_play(v, TOLD_S, await_turn);
    const double *q = v->rows[0].orientation;
    if (why || (q[0] == 0.0 && q[1] == 0.0 && q[2] == 0.0 && q[3] == 0.0)) {
        return why ? why : "the device does not measure it";
    }
    (void)verify_find(v, "a turn to the left", v->state[0], "degrees", 30.0, 180.0,
                      "counter-clockwise seen from above: positive about y", "%s",
                      v->state[0] < -30.0 ? "it turns the other way: mirrored, or an inverse" : "it hardly turns");
    return NULL;
}
