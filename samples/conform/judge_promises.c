/* The promises and how each is checked. Read judge_write() and judge_tick() first. SPDX-License-Identifier: MIT */
#include "judge.h"

#include <math.h>
#include <string.h>

#define ROUNDING 1e-9 /* N */

const judge_promise judge_promises[JUDGE_COUNT] = {
#define JUDGE_ROW(code, name, sentence) [JUDGE_##code] = {name, sentence},
    JUDGE_PROMISES(JUDGE_ROW)
#undef JUDGE_ROW
};

static const double zero[3] = {0.0, 0.0, 0.0};

static double length_of(const double v[3]) {
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* From `a` to the nearest point between zero and `b`: a force that only gets shorter does not count as changed. */
static double distance_to_fall(const double a[3], const double b[3]) {
    const double square = b[0] * b[0] + b[1] * b[1] + b[2] * b[2];
    const double along = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    const double share = square > 0.0 ? fmin(1.0, fmax(0.0, along / square)) : 0.0;
    const double apart[3] = {a[0] - share * b[0], a[1] - share * b[1], a[2] - share * b[2]};
    return length_of(apart);
}

/* --- the checks of each force: N above its limit; above 0: broken --- */

static double excess_finite(const judge *j, double length) {
    (void)j;
    return isfinite(length) ? 0.0 : INFINITY;
}

static double excess_bounded(const judge *j, double length) {
    return length - j->max_force * (1.0 + 1e-12);
}

static double excess_heat(const judge *j, double length) {
    (void)length;
    return j->ending ? 0.0 : j->theta - 1.01; /* a tick's worth; the ramp at a loop's end is not limited by it */
}

/* After a squeeze the force may fall more slowly. */
static double excess_ramp(const judge *j, double length) {
    const double most = j->max_force * (j->cap + (1.0 + j->slack) / j->ramp);
    return length - fmax(most, length_of(j->reset ? zero : j->force)) - ROUNDING;
}

static double excess_halted(const judge *j, double length) {
    return j->halted && j->slack == 0 ? length : 0.0;
}

static double excess_absent(const judge *j, double length) {
    return j->absent ? length : 0.0;
}

static double excess_paused(const judge *j, double length) {
    return j->paused_ticks > j->ramp + 0.5 + j->slack && !j->ending ? length : 0.0;
}

static double excess_muted(const judge *j, double length) {
    return j->muted_ticks > j->ramp + 0.5 + j->slack && !j->ending ? length : 0.0;
}

static double excess_closed(const judge *j, double length) {
    return j->closed ? length : 0.0;
}

static const struct {
    int promise;
    double (*excess)(const judge *j, double length);
} checks[] = {{JUDGE_FINITE, excess_finite}, {JUDGE_BOUNDED, excess_bounded}, {JUDGE_HEAT, excess_heat},
              {JUDGE_RAMP, excess_ramp},     {JUDGE_HALTED, excess_halted},   {JUDGE_ABSENT, excess_absent},
              {JUDGE_PAUSED, excess_paused}, {JUDGE_MUTED, excess_muted},     {JUDGE_CLOSED, excess_closed}};

void judge_breaks(judge *j, int promise, double excess) {
    judge_breach *b = &j->breaches[promise];
    if (b->count++ == 0) {
        b->seed = j->seed;
        b->tick = j->forces;
        b->after = j->after;
    }
    b->worst = fmax(b->worst, excess);
}

void judge_look(judge *j, const double force[3]) {
    const double length = length_of(force);
    for (int i = 0; i < 2; i++) { /* the first two apply to each force by itself */
        const double excess = checks[i].excess(j, length);
        if (excess > 0.0) {
            judge_breaks(j, checks[i].promise, excess);
        }
    }
}

/* The game's gain ramps with and without a position. */
static void advance_game_gain(judge *j, double ticks) {
    const double most = ticks / j->ramp;
    j->game_gain += fmin(most, fmax(-most, j->gain - j->game_gain));
    j->muted_ticks = j->gain == 0.0 ? j->muted_ticks + ticks : 0.0;
}

/* The share of max_force that the loop's ramp and the game's gain allow in this tick. */
static void advance_gains(judge *j) {
    const double step = 1.0 / j->ramp;
    j->loop_gain = j->reset || j->halted ? 0.0 : j->loop_gain;
    if (j->paused) {
        j->loop_gain = fmax(0.0, j->loop_gain - step);
    }
    advance_game_gain(j, 1.0);
    j->cap = j->loop_gain * j->game_gain;
    if (!j->paused) {
        j->loop_gain = fmin(1.0, j->loop_gain + step);
    }
    j->paused_ticks = j->paused ? j->paused_ticks + 1.0 : 0.0;
}

/* steps: N that textures and vibrations may add to the slew limit. */
static void finish(judge *j, double steps) {
    const double share = fmin(1.0, j->cap + (1.0 + j->slack) / j->ramp);
    const double excess = distance_to_fall(j->force, j->previous) - j->slew - share * steps - ROUNDING;
    if (excess > 0.0) {
        judge_breaks(j, JUDGE_SLEW, excess);
    }
    memcpy(j->previous, j->force, sizeof j->previous);
    j->pending = 0;
}

void judge_write(judge *j, const double force[3]) {
    const double length = length_of(force);
    if (j->pending) {
        finish(j, 0.0);
    }
    j->forces++;
    if (!j->ending) { /* a loop's end has a ramp of its own */
        advance_gains(j);
    }
    const double share = length / j->continuous;
    j->theta += j->cooling * ((isfinite(length) ? share * share : 0.0) - j->theta);
    for (size_t i = 0; i < sizeof checks / sizeof *checks; i++) {
        const double excess = checks[i].excess(j, length);
        if (excess > 0.0) {
            judge_breaks(j, checks[i].promise, excess);
        }
    }
    if (j->reset) {
        memset(j->previous, 0, sizeof j->previous);
    }
    if (j->absent) {
        judge_forget_contacts(j);
    }
    j->reset = j->absent;
    j->halted = j->absent = 0;
    for (int axis = 0; axis < 3; axis++) {
        j->force[axis] = isfinite(length) ? force[axis] : 0.0;
    }
    j->pending = 1;
}

void judge_tick(judge *j, const knurl_tick_output *output, const knurl_hip_contact *contacts, uint32_t count) {
    if (j->has_tick && output->tick > j->tick + 1 && !j->sees_writes) {
        judge_miss(j, output->tick - j->tick - 1);
    }
    j->has_tick = 1;
    j->tick = output->tick;
    if (!j->sees_writes) {
        judge_write(j, output->device_force);
    }
    const double off[3] = {j->force[0] - output->device_force[0], j->force[1] - output->device_force[1],
                           j->force[2] - output->device_force[2]};
    if (length_of(off) > ROUNDING) {
        judge_breaks(j, JUDGE_TOLD, length_of(off));
    }
    const double steps = judge_texture_steps(j, output, contacts, count) + judge_wave_step(j);
    const double moved[3] = {j->force[0] - j->previous[0], j->force[1] - j->previous[1], j->force[2] - j->previous[2]};
    const double excess = length_of(moved) - j->slew - steps - 0.01 * j->max_force;
    const int falls = length_of(j->force) < length_of(j->previous);
    if ((output->flags & KNURL_TICK_SQUEEZED) && falls && j->cap >= 1.0 && excess > 0.0) {
        judge_breaks(j, JUDGE_SQUEEZED, excess);
    }
    finish(j, steps);
    j->edited -= j->edited > 0;
    j->ticks++;
    j->contacts += count > 0;
    j->squeezed_ticks += (output->flags & KNURL_TICK_SQUEEZED) != 0;
}

void judge_pass_over(judge *j, const knurl_tick_output *output) {
    for (uint64_t i = j->tick; i < output->tick; i++) {
        advance_gains(j);
        (void)judge_wave_step(j);
    }
    j->tick = output->tick;
    memcpy(j->previous, output->device_force, sizeof j->previous);
    j->deepest = 0;
    for (int i = 0; i < JUDGE_SURFACES; i++) {
        j->surfaces[i].touched = 1; /* perhaps */
    }
}

void judge_miss(judge *j, uint64_t cycles) {
    if (j->pending) {
        finish(j, 0.0);
    }
    j->theta *= pow(1.0 - j->cooling, (double)cycles);
    advance_game_gain(j, (double)cycles);
    j->reset = 1;
    memset(j->force, 0, sizeof j->force);
    judge_forget_contacts(j);
}
