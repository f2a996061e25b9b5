/* Reads the CSV files of sessions. SPDX-License-Identifier: MIT */
#include "record_row.h"

#include "in.h"
#include "os.h"

#include <stdlib.h>
#include <string.h>

/* 1 if the two methods are the same, in either order. */
static int same_pair(const exp_trial *a, const exp_trial *b) {
    return (a->methods[0] == b->methods[0] && a->methods[1] == b->methods[1]) ||
           (a->methods[0] == b->methods[1] && a->methods[1] == b->methods[0]);
}

static int same_trial(const exp_record *a, const exp_record *b) {
    return a->experiment == b->experiment && a->sound == b->sound && a->trial.block == b->trial.block &&
           a->trial.period == b->trial.period && a->trial.amplitude == b->trial.amplitude &&
           same_pair(&a->trial, &b->trial) && memcmp(a->trial.faults, b->trial.faults, sizeof a->trial.faults) == 0 &&
           strcmp(a->subject, b->subject) == 0;
}

/* Adds a row if it is consistent with the previous ones: all from people or all simulated, and each trial once. */
static int add_row(const record_place *at, exp_records *records, const exp_record *r) {
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

/* Splits a line at its commas. */
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

static int read_line(const record_place *at, char *line, exp_records *records) {
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
    const int code = record_read(at, cells, &record);
    return code ? code : add_row(at, records, &record);
}

int exp_read_records(const char *path, exp_records *records) {
    record_place at = {path, 0};
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

int exp_is_of(const exp_record *r, const exp_design *d) {
    return r->experiment == d->experiment &&
           ((r->trial.methods[0] == d->methods[0] && r->trial.methods[1] == d->methods[1]) ||
            (r->trial.methods[0] == d->methods[1] && r->trial.methods[1] == d->methods[0]));
}
