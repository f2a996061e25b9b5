/* Messages on standard output and standard error. No other file of the samples prints names there:
 * tests/tool/printing.py, part of the lint, checks it. SPDX-License-Identifier: MIT */
#ifndef KNURL_SAMPLES_SAY_H
#define KNURL_SAMPLES_SAY_H

#include <knurl/base.h>

#include <stdio.h>

/* Prints a line, or a part of one if the format does not end with '\n'. Names and messages stay on this line and cannot
 * send escapes to a terminal: knurl_text_line(). */
void say(FILE *stream, const char *format, ...) KNURL_PRINTF(2, 3);

/* Prints the lines of a constant text, such as the help. */
void say_page(FILE *stream, const char *text);

/* Replaces the line of progress, on standard error if that is a terminal. say() erases it first. [main thread, as all
 * of these] */
void say_progress(const char *format, ...) KNURL_PRINTF(1, 2);
void say_progress_end(void);

#endif
