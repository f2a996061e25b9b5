/* JSON on stdout. SPDX-License-Identifier: MIT */
#include "json.h"

#include "out.h"

#include <math.h>
#include <stdio.h>

static void print_json_text(const char *text) {
    putchar('"');
    for (const char *c = text; *c; c++) {
        if (*c == '"' || *c == '\\') {
            printf("\\%c", *c);
        } else if ((unsigned char)*c < 0x20) {
            printf("\\u%04x", (unsigned)(unsigned char)*c);
        } else {
            putchar(*c);
        }
    }
    putchar('"');
}

static void next_line(const tool_json *json) {
    if (json->pretty && json->depth > 0) {
        printf("\n%*s", 2 * json->depth, "");
    }
}

static void begin_value(tool_json *json, const char *key) {
    if (!json->first && json->depth > 0) {
        fputs(json->pretty ? "," : ", ", stdout);
    }
    json->first = 0;
    next_line(json);
    if (key) {
        print_json_text(key);
        fputs(": ", stdout);
    }
}

void json_open(tool_json *json, const char *key, char bracket) {
    begin_value(json, key);
    putchar(bracket);
    json->depth++;
    json->first = 1;
}

void json_close(tool_json *json, char bracket) {
    json->depth--;
    if (!json->first && json->pretty) {
        printf("\n%*s", 2 * json->depth, "");
    }
    putchar(bracket);
    json->first = 0;
}

void json_number(tool_json *json, const char *key, double value) {
    begin_value(json, key);
    if (isfinite(value)) {
        out_number(stdout, value);
    } else {
        fputs("null", stdout);
    }
}

void json_flag(tool_json *json, const char *key, int value) {
    begin_value(json, key);
    fputs(value ? "true" : "false", stdout);
}

void json_string(tool_json *json, const char *key, const char *value) {
    begin_value(json, key);
    print_json_text(value);
}

void json_end(tool_json *json) {
    (void)json;
    putchar('\n');
}
