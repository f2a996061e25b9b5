/* The method LOCKED beside S1 and S2: the study, and its table. SPDX-License-Identifier: MIT */
#include "locked.h"
#include "study.h"

#include <math.h>
#include <string.h>

#define TOUCH      0.055e-3 /* m: the quantum of the paper's device */
#define FINE       0.01e-3
#define SPEEDS     231 /* 20 to 480 Hz */
#define CROSSOVERS 14  /* 40 to 300 Hz */
#define RATES      4
#define STARTS     48

static const int32_t methods[] = {KNURL_METHOD_S1, KNURL_METHOD_S2, KNURL_METHOD_LOCKED};
static const double quanta[] = {0.0, TOUCH, FINE};
static const double periods[] = {0.0005, 0.001, 0.002};
static const double rates[RATES] = {1000.0, 2000.0, 5000.0, 10000.0};

typedef struct stroke_cell {
    double error, longest; /* cycles, s */
} stroke_cell;

/* At one crossover: the worst of strokes, by quantum (0.5 mm), and the price just below it. */
typedef struct crossover_cell {
    double crossover;
    double error[3];
    double push, net, spurious;
} crossover_cell;

typedef struct table {
    locked_found speeds[3][SPEEDS];
    stroke_cell strokes[3][3][3][2]; /* method, quantum, period, turns */
    crossover_cell crossovers[RATES][CROSSOVERS];
} table;

static double frequency_of(size_t i) {
    return 20.0 + 2.0 * (double)i;
}

static locked_scan scan_of(int32_t method, double rate) {
    const locked_scan scan = {method, rate, 0.001, 0.0, 0.0, 0.0, 0.0, 0.0, 0};
    return scan;
}

static int measure_speeds(table *t) {
    for (size_t i = 0; i < 3 * SPEEDS; i++) {
        const locked_scan scan = scan_of(methods[i / SPEEDS], 1000.0);
        if (!locked_scan_worst(&scan, frequency_of(i % SPEEDS), 3, 1, &t->speeds[i / SPEEDS][i % SPEEDS])) {
            return 0;
        }
        study_progress("locked", 0.3 * (double)i / (3.0 * SPEEDS));
    }
    return 1;
}

/* The worst of strokes with three repetition rates up to each of four frequencies, 0.48 f_h at most and 480 Hz. */
static int measure_stroke(const locked_scan *what, int starts, stroke_cell *cell) {
    static const double tops[] = {100.0, 250.0, 400.0, 480.0};
    for (size_t i = 0; i < 12; i++) {
        locked_scan scan = *what;
        locked_found found;
        scan.per_second = i < 4 ? 0.5 : i < 8 ? 1.0 : 2.0;
        scan.start = 0.013;
        if (!locked_scan_worst(&scan, tops[i % 4], starts, 0, &found)) {
            return 0;
        }
        cell->error = fmax(cell->error, found.step.error);
        cell->longest = fmax(cell->longest, found.step.longest / scan.rate);
    }
    return 1;
}

static int measure_strokes(table *t) {
    for (size_t i = 0; i < 54; i++) {
        const size_t method = i / 18;
        locked_scan scan = scan_of(methods[method], 1000.0);
        scan.quantum = quanta[i / 6 % 3];
        scan.period = periods[i / 2 % 3];
        scan.turns = i % 2;
        if (!measure_stroke(&scan, STARTS, &t->strokes[method][i / 6 % 3][i / 2 % 3][i % 2])) {
            return 0;
        }
        study_progress("locked", 0.3 + 0.2 * (double)i / 54.0);
    }
    return 1;
}

/* What following the position costs at the highest frequencies that do so: at the odd period nearest below, where a
 * square wave of whole ticks pushes most, and at seven others down to 0.85 of the crossover. */
static int measure_price(double rate, crossover_cell *cell) {
    const double odd = 2.0 * floor(0.5 * (rate / cell->crossover + 1.0)) + 1.0;
    for (int i = 0; i < 8; i++) {
        locked_scan scan = scan_of(KNURL_METHOD_LOCKED, rate);
        locked_found found;
        scan.crossover = cell->crossover;
        scan.seconds = 2.0;
        if (!locked_scan_worst(&scan, i == 0 ? rate / odd : cell->crossover * (1.0 - 0.02137 * i), 2, 1, &found)) {
            return 0;
        }
        cell->push = fmax(cell->push, found.push);
        cell->net = fmax(cell->net, found.net);
        cell->spurious = fmax(cell->spurious, found.spurious);
    }
    return 1;
}

static int measure_crossovers(table *t) {
    for (size_t i = 0; i < RATES * CROSSOVERS; i++) {
        crossover_cell *cell = &t->crossovers[i / CROSSOVERS][i % CROSSOVERS];
        cell->crossover = 40.0 + 20.0 * (double)(i % CROSSOVERS);
        for (int k = 0; k < 6; k++) { /* quanta, one way and to and fro */
            locked_scan scan = scan_of(KNURL_METHOD_LOCKED, rates[i / CROSSOVERS]);
            stroke_cell stroke = {0.0, 0.0};
            scan.crossover = cell->crossover;
            scan.quantum = quanta[k % 3];
            scan.period = 0.0005;
            scan.turns = k / 3;
            if (!measure_stroke(&scan, 4, &stroke)) {
                return 0;
            }
            cell->error[k % 3] = fmax(cell->error[k % 3], stroke.error);
        }
        if (!measure_price(rates[i / CROSSOVERS], cell)) {
            return 0;
        }
        study_progress("locked", 0.5 + 0.5 * (double)i / (RATES * CROSSOVERS));
    }
    study_progress("locked", 1.0);
    return 1;
}

static void write_row(FILE *csv, const char *part, const char *method, const double *cells, size_t count) {
    fprintf(csv, "%s,%s", part, method);
    for (size_t i = 0; i < count; i++) {
        fputc(',', csv);
        if (isfinite(cells[i])) {
            out_number(csv, cells[i]);
        }
    }
    fputc('\n', csv);
}

static void write_speeds(FILE *csv, const table *t) {
    for (size_t i = 0; i < 3 * SPEEDS; i++) {
        const locked_found *f = &t->speeds[i / SPEEDS][i % SPEEDS];
        const double cells[] = {1000.0,
                                frequency_of(i % SPEEDS),
                                0.0,
                                1.0,
                                0.0,
                                KNURL_LOCKED_CROSSOVER_HZ,
                                f->step.error,
                                f->step.played / f->step.crossed,
                                f->step.longest,
                                f->push,
                                f->net,
                                f->spurious};
        write_row(csv, "speed", knurl_method_name(methods[i / SPEEDS]), cells, 12);
    }
}

static void write_strokes(FILE *csv, const table *t) {
    for (size_t i = 0; i < 54; i++) {
        const stroke_cell *s = &t->strokes[i / 18][i / 6 % 3][i / 2 % 3][i % 2];
        const double cells[] = {1000.0,
                                480.0,
                                1e3 * quanta[i / 6 % 3],
                                1e3 * periods[i / 2 % 3],
                                (double)(i % 2),
                                KNURL_LOCKED_CROSSOVER_HZ,
                                s->error,
                                NAN,
                                1e3 * s->longest,
                                NAN,
                                NAN,
                                NAN};
        write_row(csv, "stroke", knurl_method_name(methods[i / 18]), cells, 12);
    }
}

static void write_crossovers(FILE *csv, const table *t) {
    for (size_t i = 0; i < RATES * CROSSOVERS * 3; i++) {
        const crossover_cell *c = &t->crossovers[i / 3 / CROSSOVERS][i / 3 % CROSSOVERS];
        const double cells[] = {rates[i / 3 / CROSSOVERS],
                                480.0,
                                1e3 * quanta[i % 3],
                                0.5,
                                NAN,
                                c->crossover,
                                c->error[i % 3],
                                NAN,
                                NAN,
                                c->push,
                                c->net,
                                c->spurious};
        write_row(csv, "crossover", "locked", cells, 12);
    }
}

static void write_csv(FILE *csv, const table *t) {
    fputs("part,method,update_rate_hz,frequency_hz,quantum_mm,period_mm,turns,crossover_hz,phase_error_cycles,"
          "played_per_crossed,longest_event_ms,push,net,spurious\n",
          csv);
    write_speeds(csv, t);
    write_strokes(csv, t);
    write_crossovers(csv, t);
}

static int write_all(FILE *csv, json_writer *json, void *user) {
    write_csv(csv, user);
    json_string(json, "study", "locked");
    json_string(json, "table", "locked.csv");
    json_number(json, "crossover_hz", KNURL_LOCKED_CROSSOVER_HZ);
    return 0;
}

/* Over all speeds: how far played cycles are from those crossed, at most; and what else is worst. */
static void print_speeds(const table *t) {
    printf("constant speeds, 20 to 480 Hz at 1 kHz\n\n"
           "| method | played per crossed | phase error | push (50 ms) | spurious |\n|---|---|---|---|---|\n");
    for (size_t m = 0; m < 3; m++) {
        double low = INFINITY;
        double high = 0.0;
        double spurious = 0.0;
        locked_found worst;
        memset(&worst, 0, sizeof worst);
        for (size_t i = 0; i < SPEEDS; i++) {
            const locked_found *f = &t->speeds[m][i];
            low = fmin(low, f->step.played / f->step.crossed);
            high = fmax(high, f->step.played / f->step.crossed);
            worst.step.error = fmax(worst.step.error, f->step.error);
            worst.push = fmax(worst.push, f->push);
            spurious += f->spurious / SPEEDS;
        }
        printf("| %s | %.3f to %.3f | %.3g | %.3f A | %.1f %% |\n", knurl_method_name(methods[m]), low, high,
               worst.step.error, worst.push, 100.0 * spurious);
    }
}

static void print_strokes(const table *t) {
    printf("\nstrokes to 100, 250, 400, 480 Hz, 0.5, 1 and 2 a second: worst phase error, one way and to and fro\n\n"
           "| method, positions | 0.5 mm | 1 mm | 2 mm | longest event |\n|---|---|---|---|---|\n");
    for (size_t i = 0; i < 9; i++) {
        const stroke_cell(*row)[2] = t->strokes[i / 3][i % 3];
        double longest = 0.0;
        printf("| %s, %s |", knurl_method_name(methods[i / 3]),
               i % 3 == 0   ? "ideal"
               : i % 3 == 1 ? "0.055 mm"
                            : "0.01 mm");
        for (size_t p = 0; p < 3; p++) {
            printf(" %.3g, %.3g |", row[p][0].error, row[p][1].error);
            longest = fmax(longest, fmax(row[p][0].longest, row[p][1].longest));
        }
        printf(" %.0f ms |\n", 1e3 * longest);
    }
}

static void print_crossovers(const table *t) {
    printf("\ncrossover: worst phase error on 0.5 mm (ideal, 0.055 mm, 0.01 mm); worst push just below it\n\n"
           "| Hz | 1 kHz | 2 kHz | 5 kHz | 10 kHz |\n|---|---|---|---|---|\n");
    for (size_t i = 0; i < CROSSOVERS; i++) {
        printf("| %.0f |", t->crossovers[0][i].crossover);
        for (size_t r = 0; r < RATES; r++) {
            const crossover_cell *c = &t->crossovers[r][i];
            printf(" %.2f, %.2f, %.2f; %.3f A |", c->error[0], c->error[1], c->error[2], c->push);
        }
        printf("\n");
    }
}

int study_locked(const char *folder) {
    static table t;
    memset(&t, 0, sizeof t);
    if (!measure_speeds(&t) || !measure_strokes(&t) || !measure_crossovers(&t)) {
        return tool_error(1, "study: locked: no memory");
    }
    if (study_write(folder, "locked", write_all, &t)) {
        return 1;
    }
    print_speeds(&t);
    print_strokes(&t);
    print_crossovers(&t);
    return 0;
}
