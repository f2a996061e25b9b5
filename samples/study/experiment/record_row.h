/* The columns of a session's CSV. SPDX-License-Identifier: MIT */
#ifndef KNURL_EXPERIMENT_RECORD_ROW_H
#define KNURL_EXPERIMENT_RECORD_ROW_H

#include "experiment.h"

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
    SOFTER_TICKS,
    FAULT_FIRST,
    FAULT_SECOND,
    COLUMNS
};

/* Position of a row, for messages. */
typedef struct record_place {
    const char *path;
    unsigned long line;
} record_place;

/* Checks a row's cells (COLUMNS of them). TOOL_FAILURE after printing the wrong one. */
int record_read(const record_place *at, char *const *cells, exp_record *record);

#endif
