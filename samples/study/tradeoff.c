/* Study `tradeoff`: cost against accuracy of each method at each rate with each velocity estimator. x: ns per tick
 * (measured in this run, minus the empty tick's) times ticks per second; y: accuracy at constant speeds.
 * SPDX-License-Identifier: MIT */
#include "contender.h"
#include "cost.h"
#include "machine.h"
#include "steady.h"
#include "study.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Temporal frequencies: whole ones from 20 to 480 Hz, below f_h/2 at 1 kHz, and those of the paper's experiments: odd
 * periods from 3 to 23 ms, and 2.5 ms, where the methods differ most. */
#define PI          3.141592653589793
#define WHOLE       28
#define EXPERIMENT  12
#define FREQUENCIES (WHOLE + EXPERIMENT)
#define SHAPE_HZ    290.0
#define SHAPE_TICKS 20

/* Means over the frequencies. */
typedef struct accuracy {
    double net;             /* |mean height| / A */
    double net_worst;       /* the largest of them */
    double frequency_error; /* |dominant - asked| / asked */
    double beyond_jnd;      /* share of frequencies whose error is above the haptic Weber fraction, 0.38 */
    double spurious;        /* share of power outside the dominant line and its odd harmonics */
    double drift;           /* |played / crossed cycles - 1|; NaN for temporal methods */
    double dropout;         /* share of crossed cycles never played; NaN for temporal methods */
    double strokes;         /* drift in strokes, not a mean over frequencies; NaN for temporal methods */
    /* of spatial methods; see steady.h */
    double push, push_worst;
    double frequency_worst;
    double level;      /* |level / (4/pi) - 1| of the ticks */
    double level_held; /* the same of what is held from tick to tick */
    double unevenness, unevenness_worst;
    double folded, folded_worst; /* spurious power below f_h/2: what a method does, not the hold */
} accuracy;

static double frequency_at(size_t i) {
    if (i < WHOLE) {
        return floor(20.0 * pow(24.0, (double)i / (WHOLE - 1)) + 0.5);
    }
    return i == WHOLE ? 400.0 : 1000.0 / (2.0 * (double)(i - WHOLE) + 1.0);
}

/* Ticks of a scan of about a second that holds a whole number of cycles. */
static size_t scan_length(const study_contender *c, double frequency) {
    const size_t whole = study_whole_ticks(c->update_rate_hz / frequency);
    return (size_t)c->update_rate_hz / whole * whole;
}

/* The part of a rendering that is a whole number of events: what a partial event would add to the mean is not the
 * method's. S1 and the temporal methods: whole cycles or actual periods. */
static int render(const study_contender *c, double frequency, study_signal *signal, double *played) {
    study_rendering r;
    const size_t length = scan_length(c, frequency);
    const size_t lead = (size_t)(0.064 * c->update_rate_hz); /* the estimators' windows fill */
    if (study_rendering_start(&r, c, frequency)) {
        return 0;
    }
    if (!c->method->spatial) {
        return study_signal_of_wave(&r.wave, c->update_rate_hz, signal);
    }
    double *heights = malloc(length * sizeof *heights);
    size_t end = length;
    for (size_t i = 0; i < lead || (r.state.playing && i < lead + length); i++) {
        (void)study_rendering_tick(&r);
    }
    r.cycles_played = 0.0;
    for (size_t i = 0; heights && i < length; i++) {
        heights[i] = study_rendering_tick(&r);
        if (c->method->id != KNURL_METHOD_S1 && !r.state.playing) {
            end = i + 1;
        }
    }
    *played = r.cycles_played;
    const int made = heights && study_signal_of_values(heights, end, c->update_rate_hz, signal);
    free(heights);
    return made;
}

/* sin(pi x)/(pi x): what a hold over a tick leaves of a line of x cycles a tick. */
static double sinc(double x) {
    return sin(PI * x) / (PI * x);
}

static int add_steady(const study_contender *c, double frequency, const study_signal *signal, accuracy *sum) {
    steady_metrics m = {NAN, NAN, NAN, NAN};
    if (c->method->spatial && !steady_measure(signal->values, signal->length, c->update_rate_hz, frequency, &m)) {
        return 0;
    }
    const double ideal = 4.0 / PI;
    sum->push += m.push;
    sum->push_worst = fmax(sum->push_worst, m.push);
    sum->level += fabs(m.level / ideal - 1.0);
    sum->level_held += fabs(m.level / ideal * sinc(frequency / c->update_rate_hz) - 1.0);
    sum->unevenness += m.unevenness;
    sum->unevenness_worst = fmax(sum->unevenness_worst, m.unevenness);
    sum->folded += m.spurious;
    sum->folded_worst = fmax(sum->folded_worst, m.spurious);
    return 1;
}

static int measure_one(const study_contender *c, double frequency, accuracy *sum) {
    study_signal signal;
    study_line line;
    double played = 0.0;
    if (!render(c, frequency, &signal, &played)) {
        return 0;
    }
    const int found = study_dominant(&signal, &line) && add_steady(c, frequency, &signal, sum);
    if (found) {
        const double error = fabs(line.frequency - frequency) / frequency;
        const double crossed = frequency * (double)scan_length(c, frequency) / c->update_rate_hz;
        const double ratio = c->method->spatial ? played / crossed : NAN;
        const double spurious = study_spurious(&signal, line.frequency);
        sum->net += fabs(study_net(&signal));
        sum->net_worst = fmax(sum->net_worst, fabs(study_net(&signal)));
        sum->frequency_error += error;
        sum->frequency_worst = fmax(sum->frequency_worst, error);
        sum->beyond_jnd += error > 0.38;
        sum->spurious += isnan(spurious) ? 1.0 : spurious; /* what does not vary is no vibration at all */
        sum->drift += fabs(ratio - 1.0);
        sum->dropout += c->method->spatial ? fmax(0.0, 1.0 - ratio) : NAN;
    }
    study_signal_free(&signal);
    return found;
}

/* |played / crossed cycles - 1| over 4 s of strokes, v = vmax |sin(pi t)| up to 250 Hz. Half a cycle of 637 is 0.08 %.
 */
static double measure_strokes(const study_contender *c) {
    const double seconds = 4.0;
    const double fastest = 250.0;
    study_rendering r;
    if (!c->method->spatial || study_rendering_start(&r, c, fastest)) {
        return NAN;
    }
    const size_t ticks = (size_t)(seconds * c->update_rate_hz);
    for (size_t k = 0; k < ticks; k++) {
        const double t = (double)k / c->update_rate_hz;
        const double into = t - floor(t);
        const double x = r.speed / PI * (2.0 * floor(t) + 1.0 - cos(PI * into));
        (void)study_rendering_tick_at(&r, x, r.speed * sin(PI * into));
    }
    return fabs(r.cycles_played / (fastest / PI * 2.0 * seconds) - 1.0);
}

static int measure(const study_contender *c, accuracy *mean) {
    double *const parts[] = {&mean->net,        &mean->frequency_error, &mean->beyond_jnd, &mean->spurious,
                             &mean->drift,      &mean->dropout,         &mean->push,       &mean->level,
                             &mean->level_held, &mean->unevenness,      &mean->folded};
    memset(mean, 0, sizeof *mean);
    for (size_t i = 0; i < FREQUENCIES; i++) {
        if (!measure_one(c, frequency_at(i), mean)) {
            return 0;
        }
    }
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        *parts[i] /= FREQUENCIES;
    }
    mean->strokes = measure_strokes(c);
    return 1;
}

static void print_text(FILE *f, const study_contender *c) {
    static const char *const velocities[] = {"ideal", "difference", "lowpass", "foaw"};
    fprintf(f, "%s,%g,%s,%s", c->method->name, c->update_rate_hz,
            c->method->uses_velocity ? velocities[c->velocity] : "none",
            !c->method->spatial   ? "none"
            : c->resolution > 0.0 ? "0.055mm"
                                  : "ideal");
}

static void print_row(FILE *f, const study_contender *c, const study_cost *cost, double instructions,
                      const accuracy *a) {
    const double cells[] = {cost->ns_median,
                            cost->ns_p99,
                            cost->ns_median * c->update_rate_hz,
                            instructions,
                            a->net,
                            a->net_worst,
                            a->frequency_error,
                            a->beyond_jnd,
                            a->spurious,
                            a->drift,
                            a->dropout,
                            a->strokes,
                            a->push,
                            a->push_worst,
                            a->frequency_worst,
                            a->level,
                            a->level_held,
                            a->unevenness,
                            a->unevenness_worst,
                            a->folded,
                            a->folded_worst};
    print_text(f, c);
    for (size_t i = 0; i < sizeof cells / sizeof *cells; i++) {
        fputc(',', f);
        out_number(f, cells[i]);
    }
    fputc('\n', f);
}

static int print_rows(FILE *f) {
    study_contender c;
    size_t count = 0;
    while (study_contender_at(count, &c)) {
        count++;
    }
    fputs(
        "method,rate_hz,velocity,positions,ns_tick,ns_tick_p99,ns_second,instructions_tick,net,net_worst,frequency_error,beyond_jnd,"
        "spurious,drift,dropout,strokes,push,push_worst,frequency_worst,level,level_held,unevenness,unevenness_worst,folded,"
        "folded_worst\n",
        f);
    for (size_t i = 0; study_contender_at(i, &c); i++) {
        accuracy mean;
        study_cost cost;
        char name[96];
        study_contender_name(&c, name, sizeof name);
        if (!measure(&c, &mean) || !study_measure_cost(&c, &cost)) {
            return tool_error(1, "study: tradeoff: %s could not be measured", name);
        }
        print_row(f, &c, &cost, study_count_instructions(i), &mean);
        study_progress("tradeoff", (double)(i + 1) / (double)count);
    }
    return 0;
}

/* What a method plays at 1 kHz from 0.055 mm positions, at a frequency that no whole ticks are a cycle of. */
static void print_shapes(json_writer *json) {
    study_contender c;
    json_open(json, "shapes", '{');
    json_number(json, "hz", SHAPE_HZ);
    for (size_t i = 0; study_contender_at(i, &c); i++) {
        double heights[SHAPE_TICKS];
        study_rendering r;
        const int foaw = !c.method->uses_velocity || c.velocity == STUDY_FOAW;
        if (!c.method->spatial || c.update_rate_hz != 1000.0 || c.resolution == 0.0 || !foaw ||
            study_rendering_start(&r, &c, SHAPE_HZ)) {
            continue;
        }
        for (int k = -100; k < SHAPE_TICKS; k++) {
            heights[k > 0 ? k : 0] = study_rendering_tick(&r);
        }
        json_numbers(json, c.method->name, heights, SHAPE_TICKS, 1);
    }
    json_close(json, '}');
}

static int print_about(const char *folder) {
    out_file file;
    json_writer json;
    char machine[128];
    if (study_open(&file, folder, "tradeoff.json")) {
        return 1;
    }
    machine_name(machine, sizeof machine);
    json_start(&json, file.stream, 1);
    json_open(&json, NULL, '{');
    json_string(&json, "study", "tradeoff");
    json_string(&json, "machine", machine);
    json_number(&json, "empty_tick_ns", study_empty_tick_ns());
    json_number(&json, "frequencies", FREQUENCIES);
    json_number(&json, "from_hz", frequency_at(0));
    json_number(&json, "to_hz", frequency_at(WHOLE - 1));
    json_number(&json, "period_m", 0.001);
    json_string(&json, "table", "tradeoff.csv");
    json_close(&json, '}');
    return out_keep(&file);
}

/* The one panel: the same table, with how each method looks. */
static int print_panel(const char *folder) {
    out_file file;
    json_writer json;
    if (study_open(&file, folder, "speed_accuracy.json")) {
        return 1;
    }
    json_start(&json, file.stream, 1);
    json_open(&json, NULL, '{');
    json_string(&json, "study", "speed_accuracy");
    json_string(&json, "table", "tradeoff.csv");
    print_shapes(&json);
    json_close(&json, '}');
    return out_keep(&file);
}

int study_tradeoff(const char *folder) {
    out_file file;
    if (study_open(&file, folder, "tradeoff.csv")) {
        return 1;
    }
    if (print_rows(file.stream)) {
        out_discard(&file);
        return 1;
    }
    return out_keep(&file) || print_about(folder) || print_panel(folder);
}
