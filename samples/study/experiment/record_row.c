/* One row of a session's CSV: checks every cell that the analysis uses. SPDX-License-Identifier: MIT */
#include "record_row.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int refuse(const record_place *at, const char *column, const char *expected, const char *found) {
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

static int read_method(const record_place *at, const exp_design *d, const char *column, const char *cell,
                       int32_t *method) {
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

static int read_fault(const record_place *at, const char *column, const char *cell, int32_t *fault) {
    for (int32_t i = 0; i < 4; i++) {
        if (strcmp(cell, exp_fault_names[i]) == 0) {
            *fault = i;
            return TOOL_OK;
        }
    }
    return refuse(at, column, "none, steady, rough or push", cell);
}

/* The block, period and amplitude. */
static int read_cell(const record_place *at, char *const *cells, const exp_design *d, exp_record *r) {
    static const double blocks[] = {0, 1, 2, 3, 4};
    static const double training[] = {EXP_TRAINING_MM};
    const int is_taught = d->experiment != 3; /* the paper has no training there */
    const double block = one_of(cells[BLOCK], is_taught ? blocks : blocks + 1, d->blocks + (is_taught ? 1 : 0));
    r->trial.period = block == 0.0 && exp_has_gratings(d) ? one_of(cells[PERIOD], training, 1)
                                                          : one_of(cells[PERIOD], d->periods, d->period_count);
    r->trial.amplitude = one_of(cells[AMPLITUDE], d->amplitudes, 2);
    if (isnan(block)) {
        return refuse(at, "block", "one of the experiment's", cells[BLOCK]);
    }
    if (isnan(r->trial.period)) {
        return refuse(at, "period", "one of the experiment's", cells[PERIOD]);
    }
    if (isnan(r->trial.amplitude)) {
        return refuse(at, "amplitude", "one of the experiment's two", cells[AMPLITUDE]);
    }
    r->trial.block = (uint32_t)block;
    return TOOL_OK;
}

/* The stimuli, their order, and the answer. */
static int read_trial(const record_place *at, char *const *cells, const exp_design *d, exp_record *r) {
    int32_t preferred = 0;
    int code = read_cell(at, cells, d, r);
    code = code ? code : read_method(at, d, "first", cells[FIRST], &r->trial.methods[0]);
    code = code ? code : read_method(at, d, "second", cells[SECOND], &r->trial.methods[1]);
    code = code ? code : read_method(at, d, "preferred", cells[PREFERRED], &preferred);
    code = code ? code : read_fault(at, "fault_first", cells[FAULT_FIRST], &r->trial.faults[0]);
    code = code ? code : read_fault(at, "fault_second", cells[FAULT_SECOND], &r->trial.faults[1]);
    if (code == TOOL_OK && r->trial.methods[0] == r->trial.methods[1]) {
        return refuse(at, "second", "the other method than first", cells[SECOND]);
    }
    r->side = preferred == r->trial.methods[1];
    return code;
}

/* The numbers that the analysis uses: not negative, and finite. */
static int read_numbers(const record_place *at, char *const *cells, exp_record *r) {
    const struct {
        const char *name;
        int column;
        double *value;
    } numbers[] = {{"ticks", TICKS, &r->ticks},
                   {"force_limit_ticks", FORCE_LIMIT_TICKS, &r->force_limit_ticks},
                   {"overruns", OVERRUNS, &r->overruns},
                   {"contact_first_s", CONTACT_FIRST, &r->contact_s[0]},
                   {"contact_second_s", CONTACT_SECOND, &r->contact_s[1]},
                   {"softer_ticks", SOFTER_TICKS, &r->softer_ticks}};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        const char *cell = cells[numbers[i].column];
        char *end = NULL;
        *numbers[i].value = strtod(cell, &end);
        if (end == cell || *end || !(*numbers[i].value >= 0.0 && isfinite(*numbers[i].value))) {
            return refuse(at, numbers[i].name, "a number, 0 or more", cell);
        }
    }
    return TOOL_OK;
}

/* The experiment; for 4 from the two methods that the row names. */
static int read_design(const record_place *at, char *const *cells, exp_record *r, exp_design *design) {
    static const double experiments[] = {1, 2, 3, EXP_COMPARE};
    const double experiment = one_of(cells[EXPERIMENT], experiments, 4);
    int32_t methods[2] = {0, 0};
    if (isnan(experiment)) {
        return refuse(at, "experiment", "1, 2, 3 or 4", cells[EXPERIMENT]);
    }
    r->experiment = (int32_t)experiment;
    if (r->experiment != EXP_COMPARE) {
        *design = *exp_design_of(r->experiment);
        return TOOL_OK;
    }
    for (int i = 0; i < 2; i++) {
        if (knurl_method_from_name(cells[FIRST + i], &methods[i])) {
            return tool_error(TOOL_FAILURE, "%s: line %lu: %s: %s", at->path, at->line, i ? "second" : "first",
                              knurl_error_message());
        }
    }
    return methods[0] == methods[1] ? refuse(at, "second", "the other method than first", cells[SECOND])
                                    : exp_compare(methods[0], methods[1], design);
}

/* Whole numbers without sign or blanks; the seed may have as many digits as were given. */
static int read_count(const record_place *at, const char *column, const char *cell, uint64_t *value) {
    *value = strtoull(cell, NULL, 10);
    return *cell && strspn(cell, "0123456789") == strlen(cell) && *value <= 4294967295u
               ? TOOL_OK
               : refuse(at, column, "a whole number from 0 to 4294967295", cell);
}

int record_read(const record_place *at, char *const *cells, exp_record *r) {
    exp_design design = *exp_design_of(1); /* default until it is read */
    uint64_t number = 0;
    memset(r, 0, sizeof *r);
    int code = read_design(at, cells, r, &design);
    if (code) {
        return code;
    }
    if (strlen(cells[SUBJECT]) == 0 || strlen(cells[SUBJECT]) >= sizeof r->subject) {
        return refuse(at, "subject", "1 to 31 characters", cells[SUBJECT]);
    }
    memcpy(r->subject, cells[SUBJECT], strlen(cells[SUBJECT]) + 1);
    (void)snprintf(r->device, sizeof r->device, "%.*s", (int)sizeof r->device - 1, cells[DEVICE]);
    r->simulated = strcmp(cells[ANSWERS], exp_answer_names[EXP_SIMULATED]) == 0;
    if (!r->simulated && strcmp(cells[ANSWERS], "keyboard") != 0 && strcmp(cells[ANSWERS], "buttons") != 0) {
        return refuse(at, "answers", "keyboard, buttons or SIMULATED", cells[ANSWERS]);
    }
    r->sound = strcmp(cells[SOUND], "yes") == 0;
    if (!r->sound && strcmp(cells[SOUND], "no") != 0) {
        return refuse(at, "sound", "yes or no", cells[SOUND]);
    }
    code = read_count(at, "seed", cells[SEED], &r->seed);
    code = code ? code : read_count(at, "trial", cells[TRIAL], &number);
    r->number = (uint32_t)number;
    code = code ? code : read_numbers(at, cells, r);
    return code ? code : read_trial(at, cells, &design, r);
}
