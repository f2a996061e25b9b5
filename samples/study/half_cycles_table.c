/* The half cycles of every surface, period and speed: the study, and its table. SPDX-License-Identifier: MIT */
#include "half_cycles.h"
#include "say.h"
#include "study.h"

#include <string.h>

#define SPEEDS  4
#define PERIODS 3

static const double periods[PERIODS] = {0.001, 0.002, 0.004};
static const double speeds[SPEEDS] = {0.049, 0.099, 0.247, 0.447}; /* the speeds at which CHAI3D was measured */

static const struct {
    const char *name;
    int surface;
    uint32_t triangles;
} surfaces[] = {{"plane", HALF_CYCLES_PLANE, 0},          {"sheet 1k", HALF_CYCLES_FACETS, 1000},
                {"sheet 10k", HALF_CYCLES_FACETS, 10000}, {"sheet 100k", HALF_CYCLES_FACETS, 100000},
                {"curve 1k", HALF_CYCLES_CURVE, 1000},    {"curve 10k", HALF_CYCLES_CURVE, 10000},
                {"curve 100k", HALF_CYCLES_CURVE, 100000}};

#define SURFACES (sizeof surfaces / sizeof *surfaces)

typedef struct table {
    half_cycles cells[SURFACES][PERIODS][SPEEDS];
} table;

static int measure(table *t) {
    const size_t surface_count = SURFACES;
    const double count = (double)surface_count;
    for (size_t i = 0; i < SURFACES; i++) {
        wavy_sheet sheet;
        memset(&sheet, 0, sizeof sheet);
        if (surfaces[i].triangles > 0 && wavy_sheet_make(surfaces[i].triangles, &sheet)) {
            return tool_error(1, "study: half_cycles: no memory");
        }
        int failed = 0;
        for (size_t cell = 0; cell < PERIODS * SPEEDS && !failed; cell++) {
            const size_t p = cell / SPEEDS;
            const size_t v = cell % SPEEDS;
            study_progress("half_cycles", ((double)i + (double)cell / (PERIODS * SPEEDS)) / count);
            failed = half_cycles_measure(surfaces[i].surface, sheet.indices ? &sheet : NULL, periods[p], speeds[v],
                                         &t->cells[i][p][v]);
        }
        wavy_sheet_free(&sheet);
        if (failed) {
            return tool_error(1, "study: half_cycles: %s", knurl_error_message());
        }
    }
    study_progress("half_cycles", 1.0);
    return 0;
}

static void write_row(FILE *csv, size_t i, size_t p, size_t v, const half_cycles *h) {
    const double cells[] = {(double)surfaces[i].triangles,
                            1e3 * periods[p],
                            1e3 * speeds[v],
                            h->events,
                            h->ticks_min,
                            h->ticks_max,
                            h->lost,
                            h->cv,
                            h->raw_cv,
                            h->worst_half,
                            h->played_per_crossed};
    fputs(surfaces[i].name, csv);
    study_end_row(csv, cells, sizeof cells / sizeof *cells);
}

static int write_table(FILE *csv, json_writer *json, void *user) {
    const table *t = user;
    fputs("surface,triangles,period_mm,speed_mm_s,events,ticks_min,ticks_max,lost,cv,raw_cv,worst_half,"
          "played_per_crossed\n",
          csv);
    for (size_t i = 0; i < SURFACES * PERIODS * SPEEDS; i++) {
        const size_t p = i / SPEEDS % PERIODS;
        write_row(csv, i / (PERIODS * SPEEDS), p, i % SPEEDS, &t->cells[i / (PERIODS * SPEEDS)][p][i % SPEEDS]);
    }
    json_string(json, "table", "half_cycles.csv");
    json_number(json, "update_rate_hz", HALF_CYCLES_RATE);
    json_number(json, "stiffness", HALF_CYCLES_STIFFNESS);
    json_number(json, "amplitude", HALF_CYCLES_AMPLITUDE);
    json_number(json, "depth", HALF_CYCLES_DEPTH);
    json_number(json, "start_phases", HALF_CYCLES_PHASES);
    json_number(json, "stroke_m", HALF_CYCLES_STROKE);
    return 0;
}

static void print_table(const table *t) {
    printf("lost (CV; CV of the impulses as they are; worst half), events per crossed cycle\n\n| grating |");
    for (size_t v = 0; v < SPEEDS; v++) {
        printf(" %g mm/s |", 1e3 * speeds[v]);
    }
    printf("\n|---|---|---|---|---|\n");
    for (size_t i = 0; i < SURFACES; i++) {
        for (size_t p = 0; p < PERIODS; p++) {
            say(stdout, "| %s, %g mm |", surfaces[i].name, 1e3 * periods[p]);
            for (size_t v = 0; v < SPEEDS; v++) {
                const half_cycles *h = &t->cells[i][p][v];
                printf(" %.0f %% (%.3f; %.3f; %.1f %%), %.3f |", 100.0 * h->lost, h->cv, h->raw_cv,
                       100.0 * h->worst_half, h->played_per_crossed);
            }
            printf("\n");
        }
    }
}

int study_half_cycles(const char *folder) {
    static table t;
    if (measure(&t) || study_write(folder, "half_cycles", write_table, &t)) {
        return 1;
    }
    print_table(&t);
    return 0;
}
