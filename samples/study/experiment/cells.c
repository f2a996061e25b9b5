/* One experiment's cells: counts, Eq. 14, verdicts under three rules, intervals. SPDX-License-Identifier: MIT */
#include "experiment.h"

#include "inference.h"
#include "say.h"
#include "statistics.h"

#include <string.h>

#define SIGNIFICANCE 0.05 /* before Bonferroni's correction (IV-A3) */
#define CONFIDENCE   0.95

static const char *const rules[] = {"point", "one-sided", "two-sided"};

/* One cell's trials. */
typedef struct cell {
    uint32_t n, m; /* trials; those in which the second method was preferred */
    double force_limit_ticks;
    uint32_t subjects[2]; /* subjects who preferred a method in more than half of their trials */
} cell;

static int is_in(const exp_record *r, const exp_design *d, double period, double amplitude, int32_t sound) {
    return exp_is_of(r, d) && !r->excluded && r->trial.block > 0 && r->trial.period == period &&
           r->trial.amplitude == amplitude && r->sound == sound;
}

/* One subject's trials, from the first of them on: +1 or -1 for a majority of the second or the first method; 0 for no
 * majority, or if the subject was counted before. */
static int majority(const exp_records *records, size_t first, const exp_design *d) {
    const exp_record *of = &records->rows[first];
    int balance = 0;
    for (size_t i = 0; i < records->count; i++) {
        const exp_record *r = &records->rows[i];
        if (is_in(r, d, of->trial.period, of->trial.amplitude, of->sound) && strcmp(r->subject, of->subject) == 0) {
            if (i < first) {
                return 0;
            }
            balance += r->trial.methods[r->side] == d->methods[1] ? 1 : -1;
        }
    }
    return (balance > 0) - (balance < 0);
}

static cell count_cell(const exp_records *records, const exp_design *d, double period, double amplitude,
                       int32_t sound) {
    cell c = {0, 0, 0.0, {0, 0}};
    for (size_t i = 0; i < records->count; i++) {
        const exp_record *r = &records->rows[i];
        if (is_in(r, d, period, amplitude, sound)) {
            const int who = majority(records, i, d);
            c.n++;
            c.m += r->trial.methods[r->side] == d->methods[1];
            c.force_limit_ticks += r->force_limit_ticks;
            c.subjects[0] += who < 0;
            c.subjects[1] += who > 0;
        }
    }
    return c;
}

/* 1 the second method, 0 the first, -1 neither. */
static int verdict(const exp_design *d, uint32_t n, uint32_t m, int32_t rule) {
    const uint32_t enough = binomial_threshold(rule, n, SIGNIFICANCE / d->family);
    return m >= enough ? 1 : n - m >= enough ? 0 : -1;
}

static const char *verdict_name(const exp_design *d, int who) {
    return who < 0 ? "-" : d->names[who];
}

/* Prints the probability of at least this many answers for the method that was chosen more often. */
static void print_cell(const exp_design *d, double period, double amplitude, int32_t sound, const cell *c,
                       uint32_t won[3][2]) {
    const uint32_t more = c->m > c->n - c->m ? c->m : c->n - c->m;
    say(stdout, "%9g %9g %5s %6u %4u", period, amplitude, sound ? "yes" : "no", (unsigned)c->m, (unsigned)c->n);
    for (int32_t rule = 0; rule < 3; rule++) {
        printf(" %10.3g", binomial_probability(rule, c->n, more));
    }
    for (int32_t rule = 0; rule < 3; rule++) {
        const int who = verdict(d, c->n, c->m, rule);
        say(stdout, " %*s", d->experiment == EXP_COMPARE ? 11 : 10, verdict_name(d, who));
        if (who >= 0) {
            won[rule][who]++;
        }
    }
    printf(" %10.0f\n", c->force_limit_ticks);
}

/* The share of the second method, by trials and by subjects. */
static void print_share(const exp_design *d, double period, double amplitude, int32_t sound, const cell *c) {
    const uint32_t decided = c->subjects[0] + c->subjects[1];
    const uint32_t more = c->subjects[1] > c->subjects[0] ? c->subjects[1] : c->subjects[0];
    double by_trials[2];
    double by_subjects[2];
    binomial_interval(c->n, c->m, CONFIDENCE, by_trials);
    binomial_interval(decided, c->subjects[1], CONFIDENCE, by_subjects);
    say(stdout, "%9g %9g %5s  %6.3f (%.3f to %.3f)  %6u of %3u (%.3f to %.3f) %10.3g %12s\n", period, amplitude,
        sound ? "yes" : "no", (double)c->m / c->n, by_trials[0], by_trials[1], (unsigned)c->subjects[1],
        (unsigned)decided, by_subjects[0], by_subjects[1], binomial_probability(BINOMIAL_TWO_SIDED, decided, more),
        verdict_name(d, verdict(d, decided, c->subjects[1], BINOMIAL_TWO_SIDED)));
}

static void print_heading(const exp_design *d) {
    say(stdout, "%9s %9s %5s %6.6s %4s %32s %32s\n", "period", "amplitude", "sound", d->names[1], "of",
        "---- probability by chance -----", "--------- preferred by ---------");
    say(stdout, "%9s %9s %5s %6s %4s", d->period_unit, d->force_unit, "", "", "");
    for (int block = 0; block < 2; block++) {
        for (int32_t rule = 0; rule < 3; rule++) {
            say(stdout, " %*s", block && d->experiment == EXP_COMPARE ? 11 : 10, rules[rule]);
        }
    }
    say(stdout, " %10s\n", "limited");
}

/* Prints the counts that the rules require at n trials, or that no count is enough. */
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

/* Adds n to the list of trials per cell, unless it is there. */
static void note(uint32_t n, uint32_t *seen, uint32_t *count, uint32_t room) {
    uint32_t i = 0;
    while (i < *count && seen[i] != n) {
        i++;
    }
    if (i == *count && i < room) {
        seen[(*count)++] = n;
    }
}

/* Collects the cells that have trials, in order, with their indices; returns their number. */
static uint32_t collect(const exp_records *records, const exp_design *d, cell cells[4 * EXP_PERIODS],
                        uint32_t places[4 * EXP_PERIODS]) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < 4 * d->period_count; i++) {
        cells[count] = count_cell(records, d, d->periods[i % d->period_count], d->amplitudes[i / d->period_count / 2],
                                  i / d->period_count % 2 == 0);
        places[count] = i;
        count += cells[count].n > 0;
    }
    return count;
}

void exp_print_cells(const exp_records *records, const exp_design *d) {
    cell cells[4 * EXP_PERIODS];
    uint32_t places[4 * EXP_PERIODS];
    uint32_t won[3][2];
    uint32_t seen[8];
    uint32_t seen_count = 0;
    const uint32_t count = collect(records, d, cells, places);
    memset(won, 0, sizeof won);
    print_heading(d);
    for (uint32_t i = 0; i < count; i++) {
        print_cell(d, d->periods[places[i] % d->period_count], d->amplitudes[places[i] / d->period_count / 2],
                   places[i] / d->period_count % 2 == 0, &cells[i], won);
        note(cells[i].n, seen, &seen_count, sizeof seen / sizeof *seen);
    }
    for (uint32_t i = 0; i < seen_count; i++) {
        print_thresholds(d, seen[i]);
    }
    for (int32_t rule = 0; rule < 3; rule++) {
        say(stdout, "%s: %s preferred in %u of %u cells, %s in %u\n", rules[rule], d->names[1], (unsigned)won[rule][1],
            (unsigned)count, d->names[0], (unsigned)won[rule][0]);
    }
    say(stdout, "shares of %s with 95 %% intervals (Clopper-Pearson); verdict by subjects two-sided at 0.05/%u\n",
        d->names[1], (unsigned)d->family);
    say(stdout, "%9s %9s %5s  %-25s %-37s %9s %12s\n", "period", "amplitude", "sound", "of trials",
        "of subjects with a majority", "by chance", "preferred");
    for (uint32_t i = 0; i < count; i++) {
        print_share(d, d->periods[places[i] % d->period_count], d->amplitudes[places[i] / d->period_count / 2],
                    places[i] / d->period_count % 2 == 0, &cells[i]);
    }
}
