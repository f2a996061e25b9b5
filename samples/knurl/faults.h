/* Device faults, printed as they occur and counted for the summary. SPDX-License-Identifier: MIT */
#ifndef KNURL_TOOL_FAULTS_H
#define KNURL_TOOL_FAULTS_H

#include "tool.h"

#include <knurl/device.h>

#define FAULT_CODES 64

typedef struct faults {
    uint64_t counts[FAULT_CODES]; /* by code */
    int64_t start_ns;             /* of the run, on the clock of the events */
} faults;

void faults_start(faults *f);

/* Prints a line on stderr for each event since the last call; overruns are only in the summary. simulated: s, the time
 * to print in a run that is not in real time; negative: print each event's time. */
void faults_show(faults *f, knurl_device *device, double simulated);

/* "faults": {"lost": 1, ...}: those that occurred. */
void faults_print(const faults *f, json_writer *json);

#endif
