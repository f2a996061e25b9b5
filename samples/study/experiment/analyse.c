/* Analysis of the answers: counts, Eq. 14, and verdicts under three rules. SPDX-License-Identifier: MIT */
#include "experiment.h"

#include "say.h"
#include "statistics.h"

#include <stdlib.h>
#include <string.h>

#define SIGNIFICANCE 0.05 /* before Bonferroni's correction (IV-A3) */

static const char *const rules[] = {"point", "one-sided", "two-sided"};

/* One cell's trials. */
typedef struct cell {
    uint32_t n, m; /* trials; those in which our method was preferred */
    double force_limit_ticks;
} cell;

static cell count_cell(const exp_records *records, const exp_design *d, double period, double amplitude,
                       int32_t sound) {
    cell c = {0, 0, 0.0};
    for (size_t i = 0; i < records->count; i++) {
        const exp_record *r = &records->rows[i];
        if (r->experiment == d->experiment && r->trial.period == period && r->trial.amplitude == amplitude &&
            r->sound == sound) {
            c.n++;
            c.m += r->preferred == d->methods[1];
            c.force_limit_ticks += r->force_limit_ticks;
        }
    }
    return c;
}

/* 1 ours, 0 the rival's, -1 neither. */
static int verdict(const exp_design *d, const cell *c, int32_t rule) {
    const uint32_t enough = binomial_threshold(rule, c->n, SIGNIFICANCE / d->family);
    return c->m >= enough ? 1 : c->n - c->m >= enough ? 0 : -1;
}

/* The probability of so many or more for whichever was chosen more often. */
static void print_cell(const exp_design *d, double period, double amplitude, int32_t sound, const cell *c,
                       uint32_t won[3][2]) {
    const uint32_t more = c->m > c->n - c->m ? c->m : c->n - c->m;
    say(stdout, "%9g %9g %5s %6u %4u", period, amplitude, sound ? "yes" : "no", (unsigned)c->m, (unsigned)c->n);
    for (int32_t rule = 0; rule < 3; rule++) {
        printf(" %10.3g", binomial_probability(rule, c->n, more));
    }
    for (int32_t rule = 0; rule < 3; rule++) {
        const int who = verdict(d, c, rule);
        say(stdout, " %10s", who < 0 ? "-" : d->names[who]);
        if (who >= 0) {
            won[rule][who]++;
        }
    }
    printf(" %10.0f\n", c->force_limit_ticks);
}

static void print_heading(const exp_design *d) {
    say(stdout, "%9s %9s %5s %6s %4s %32s %32s\n", "period", "amplitude", "sound", d->names[1], "of",
        "---- probability by chance -----", "--------- preferred by ---------");
    say(stdout, "%9s %9s %5s %6s %4s", d->period_unit, d->force_unit, "", "", "");
    for (int block = 0; block < 2; block++) {
        for (int32_t rule = 0; rule < 3; rule++) {
            say(stdout, " %10s", rules[rule]);
        }
    }
    say(stdout, " %10s\n", "limited");
}

/* The counts that the rules ask for at n trials, or that none is enough. */
static void print_thresholds(const exp_design *d, uint32_t n) {
    printf("needed of %u trials at 0.05/%u:", (unsigned)n, (unsigned)d->family);
    for (int32_t rule = 0; rule < 3; rule++) {
        const uint32_t m = binomial_threshold(rule, n, SIGNIFICANCE / d->family);
        if (m > n) {
            say(stdout, "%s %s none is enough", rule ? "," : "", rules[rule]);
        } else {
            say(stdout, "%s %s %u", rule ? "," : "", rules[rule], (unsigned)m);
        }
    }
    putchar('\n');
}

/* Adds n to the numbers of trials a cell that were seen, once. */
static void note(uint32_t n, uint32_t *seen, uint32_t *count, uint32_t room) {
    uint32_t i = 0;
    while (i < *count && seen[i] != n) {
        i++;
    }
    if (i == *count && i < room) {
        seen[(*count)++] = n;
    }
}

static void print_cells(const exp_records *records, const exp_design *d) {
    uint32_t won[3][2];
    uint32_t seen[8];
    uint32_t seen_count = 0;
    uint32_t cells = 0;
    memset(won, 0, sizeof won);
    print_heading(d);
    for (uint32_t i = 0; i < 4 * d->period_count; i++) {
        const double period = d->periods[i % d->period_count];
        const double amplitude = d->amplitudes[i / d->period_count / 2];
        const int32_t sound = i / d->period_count % 2 == 0;
        const cell c = count_cell(records, d, period, amplitude, sound);
        if (c.n > 0) {
            print_cell(d, period, amplitude, sound, &c, won);
            note(c.n, seen, &seen_count, sizeof seen / sizeof *seen);
            cells++;
        }
    }
    for (uint32_t i = 0; i < seen_count; i++) {
        print_thresholds(d, seen[i]);
    }
    for (int32_t rule = 0; rule < 3; rule++) {
        say(stdout, "%s: %s preferred in %u of %u cells, %s in %u\n", rules[rule], d->names[1], (unsigned)won[rule][1],
            (unsigned)cells, d->names[0], (unsigned)won[rule][0]);
    }
}

static void print_experiment(const exp_records *records, const exp_design *d) {
    size_t trials = 0;
    size_t subjects = 0;
    size_t first = 0; /* answers that chose what came first */
    for (size_t i = 0; i < records->count; i++) {
        const exp_record *r = &records->rows[i];
        size_t before = 0;
        if (r->experiment != d->experiment) {
            continue;
        }
        while (before < i && (records->rows[before].experiment != d->experiment ||
                              strcmp(records->rows[before].subject, r->subject) != 0)) {
            before++;
        }
        subjects += before == i;
        first += r->preferred == r->trial.methods[0];
        trials++;
    }
    if (trials > 0) {
        say(stdout, "\n");
        say(stdout, "Experiment %d, %s against %s: %lu trials, subjects: %lu; the first was chosen %lu times\n",
            (int)d->experiment, d->names[0], d->names[1], (unsigned long)trials, (unsigned long)subjects,
            (unsigned long)first);
        print_cells(records, d);
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
        for (int32_t experiment = 1; experiment <= 3; experiment++) {
            print_experiment(&records, exp_design_of(experiment));
        }
        if (simulated) {
            say(stdout, "\n");
            say(stdout, "%s\n", EXP_SIMULATION);
        }
    }
    free(records.rows);
    return code;
}
