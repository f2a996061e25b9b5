/* Command-line options. SPDX-License-Identifier: MIT */
#include "options.h"

#include "say.h"

#include <knurl/knurl.h>

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *tool_name = "knurl";

int tool_error(int code, const char *format, ...) {
    char text[4608]; /* room for a path and a sentence */
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    say(stderr, "%s: %s\n", tool_name, text);
    return code;
}

void tool_tell(const char *kind, const char *format, ...) {
    char text[4608];
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    say(stderr, "%s: %s: %s\n", tool_name, kind, text);
}

int tool_library_error(int code, const char *what) {
    return what ? tool_error(code, "%s: %s", what, knurl_error_message())
                : tool_error(code, "%s", knurl_error_message());
}

int tool_end(int code) {
    return fflush(stdout) != 0 && code == TOOL_OK ? tool_error(TOOL_FAILURE, "standard output cannot be written")
                                                  : code;
}

static int set_value(const tool_option *option, const char *text) {
    if (option->kind == TOOL_TEXT) {
        *(const char **)option->value = text;
        return TOOL_OK;
    }
    char *end = NULL;
    const double value = strtod(text, &end);
    if (end == text || *end || !(value >= option->least && value <= option->greatest)) {
        return tool_error(TOOL_USAGE, "%s: expected a number from %g to %g%s%s, found '%s'", option->name,
                          option->least, option->greatest, option->unit[0] ? " " : "", option->unit, text);
    }
    *(double *)option->value = value;
    return TOOL_OK;
}

#define WORD_MAX 32

/* The number of letters to change, insert, remove or swap with a neighbour to get from one word to the other; WORD_MAX
 * for long words. */
static size_t edit_distance(const char *a, const char *b) {
    size_t rows[WORD_MAX + 1][WORD_MAX + 1];
    const size_t n = strlen(a);
    const size_t m = strlen(b);
    if (n > WORD_MAX || m > WORD_MAX) {
        return WORD_MAX;
    }
    for (size_t i = 0; i <= n; i++) {
        for (size_t j = 0; j <= m; j++) {
            size_t best = i == 0 ? j : i;
            if (i > 0 && j > 0) {
                const size_t change = rows[i - 1][j - 1] + (a[i - 1] != b[j - 1]);
                const size_t remove = rows[i - 1][j] + 1;
                const size_t insert = rows[i][j - 1] + 1;
                best = change < remove ? change : remove;
                best = insert < best ? insert : best;
                if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] && rows[i - 2][j - 2] + 1 < best) {
                    best = rows[i - 2][j - 2] + 1;
                }
            }
            rows[i][j] = best;
        }
    }
    return rows[n][m];
}

const char *tool_nearest(const char *word, const char *const *names, size_t count) {
    const char *nearest = NULL;
    size_t least = 3;
    for (size_t i = 0; i < count; i++) {
        const size_t distance = edit_distance(word, names[i]);
        if (distance < least && distance < strlen(names[i])) {
            least = distance;
            nearest = names[i];
        }
    }
    return nearest;
}

/* The option of an argument, which may be --name=value. */
static const tool_option *find(const tool_option *options, size_t count, const char *argument) {
    const size_t length = strcspn(argument, "=");
    for (size_t i = 0; i < count; i++) {
        if (strlen(options[i].name) == length && strncmp(options[i].name, argument, length) == 0) {
            return &options[i];
        }
    }
    return NULL;
}

static int unknown_option(const char *command, const tool_option *options, size_t count, const char *argument) {
    const char *names[32];
    const size_t some = count < 32 ? count : 32;
    for (size_t i = 0; i < some; i++) {
        names[i] = options[i].name;
    }
    char word[WORD_MAX + 2];
    (void)snprintf(word, sizeof word, "%.*s", (int)strcspn(argument, "="), argument);
    const char *near = tool_nearest(word, names, some);
    return tool_error(TOOL_USAGE, "%s: unknown option '%s'%s%s%s; see '%s --help'", command, argument,
                      near ? "; did you mean '" : "", near ? near : "", near ? "'?" : "", tool_name);
}

/* Parses the option at argv[*i]; *i advances to its value if that is a separate argument. */
static int parse_option(int argc, char **argv, int *i, const tool_option *option) {
    const char *value = strchr(argv[*i], '=');
    if (option->kind == TOOL_FLAG) {
        if (value) {
            return tool_error(TOOL_USAGE, "%s: %s takes no value, found '%s'", argv[0], option->name, value + 1);
        }
        *(int *)option->value = 1;
        return TOOL_OK;
    }
    if (!value && *i + 1 == argc) {
        return tool_error(TOOL_USAGE, "%s: expected a value after %s, found none", argv[0], option->name);
    }
    return set_value(option, value ? value + 1 : argv[++*i]);
}

int tool_parse(int argc, char **argv, const tool_option *options, size_t count, const char **positional) {
    for (int i = 1; i < argc; i++) {
        if (argv[i][0] != '-' || !argv[i][1]) {
            if (!positional || *positional) {
                return tool_error(TOOL_USAGE, "%s: unexpected argument '%s'; see '%s --help'", argv[0], argv[i],
                                  tool_name);
            }
            *positional = argv[i];
            continue;
        }
        const tool_option *option = find(options, count, argv[i]);
        const int code =
            option ? parse_option(argc, argv, &i, option) : unknown_option(argv[0], options, count, argv[i]);
        if (code != TOOL_OK) {
            return code;
        }
    }
    return TOOL_OK;
}

int tool_parse_pair(const char *text, double out[2]) {
    char *end = NULL;
    out[1] = 0.0;
    out[0] = strtod(text, &end);
    if (end == text) {
        return 0;
    }
    if (*end == ',') {
        const char *second = end + 1;
        out[1] = strtod(second, &end);
        if (end == second) {
            return 0;
        }
    }
    return *end == 0 && isfinite(out[0]) && isfinite(out[1]);
}
