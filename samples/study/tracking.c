/* Study `tracking`: methods to interpolate a position in counts, always within half a count of the measured one: by
 * FOAW's velocity, by its mean over some time (the library uses 20 ms, knurl_velocity_track()), or by a second-order
 * observer. SPDX-License-Identifier: MIT */
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

/* mean: s, of the velocity; its largest error after a new count is a count in `ticks` */
typedef struct way {
    const char *name;
    enum { VELOCITY, MEAN, BUILT, OBSERVER } how;
    double mean, ticks;
} way;

static const way ways[] = {{"velocity", VELOCITY, 0.0, 0.0},
                           {"mean of 10 ms", MEAN, 0.01, 10.0},
                           {"mean of 20 ms: built", BUILT, KNURL_TRACK_S, 10.0},
                           {"the same but off by a count in 15 ms at most", MEAN, KNURL_TRACK_S, 15.0},
                           {"mean of 30 ms", MEAN, 0.03, 10.0},
                           {"mean of 100 ms", MEAN, 0.1, 10.0},
                           {"observer", OBSERVER, 0.0, 0.0}};
/* Hz; those of the paper's range, and about one count per tick on both gratings */
static const double steady[] = {25.3,  31.7,  40.9,  52.6,  54.3,  55.2,  56.1,  60.7,  80.3,
                                108.4, 110.7, 110.9, 140.3, 180.7, 220.9, 270.3, 300.7, 333.3,
                                350.1, 380.7, 400.3, 420.3, 437.3, 439.7, 450.9, 462.3};
static const double ridges[] = {1e-3, 0.5e-3};
static const double tremors[] = {0.02e-3, 0.05e-3};
#define OF(array) (sizeof(array) / sizeof *(array))

typedef struct tracker {
    const way *kind;
    double place, speed;
    knurl_velocity estimator;
    knurl_grating grating;
    knurl_grating_state state;
} tracker;

static int start(tracker *t, const way *kind, double ridge) {
    const tracker fresh = {.kind = kind, .place = NAN};
    *t = fresh;
    t->grating.spatial_frequency[0] = 1.0 / ridge;
    t->grating.amplitude = 1.0;
    t->grating.update_rate_hz = RATE;
    t->grating.method = KNURL_METHOD_BANDLIMITED;
    return !knurl_grating_check(&t->grating) &&
           !knurl_velocity_prepare(KNURL_VELOCITY_FOAW, COUNT, RATE, &t->estimator);
}

/* Advances the position. velocity: FOAW's. */
static void follow(tracker *t, double measured, double velocity) {
    const double w = 2.0 * PI * OBSERVER_HZ / RATE;
    const double off = t->kind->how == MEAN ? COUNT * RATE / t->kind->ticks : 0.0;
    if (t->kind->how != OBSERVER) {
        t->speed += t->kind->how == MEAN ? (velocity - t->speed) / (t->kind->mean * RATE) : 0.0;
        t->speed = fmin(fmax(t->speed, velocity - off), velocity + off);
    }
    t->place = isnan(t->place) ? measured : t->place + t->speed / RATE;
    if (t->kind->how == OBSERVER) {
        const double error = measured - t->place;
        t->place += 2.0 * DAMPING * w * error;
        t->speed += w * w * error * RATE;
    }
    t->place = fmin(fmax(t->place, measured - 0.5 * COUNT), measured + 0.5 * COUNT);
}

/* Returns the tracked position for x. */
static double tick(tracker *t, double x, knurl_grating_output *out) {
    double position[3] = {floor(x / COUNT + 0.5) * COUNT, 0.0, 0.0};
    double velocity[3] = {0.0, 0.0, 0.0};
    knurl_velocity_update(&t->estimator, position, velocity);
    if (t->kind->how == BUILT) {
        knurl_velocity_track(&t->estimator, position, velocity, position);
    } else {
        follow(t, position[0], velocity[0]);
        position[0] = t->place;
        velocity[0] = t->kind->how == OBSERVER ? t->speed : velocity[0];
    }
    knurl_grating_step(&t->grating, &t->state, position, velocity, out);
    return position[0];
}

/* The worst shares over the speeds: false tones, and felt ones up to 440 Hz. */
static int measure_steady(const way *kind, double ridge, double worst[2]) {
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
            (void)tick(&t, ridge * (steady[i] * k / RATE + 0.123), &out);
            heights[k] = out.height;
        }
        if (!steady_measure(heights + LEAD, TICKS - LEAD, RATE, steady[i], &found)) {
            return 0;
        }
        worst[0] = fmax(worst[0], found.false_tones);
        worst[1] = steady[i] < 440.0 ? fmax(worst[1], found.felt_false) : worst[1];
    }
    return 1;
}

/* Half cycles played and crossed by a tremor at positions spread over a ridge of 0.2 mm. */
static int measure_tremor(const way *kind, double amplitude, double *played, double *crossed) {
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

/* A hand's speed wavers: 60 mm/s, by 10 % at 0.7 Hz and by 2 % at 3 Hz. The error of the position, less its mean over
 * 51 ms: rms in counts. */
static int measure_wavering(const way *kind, double *strays) {
    enum { WINDOW = 51 };
    static double off[TICKS];
    tracker t;
    knurl_grating_output out;
    double squares = 0.0;
    double sum = 0.0;
    if (!start(&t, kind, 1e-3)) {
        return 0;
    }
    for (int k = 0; k < TICKS; k++) {
        const double s = k / RATE;
        const double x = 0.06 * (s + 0.02 / (6.0 * PI) * sin(6.0 * PI * s) + 0.1 / (1.4 * PI) * sin(1.4 * PI * s));
        off[k] = (tick(&t, x, &out) - x) / COUNT;
        sum += off[k] - (k >= WINDOW ? off[k - WINDOW] : 0.0);
        if (k >= LEAD) {
            squares += pow(off[k - WINDOW / 2] - sum / WINDOW, 2.0) / (TICKS - LEAD);
        }
    }
    *strays = sqrt(squares);
    return 1;
}

static int write_rows(FILE *csv, json_writer *json, void *user) {
    (void)user;
    json_string(json, "table", "tracking.csv");
    json_number(json, "tolerance", STEADY_TOLERANCE);
    fputs(
        "tracker,false_1mm,felt_1mm,false_0.5mm,felt_0.5mm,tremor_20um,crossed_20um,tremor_50um,crossed_50um,strays\n",
        csv);
    for (const way *k = ways; k < ways + OF(ways); k++) {
        double cells[9];
        for (size_t i = 0; i < OF(ridges); i++) {
            if (!measure_steady(k, ridges[i], cells + 2 * i) ||
                !measure_tremor(k, tremors[i], cells + 4 + 2 * i, cells + 5 + 2 * i) ||
                !measure_wavering(k, &cells[8])) {
                return 1;
            }
        }
        fputs(k->name, csv);
        study_end_row(csv, cells, OF(cells));
        say(stdout,
            "%s: false tones %.3f (1 mm), %.3f (0.5 mm); felt to 440 Hz %.3f, %.3f; half cycles of a tremor of 0.02 mm "
            "%.0f (crossed %.0f), of 0.05 mm %.0f (%.0f); strays by %.3f counts\n",
            k->name, cells[0], cells[2], cells[1], cells[3], cells[4], cells[5], cells[6], cells[7], cells[8]);
    }
    return 0;
}

int study_tracking(const char *folder) {
    return study_write(folder, "tracking", write_rows, NULL);
}
