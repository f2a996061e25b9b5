/* A JSON writer. SPDX-License-Identifier: MIT */
#include "json.h"

#include "out.h"

#include <math.h>
#include <stdio.h>

/* Of a character of two or three bytes that does something to a terminal, its code: C1 controls, separators of lines,
 * marks that turn the direction of reading. 0: it may be printed. */
static unsigned escaped(const char *text) {
    const unsigned char *u = (const unsigned char *)text;
    if (u[0] == 0xc2 && u[1] >= 0x80 && u[1] <= 0x9f) {
        return u[1];
    }
    if (u[0] == 0xd8 && u[1] == 0x9c) {
        return 0x61c;
    }
    const unsigned code = u[0] == 0xe2 && u[1] >= 0x80 && u[1] <= 0x81 && u[2] >= 0x80
                              ? 0x2000u + ((u[1] & 1u) << 6) + (u[2] & 0x3fu)
                              : 0;
    return code == 0x200e || code == 0x200f || (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069)
               ? code
               : 0;
}

static void print_text(FILE *stream, const char *text) {
    fputc('"', stream);
    for (const char *c = text; *c; c++) {
        const unsigned code = escaped(c);
        if (code) {
            fprintf(stream, "\\u%04x", code);
            c += code < 0x800 ? 1 : 2;
        } else if (*c == '"' || *c == '\\') {
            fprintf(stream, "\\%c", *c);
        } else if ((unsigned char)*c < 0x20 || *c == 0x7f) {
            fprintf(stream, "\\u%04x", (unsigned)(unsigned char)*c);
        } else {
            fputc(*c, stream);
        }
    }
    fputc('"', stream);
}

static void next_line(const json_writer *json) {
    if (json->pretty && json->depth > 0) {
        fprintf(json->stream, "\n%*s", 2 * json->depth, "");
    }
}

static void begin_value(json_writer *json, const char *key) {
    if (!json->first && json->depth > 0) {
        fputs(json->pretty ? "," : ", ", json->stream);
    }
    json->first = 0;
    next_line(json);
    if (key) {
        print_text(json->stream, key);
        fputs(": ", json->stream);
    }
}

void json_start(json_writer *json, FILE *stream, int pretty) {
    json->stream = stream;
    json->pretty = pretty;
    json->depth = 0;
    json->first = 1;
}

void json_open(json_writer *json, const char *key, char bracket) {
    begin_value(json, key);
    fputc(bracket, json->stream);
    json->depth++;
    json->first = 1;
}

void json_close(json_writer *json, char bracket) {
    json->depth--;
    if (!json->first && json->pretty) {
        fprintf(json->stream, "\n%*s", 2 * json->depth, "");
    }
    fputc(bracket, json->stream);
    if (json->depth == 0) {
        fputc('\n', json->stream);
    }
    json->first = 0;
}

static void print_number(const json_writer *json, double value) {
    if (isfinite(value)) {
        out_number(json->stream, value);
    } else {
        fputs("null", json->stream);
    }
}

void json_number(json_writer *json, const char *key, double value) {
    begin_value(json, key);
    print_number(json, value);
}

void json_numbers(json_writer *json, const char *key, const double *values, size_t count, size_t stride) {
    begin_value(json, key);
    fputc('[', json->stream);
    for (size_t i = 0; i < count; i++) {
        fputs(i > 0 ? ", " : "", json->stream);
        print_number(json, values[i * stride]);
    }
    fputc(']', json->stream);
}

void json_flag(json_writer *json, const char *key, int value) {
    begin_value(json, key);
    fputs(value ? "true" : "false", json->stream);
}

void json_string(json_writer *json, const char *key, const char *value) {
    begin_value(json, key);
    print_text(json->stream, value);
}
