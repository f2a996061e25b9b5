/* The contenders of the tradeoff. SPDX-License-Identifier: MIT */
#include "contender.h"

#include "grating_metrics.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define TAU        6.283185307179586
#define RIDGE      0.001
#define RESOLUTION 0.055e-3 /* the Touch's */
#define LOW_PASS_HZ                                                                                                    \
    20.0            /* the delay of FOAW's widest window, 8 ms. 10 Hz would halve the error and double the delay       \
                     */
#define START 0.123 /* cycles: not at an edge, crest or middle */

study_method study_methods[] = {{"T1", KNURL_WAVE_T1, 0, 0},
                                {"T2", KNURL_WAVE_T2, 0, 0},
                                {"T3", KNURL_WAVE_T3, 0, 0},
                                {"S1", KNURL_METHOD_S1, 1, 0},
                                {"S2", KNURL_METHOD_S2, 1, 1},
                                {"bandlimited", KNURL_METHOD_BANDLIMITED, 1, 1},
                                {NULL, 0, 0, 0}, /* study_add_own()'s */
                                {NULL, 0, 0, 0}};

static const double rates[] = {1000.0, 2000.0, 5000.0, 10000.0};

int study_contender_at(size_t index, study_contender *contender) {
    for (const study_method *m = study_methods; m->name; m++) {
        const size_t positions = m->spatial ? 2 : 1;
        const size_t velocities = m->uses_velocity ? STUDY_VELOCITIES : 1;
        const size_t variants = positions * velocities;
        const size_t count = variants * sizeof rates / sizeof *rates;
        if (index < count) {
            contender->method = m;
            contender->update_rate_hz = rates[index / variants];
            contender->resolution = index % positions == 1 ? RESOLUTION : 0.0;
            contender->velocity = m->uses_velocity              ? (int)(index % variants / positions)
                                  : contender->resolution > 0.0 ? STUDY_FOAW /* S1: only for the tracked position */
                                                                : STUDY_IDEAL;
            contender->ridge = RIDGE;
            return 1;
        }
        index -= count;
    }
    return 0;
}

void study_contender_name(const study_contender *c, char *name, size_t size) {
    static const char *const velocities[] = {"ideal velocity", "first difference", "low pass", "FOAW"};
    const char *velocity = c->method->uses_velocity ? velocities[c->velocity] : "position";
    const char *positions = c->resolution > 0.0 ? "0.055 mm" : "ideal positions";
    (void)snprintf(name, size, "%s %g Hz", c->method->name, c->update_rate_hz);
    if (c->method->spatial) {
        const size_t used = strlen(name);
        (void)snprintf(name + used, size - used, ", %s from %s", velocity, positions);
    }
}

double study_low_pass_tick(study_low_pass *low_pass, double cutoff_hz, double rate, double x) {
    const double share = 1.0 - exp(-TAU * cutoff_hz / rate);
    const double difference = low_pass->started ? (x - low_pass->last) * rate : 0.0;
    low_pass->smooth += share * (difference - low_pass->smooth);
    low_pass->last = x;
    low_pass->started = 1;
    return low_pass->smooth;
}

int study_rendering_start(study_rendering *r, const study_contender *contender, double frequency) {
    memset(r, 0, sizeof *r);
    r->contender = *contender;
    if (!contender->method->spatial) {
        return knurl_wave_prepare(contender->method->id, 1.0 / frequency, 1.0, contender->update_rate_hz, &r->wave) !=
               0;
    }
    r->speed = frequency * contender->ridge;
    r->grating.spatial_frequency[0] = 1.0 / contender->ridge;
    r->grating.amplitude = 1.0;
    r->grating.update_rate_hz = contender->update_rate_hz;
    r->grating.method = contender->method->id;
    r->grating.resolution = contender->resolution;
    const int32_t estimator = contender->velocity == STUDY_FOAW ? KNURL_VELOCITY_FOAW : KNURL_VELOCITY_DIFFERENCE;
    return knurl_grating_check(&r->grating) ||
           knurl_velocity_prepare(estimator, RESOLUTION, contender->update_rate_hz, &r->estimator);
}

/* An event is one cycle, the six-tick mix 2.4 cycles of 2.5 ticks; without events, two changes of sign are one cycle.
 */
static double cycles_of(study_rendering *r, const knurl_grating_output *output) {
    if (study_plays_event(&r->grating, output)) {
        const double cycles = r->state.event.kind == KNURL_EVENT_MIXED ? 2.4 : 1.0;
        return cycles / r->state.event.length;
    }
    return r->grating.method != KNURL_METHOD_S2 && output->turned ? 0.5 : 0.0;
}

double study_rendering_tick(study_rendering *r) {
    const uint64_t tick = r->tick++;
    if (!r->contender.method->spatial) {
        return knurl_wave_value(&r->wave, tick);
    }
    const double x = START * r->contender.ridge + r->speed * (double)tick / r->contender.update_rate_hz;
    return study_rendering_tick_at(r, x, r->speed);
}

double study_rendering_tick_at(study_rendering *r, double x, double speed) {
    const double quantum = r->contender.resolution;
    double position[3] = {quantum > 0.0 ? floor(x / quantum + 0.5) * quantum : x, 0.0, 0.0};
    double velocity[3] = {speed, 0.0, 0.0};
    knurl_grating_output output;
    if (r->contender.velocity == STUDY_LOWPASS) {
        velocity[0] = study_low_pass_tick(&r->low_pass, LOW_PASS_HZ, r->contender.update_rate_hz, position[0]);
    } else if (r->contender.velocity != STUDY_IDEAL) {
        knurl_velocity_update(&r->estimator, position, velocity);
    }
    if (quantum > 0.0 && r->grating.method != KNURL_METHOD_S2) { /* as in a scene */
        knurl_velocity_track(&r->estimator, position, velocity, position);
    }
    knurl_grating_step(&r->grating, &r->state, position, velocity, &output);
    r->cycles_played += cycles_of(r, &output);
    r->last = output.height;
    r->within =
        study_plays_event(&r->grating, &output) ? (double)(r->state.next_tick - 1) / r->state.event.length : -1.0;
    return output.height;
}
