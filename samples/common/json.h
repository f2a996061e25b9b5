/* A JSON writer for the tool and the studies. SPDX-License-Identifier: MIT */
#ifndef KNURL_SAMPLES_JSON_H
#define KNURL_SAMPLES_JSON_H

#include <stddef.h>
#include <stdio.h>

/* State of a JSON text that is being written; the writer adds commas and line breaks. */
typedef struct json_writer {
    FILE *stream;
    int pretty; /* 0: on one line */
    int depth;
    int first; /* the next value is the first of its object or array */
} json_writer;

void json_start(json_writer *json, FILE *stream, int pretty);

/* Values: `key` is null in an array. Numbers that are not finite become null. */
void json_open(json_writer *json, const char *key, char bracket); /* '{' or '[' */
void json_close(json_writer *json, char bracket);                 /* '}' or ']'; ends the line after the last */
void json_number(json_writer *json, const char *key, double value);
void json_flag(json_writer *json, const char *key, int value);
void json_string(json_writer *json, const char *key, const char *value);
void json_raw(json_writer *json, const char *key, const char *value); /* JSON text; printed on one line */

/* An array on one line: every `stride`-th of the numbers from the first on. */
void json_numbers(json_writer *json, const char *key, const double *values, size_t count, size_t stride);

#endif
