/* Analysis of all sessions' answers, and the number of subjects needed. SPDX-License-Identifier: MIT */
#include "experiment.h"

#include "inference.h"
#include "say.h"

#include <stdlib.h>
#include <string.h>

static void print_experiment(const exp_records *records, const exp_design *d) {
    size_t trials = 0;
    size_t subjects = 0;
    size_t first = 0; /* answers for the first stimulus */
    for (size_t i = 0; i < records->count; i++) {
        const exp_record *r = &records->rows[i];
        size_t before = 0;
        if (!exp_is_of(r, d) || r->excluded || r->trial.block == 0) {
            continue;
        }
        while (before < i &&
               (!exp_is_of(&records->rows[before], d) || records->rows[before].trial.block == 0 ||
                records->rows[before].excluded || strcmp(records->rows[before].subject, r->subject) != 0)) {
            before++;
        }
        subjects += before == i;
        first += r->side == 0;
        trials++;
    }
    if (trials > 0) {
        say(stdout, "\n");
        say(stdout, "Experiment %d, %s against %s: %lu trials, subjects: %lu; the first was chosen %lu times\n",
            (int)d->experiment, d->names[0], d->names[1], (unsigned long)trials, (unsigned long)subjects,
            (unsigned long)first);
        exp_print_cells(records, d);
    }
}

/* Every pair of methods that a row of experiment 4 compares, printed at its first row. */
static void print_comparisons(const exp_records *records) {
    for (size_t i = 0; i < records->count; i++) {
        exp_design design;
        size_t before = 0;
        const exp_record *r = &records->rows[i];
        if (r->experiment == EXP_COMPARE && exp_compare(r->trial.methods[0], r->trial.methods[1], &design) == TOOL_OK) {
            while (!exp_is_of(&records->rows[before], &design)) {
                before++;
            }
            if (before == i) {
                print_experiment(records, &design);
            }
        }
    }
}

int exp_analyse(int count, char *const *paths) {
    exp_records records = {NULL, 0, 0};
    int code = TOOL_OK;
    for (int i = 0; i < count && code == TOOL_OK; i++) {
        code = exp_read_records(paths[i], &records);
    }
    if (code == TOOL_OK) {
        const int simulated = records.count > 0 && records.rows[0].simulated;
        if (simulated) {
            say(stdout, "%s\n", EXP_SIMULATION);
        }
        exp_exclude(&records);
        for (int32_t experiment = 1; experiment <= 3; experiment++) {
            print_experiment(&records, exp_design_of(experiment));
        }
        print_comparisons(&records);
        if (simulated) {
            say(stdout, "\n");
            say(stdout, "%s\n", EXP_SIMULATION);
        }
    }
    free(records.rows);
    return code;
}

int exp_print_power(const exp_power *o) {
    static const double shares[] = {0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9};
    const double significance = 0.05 / o->comparisons;
    say(stdout,
        "subjects needed for a power of %g at 0.05/%g two-sided, %g trials a subject and cell, whose answers correlate "
        "by %g\n",
        o->power, o->comparisons, o->repetitions, o->correlation);
    say(stdout, "%8s %22s %9s\n", "share of", "subjects who prefer it", "subjects");
    say(stdout, "%8s %22s %9s\n", "answers", "/ the other / neither", "needed");
    for (size_t i = 0; i < sizeof shares / sizeof *shares; i++) {
        const preference_model model = {shares[i], o->correlation, (uint32_t)o->repetitions};
        double outcome[3];
        preference_majority(&model, outcome);
        const uint32_t n = preference_subjects(&model, significance, o->power);
        say(stdout, "%8g %8.2f /%5.2f /%5.2f ", shares[i], outcome[1], outcome[0], outcome[2]);
        if (n) {
            say(stdout, "%9u\n", (unsigned)n);
        } else {
            say(stdout, "%9s\n", "over 200");
        }
    }
    return TOOL_OK;
}
