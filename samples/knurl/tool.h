/* Declarations that the commands share: CSV input, warnings. SPDX-License-Identifier: MIT */
#ifndef KNURL_TOOL_H
#define KNURL_TOOL_H

#include "csv.h"
#include "json.h"
#include "options.h"
#include "out.h"
#include "say.h"

#include <knurl/device.h>
#include <knurl/gltf.h>
#include <knurl/hip.h>
#include <knurl/query.h>

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* --- output (output.c) --- */

/* A line on stderr for each limit of HIP 0's device that a surface exceeds. Returns their number. */
uint32_t tool_warn(const knurl_scene *scene);

/* --- loading (load.c) --- */

/* --budget: "surfaces=1000,seconds=0.5"; null: not given. TOOL_OK, or TOOL_USAGE after printing the reason. */
int tool_parse_budget(const char *text, knurl_gltf_options *budget);

/* knurl_gltf_load_file(). Protects the files that were read from being overwritten, and shows progress on a terminal.
 */
knurl_result tool_load(knurl_scene *scene, const char *path, const knurl_gltf_options *budget, uint32_t *skipped);

/* --- even sensation (even.c) --- */

/* TOOL_OK, or TOOL_USAGE having said that it is one or the other. */
int tool_check_even(const char *command, int even, const char *response);

/* --response FILE, or --even (path null): HIP 0's gains, by the file or by the device's mass and friction. TOOL_OK, or
 * TOOL_FAILURE having said why. */
int tool_even(knurl_scene *scene, const char *path, const knurl_device *device, double rate);

/* The gains from a response's file. TOOL_OK, or TOOL_FAILURE having said why. */
int tool_read_response(const char *path, knurl_gain gains[KNURL_GAINS]);

/* "even": {"lowest_gain", "from_hz", "to_hz"} of HIP 0, if it has gains. */
void tool_print_even(json_writer *json, const knurl_scene *scene);

/* --- CSV input (csv_in.c) --- */

typedef struct tool_table {
    double *cells; /* row_count rows of `columns` numbers */
    uint64_t row_count;
    uint32_t columns;
} tool_table;

/* Reads a CSV of finite numbers whose header holds all of `names` (count of them, in any order, others are ignored).
 * Returns TOOL_OK, or TOOL_FAILURE after printing the line of the error. */
int tool_read_csv(const char *path, const char *const *names, uint32_t count, tool_table *table);

/* 1 if the file's header line holds the name. */
int tool_csv_has(const char *path, const char *name);

/* --- commands --- */

int cmd_inspect(int argc, char **argv);
int cmd_tag(int argc, char **argv);
int cmd_run(int argc, char **argv);
int cmd_signal(int argc, char **argv);
int cmd_scan(int argc, char **argv);
int cmd_bench(int argc, char **argv);
int cmd_devices(int argc, char **argv);
int cmd_calibrate(int argc, char **argv);
int cmd_sweep(int argc, char **argv);
int cmd_verify(int argc, char **argv);

#endif
