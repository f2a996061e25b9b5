/* The force as a signal. SPDX-License-Identifier: MIT */
#include "audio/coil.h"

#include "audio/wave.h"
#include "base/atomic.h"
#include "base/vec3.h"

#include <string.h>

#define PI 3.14159265358979323846

/* A sinc with a Kaiser window: at 1 kHz -0.7 dB at 400 Hz, -6 dB at 500 Hz, and images of the ticks 38 dB lower from
 * 650 Hz on. A longer window would be flat further, and later. */
#define BETA 3.5

#define HIGH_PASS_HZ 3.0   /* -0.4 dB at 10 Hz */
#define SILENCE      1e-6  /* N */
#define ROUNDING     1e-12 /* N: of a sample; a step below it is that of a constant force */
#define CROSSOVER_HZ 80.0  /* between a gamepad's slow, heavy motor and its fast, light one */
#define MEAN_S       0.025

void knurl_coil_init(knurl_coil *coil, double sample_rate_hz) {
    const double half = 0.5 * KNURL_COIL_TAPS;
    memset(coil, 0, sizeof *coil);
    coil->decay = exp(-2.0 * PI * HIGH_PASS_HZ / sample_rate_hz);
    for (int i = 0; i <= KNURL_COIL_TAPS / 2 * KNURL_COIL_STEPS; i++) {
        const double t = (double)i / KNURL_COIL_STEPS;
        const double edge = t / half;
        coil->table[i] = (i ? sin(PI * t) / (PI * t) : 1.0) * knurl_wave_bessel(BETA * sqrt(1.0 - edge * edge));
    }
}

void knurl_coil_push(knurl_coil *coil, double force) {
    coil->history[coil->next] = force;
    coil->next = (coil->next + 1) % KNURL_COIL_TAPS;
}

/* Straight between the table's entries. t: ticks, at most half of the taps. */
static double weight(const knurl_coil *coil, double t) {
    const double place = fabs(t) * KNURL_COIL_STEPS;
    const int i = (int)place;
    return coil->table[i] + (place - i) * (coil->table[i + 1] - coil->table[i]);
}

double knurl_coil_pull(knurl_coil *coil, double at) {
    double sum = 0.0;
    double weights = 0.0;
    for (uint32_t k = 0; k < KNURL_COIL_TAPS; k++) { /* the oldest first */
        const double w = weight(coil, (double)k + 1.0 - 0.5 * KNURL_COIL_TAPS - at);
        sum += w * coil->history[(coil->next + k) % KNURL_COIL_TAPS];
        weights += w;
    }
    const double input = sum / weights;
    const double step = input - coil->before;
    coil->output = coil->decay * coil->output + step;
    coil->before = input;
    if (fabs(step) < ROUNDING && fabs(coil->output) < SILENCE) {
        coil->output = 0.0;
    }
    return coil->output;
}

/* Butterworth filters by the bilinear transform. */
static void init_band(knurl_band *band, double hz, double rate, int is_high) {
    const double k = tan(PI * hz / rate);
    const double norm = 1.0 / (1.0 + sqrt(2.0) * k + k * k);
    band->b[0] = band->b[2] = is_high ? norm : k * k * norm;
    band->b[1] = is_high ? -2.0 * band->b[0] : 2.0 * band->b[0];
    band->a[0] = 2.0 * (k * k - 1.0) * norm;
    band->a[1] = (1.0 - sqrt(2.0) * k + k * k) * norm;
}

static double pass(knurl_band *band, double x) {
    const double y = band->b[0] * x + band->b[1] * band->x[0] + band->b[2] * band->x[1] - band->a[0] * band->y[0] -
                     band->a[1] * band->y[1];
    band->x[1] = band->x[0];
    band->x[0] = x;
    band->y[1] = band->y[0];
    band->y[0] = fabs(y) < ROUNDING ? 0.0 : y;
    return y;
}

void knurl_rumble_init(knurl_rumble *rumble, double update_rate_hz) {
    memset(rumble, 0, sizeof *rumble);
    init_band(&rumble->steady, HIGH_PASS_HZ, update_rate_hz, 1);
    init_band(&rumble->low, knurl_min(CROSSOVER_HZ, 0.4 * update_rate_hz), update_rate_hz, 0);
    init_band(&rumble->high, knurl_min(CROSSOVER_HZ, 0.4 * update_rate_hz), update_rate_hz, 1);
    rumble->share = -expm1(-1.0 / (MEAN_S * update_rate_hz));
}

static void add_power(knurl_rumble *rumble, int band, double force) {
    const double power = knurl_load_double(&rumble->power[band]);
    knurl_store_double(&rumble->power[band], power + rumble->share * (force * force - power));
}

double knurl_rumble_update(knurl_rumble *rumble, const knurl_tick_output *tick) {
    const double length = vec3_length(tick->force);
    if (tick->flags & KNURL_TICK_CONTACT) {
        vec3_copy(tick->normal, rumble->axis);
    } else if (fabs(vec3_dot(tick->force, rumble->axis)) < 0.5 * length) {
        vec3_scale(1.0 / length, tick->force, rumble->axis);
    }
    const double force = vec3_dot(tick->force, rumble->axis);
    const double changing = pass(&rumble->steady, force);
    add_power(rumble, 0, pass(&rumble->low, changing));
    add_power(rumble, 1, pass(&rumble->high, changing));
    return force;
}
