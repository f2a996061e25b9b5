/* Study `tradeoff`: cost against accuracy of each method at each rate with each velocity estimator, on ridges of 1 and
 * 0.5 mm. x: ns per tick (measured in this run, minus the empty tick's) times ticks per second; y: accuracy.h.
 * SPDX-License-Identifier: MIT */
#include "accuracy.h"
#include "contender.h"
#include "cost.h"
#include "machine.h"
#include "steady.h"
#include "study.h"

#include <math.h>
#include <stddef.h>

#define SHAPE_HZ    290.0
#define SHAPE_TICKS 20

static const double ridges[] = {1e-3, 0.5e-3};

/* The table's columns of an accuracy. */
static const struct {
    const char *name;
    size_t offset;
} columns[] = {{"mean", offsetof(accuracy, mean)},
               {"mean_worst", offsetof(accuracy, mean_worst)},
               {"push_worst", offsetof(accuracy, push_worst)},
               {"frequency", offsetof(accuracy, frequency)},
               {"frequency_worst", offsetof(accuracy, frequency_worst)},
               {"false", offsetof(accuracy, false_tones)},
               {"false_worst", offsetof(accuracy, false_worst)},
               {"false_above", offsetof(accuracy, false_above)},
               {"felt", offsetof(accuracy, felt)},
               {"felt_worst", offsetof(accuracy, felt_worst)},
               {"felt_above", offsetof(accuracy, felt_above)},
               {"felt_stylus_worst", offsetof(accuracy, stylus_worst)},
               {"wavering", offsetof(accuracy, wavering)},
               {"wavering_worst", offsetof(accuracy, wavering_worst)},
               {"wavering_above", offsetof(accuracy, wavering_above)},
               {"wavering_50_worst", offsetof(accuracy, wavering_50_worst)},
               {"level", offsetof(accuracy, level)},
               {"felt_range_db", offsetof(accuracy, felt_range)},
               {"crest", offsetof(accuracy, crest)},
               {"drift", offsetof(accuracy, drift)},
               {"strokes", offsetof(accuracy, strokes)},
               {"step", offsetof(accuracy, step)}};

#define COLUMNS (sizeof columns / sizeof *columns)

static void print_text(FILE *f, const study_contender *c) {
    static const char *const velocities[] = {"ideal", "difference", "lowpass", "foaw"};
    fprintf(f, "%s,%g,%s,%s", c->method->name, c->update_rate_hz,
            c->method->uses_velocity ? velocities[c->velocity] : "none",
            !c->method->spatial   ? "none"
            : c->resolution > 0.0 ? "0.055mm"
                                  : "ideal");
}

static void print_cells(FILE *f, const double *cells, size_t count) {
    for (size_t i = 0; i < count; i++) {
        fputc(',', f);
        out_number(f, cells[i]);
    }
}

static void print_row(FILE *f, const study_contender *c, const study_cost *cost, double instructions,
                      const accuracy *a) {
    const double cells[] = {c->ridge * 1e3, cost->ns_median, cost->ns_p99, cost->ns_median * c->update_rate_hz,
                            instructions};
    print_text(f, c);
    print_cells(f, cells, sizeof cells / sizeof *cells);
    for (size_t i = 0; i < COLUMNS; i++) {
        const double value = *(const double *)((const char *)a + columns[i].offset);
        print_cells(f, &value, 1);
    }
    fputc('\n', f);
}

static void print_header(FILE *f) {
    fputs("method,rate_hz,velocity,positions,ridge_mm,ns_tick,ns_tick_p99,ns_second,instructions_tick", f);
    for (size_t i = 0; i < COLUMNS; i++) {
        fprintf(f, ",%s", columns[i].name);
    }
    fputc('\n', f);
}

static int print_rows(FILE *f) {
    study_contender c;
    size_t count = 0;
    while (study_contender_at(count, &c)) {
        count++;
    }
    print_header(f);
    for (size_t i = 0; study_contender_at(i, &c); i++) {
        accuracy found;
        study_cost cost;
        char name[96];
        const size_t lines = c.method->spatial ? sizeof ridges / sizeof *ridges : 1;
        const double instructions = study_count_instructions(i);
        study_contender_name(&c, name, sizeof name);
        int done = study_measure_cost(&c, &cost);
        for (size_t line = 0; done && line < lines; line++) {
            c.ridge = ridges[line];
            done = accuracy_measure(&c, &found);
            if (done) {
                print_row(f, &c, &cost, instructions, &found);
            }
        }
        if (!done) {
            return tool_error(1, "study: tradeoff: %s could not be measured", name);
        }
        study_progress("tradeoff", (double)(i + 1) / (double)count);
    }
    return 0;
}

/* A method's signal at 1 kHz from 0.055 mm positions, at a frequency whose cycle is not a whole number of ticks. */
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

static void print_yardstick(json_writer *json) {
    json_number(json, "frequencies", ACCURACY_FREQUENCIES);
    json_number(json, "from_hz", ACCURACY_FROM);
    json_number(json, "split_hz", ACCURACY_SPLIT);
    json_number(json, "to_hz", ACCURACY_TO);
    json_number(json, "tolerance", STEADY_TOLERANCE);
    json_number(json, "tolerance_hz", STEADY_TOLERANCE_HZ);
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
    print_yardstick(&json);
    json_string(&json, "table", "tradeoff.csv");
    json_close(&json, '}');
    return out_keep(&file);
}

/* The single panel: the same table, with the shape of each method's signal. */
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
    print_yardstick(&json);
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
