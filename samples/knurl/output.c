/* Files that are whole or not there, numbers that read back, JSON. SPDX-License-Identifier: MIT */
#include "tool.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

int tool_file_open(tool_file *file, const char *path) {
    struct stat existing;
    const int straight = stat(path, &existing) == 0 && !S_ISREG(existing.st_mode);
    const size_t length = strlen(path);
    memset(file, 0, sizeof *file);
    file->path = malloc(length + 1);
    file->partial = straight ? NULL : malloc(length + sizeof ".part");
    if (!file->path || (!straight && !file->partial)) {
        tool_file_discard(file);
        return tool_error(TOOL_FAILURE, "%s: no memory", path);
    }
    memcpy(file->path, path, length + 1);
    if (!straight) {
        memcpy(file->partial, path, length);
        memcpy(file->partial + length, ".part", sizeof ".part");
    }
    file->stream = fopen(straight ? path : file->partial, "w");
    if (!file->stream) {
        const int code = tool_error(TOOL_FAILURE, "%s: cannot be written: %s", path, strerror(errno));
        free(file->partial);
        file->partial = NULL; /* there is nothing to remove */
        tool_file_discard(file);
        return code;
    }
    return TOOL_OK;
}

int tool_file_keep(tool_file *file) {
    int failed = ferror(file->stream);
    failed = fclose(file->stream) != 0 || failed;
    file->stream = NULL;
    failed = failed || (file->partial && rename(file->partial, file->path) != 0);
    if (failed) {
        (void)tool_error(TOOL_FAILURE, "%s: cannot be written: %s", file->path, strerror(errno));
    } else {
        free(file->partial);
        file->partial = NULL;
    }
    tool_file_discard(file);
    return failed ? TOOL_FAILURE : TOOL_OK;
}

void tool_file_discard(tool_file *file) {
    if (file->stream) {
        (void)fclose(file->stream);
    }
    if (file->partial) {
        (void)remove(file->partial);
    }
    free(file->partial);
    free(file->path);
    memset(file, 0, sizeof *file);
}

void tool_print_number(FILE *stream, double value) {
    char text[32];
    (void)snprintf(text, sizeof text, "%.15g", value + 0.0);
    if (strtod(text, NULL) != value) {
        (void)snprintf(text, sizeof text, "%.17g", value + 0.0);
    }
    fputs(text, stream);
}

void tool_print_cell(FILE *stream, const char *text) {
    if (!strpbrk(text, ",\"\r\n")) {
        fputs(text, stream);
        return;
    }
    fputc('"', stream);
    for (const char *c = text; *c; c++) {
        if (*c == '"') {
            fputc('"', stream);
        }
        fputc(*c, stream);
    }
    fputc('"', stream);
}

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
        tool_print_number(stdout, value);
    } else {
        fputs("null", stdout);
    }
}

void json_string(tool_json *json, const char *key, const char *value) {
    begin_value(json, key);
    print_json_text(value);
}

void json_end(tool_json *json) {
    (void)json;
    putchar('\n');
}
