/* Reads the CSV files of sessions and checks every cell that the analysis uses. SPDX-License-Identifier: MIT */
#include "experiment.h"

#include "in.h"
#include "os.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    EXPERIMENT,
    SUBJECT,
    ANSWERS,
    DEVICE,
    SEED,
    SOUND,
    TRIAL,
    BLOCK,
    PERIOD,
    AMPLITUDE,
    FIRST,
    SECOND,
    PREFERRED,
    RT,
    TICKS,
    FORCE_LIMIT_TICKS,
    FREQUENCIES,
    OVERRUNS,
    RESTARTS,
    CONTACT_FIRST,
    CONTACT_SECOND,
    COLUMNS
};

/* Where a row is, for messages. */
typedef struct place {
    const char *path;
    unsigned long line;
} place;

static int refuse(const place *at, const char *column, const char *expected, const char *found) {
    return tool_error(TOOL_FAILURE, "%s: line %lu: %s: expected %s, found '%s'", at->path, at->line, column, expected,
                      found);
}

/* The number that is the whole cell and one of `allowed`, or NaN. */
static double one_of(const char *cell, const double *allowed, uint32_t count) {
    char *end = NULL;
    const double value = strtod(cell, &end);
    for (uint32_t i = 0; end != cell && !*end && i < count; i++) {
        if (fabs(value - allowed[i]) < 1e-9) {
            return allowed[i];
        }
    }
    return NAN;
}

static int read_method(const place *at, const exp_design *d, const char *column, const char *cell, int32_t *method) {
    for (int i = 0; i < 2; i++) {
        if (strcmp(cell, d->names[i]) == 0) {
            *method = d->methods[i];
            return TOOL_OK;
        }
    }
    char expected[32];
    (void)snprintf(expected, sizeof expected, "%s or %s", d->names[0], d->names[1]);
    return refuse(at, column, expected, cell);
}

/* What was played: the cell and the order. */
static int read_trial(const place *at, char *const *cells, const exp_design *d, exp_record *r) {
    static const double blocks[] = {1, 2, 3};
    const double block = one_of(cells[BLOCK], blocks, d->blocks);
    r->trial.period = one_of(cells[PERIOD], d->periods, d->period_count);
    r->trial.amplitude = one_of(cells[AMPLITUDE], d->amplitudes, 2);
    if (isnan(block)) {
        return refuse(at, "block", d->blocks == 1 ? "1" : "1, 2 or 3", cells[BLOCK]);
    }
    if (isnan(r->trial.period)) {
        return refuse(at, "period", "one of the experiment's", cells[PERIOD]);
    }
    if (isnan(r->trial.amplitude)) {
        return refuse(at, "amplitude", "one of the experiment's two", cells[AMPLITUDE]);
    }
    r->trial.block = (uint32_t)block;
    int code = read_method(at, d, "first", cells[FIRST], &r->trial.methods[0]);
    code = code ? code : read_method(at, d, "second", cells[SECOND], &r->trial.methods[1]);
    code = code ? code : read_method(at, d, "preferred", cells[PREFERRED], &r->preferred);
    if (code == TOOL_OK && r->trial.methods[0] == r->trial.methods[1]) {
        return refuse(at, "second", "the other method than first", cells[SECOND]);
    }
    return code;
}

static int read_row(const place *at, char *const *cells, exp_record *r) {
    static const double experiments[] = {1, 2, 3};
    const double experiment = one_of(cells[EXPERIMENT], experiments, 3);
    char *end = NULL;
    memset(r, 0, sizeof *r);
    if (isnan(experiment)) {
        return refuse(at, "experiment", "1, 2 or 3", cells[EXPERIMENT]);
    }
    r->experiment = (int32_t)experiment;
    if (strlen(cells[SUBJECT]) == 0 || strlen(cells[SUBJECT]) >= sizeof r->subject) {
        return refuse(at, "subject", "1 to 31 characters", cells[SUBJECT]);
    }
    memcpy(r->subject, cells[SUBJECT], strlen(cells[SUBJECT]) + 1);
    r->simulated = strcmp(cells[ANSWERS], exp_answer_names[EXP_SIMULATED]) == 0;
    if (!r->simulated && strcmp(cells[ANSWERS], "keyboard") != 0 && strcmp(cells[ANSWERS], "buttons") != 0) {
        return refuse(at, "answers", "keyboard, buttons or SIMULATED", cells[ANSWERS]);
    }
    r->sound = strcmp(cells[SOUND], "yes") == 0;
    if (!r->sound && strcmp(cells[SOUND], "no") != 0) {
        return refuse(at, "sound", "yes or no", cells[SOUND]);
    }
    r->force_limit_ticks = strtod(cells[FORCE_LIMIT_TICKS], &end);
    if (end == cells[FORCE_LIMIT_TICKS] || *end || !(r->force_limit_ticks >= 0.0 && isfinite(r->force_limit_ticks))) {
        return refuse(at, "force_limit_ticks", "a number of ticks", cells[FORCE_LIMIT_TICKS]);
    }
    return read_trial(at, cells, exp_design_of(r->experiment), r);
}

static int same_trial(const exp_record *a, const exp_record *b) {
    return a->experiment == b->experiment && a->sound == b->sound && a->trial.block == b->trial.block &&
           a->trial.period == b->trial.period && a->trial.amplitude == b->trial.amplitude &&
           strcmp(a->subject, b->subject) == 0;
}

/* Adds a row that goes with those before: all people's or all simulated, and each trial once. */
static int add_row(const place *at, exp_records *records, const exp_record *r) {
    for (size_t i = 0; i < records->count; i++) {
        if (records->rows[i].simulated != r->simulated) {
            return tool_error(TOOL_FAILURE, "%s: line %lu: people's answers and simulated ones do not go together",
                              at->path, at->line);
        }
        if (same_trial(&records->rows[i], r)) {
            return tool_error(TOOL_FAILURE, "%s: line %lu: this trial of subject %s was there before", at->path,
                              at->line, r->subject);
        }
    }
    if (records->count == records->capacity) {
        const size_t wanted = records->capacity ? 2 * records->capacity : 256;
        exp_record *more = realloc(records->rows, wanted * sizeof *more);
        if (!more) {
            return tool_error(TOOL_FAILURE, "no memory for %lu rows", (unsigned long)wanted);
        }
        records->rows = more;
        records->capacity = wanted;
    }
    records->rows[records->count++] = *r;
    return TOOL_OK;
}

/* Takes a line apart at its commas. */
static int split(char *line, char *cells[COLUMNS]) {
    int count = 0;
    for (char *rest = line; rest; count++) {
        char *comma = strchr(rest, ',');
        if (comma) {
            *comma++ = 0;
        }
        if (count < COLUMNS) {
            cells[count] = rest;
        }
        rest = comma;
    }
    return count;
}

static int read_line(const place *at, char *line, exp_records *records) {
    char *cells[COLUMNS];
    exp_record record;
    if (at->line == 1) {
        return strcmp(line, exp_csv_header) == 0
                   ? TOOL_OK
                   : tool_error(TOOL_FAILURE,
                                "%s: line 1: expected the header that knurl_experiment writes, found '%.40s'", at->path,
                                line);
    }
    const int count = split(line, cells);
    if (count != COLUMNS) {
        return tool_error(TOOL_FAILURE, "%s: line %lu: expected %d cells, found %d", at->path, at->line, COLUMNS,
                          count);
    }
    const int code = read_row(at, cells, &record);
    return code ? code : add_row(at, records, &record);
}

int exp_read_records(const char *path, exp_records *records) {
    place at = {path, 0};
    char *line = NULL;
    size_t size = 0;
    int code = TOOL_OK;
    int too_long = 0;
    const char *why = "";
    FILE *f = os_open_input(path, &why);
    if (!f) {
        return tool_error(TOOL_FAILURE, "%s: cannot be read: %s", path, why);
    }
    while (code == TOOL_OK && in_line(f, &line, &size, &too_long) != -1) {
        at.line++;
        exp_chop(line);
        code = read_line(&at, line, records);
    }
    if (code == TOOL_OK && too_long) {
        code = tool_error(TOOL_FAILURE, "%s: line %lu: expected at most 65536 bytes, found more", path, at.line + 1);
    }
    if (code == TOOL_OK && (ferror(f) || at.line < 2)) {
        code = tool_error(TOOL_FAILURE, "%s: expected a header and at least one row", path);
    }
    free(line);
    (void)fclose(f);
    return code;
}
