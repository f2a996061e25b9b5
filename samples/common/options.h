/* Command-line options and errors, for the tool and the studies. SPDX-License-Identifier: MIT */
#ifndef KNURL_SAMPLES_OPTIONS_H
#define KNURL_SAMPLES_OPTIONS_H

#include <knurl/base.h>

#include <stddef.h>

/* Exit codes; TOOL_INTERRUPTED plus a signal's number, as in shells. */
enum { TOOL_OK = 0, TOOL_FAILURE = 1, TOOL_USAGE = 2, TOOL_CHECK = 3, TOOL_NO_CONTACT = 4, TOOL_INTERRUPTED = 128 };

/* The program's name in messages: "knurl" unless main() sets another. */
extern const char *tool_name;

/* Prints "knurl: ..." as one line on stderr; returns `code`. */
int tool_error(int code, const char *format, ...) KNURL_PRINTF(2, 3);

/* Prints "knurl: KIND: ..." as one line on stderr, for messages that do not end the program: "note", "warning", "hint".
 */
void tool_tell(const char *kind, const char *format, ...) KNURL_PRINTF(2, 3);

/* tool_error() with the library's own message. */
int tool_library_error(int code, const char *what);

/* The result of main(): `code`, or TOOL_FAILURE if that is TOOL_OK and standard output cannot be written, so that a
 * full disk does not look like success. */
int tool_end(int code);

enum { TOOL_FLAG, TOOL_TEXT, TOOL_NUMBER };

typedef struct tool_option {
    const char *name; /* "--rate" */
    int kind;         /* TOOL_ */
    void *value;      /* int *, const char **, double * */
    double least, greatest;
    const char *unit; /* for messages */
} tool_option;

/* The nearest name to a mistyped word, within two wrong letters, or null. */
const char *tool_nearest(const char *word, const char *const *names, size_t count);

/* Reads options (--name value or --name=value) and at most one positional argument. Returns TOOL_OK, or TOOL_USAGE
 * after printing the reason. */
int tool_parse(int argc, char **argv, const tool_option *options, size_t count, const char **positional);

/* Parses one or two numbers with a comma in between; returns 0 on any other text. */
int tool_parse_pair(const char *text, double out[2]);

#endif
