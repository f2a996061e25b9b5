/* Command-line options. SPDX-License-Identifier: MIT */
#include "options.h"

#include <knurl/knurl.h>

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *tool_name = "knurl";

int tool_error(int code, const char *format, ...) {
    char text[4608]; /* a path and a sentence */
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    (void)knurl_text_line(text, sizeof text, text); /* whatever a name holds */
    fprintf(stderr, "%s: %s\n", tool_name, text);
    return code;
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

static const tool_option *find(const tool_option *options, size_t count, const char *name) {
    for (size_t i = 0; i < count; i++) {
        if (strcmp(options[i].name, name) == 0) {
            return &options[i];
        }
    }
    return NULL;
}

int tool_parse(int argc, char **argv, const tool_option *options, size_t count, const char **positional) {
    for (int i = 1; i < argc; i++) {
        if (strncmp(argv[i], "--", 2) != 0) {
            if (!positional || *positional) {
                return tool_error(TOOL_USAGE, "%s: unexpected argument '%s'; see '%s --help'", argv[0], argv[i],
                                  tool_name);
            }
            *positional = argv[i];
            continue;
        }
        const tool_option *option = find(options, count, argv[i]);
        if (!option) {
            return tool_error(TOOL_USAGE, "%s: unknown option '%s'; see '%s --help'", argv[0], argv[i], tool_name);
        }
        if (option->kind == TOOL_FLAG) {
            *(int *)option->value = 1;
        } else if (i + 1 == argc) {
            return tool_error(TOOL_USAGE, "%s: expected a value after %s, found none", argv[0], argv[i]);
        } else if (set_value(option, argv[++i]) != TOOL_OK) {
            return TOOL_USAGE;
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
