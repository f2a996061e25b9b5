/* What the commands of the tool share: options, output, input. SPDX-License-Identifier: MIT */
#ifndef KNURL_TOOL_H
#define KNURL_TOOL_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* Exit codes. */
enum { TOOL_OK = 0, TOOL_FAILURE = 1, TOOL_USAGE = 2 };

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

/* --- output (output.c) --- */

/* A file that is there whole or not at all: it is written beside and renamed at the end. A device or pipe is written
 * straight to. */
typedef struct tool_file {
    FILE *stream;
    char *path;
    char *partial; /* null: written straight to */
} tool_file;

int tool_file_open(tool_file *file, const char *path); /* TOOL_OK or TOOL_FAILURE */
int tool_file_keep(tool_file *file);                   /* closes and renames; TOOL_OK or TOOL_FAILURE */
void tool_file_discard(tool_file *file);               /* closes and removes; does nothing after keep */

/* The shortest decimal that reads back as the same double (15 or 17 digits); -0 is 0. */
void tool_print_number(FILE *stream, double value);

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
void json_string(tool_json *json, const char *key, const char *value);
void json_end(tool_json *json); /* the last newline */

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
int cmd_scan(int argc, char **argv);

#endif
