/* Device faults, printed as they come and counted for the summary. SPDX-License-Identifier: MIT */
#ifndef KNURL_TOOL_FAULTS_H
#define KNURL_TOOL_FAULTS_H

#include "tool.h"

#include <knurl/device.h>

#define FAULT_CODES 64

typedef struct faults {
    uint64_t counts[FAULT_CODES]; /* by code */
    int64_t start_ns;             /* of the run, on the clock that events bear */
} faults;

void faults_start(faults *f);

/* A line on stderr for each event since the last call; rows of overruns only in the summary. */
void faults_show(faults *f, knurl_device *device);

/* "faults": {"lost": 1, ...}: those that came. */
void faults_print(const faults *f, json_writer *json);

#endif
