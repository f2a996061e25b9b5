/* Runs of the velocity estimators against the true velocity. SPDX-License-Identifier: MIT */
#include "velocity.h"

#include <math.h>
#include <string.h>

#define TAU     6.283185307179586
#define GOLDEN  2.399963229728653 /* radians: spreads angles evenly */
#define LEAD_S  0.25              /* for windows to fill and the low pass to settle */
#define LEAST_S 4.0               /* of a run */
#define CYCLES  20.0              /* of the grating in a run, at least */

const velocity_contender velocity_contenders[] = {{"difference", KNURL_VELOCITY_DIFFERENCE, 0.0},
                                                  {"low pass, 10 Hz", VELOCITY_LOW_PASS, 10.0},
                                                  {"low pass, 20 Hz", VELOCITY_LOW_PASS, 20.0},
                                                  {"low pass, 40 Hz", VELOCITY_LOW_PASS, 40.0},
                                                  {"FOAW as published", KNURL_VELOCITY_AUTO, 0.0},
                                                  {"FOAW", KNURL_VELOCITY_FOAW, 0.0},
                                                  {NULL, 0, 0.0}};

/* A hand on a line: its position and speed. */
typedef struct hand {
    double speed, rate, resolution;
    double start; /* m */
    double angle; /* start phase of the wobble or stroke */
} hand;

static hand hand_at(double speed, double rate, double resolution, int phase) {
    const double apart = (phase + 0.5) / VELOCITY_PHASES - 0.5;
    const hand h = {speed * (1.0 + 2.0 * VELOCITY_SPREAD * apart), rate, resolution,
                    (resolution + VELOCITY_PERIOD) * phase / VELOCITY_PHASES, GOLDEN * phase};
    return h;
}

static double in_counts(const hand *h, double x) {
    return floor(x / h->resolution + 0.5) * h->resolution;
}

/* A steady speed with a wobble. */
static double steady(const hand *h, double tick, double *speed) {
    const double t = tick / h->rate;
    const double omega = TAU * VELOCITY_WOBBLE_HZ;
    *speed = h->speed * (1.0 + VELOCITY_WOBBLE * sin(omega * t + h->angle));
    return h->start + h->speed * (t - VELOCITY_WOBBLE / omega * cos(omega * t + h->angle));
}

/* A stroke to and fro. */
static double stroke(const hand *h, double tick, double *speed) {
    const double omega = TAU * VELOCITY_STROKE_HZ;
    *speed = h->speed * cos(omega * tick / h->rate + h->angle);
    return h->start + h->speed / omega * sin(omega * tick / h->rate + h->angle);
}

int velocity_start(velocity_estimator *e, const velocity_contender *contender, double resolution, double rate) {
    memset(e, 0, sizeof *e);
    e->contender = contender;
    e->resolution = resolution;
    e->rate = rate;
    return contender->method != VELOCITY_LOW_PASS &&
           knurl_velocity_prepare(contender->method, resolution, rate, &e->estimator);
}

/* Janabi-Sharifi, Hayward and Chen 2000, the widest window that fits; slopes over i ticks times 360360 are integers. */
static double as_published(velocity_estimator *e, int64_t counts) {
    int64_t low = INT64_MIN;
    int64_t high = INT64_MAX;
    int64_t best = 0;
    memmove(e->counts + 1, e->counts, 15 * sizeof *e->counts);
    e->counts[0] = counts;
    for (int i = 1; i <= e->seen; i++) {
        const int64_t slack = 360360 / i;
        const int64_t slope = (counts - e->counts[i]) * slack;
        best = slope >= low && slope <= high ? slope : best;
        low = slope - slack > low ? slope - slack : low;
        high = slope + slack < high ? slope + slack : high;
    }
    e->seen += e->seen < 15;
    return (double)best / 360360.0 * e->resolution * e->rate;
}

double velocity_of(velocity_estimator *e, double x) {
    const double position[3] = {x, 0.0, 0.0};
    double velocity[3];
    if (e->contender->method == KNURL_VELOCITY_AUTO) {
        return as_published(e, (int64_t)floor(x / e->resolution + 0.5));
    }
    if (e->contender->method == VELOCITY_LOW_PASS) {
        return study_low_pass_tick(&e->low_pass, e->contender->cutoff_hz, e->rate, x);
    }
    knurl_velocity_update(&e->estimator, position, velocity);
    return velocity[0];
}

/* S2 on a grating of 1 mm, driven by the estimate. */
typedef struct player {
    knurl_grating grating;
    knurl_grating_state state;
    int64_t event;
    double played; /* cycles */
} player;

/* Plays one tick, and judges the period at an event's start. */
static void play(player *p, double speed, double truth, velocity_errors *sum) {
    const double velocity[2] = {speed, 0.0};
    const double nowhere[2] = {0.0, 0.0};
    knurl_grating_output output;
    knurl_grating_step(&p->grating, &p->state, nowhere, velocity, &output);
    if (output.event == KNURL_NO_EVENT) {
        return;
    }
    /* the six-tick mix is 2.4 of 2.5 ticks */
    p->played += (p->state.event.kind == KNURL_EVENT_MIXED ? 2.4 : 1.0) / p->state.event.length;
    if (output.event != p->event) {
        const double error = fabs(truth / fabs(speed) - 1.0);
        p->event = output.event;
        sum->events += 1.0;
        sum->period_mean += error;
        sum->period_worst = fmax(sum->period_worst, error);
    }
}

/* One run at a steady speed; adds to the sums. Returns the ticks. */
static double run_steady(velocity_estimator *e, const hand *h, velocity_errors *sum, double *played, double *crossed) {
    const int lead = (int)(LEAD_S * h->rate);
    const int end = lead + (int)(fmax(LEAST_S, CYCLES * VELOCITY_PERIOD / h->speed) * h->rate);
    player p;
    double truth = 0.0;
    double from = 0.0;
    double x = 0.0;
    memset(&p, 0, sizeof p);
    p.event = KNURL_NO_EVENT;
    p.grating.spatial_frequency[0] = 1.0 / VELOCITY_PERIOD;
    p.grating.amplitude = 1.0;
    p.grating.update_rate_hz = h->rate;
    p.grating.method = KNURL_METHOD_S2;
    p.grating.resolution = h->resolution;
    for (int i = 0; i < end; i++) {
        x = steady(h, i, &truth);
        const double estimate = velocity_of(e, in_counts(h, x));
        if (i < lead) {
            from = x;
            continue;
        }
        sum->bias += estimate - truth;
        sum->rms += (estimate - truth) * (estimate - truth);
        play(&p, estimate, truth, sum);
    }
    *played += p.played;
    *crossed += (x - from) / VELOCITY_PERIOD;
    return end - lead;
}

/* One run of strokes: the estimate's components in phase with the truth and a quarter cycle behind it. */
static void run_strokes(velocity_estimator *e, const hand *h, double parts[2]) {
    const int lead = (int)(h->rate / VELOCITY_STROKE_HZ);
    const int end = lead + (int)(2.0 * h->rate / VELOCITY_STROKE_HZ); /* whole strokes */
    for (int i = 0; i < end; i++) {
        double truth;
        const double x = stroke(h, i, &truth);
        const double estimate = velocity_of(e, in_counts(h, x));
        if (i >= lead) {
            parts[0] += estimate * truth;
            parts[1] += estimate * h->speed * sin(TAU * VELOCITY_STROKE_HZ * i / h->rate + h->angle);
        }
    }
}

int velocity_measure(const velocity_contender *contender, double resolution, double rate, double speed,
                     velocity_errors *out) {
    velocity_errors sum = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    velocity_estimator e;
    double parts[2] = {0.0, 0.0};
    double ticks = 0.0;
    double played = 0.0;
    double crossed = 0.0;
    for (int phase = 0; phase < VELOCITY_PHASES; phase++) {
        const hand h = hand_at(speed, rate, resolution, phase);
        if (velocity_start(&e, contender, resolution, rate)) {
            return 1;
        }
        ticks += run_steady(&e, &h, &sum, &played, &crossed);
        (void)velocity_start(&e, contender, resolution, rate);
        run_strokes(&e, &h, parts);
    }
    out->bias = sum.bias / ticks;
    out->rms = sqrt(sum.rms / ticks);
    out->delay = atan2(parts[1], parts[0]) / (TAU * VELOCITY_STROKE_HZ);
    out->period_mean = sum.events > 0.0 ? sum.period_mean / sum.events : (double)NAN;
    out->period_worst = sum.events > 0.0 ? sum.period_worst : (double)NAN;
    out->drift = played / crossed - 1.0;
    out->events = sum.events;
    return 0;
}
