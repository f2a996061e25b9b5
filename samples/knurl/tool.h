/* What the commands of the tool share: options, output, input. SPDX-License-Identifier: MIT */
#ifndef KNURL_TOOL_H
#define KNURL_TOOL_H

#include "out.h"

#include <knurl/scene.h>

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* Exit codes; TOOL_INTERRUPTED and a signal's number as shells have it. */
enum { TOOL_OK = 0, TOOL_FAILURE = 1, TOOL_USAGE = 2, TOOL_NOTHING_FELT = 4, TOOL_INTERRUPTED = 128 };

/* Prints "knurl: ..." as one line on stderr; returns `code`. */
int tool_error(int code, const char *format, ...);

/* The same with the library's own message. */
int tool_library_error(int code, const char *what);

/* --- options (options.c) --- */

enum { TOOL_FLAG, TOOL_TEXT, TOOL_NUMBER };

typedef struct tool_option {
    const char *name; /* "--rate" */
    int kind;         /* TOOL_ */
    void *value;      /* int *, const char **, double * */
    double least, greatest;
    const char *unit; /* for messages */
} tool_option;

/* Reads options and at most one positional argument. Returns TOOL_OK or TOOL_USAGE, having said why. */
int tool_parse(int argc, char **argv, const tool_option *options, size_t count, const char **positional);

/* One or two numbers with a comma between; 0 unless the whole text is that. */
int tool_parse_pair(const char *text, double out[2]);

/* A temporal signal as the options of `signal` and `metrics` name it (cmd_signal.c). */
typedef struct tool_wave {
    knurl_wave wave;
    double period_s, amplitude, rate;
} tool_wave;

/* Reads --method, --period-ms, --amplitude, --rate and one option more. TOOL_OK or TOOL_USAGE. */
int tool_read_wave(int argc, char **argv, const tool_option *more, tool_wave *out);

/* --- output (output.c) --- */

/* A CSV cell, quoted where it must be (RFC 4180). */
void tool_print_cell(FILE *stream, const char *text);

/* JSON to stdout, on one line unless pretty. */
typedef struct tool_json {
    int pretty;
    int depth;
    int first;
} tool_json;

void json_open(tool_json *json, const char *key, char bracket); /* '{' or '[' */
void json_close(tool_json *json, char bracket);                 /* '}' or ']' */
void json_number(tool_json *json, const char *key, double value);
void json_flag(tool_json *json, const char *key, int value);
void json_string(tool_json *json, const char *key, const char *value);
void json_end(tool_json *json); /* the last newline */

/* A line on stderr for each limit of HIP 0's device that a surface exceeds. */
void tool_warn(const knurl_scene *scene);

/* --- CSV input (csv_in.c) --- */

typedef struct tool_table {
    double *cells; /* row_count rows of `columns` numbers */
    uint64_t row_count;
    uint32_t columns;
} tool_table;

/* Reads a CSV of finite numbers whose header holds all of `names` (count of them, in any order, others are passed
 * over). Returns TOOL_OK, or TOOL_FAILURE having said which line. */
int tool_read_csv(const char *path, const char *const *names, uint32_t count, tool_table *table);

/* 1 if the file's header line holds the name. */
int tool_csv_has(const char *path, const char *name);

/* --- commands --- */

int cmd_inspect(int argc, char **argv);
int cmd_run(int argc, char **argv);
int cmd_signal(int argc, char **argv);
int cmd_metrics(int argc, char **argv);
int cmd_scan(int argc, char **argv);
int cmd_study(int argc, char **argv);
int cmd_bench(int argc, char **argv);
int cmd_devices(int argc, char **argv);

#endif
