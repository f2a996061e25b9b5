/* Messages. SPDX-License-Identifier: MIT */
#include "say.h"

#include <stdarg.h>
#include <string.h>
#include <unistd.h>

static int has_progress; /* a line of it is on the terminal */

void say_progress_end(void) {
    if (has_progress) {
        fputs("\r\033[K", stderr);
        has_progress = 0;
    }
}

static void print(FILE *stream, const char *format, va_list arguments) {
    char text[5120]; /* room for a path and a sentence */
    (void)vsnprintf(text, sizeof text, format, arguments);
    const size_t length = strlen(format);
    const int is_line = length > 0 && format[length - 1] == '\n';
    const size_t written = strlen(text);
    if (is_line && written > 0 && text[written - 1] == '\n') { /* remove the line end of a text that was cut */
        text[written - 1] = '\0';
    }
    (void)knurl_text_line(text, sizeof text, text);
    fprintf(stream, "%s%s", text, is_line ? "\n" : "");
}

void say(FILE *stream, const char *format, ...) {
    va_list arguments;
    say_progress_end();
    va_start(arguments, format);
    print(stream, format, arguments);
    va_end(arguments);
}

void say_page(FILE *stream, const char *text) {
    for (const char *line = text, *end; *line; line = end + (*end == '\n')) {
        end = line + strcspn(line, "\n");
        say(stream, "%.*s\n", (int)(end - line), line);
    }
}

void say_progress(const char *format, ...) {
    va_list arguments;
    if (!isatty(STDERR_FILENO)) {
        return;
    }
    fputc('\r', stderr);
    va_start(arguments, format);
    print(stderr, format, arguments);
    va_end(arguments);
    fputs("\033[K", stderr); /* clear the rest of a longer line */
    has_progress = 1;
}
