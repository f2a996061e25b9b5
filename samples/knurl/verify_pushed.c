/* knurl verify's first steps with a force: signs, scale, friction, latency. SPDX-License-Identifier: MIT */
#include "verify.h"
#include "weigh.h"

#include <math.h>
#include <string.h>

#define PI      3.141592653589793
#define GRAVITY 9.80665
#define PULSE   20  /* ticks of a pulse, */
#define SPACE   200 /* and from one to the next, which has the other sign */
#define PULSES  12
#define USED    10  /* of them, the last ones */
#define SHARE   0.7 /* of the force; the rest carries the grip over its encoders' counts, slowly */
#define SLOW    3   /* its turns in USED pulses, a whole number: it cancels out in their mean */

static void pulses(verify *v, uint64_t tick, double force[3]) {
    const double slow = sin(2.0 * PI * (double)(SLOW * tick % (USED * SPACE)) / (USED * SPACE));
    const double pulse = tick % SPACE < PULSE ? (tick / SPACE % 2 ? -SHARE : SHARE) : 0.0;
    force[v->axis] = v->newtons * (pulse + (1.0 - SHARE) * slow);
}

/* The mean motion after a pulse along v->axis: m, a row per tick. */
static const char *measure_pulses(verify *v, double mean[SPACE][3]) {
    const char *why = verify_play(v, PULSES * SPACE / VERIFY_RATE, pulses);
    why = why || v->count >= PULSES * SPACE ? why : "positions were missing";
    memset(mean, 0, SPACE * sizeof *mean);
    for (uint64_t i = PULSES - USED; i < PULSES && !why; i++) {
        const verify_row *row = &v->rows[i * SPACE];
        for (int k = 0; k < 3 * SPACE; k++) {
            const double moved = row[k / 3].position[k % 3] - row->position[k % 3];
            mean[k / 3][k % 3] += (i % 2 ? -moved : moved) / USED;
        }
    }
    return why;
}

static const char *judge_sign(verify *v) {
    static const char *const names[] = {"a push along +x moves it to +x", "a push along +y moves it to +y",
                                        "a push along +z moves it to +z"};
    double mean[SPACE][3];
    const double *d = mean[0];
    const char *why = measure_pulses(v, mean);
    for (int k = 1; k < SPACE && !why; k++) {
        d = verify_length(mean[k]) > verify_length(d) ? mean[k] : d;
    }
    const int most = verify_largest(d);
    const int moves = verify_length(d) > fmax(0.5 * v->info.resolution, 2e-5);
    const double cosine = moves ? d[v->axis] / verify_length(d) : 0.0;
    if (!why && !verify_find(v, names[v->axis], cosine, "", 0.7, 1.0, "cosine of the motion and the force",
                             moves ? "%s: it moves along %c%c"
                                   : "no motion: much less force than is sent, or a joint that sticks",
                             most == v->axis ? "wrong sign" : "swapped axis", d[most] < 0.0 ? '-' : '+', "xyz"[most])) {
        v->is_wrong = moves ? "the signs of the force have to be right first" : v->is_wrong;
    }
    return why;
}

const char *verify_signs(verify *v) {
    const char *why = verify_ask_to_hold(v);
    for (v->axis = 0; v->axis < 3 && !why; v->axis++) {
        why = judge_sign(v);
    }
    return why;
}

/* --- scale --- */

static void hold_height(verify *v, uint64_t tick, double force[3]) {
    knurl_device_sample at;
    memset(&at, 0, sizeof at);
    memcpy(at.position, v->rows[v->count - 1].position, sizeof at.position);
    weigh_hold(tick, &at, force, v->weighing);
}

static const char *weigh_once(verify *v, weighing *w, double height) {
    memset(w, 0, sizeof *w);
    w->most = v->limit = fmin(VERIFY_WEIGHING, v->info.max_force);
    w->height = height;
    v->weighing = w;
    const char *why = verify_play(v, WEIGH_SECONDS, hold_height);
    const int is_cut = w->count == 0 || w->cut > w->count / 20 || v->stats.heat_ticks > 0;
    v->limit = v->newtons;
    return why || !is_cut ? why : "grip, mass and friction take more than it may push: use a smaller mass";
}

const char *verify_scale(verify *v) {
    weighing empty;
    weighing loaded;
    if (isnan(v->mass)) {
        return "no mass was given: --mass KG";
    }
    const char *why = verify_ask(
        v, VERIFY_LET_GO, "Hold the grip in the middle, and release it slowly: it moves up and down, by up to 3 N");
    why = why ? why : weigh_once(v, &empty, NAN);
    why = why ? why : verify_ask(v, VERIFY_HANG, "Hang the mass from the grip, and release it slowly in the middle");
    why = why ? why : weigh_once(v, &loaded, empty.height);
    if (why) {
        return why;
    }
    const double sent = loaded.sum / (double)loaded.count - empty.sum / (double)empty.count;
    if (sent < 0.1 * GRAVITY * v->mass) {
        return "the grip with the mass is hardly heavier: the mass is not on it, or something carries it";
    }
    v->scale = GRAVITY * v->mass / sent;
    (void)verify_find(v, "force for each N that is sent", v->scale, "N", 0.85, 1.15,
                      "the known mass, 15 % for friction", "%s: %.3g N were sent to carry %.3g N",
                      v->scale > 0.45 && v->scale < 0.55 ? "half gain" : "wrong gain, or something touched the mass",
                      sent, GRAVITY * v->mass);
    return NULL;
}

/* --- friction --- */

#define RAMP  1000 /* ticks: a rest, then a force that grows */
#define REST  200
#define SIDES 6

/* Pushes along each axis, to both sides, until the grip moves. state: a breakaway force for each side, then its
 * place before, and whether it has moved. */
static void ramps(verify *v, uint64_t tick, double force[3]) {
    const int side = (int)(tick / RAMP) % SIDES;
    const int k = (int)(tick % RAMP) - REST;
    const double at = v->rows[v->count - 1].position[side / 2];
    double *has_moved = &v->state[SIDES + 1];
    if (k <= 0) {
        v->state[SIDES] = at;
        *has_moved = 0.0;
        v->state[side] = v->newtons;
        return;
    }
    const double newtons = v->newtons * k / (RAMP - REST);
    if (*has_moved == 0.0 && fabs(at - v->state[SIDES]) > fmax(2.5 * v->info.resolution, 1e-4)) {
        *has_moved = 1.0;
        v->state[side] = newtons;
    }
    force[side / 2] = *has_moved > 0.0 ? 0.0 : side % 2 ? -newtons : newtons;
}

/* The worst axis's force at which the grip moves: the mean of both sides, so that its weight cancels out. N */
static double measure_friction(verify *v) {
    double worst = 0.0;
    const char *why = verify_play(v, SIDES * RAMP / VERIFY_RATE, ramps);
    for (int axis = 0; axis < 3; axis++) {
        const double mean = 0.5 * (v->state[2 * axis] + v->state[2 * axis + 1]);
        v->axis = mean > worst ? axis : v->axis;
        worst = fmax(worst, mean);
    }
    return why ? NAN : worst * v->scale;
}

const char *verify_friction(verify *v) {
    double newtons;
    double expected;
    const char *why = verify_ask(v, VERIFY_HOLD, "Let the grip rest, or support it with a finger, so that it stays");
    why = verify_compare(v, why, measure_friction, &newtons, &expected);
    const double whole = 0.95 * v->newtons * v->scale;
    if (!why &&
        !verify_find(v, "force until it moves, worst axis", newtons, "N", 0.0, fmin(whole, 1.5 * expected + 0.15),
                     "a simulation with its dry friction as Knurl knows it, a half and 0.15 N more",
                     "sticky joint, along %c%s", "xyz"[v->axis],
                     newtons > whole ? ": the whole force did not move it" : "")) {
        v->is_unclear = "a joint sticks, which comes first";
    }
    return why;
}

/* --- latency --- */

/* From the force until a tenth of the motion that it causes: ticks, which are milliseconds. */
static double measure_latency(verify *v) {
    double mean[SPACE][3];
    int peak = 1;
    v->axis = 1;
    const char *why = measure_pulses(v, mean);
    for (int i = 1; i < SPACE; i++) {
        peak = mean[i][1] > mean[peak][1] ? i : peak;
    }
    int k = peak;
    while (k > 1 && mean[k - 1][1] > 0.1 * mean[peak][1]) {
        k--;
    }
    const int is_clear = mean[peak][1] > fmax(1.5 * v->info.resolution, 5e-5);
    const double over = (mean[k][1] - 0.1 * mean[peak][1]) / (mean[k][1] - mean[k - 1][1]);
    return why || !is_clear ? NAN : k - over;
}

const char *verify_latency(verify *v) {
    double ms;
    double expected;
    const char *why =
        verify_compare(v, v->is_unclear ? v->is_unclear : verify_ask_to_hold(v), measure_latency, &ms, &expected);
    if (!why) {
        (void)verify_find(v, "from a force to a tenth of its motion", ms, "ms", 0.0, expected + 1.5,
                          "a simulation with its delay as Knurl knows it, 1.5 ms more",
                          "late by %.1f ms: a filter or queue on the way; walls have to be less stiff", ms - expected);
    }
    return why;
}
