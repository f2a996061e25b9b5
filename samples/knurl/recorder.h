/* Records a run: the haptic thread fills a ring buffer, the main thread writes it to a CSV file.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TOOL_RECORDER_H
#define KNURL_TOOL_RECORDER_H

#include "tool.h"

#include <knurl/knurl.h>

#define RECORDER_ROWS 16384 /* 1.6 s at 10 kHz */

typedef struct recorder {
    knurl_tick_output *rows;
    uint64_t written; /* by the haptic thread */
    uint64_t read;    /* by the other */
    uint64_t lost;    /* rows for which there was no room */
    const knurl_scene *scene;
    out_file file;
    double rate;
} recorder;

/* Opens the file and writes the header. TOOL_OK, or TOOL_FAILURE having said why. */
int recorder_open(recorder *r, const char *path, const knurl_scene *scene, double rate);

/* A knurl_tick_callback; `user` is the recorder. [haptic thread] */
void recorder_take(const knurl_tick_output *output, void *user);

/* Writes what has come. */
void recorder_drain(recorder *r);

/* Drains and keeps the file, or takes it away. TOOL_OK, or TOOL_FAILURE having said why. */
int recorder_close(recorder *r, int keep);

#endif
