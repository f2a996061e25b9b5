/* Study `velocity`: errors of each velocity estimator at each speed, resolution and rate, and its cost, to choose the
 * default. SPDX-License-Identifier: MIT */
#include "velocity.h"

#include "cost.h"
#include "machine.h"
#include "study.h"

#include <math.h>
#include <string.h>

#define SPEEDS      9
#define RATES       4
#define RESOLUTIONS 2
#define MOST        8 /* contenders */
#define PLACES      4096
#define ROUNDS      9 /* of timing: the fastest counts, because others use the machine */

static const double speeds[SPEEDS] = {0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5};
static const double rates[RATES] = {1000.0, 2000.0, 5000.0, 10000.0};
static const double resolutions[RESOLUTIONS] = {0.055e-3, 0.01e-3}; /* the Touch's; a finer encoder */

typedef struct table {
    velocity_errors cells[MOST][RESOLUTIONS][RATES][SPEEDS];
    double cost[MOST][RATES]; /* ns per tick */
} table;

/* The timed work: three axes in counts, each at its own speed. */
typedef struct timed {
    knurl_velocity estimator;
    uint32_t tick;
    double places[PLACES][3];
} timed;

static double timed_tick(void *subject) {
    timed *t = subject;
    double velocity[3];
    knurl_velocity_update(&t->estimator, t->places[t->tick++ % PLACES], velocity);
    return velocity[0];
}

static double empty_tick(void *subject) {
    timed *t = subject;
    return t->places[t->tick++ % PLACES][0];
}

double velocity_cost(const velocity_contender *contender, double resolution, double rate) {
    static timed t;
    velocity_estimator e;
    study_cost empty;
    study_cost cost;
    if (contender->method == KNURL_VELOCITY_AUTO || contender->method == VELOCITY_LOW_PASS ||
        velocity_start(&e, contender, resolution, rate)) {
        return -1.0;
    }
    t.estimator = e.estimator;
    for (int i = 0; i < PLACES; i++) {
        const double turn = 6.283185307179586 * i / PLACES; /* seven, three and forty strokes in all */
        const double x[3] = {0.03 * sin(7.0 * turn), 0.02 * cos(3.0 * turn), 0.001 * sin(40.0 * turn)};
        for (int axis = 0; axis < 3; axis++) {
            t.places[i][axis] = floor(x[axis] / resolution + 0.5) * resolution;
        }
    }
    study_time_ticks(empty_tick, &t, &empty);
    study_time_ticks(timed_tick, &t, &cost);
    return cost.ns_median - empty.ns_median;
}

/* Times all estimators in turn, repeatedly, so that a slow second of the machine does not affect only one. */
static void measure_costs(table *t, int count) {
    for (int i = 0; i < ROUNDS * count * RATES; i++) {
        const int c = i / RATES % count;
        const int r = i % RATES;
        const double cost = velocity_cost(&velocity_contenders[c], resolutions[0], rates[r]);
        t->cost[c][r] = i < count * RATES ? cost : fmin(t->cost[c][r], cost);
    }
}

static int measure(table *t) {
    int count = 0;
    while (velocity_contenders[count].name) {
        count++;
    }
    for (int c = 0; c < count; c++) {
        for (size_t cell = 0; cell < RESOLUTIONS * RATES * SPEEDS; cell++) {
            const size_t q = cell / (RATES * SPEEDS);
            const size_t r = cell / SPEEDS % RATES;
            const size_t v = cell % SPEEDS;
            study_progress("velocity", ((double)c + (double)cell / (RESOLUTIONS * RATES * SPEEDS)) / count);
            if (velocity_measure(&velocity_contenders[c], resolutions[q], rates[r], speeds[v], &t->cells[c][q][r][v])) {
                return tool_error(1, "study: velocity: %s", knurl_error_message());
            }
        }
    }
    measure_costs(t, count);
    study_progress("velocity", 1.0);
    return 0;
}

static void write_row(FILE *csv, int c, size_t q, size_t r, size_t v, const velocity_errors *e) {
    const double cells[] = {1e3 * resolutions[q], rates[r],       1e3 * speeds[v], 1e3 * e->bias, 1e3 * e->rms,
                            1e3 * e->delay,       e->period_mean, e->period_worst, e->drift,      e->events};
    fprintf(csv, "\"%s\"", velocity_contenders[c].name);
    study_end_row(csv, cells, sizeof cells / sizeof *cells);
}

static int write_table(FILE *csv, json_writer *json, void *user) {
    const table *t = user;
    char machine[128];
    machine_name(machine, sizeof machine);
    fputs(
        "estimator,resolution_mm,rate_hz,speed_mm_s,bias_mm_s,rms_mm_s,delay_ms,period_mean,period_worst,drift,events\n",
        csv);
    json_string(json, "study", "velocity");
    json_string(json, "table", "velocity.csv");
    json_string(json, "machine", machine);
    json_number(json, "period_m", VELOCITY_PERIOD);
    json_number(json, "runs", VELOCITY_PHASES);
    json_number(json, "wobble", VELOCITY_WOBBLE);
    json_number(json, "wobble_hz", VELOCITY_WOBBLE_HZ);
    json_number(json, "stroke_hz", VELOCITY_STROKE_HZ);
    json_numbers(json, "rates_hz", rates, RATES, 1);
    json_open(json, "cost_ns", '{');
    for (int c = 0; velocity_contenders[c].name; c++) {
        for (size_t i = 0; i < RESOLUTIONS * RATES * SPEEDS; i++) {
            const size_t q = i / (RATES * SPEEDS);
            const size_t r = i / SPEEDS % RATES;
            write_row(csv, c, q, r, i % SPEEDS, &t->cells[c][q][r][i % SPEEDS]);
        }
        if (t->cost[c][0] >= 0.0) {
            json_numbers(json, velocity_contenders[c].name, t->cost[c], RATES, 1);
        }
    }
    json_close(json, '}');
    return 0;
}

int study_velocity(const char *folder) {
    static table t;
    memset(&t, 0, sizeof t);
    return measure(&t) || study_write(folder, "velocity", write_table, &t);
}
