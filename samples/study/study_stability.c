/* knurl study stability: the checks, the maps, their files. SPDX-License-Identifier: MIT */
#include "stability.h"

#include "say.h"
#include "study.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MAX_MAPS 72
#define CELLS    (STABILITY_COLUMNS * STABILITY_ROWS)

static const char *const figures[] = {"stability", "stability_methods", "stability_amplitudes", "stability_effects",
                                      "stability_walls"}; /* the last as a table only */

static const char *const walls[] = {"plane", "waves of facets", "smooth waves"};

#define FIGURES (sizeof figures / sizeof *figures)

/* One figure's maps, all cells of them. */
typedef struct chart {
    const char *figure;
    size_t maps;
    stability_map map[MAX_MAPS];
    char device[MAX_MAPS][64];
    size_t cells[MAX_MAPS];
    stability_cell cell[MAX_MAPS][CELLS];
    const stability_check *checks;
    size_t check_count;
} chart;

static const char *name_of(const stability_map *map) {
    return map->effect == 0                     ? stability_methods[map->method].name
           : map->effect == KNURL_EFFECT_DETENT ? "detent"
                                                : "spring";
}

static void write_cell(FILE *csv, const stability_map *map, const stability_cell *cell) {
    const lab_result *r = &cell->result;
    const double values[] = {
        cell->x, cell->y,  r->energy, r->unauthorised, r->activity_force, r->activity_motion, r->activity,
        r->felt, r->asked, r->bangs,  r->swing,        r->force_max,      r->guarded_ticks};
    fprintf(csv, "%s%s%s,%s,%s,%s,%s,%s", map->name, map->wall ? " on " : "", map->wall ? walls[map->wall] : "",
            map->label, map->grip, name_of(map), map->without ? "raw" : "protected", lab_outcome_name(r->outcome));
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        fputs(",", csv);
        out_number(csv, values[i]);
    }
    fputs("\n", csv);
}

static int write_chart(FILE *csv, json_writer *json, void *user) {
    const chart *c = user;
    fputs("map,label,grip,method,protections,outcome,x,y,energy_j,unauthorised_j,activity_n,activity_m,"
          "activity_thresholds,felt_thresholds,asked_thresholds,bangs,swing_m,force_max_n,guarded_ticks\n",
          csv);
    for (size_t m = 0; m < c->maps; m++) {
        for (size_t i = 0; i < c->cells[m]; i++) {
            write_cell(csv, &c->map[m], &c->cell[m][i]);
        }
    }
    char table[64];
    (void)snprintf(table, sizeof table, "%s.csv", c->figure);
    json_string(json, "table", table);
    json_open(json, "grips", '{');
    for (const lab_grip *g = lab_grips; g->name; g++) {
        const double grip[] = {g->stiffness, g->damping, g->mass};
        json_numbers(json, g->name, grip, 3, 1);
    }
    json_close(json, '}');
    json_open(json, "checks", '[');
    for (size_t i = 0; i < c->check_count; i++) {
        const stability_check *k = &c->checks[i];
        json_open(json, NULL, '{');
        json_string(json, "what", k->what);
        json_string(json, "unit", k->unit);
        json_number(json, "expected", k->expected);
        json_number(json, "found", k->found);
        json_number(json, "holds", stability_holds(k));
        json_close(json, '}');
    }
    json_close(json, ']');
    return 0;
}

static void print_checks(const stability_check *checks, size_t count) {
    printf("| check | expected | found | |\n|---|---|---|---|\n");
    for (size_t i = 0; i < count; i++) {
        const stability_check *k = &checks[i];
        if (strcmp(k->unit, "outcome") == 0) {
            say(stdout, "| %s | %s | %s | %s |\n", k->what, lab_outcome_name((int)k->expected),
                lab_outcome_name((int)k->found), stability_holds(k) ? "" : "DIFFERS");
        } else {
            say(stdout, "| %s | %s%.5g %s | %.5g", k->what, isinf(k->tolerance) ? "at least " : "", k->expected,
                k->unit, k->found);
            if (!isinf(k->tolerance)) {
                printf(" (%+.2f %%)", 100.0 * (k->found / k->expected - 1.0));
            }
            say(stdout, " | %s |\n", stability_holds(k) ? "" : "DIFFERS");
        }
    }
}

/* Prints the runaways below the maker's stiffness and within the motors' force. */
static void print_runaways(const chart *c) {
    const double limits[][2] = {{1020.0, 3000.0}, {1.0, 1.0}}; /* a map of amplitudes ends at the motors' force */
    const int amplitudes = strcmp(c->figure, "stability_amplitudes") == 0;
    say(stdout, "\n");
    say(stdout, "%s: cells that run away or buzz within the device's own limits, of those that lie within them\n",
        amplitudes                                  ? "Amplitude against speed"
        : strcmp(c->figure, "stability_walls") == 0 ? "Curved walls, stiffness against speed"
                                                    : "Stiffness against speed");
    printf(
        "\n| device, grip | protections | method | wall | runs away | buzzes | of |\n|---|---|---|---|---|---|---|\n");
    for (size_t m = 0; m < c->maps; m++) {
        const stability_map *map = &c->map[m];
        int counts[4] = {0};
        int all = 0;
        for (size_t i = 0; i < c->cells[m]; i++) {
            const int within = c->cell[m][i].y <= limits[amplitudes][strcmp(map->label, "Falcon") == 0] * 1.001;
            all += within;
            counts[c->cell[m][i].result.outcome] += within;
        }
        say(stdout, "| %s, %s | %s | %s | %s | %d | %d | %d |\n", map->label, map->grip,
            map->without ? "raw" : "protected", stability_methods[map->method].name, walls[map->wall],
            counts[LAB_UNSTABLE], counts[LAB_LIMIT_CYCLE], all);
    }
}

/* Prints the stiffest spring that rests, below all that do not, over all dampings. */
static void print_stiffest(const chart *c) {
    printf("\nEffects: the stiffness up to which every cell rests, and the cells that do not\n\n"
           "| device, hand | effect | protections | N/m | do not rest | of |\n|---|---|---|---|---|---|\n");
    for (size_t m = 0; m < c->maps; m++) {
        const stability_map *map = &c->map[m];
        double least = HUGE_VAL;
        double stiffest = 0.0;
        int bad = 0;
        for (size_t i = 0; i < c->cells[m]; i++) {
            const stability_cell *cell = &c->cell[m][i];
            const int rests = cell->result.outcome == LAB_REST;
            least = rests ? least : fmin(least, cell->y);
            bad += !rests;
        }
        for (size_t i = 0; i < c->cells[m]; i++) {
            stiffest = c->cell[m][i].y < least ? fmax(stiffest, c->cell[m][i].y) : stiffest;
        }
        say(stdout, "| %s, %s | %s | %s | %.0f | %d | %d |\n", map->label, map->grip, name_of(map),
            map->without ? "raw" : "protected", stiffest, bad, (int)c->cells[m]);
    }
}

static int run_chart(chart *c, size_t figure, lab_signals *signals) {
    c->figure = figures[figure];
    c->maps = 0;
    size_t count = 0;
    while (count < MAX_MAPS && stability_map_at(c->figure, count, &c->map[count])) {
        (void)snprintf(c->device[count], sizeof c->device[count], "%s", c->map[count].device);
        c->map[count].device = c->device[count];
        count++;
    }
    for (size_t m = 0; m < count; m++) {
        study_progress(c->figure, (double)m / (double)count);
        c->cells[m] = stability_map_run(&c->map[m], signals, c->cell[m]);
        if (c->cells[m] == 0) {
            return 1;
        }
    }
    study_progress(c->figure, 1.0);
    c->maps = count;
    return 0;
}

int study_stability(const char *folder) {
    static stability_check checks[STABILITY_CHECKS];
    lab_signals signals = {0};
    chart *c = calloc(1, sizeof *c);
    const size_t check_count = c ? stability_checks(checks) : 0;
    int failed = check_count == 0;
    if (c && !failed) {
        print_checks(checks, check_count);
        c->checks = checks;
        c->check_count = check_count;
    }
    for (size_t figure = 0; figure < FIGURES && !failed; figure++) {
        failed = run_chart(c, figure, &signals);
        if (!failed && study_write(folder, figures[figure], write_chart, c)) {
            break; /* the reason was printed */
        }
        if (!failed && strcmp(figures[figure], "stability_effects") == 0) {
            print_stiffest(c);
        } else if (!failed && figure > 0) {
            print_runaways(c);
        }
    }
    if (failed) {
        (void)tool_error(1, "study: stability: %s", c ? knurl_error_message() : "no memory");
    }
    lab_signals_free(&signals);
    free(c);
    return failed;
}
