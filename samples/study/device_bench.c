/* The test bench of the study `device`. SPDX-License-Identifier: MIT */
#include "device_bench.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The fake device's hand is 1e4 N/m at most. Dividing mass, damping and stiffness by a number multiplies the motion by
 * it and changes no force, not even dry friction: so a stiff fixture is simulated as a light mass in that hand.
 */
#define HAND_STIFFNESS 1e4 /* N/m */
#define REST           500 /* ticks: 0.25 s for the hand to come down, and as long to come to rest */
#define AFTER          300 /* ticks */
#define BIAS           100 /* ticks, the last ones of each pause */
#define SETTLED        400 /* ticks at least: the slowest resonance has died away by e^-18 */
#define MEASURED       500 /* ticks at least */

typedef struct bench {
    knurl_device *device;
    double stiffness; /* as simulated */
    double damping;
    double last; /* m: the previous sample */
} bench;

bench_fixture bench_make_fixture(double stiffness, double viscous) {
    const bench_fixture fixture = {stiffness, 2.0 * BENCH_DAMPING_RATIO * sqrt(stiffness * BENCH_MASS), viscous};
    return fixture;
}

double bench_resonance(const bench_fixture *fixture) {
    return sqrt(fixture->stiffness / BENCH_MASS) / 6.283185307179586;
}

static int open_bench(const bench_fixture *fixture, bench *b) {
    char uri[256];
    knurl_stroke_desc stroke;
    const double scale = fixture->stiffness / HAND_STIFFNESS;
    memset(b, 0, sizeof *b);
    b->stiffness = HAND_STIFFNESS;
    b->damping = fixture->damping / scale;
    (void)snprintf(uri, sizeof uri,
                   "fake:?mass=%.15g&viscous=%.15g&coulomb=%.15g&hand_stiffness=%.15g&hand_damping=%.15g&resolution=0"
                   "&tremor=0&delay=0",
                   BENCH_MASS / scale, fixture->viscous / scale, BENCH_COULOMB, b->stiffness, b->damping);
    knurl_stroke_desc_init(&stroke, sizeof stroke);
    stroke.stroke = KNURL_STROKE_REST;
    stroke.depth = 0.0;
    if (knurl_device_open(uri, &b->device) || knurl_fake_set_stroke(b->device, &stroke) ||
        knurl_device_start(b->device, BENCH_SAMPLING_RATE)) {
        knurl_device_close(b->device);
        return 0;
    }
    return 1;
}

/* One tick of a command; stores the sensor's samples in `samples` unless it is null. Returns their mean. */
static double play_tick(bench *b, double newtons, double *samples) {
    const double force[3] = {0.0, newtons, 0.0}; /* vertical, as in the appendix */
    double sum = 0.0;
    for (int i = 0; i < BENCH_OVERSAMPLING; i++) {
        knurl_device_sample at;
        (void)knurl_device_write(b->device, force); /* the fake device is never unplugged */
        (void)knurl_device_read(b->device, &at);
        const double velocity = (at.position[1] - b->last) * BENCH_SAMPLING_RATE;
        const double reading = b->stiffness * 0.5 * (at.position[1] + b->last) + b->damping * velocity;
        b->last = at.position[1];
        sum += reading;
        if (samples) {
            samples[i] = reading;
        }
    }
    return sum / BENCH_OVERSAMPLING;
}

/* Plays a pause. Returns the mean of its last ticks. */
static double play_rest(bench *b, int ticks) {
    double sum = 0.0;
    for (int k = 0; k < ticks; k++) {
        const double mean = play_tick(b, 0.0, NULL);
        sum += k >= ticks - BIAS ? mean : 0.0;
    }
    return sum / BIAS;
}

/* The fewest whole periods that last `ticks`. */
static size_t whole(size_t period, size_t ticks) {
    return (ticks + period - 1) / period * period;
}

int bench_measure(const bench_fixture *fixture, const study_signal *command, study_signal *measured,
                  bench_reading *reading) {
    bench b;
    const size_t period = command->length;
    const size_t settle = whole(period, SETTLED);
    const size_t measure = whole(period, MEASURED);
    double *samples = malloc(measure * BENCH_OVERSAMPLING * sizeof *samples);
    if (!samples || !open_bench(fixture, &b)) {
        free(samples);
        return 0;
    }
    reading->before = play_rest(&b, REST);
    for (size_t k = 0; k < settle + measure; k++) {
        (void)play_tick(&b, command->values[k % period],
                        k >= settle ? samples + (k - settle) * BENCH_OVERSAMPLING : NULL);
    }
    reading->after = play_rest(&b, AFTER);
    knurl_device_close(b.device);
    const int done = study_signal_of_values(samples, measure * BENCH_OVERSAMPLING, BENCH_SAMPLING_RATE, measured);
    free(samples);
    return done;
}
