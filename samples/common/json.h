/* JSON on stdout, for the tool and the studies. SPDX-License-Identifier: MIT */
#ifndef KNURL_SAMPLES_JSON_H
#define KNURL_SAMPLES_JSON_H

/* JSON to stdout, on one line unless pretty. */
typedef struct tool_json {
    int pretty;
    int depth;
    int first;
} tool_json;

void json_open(tool_json *json, const char *key, char bracket); /* '{' or '[' */
void json_close(tool_json *json, char bracket);                 /* '}' or ']' */
void json_number(tool_json *json, const char *key, double value);
void json_flag(tool_json *json, const char *key, int value);
void json_string(tool_json *json, const char *key, const char *value);
void json_end(tool_json *json); /* the last newline */

#endif
