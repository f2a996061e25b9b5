/* Text for people, on standard output and standard error. No other file of the samples prints names there: a test
 * (tests/tool/printing.py, part of the lint) looks. SPDX-License-Identifier: MIT */
#ifndef KNURL_SAMPLES_SAY_H
#define KNURL_SAMPLES_SAY_H

#include <knurl/base.h>

#include <stdio.h>

/* A line; without '\n' at the end of the format, a part of one. Whatever names and messages hold, they stay on this
 * line and send no escape to a terminal: knurl_text_line(). */
void say(FILE *stream, const char *format, ...) KNURL_PRINTF(2, 3);

/* The lines of a text of the program's own, such as its help. */
void say_page(FILE *stream, const char *text);

/* Replaces the line of progress, on standard error if that is a terminal. say() erases it first. [main thread, as all
 * of these] */
void say_progress(const char *format, ...) KNURL_PRINTF(1, 2);
void say_progress_end(void);

#endif
