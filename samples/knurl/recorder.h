/* Records a run: the haptic thread fills a ring buffer, the main thread writes it to a CSV file.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TOOL_RECORDER_H
#define KNURL_TOOL_RECORDER_H

#include "tick_ring.h"
#include "tool.h"

#include <knurl/knurl.h>

typedef struct recorder {
    tick_ring ring;
    const knurl_scene *scene;
    out_file file;
    csv_writer csv;
    double rate;
} recorder;

/* Opens the file and writes the header. TOOL_OK, or TOOL_FAILURE after printing the reason. */
int recorder_open(recorder *r, const char *path, const knurl_scene *scene, double rate);

/* Writes the new ticks in the ring. */
void recorder_drain(recorder *r);

/* Drains and keeps the file, or removes it. TOOL_OK, or TOOL_FAILURE after printing the reason. */
int recorder_close(recorder *r, int keep);

#endif
