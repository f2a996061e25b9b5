/* Study `tracking`: where bandlimited takes a position from that comes in counts. Moved on by FOAW's velocity and kept
 * within half a count of what the encoder says, as it is built, against a second-order observer within the same bound.
 * SPDX-License-Identifier: MIT */
#include "say.h"
#include "steady.h"
#include "study.h"

#include <knurl/knurl.h>

#include <math.h>
#include <stdlib.h>

#define PI          3.141592653589793
#define RATE        1000.0
#define COUNT       0.055e-3 /* m: the Touch's */
#define TICKS       4300
#define LEAD        700
#define OBSERVER_HZ 12.0
#define DAMPING     0.8
#define TREMOR_HZ   10.0
#define TREMORS     40
#define TREMOR_S    2.0

enum { VELOCITY, OBSERVER, TRACKERS };

static const char *const names[TRACKERS] = {"velocity", "observer"};
static const double steady[] = {25.3,  31.7,  40.9,  60.7,  80.3,  110.9, 140.3, 180.7, 220.9, 270.3, 300.7,
                                333.3, 350.1, 380.7, 400.3, 420.3, 440.1, 450.9, 462.3, 470.3, 480.9};
static const double ridges[] = {1e-3, 0.5e-3};
static const double tremors[] = {0.01e-3, 0.02e-3};
#define OF(array) (sizeof(array) / sizeof *(array))

typedef struct tracker {
    int kind;
    double place, speed; /* of the observer */
    knurl_velocity estimator;
    knurl_grating grating;
    knurl_grating_state state;
} tracker;

static int start(tracker *t, int kind, double ridge) {
    const tracker fresh = {.kind = kind, .place = NAN};
    *t = fresh;
    t->grating.spatial_frequency[0] = 1.0 / ridge;
    t->grating.amplitude = 1.0;
    t->grating.update_rate_hz = RATE;
    t->grating.method = KNURL_METHOD_BANDLIMITED;
    t->grating.resolution = kind == OBSERVER ? 0.0 : COUNT; /* what it gets from the observer is taken as it is */
    return !knurl_grating_check(&t->grating) &&
           !knurl_velocity_prepare(KNURL_VELOCITY_FOAW, COUNT, RATE, &t->estimator);
}

static void observe(tracker *t, double measured) {
    const double w = 2.0 * PI * OBSERVER_HZ / RATE;
    t->place = isnan(t->place) ? measured : t->place + t->speed / RATE;
    const double error = measured - t->place;
    t->place += 2.0 * DAMPING * w * error;
    t->speed += w * w * error * RATE;
    t->place = fmin(fmax(t->place, measured - 0.5 * COUNT), measured + 0.5 * COUNT);
}

static double tick(tracker *t, double x, knurl_grating_output *out) {
    double position[3] = {floor(x / COUNT + 0.5) * COUNT, 0.0, 0.0};
    double velocity[3] = {0.0, 0.0, 0.0};
    if (t->kind == OBSERVER) {
        observe(t, position[0]);
        position[0] = t->place;
        velocity[0] = t->speed;
    } else {
        knurl_velocity_update(&t->estimator, position, velocity);
    }
    knurl_grating_step(&t->grating, &t->state, position, velocity, out);
    return out->height;
}

/* The worst shares over the speeds: false tones of all, felt ones to 440 Hz. */
static int measure_steady(int kind, double ridge, double worst[2]) {
    static double heights[TICKS];
    worst[0] = 0.0;
    worst[1] = 0.0;
    for (size_t i = 0; i < OF(steady); i++) {
        tracker t;
        steady_metrics found;
        knurl_grating_output out;
        if (!start(&t, kind, ridge)) {
            return 0;
        }
        for (int k = 0; k < TICKS; k++) {
            heights[k] = tick(&t, ridge * (steady[i] * k / RATE + 0.123), &out);
        }
        if (!steady_measure(heights + LEAD, TICKS - LEAD, RATE, steady[i], &found)) {
            return 0;
        }
        worst[0] = fmax(worst[0], found.false_tones);
        worst[1] = steady[i] < 440.0 ? fmax(worst[1], found.felt_false) : worst[1];
    }
    return 1;
}

/* Half cycles played of a tremor at places that are spread over a ridge of 0.2 mm, and those that it crosses. */
static int measure_tremor(int kind, double amplitude, double *played, double *crossed) {
    const double ridge = 0.2e-3;
    *played = 0.0;
    *crossed = 0.0;
    for (int i = 0; i < TREMORS; i++) {
        tracker t;
        double last = 0.0;
        if (!start(&t, kind, ridge)) {
            return 0;
        }
        for (int k = 0; k < (int)(TREMOR_S * RATE); k++) {
            knurl_grating_output out;
            const double x = ridge * (i + 0.5) / TREMORS + amplitude * sin(2.0 * PI * TREMOR_HZ * k / RATE);
            const double high = cos(2.0 * PI * x / ridge) >= 0.0 ? 1.0 : -1.0;
            (void)tick(&t, x, &out);
            *played += out.turned;
            *crossed += high * last < 0.0;
            last = high;
        }
    }
    return 1;
}

static int write_rows(FILE *csv, json_writer *json, void *user) {
    (void)user;
    json_string(json, "table", "tracking.csv");
    json_number(json, "tolerance", STEADY_TOLERANCE);
    fputs("tracker,false_1mm,felt_1mm,false_0.5mm,felt_0.5mm,tremor_10um,crossed_10um,tremor_20um,crossed_20um\n", csv);
    for (int kind = 0; kind < TRACKERS; kind++) {
        double cells[8];
        for (size_t i = 0; i < OF(ridges); i++) {
            if (!measure_steady(kind, ridges[i], cells + 2 * i) ||
                !measure_tremor(kind, tremors[i], cells + 4 + 2 * i, cells + 5 + 2 * i)) {
                return 1;
            }
        }
        fputs(names[kind], csv);
        study_end_row(csv, cells, OF(cells));
        say(stdout,
            "%s: false tones %.3f (1 mm), %.3f (0.5 mm); felt to 440 Hz %.3f, %.3f; half cycles of a tremor of 0.01 mm "
            "%.0f (crossed %.0f), of 0.02 mm %.0f (%.0f)\n",
            names[kind], cells[0], cells[2], cells[1], cells[3], cells[4], cells[5], cells[6], cells[7]);
    }
    return 0;
}

int study_tracking(const char *folder) {
    return study_write(folder, "tracking", write_rows, NULL);
}
