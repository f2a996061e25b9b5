/* The judge's record of the game's calls: trials, surfaces, vibrations. SPDX-License-Identifier: MIT */
#include "judge.h"

#include <math.h>
#include <string.h>

void judge_begin(judge *j, const knurl_device_info *info, double rate_hz, double ramp_s, double slew_rate) {
    j->max_force = info->max_force;
    j->continuous = info->continuous_force;
    j->cooling = -expm1(-1.0 / (info->heat_time * rate_hz));
    j->slew = (slew_rate > 0.0 ? slew_rate : info->max_force / 0.005) / rate_hz;
    j->rate = rate_hz;
    j->theta = 0.0;
    j->forces = 0;
    j->closed = j->halted = j->absent = 0;
    memset(j->previous, 0, sizeof j->previous);
    memset(j->force, 0, sizeof j->force);
    j->pending = 0;
    judge_begin_loop(j, ramp_s);
}

void judge_begin_loop(judge *j, double ramp_s) {
    j->ramp = 1.0 + ramp_s * j->rate;
    memset(j->surfaces, 0, sizeof j->surfaces);
    j->loop_gain = j->game_gain = j->gain = j->cap = 1.0;
    j->paused = j->halted = j->ending = j->edited = j->reset = j->has_tick = 0;
    j->paused_ticks = j->muted_ticks = j->height = j->wave_value = 0.0;
    j->wave_tick = j->wave_ticks = 0;
    j->deepest = 0;
    j->theta = fmin(j->theta, 1.0);
}

void judge_edits(judge *j) {
    j->edited = 1 + j->slack;
}

void judge_surface_is(judge *j, knurl_surface_id id, const knurl_material_desc *material) {
    static const double peaks[] = {[KNURL_METHOD_DEFAULT] = 1.2733,
                                   [KNURL_METHOD_S1] = 1.0,
                                   [KNURL_METHOD_S2] = 1.7320509,
                                   [KNURL_METHOD_BANDLIMITED] = 1.2733};
    judge_surface *s = judge_find_surface(j, id);
    s = s ? s : judge_find_surface(j, 0);
    if (s) {
        const double crest = material->amplitude * peaks[material->method];
        const int is_new = s->id == 0;
        *s = (judge_surface){id, j->slack && !is_new ? fmax(s->stiffness, material->stiffness) : material->stiffness,
                             is_new ? crest : fmax(crest, s->crest), s->touched};
    }
    judge_edits(j);
}

void judge_surface_gone(judge *j, knurl_surface_id id) {
    judge_surface *s = judge_find_surface(j, id);
    if (s) {
        s->touched = 0;
        s->id = j->slack ? s->id : 0;
    }
    judge_edits(j);
}

void judge_vibrate(judge *j, int32_t method, double frequency_hz, double amplitude, double seconds) {
    if (knurl_wave_prepare(method, 1.0 / frequency_hz, amplitude, j->rate, &j->wave) == KNURL_OK) {
        const uint64_t event =
            method == KNURL_WAVE_T3 ? (uint64_t)j->wave.parts[0].length : 1; /* T3 ends after a whole cycle */
        j->wave_ticks = ((uint64_t)ceil(seconds * j->rate) + event - 1) / event * event;
        j->wave_tick = 0;
    }
}

void judge_expect_zero(judge *j, int promise) {
    const double *f = j->force;
    const double length = sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
    if (length > 0.0 && (j->sees_writes || promise == JUDGE_ENDED)) {
        judge_breaks(j, promise, length);
    }
}

void judge_wait(judge *j) {
    while (j->slack && !judge_try(j)) {}
}

int judge_try(judge *j) {
    return !j->slack || !__atomic_exchange_n(&j->lock, 1, __ATOMIC_ACQUIRE);
}

void judge_leave(judge *j) {
    __atomic_store_n(&j->lock, 0, __ATOMIC_RELEASE);
}
