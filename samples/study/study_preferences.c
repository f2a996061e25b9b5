/* knurl study preferences: figure 8 and Experiment 3, compared with this code's metrics. SPDX-License-Identifier: MIT
 */
#include "preferences.h"

#include "say.h"
#include "statistics.h"
#include "study.h"
#include "wave_options.h"

#include <math.h>
#include <string.h>

/* A part of an experiment's cells: all of them, or those with or without sound. */
static const struct {
    const char *name;
    int first, step; /* cells alternate: without, with sound */
} parts[] = {{"all", 0, 1}, {"without_sound", 0, 2}, {"with_sound", 1, 2}};

static void write_csv(FILE *csv, int experiment, const preference_cell *cells) {
    for (int i = 0; i < PREFERENCE_CELLS; i++) {
        const preference_cell *c = &cells[i];
        const double row[] = {c->period_ticks, 1000.0 / c->period_ticks, c->amplitude, c->sound, c->preferred};
        fprintf(csv, "%d", experiment);
        for (size_t k = 0; k < sizeof row / sizeof *row; k++) {
            fputc(',', csv);
            out_number(csv, row[k]);
        }
        for (int k = 0; k < PREFERENCE_METRICS; k++) {
            fputc(',', csv);
            out_number(csv, c->metric[k]);
        }
        fputc('\n', csv);
    }
}

typedef struct ranks {
    double spearman, kendall, separation;
} ranks;

static ranks correlate(const preference_cell *cells, int metric, int first, int step) {
    double x[PREFERENCE_CELLS];
    double y[PREFERENCE_CELLS];
    size_t count = 0;
    for (int i = first; i < PREFERENCE_CELLS; i += step) {
        x[count] = cells[i].metric[metric];
        y[count++] = cells[i].preferred;
    }
    const ranks r = {rank_spearman(x, y, count), rank_kendall(x, y, count), rank_separation(x, y, count)};
    return r;
}

/* The correlations of one part. */
static void write_part(json_writer *json, const preference_cell *cells, int part) {
    json_open(json, parts[part].name, '{');
    say(stdout, "    %-14s", parts[part].name);
    for (int k = 0; k < PREFERENCE_METRICS; k++) {
        const ranks r = correlate(cells, k, parts[part].first, parts[part].step);
        json_open(json, preference_metric_names[k], '{');
        json_number(json, "spearman", r.spearman);
        json_number(json, "kendall_tau_b", r.kendall);
        json_number(json, "separation", r.separation);
        json_close(json, '}');
        if (isfinite(r.spearman)) {
            printf("  %+6.3f (%.3f)", r.spearman, r.separation);
        } else {
            say(stdout, "  %-15s", "      none");
        }
    }
    putchar('\n');
    json_close(json, '}');
}

static void write_experiment(json_writer *json, int experiment, const preference_cell *cells) {
    const size_t stride = sizeof *cells / sizeof(double);
    int preferred = 0;
    for (int i = 0; i < PREFERENCE_CELLS; i++) {
        preferred += cells[i].preferred > 0.5;
    }
    printf("  Experiment %d, T%d against T3: T3 preferred in %d of %d cells\n", experiment, experiment, preferred,
           PREFERENCE_CELLS);
    json_open(json, NULL, '{');
    json_number(json, "experiment", experiment);
    json_string(json, "other", wave_method_name(KNURL_WAVE_T1 + experiment - 1));
    json_number(json, "preferred_cells", preferred);
    json_open(json, "cells", '{');
    json_numbers(json, "period_ticks", &cells[0].period_ticks, PREFERENCE_CELLS, stride);
    json_numbers(json, "amplitude", &cells[0].amplitude, PREFERENCE_CELLS, stride);
    json_numbers(json, "sound", &cells[0].sound, PREFERENCE_CELLS, stride);
    json_numbers(json, "preferred", &cells[0].preferred, PREFERENCE_CELLS, stride);
    for (int k = 0; k < PREFERENCE_METRICS; k++) {
        json_numbers(json, preference_metric_names[k], &cells[0].metric[k], PREFERENCE_CELLS, stride);
    }
    json_close(json, '}');
    json_open(json, "correlation_with_preferred", '{');
    for (int part = 0; part < 3; part++) {
        write_part(json, cells, part);
    }
    json_close(json, '}');
    json_close(json, '}');
}

static void write_gratings(json_writer *json, const preference_grating *g) {
    const size_t stride = sizeof *g / sizeof(double);
    double advantage[3];
    double counts[3];
    json_open(json, "experiment_3", '{');
    json_string(
        json, "scans",
        "steady speeds of 5 to 250 mm/s, equally often (an assumption: subjects scanned freely), ideal positions");
    json_numbers(json, "period_mm", &g->period_mm, 3, stride);
    json_numbers(json, "preferred_s2_of_12", &g->preferred_s2, 3, stride);
    for (int m = 0; m < 2; m++) {
        json_open(json, knurl_method_name(KNURL_METHOD_S1 + m), '{');
        json_numbers(json, "push", &g->push[m], 3, stride);
        json_numbers(json, "spurious_share", &g->spurious[m], 3, stride);
        json_numbers(json, "dropout_share", &g->dropout[m], 3, stride);
        json_numbers(json, "drift", &g->drift[m], 3, stride);
        json_close(json, '}');
    }
    printf("  Experiment 3, S1 against S2 (preferred by 12, 11, 7 of 12 at 0.5, 1, 2 mm), S1 - S2:\n");
    json_open(json, "spearman_with_preferred", '{');
    for (int k = 0; k < 3; k++) {
        static const char *const names[] = {"push", "spurious_share", "dropout_share"};
        for (int i = 0; i < 3; i++) {
            const double *pair = k == 0 ? g[i].push : k == 1 ? g[i].spurious : g[i].dropout;
            advantage[i] = pair[0] - pair[1];
            counts[i] = g[i].preferred_s2;
        }
        const double rho = rank_spearman(advantage, counts, 3);
        json_number(json, names[k], rho);
        say(stdout, "    %-14s  %+.4f %+.4f %+.4f, Spearman %+.1f (of three cells)\n", names[k], advantage[0],
            advantage[1], advantage[2], rho);
    }
    json_close(json, '}');
    json_close(json, '}');
}

static int write_all(FILE *csv, json_writer *json, void *user) {
    (void)user;
    preference_cell cells[PREFERENCE_CELLS];
    preference_grating gratings[3];
    fputs("experiment,period_ticks,frequency,amplitude,sound,preferred", csv);
    printf("preferences: how much worse the other method's metric is, against whether T3 was preferred\n"
           "  Spearman's rho (chance that a preferred cell is the worse one for the other method)\n");
    say(stdout, "    %-14s", "");
    for (int k = 0; k < PREFERENCE_METRICS; k++) {
        fprintf(csv, ",%s", preference_metric_names[k]);
        say(stdout, "  %-15s", preference_metric_names[k]);
    }
    fputc('\n', csv);
    putchar('\n');
    json_string(json, "study", "preferences");
    json_string(
        json, "unknown",
        "The paper prints verdicts (28 of 36 or more), not counts: preferred is 1 or 0. The metrics do not know of"
        " sound, so cells with and without it have the same values. Metrics are of the medium vibration alone.");
    json_open(json, "experiments", '[');
    for (int experiment = 1; experiment <= 2; experiment++) {
        if (!preference_cells(experiment, cells)) {
            return 1;
        }
        write_csv(csv, experiment, cells);
        write_experiment(json, experiment, cells);
    }
    json_close(json, ']');
    if (!preference_gratings(gratings)) {
        return 1;
    }
    write_gratings(json, gratings);
    return 0;
}

int study_preferences(const char *folder) {
    return study_write(folder, "preferences", write_all, NULL);
}
