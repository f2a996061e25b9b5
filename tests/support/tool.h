/* The command-line tool in a test: run with arguments, its output, a folder for its files.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_TOOL_H
#define KNURL_TEST_TOOL_H

#include "support/process.h"

#include <dirent.h>
#include <sys/stat.h>

static char tool_folder[512]; /* this program's own, empty at the start of a group of tests */

/** Runs `knurl` with the arguments that follow. The caller frees. */
#define RUN_TOOL(...) run_tool((const char *const[]){KNURL_TEST_TOOL, __VA_ARGS__, NULL})

/** A path in the folder; overwritten by the eighth call after. */
static inline const char *tool_path(const char *name) {
    static char paths[8][1024];
    static unsigned next;
    char *path = paths[next++ % 8];
    assert_true(tool_folder[0]); /* made by make_folder(), or files would be written to / */
    (void)snprintf(path, sizeof paths[0], "%s/%s", tool_folder, name);
    return path;
}

static inline process run_tool(const char *const *arguments) {
    process p = process_start(arguments, NULL);
    process_finish(&p);
    return p;
}

static inline size_t lines_in(const char *text) {
    size_t lines = 0;
    for (; *text; text++) {
        lines += *text == '\n';
    }
    return lines;
}

/** Files in the folder whose name ends with `ending`. */
static inline size_t files_that_end(const char *ending) {
    size_t count = 0;
    DIR *folder = opendir(tool_folder);
    if (!folder) {
        fail_msg("no folder %s", tool_folder);
        return 0;
    }
    for (const struct dirent *entry = readdir(folder); entry; entry = readdir(folder)) {
        const size_t length = strlen(entry->d_name);
        count += length >= strlen(ending) && strcmp(entry->d_name + length - strlen(ending), ending) == 0;
    }
    (void)closedir(folder);
    return count;
}

static inline void write_file(const char *path, const void *data, size_t size) {
    FILE *file = fopen(path, "wb");
    if (!file) {
        fail_msg("%s cannot be written", path);
        return;
    }
    assert_int_equal(fwrite(data, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static inline void write_text(const char *path, const char *text) {
    write_file(path, text, strlen(text));
}

/** The whole file, ended by a 0; the caller frees it. Fails if there is no file. */
static inline char *read_file(const char *path) {
    FILE *file = fopen(path, "rb");
    struct stat info;
    assert_int_equal(stat(path, &info), 0);
    if (!file) {
        fail_msg("%s cannot be read", path);
        return NULL;
    }
    const size_t size = (size_t)info.st_size;
    char *text = calloc(size + 1, 1);
    const size_t got = text ? fread(text, 1, size, file) : 0;
    (void)fclose(file);
    assert_int_equal(got, size);
    return text;
}

static inline int file_exists(const char *path) {
    struct stat info;
    return stat(path, &info) == 0;
}

/** It ended by itself with `code`, said exactly one line on standard error, which holds every one of `words` (apart by
 * '|'), and nothing on standard output. Frees. */
static inline void check_refused(process *p, int code, const char *words, const char *what) {
    char all[256];
    char *word = all;
    (void)snprintf(all, sizeof all, "%s", words);
    const size_t length = strlen(p->err);
    int good = p->signal == 0 && p->exit_code == code && p->sizes[0] == 0 && strncmp(p->err, "knurl: ", 7) == 0 &&
               lines_in(p->err) == 1 && p->err[length - 1] == '\n' && !strchr(p->err, '\r');
    for (char *end = all; good && end; word = end + 1) {
        end = strchr(word, '|');
        if (end) {
            *end = '\0';
        }
        good = strstr(p->err, word) != NULL;
        if (!end || !good) {
            break;
        }
    }
    if (!good) {
        fail_msg("%s: exit %d instead of %d, signal %d, out \"%.60s\", wanted \"%s\" in one line: %s", what,
                 p->exit_code, code, p->signal, p->out, word, p->err);
    }
    process_free(p);
}

/** One wrong command line: its words, apart by spaces, the exit code, and words of the sentence, apart by '|'. A word
 * may begin with %P, the demo plate, or %T, the folder. */
typedef struct wrong_line {
    const char *line;
    int code;
    const char *words;
} wrong_line;

/** Also that no output is left: out.csv, out.gltf or a part of one. */
static inline void check_wrong(const wrong_line *w) {
    char text[1024];
    char expanded[16][1024];
    const char *arguments[PROCESS_ARGUMENTS + 1] = {KNURL_TEST_TOOL};
    size_t count = 1;
    (void)snprintf(text, sizeof text, "%s", w->line);
    for (char *word = strtok(text, " "); word && count <= sizeof expanded / sizeof *expanded;
         word = strtok(NULL, " ")) {
        const char *head = strncmp(word, "%P", 2) == 0   ? KNURL_TEST_ASSETS "/plate_1d.glb"
                           : strncmp(word, "%T", 2) == 0 ? tool_folder
                                                         : "";
        (void)snprintf(expanded[count - 1], sizeof expanded[0], "%s%s", head, head[0] ? word + 2 : word);
        arguments[count] = expanded[count - 1];
        count++;
    }
    process p = run_tool(arguments);
    check_refused(&p, w->code, w->words, w->line);
    assert_int_equal(files_that_end(".part"), 0);
    assert_false(file_exists(tool_path("out.csv")) || file_exists(tool_path("out.gltf")));
}

/** It went well, and said nothing on standard error but notes, a line each. */
static inline void check_done(const process *p) {
    int good = p->signal == 0 && p->exit_code == 0 && !strchr(p->err, '\r') && !strchr(p->err, '\033');
    for (const char *line = p->err; good && *line; line = strchr(line, '\n') + 1) {
        good =
            (strncmp(line, "knurl: note: ", 13) == 0 || strncmp(line, "knurl: hint: ", 13) == 0) && strchr(line, '\n');
    }
    if (!good) {
        fail_msg("exit %d, signal %d: %s", p->exit_code, p->signal, p->err);
    }
}

/** The number behind "key": in a JSON text. */
static inline double json_number_of(const char *json, const char *key) {
    char quoted[64];
    (void)snprintf(quoted, sizeof quoted, "\"%s\":", key);
    const char *found = strstr(json, quoted);
    if (!found) {
        fail_msg("no %s in %s", quoted, json);
        return NAN;
    }
    return strtod(found + strlen(quoted), NULL);
}

/** Row `row` (0: the one after the header) of a CSV of numbers; empty cells become NaN. Returns the number of cells. */
static inline size_t csv_row(const char *csv, size_t row, double *cells, size_t room) {
    const char *line = csv;
    for (size_t i = 0; i <= row; i++) {
        line = strchr(line, '\n');
        assert_non_null(line);
        line++;
    }
    size_t count = 0;
    for (const char *cell = line; count < room; count++) {
        char *end = NULL;
        cells[count] = strtod(cell, &end);
        cells[count] = end == cell ? NAN : cells[count];
        cell = cell + strcspn(cell, ",\n");
        if (*cell++ != ',') {
            return count + 1;
        }
    }
    return count;
}

/** A 100 x 100 mm plate round (0.25, 0.5, -0.125) m that faces up, as a .gltf and plate.bin; `extras` is its
 * material's, or "". */
static inline const char *write_plate(const char *name, const char *extras) {
    static const float corners[18] = {-0.05F, 0, 0.05F, 0.05F, 0, 0.05F,  0.05F,  0, -0.05F,
                                      -0.05F, 0, 0.05F, 0.05F, 0, -0.05F, -0.05F, 0, -0.05F};
    char text[2048];
    (void)snprintf(text, sizeof text,
                   "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
                   "\"nodes\":[{\"name\":\"plate\",\"mesh\":0,\"translation\":[0.25,0.5,-0.125]}],"
                   "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0}]}],"
                   "\"materials\":[{\"name\":\"ridges\"%s%s}],"
                   "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":6,\"type\":\"VEC3\","
                   "\"min\":[-0.05,0,-0.05],\"max\":[0.05,0,0.05]}],"
                   "\"bufferViews\":[{\"buffer\":0,\"byteLength\":72}],"
                   "\"buffers\":[{\"uri\":\"plate.bin\",\"byteLength\":72}]}",
                   extras[0] ? ",\"extras\":" : "", extras);
    write_file(tool_path("plate.bin"), corners, sizeof corners);
    write_text(tool_path(name), text);
    return tool_path(name);
}

/** Group setup and teardown: the folder. */
static inline int make_folder(void **state) {
    (void)state;
    (void)snprintf(tool_folder, sizeof tool_folder, "%s/tool_%ld", KNURL_TEST_TMP, (long)getpid());
    return mkdir(tool_folder, 0777);
}

static inline int remove_folder(void **state) {
    (void)state;
    DIR *folder = opendir(tool_folder);
    for (const struct dirent *entry = folder ? readdir(folder) : NULL; entry; entry = readdir(folder)) {
        if (entry->d_name[0] != '.' || strlen(entry->d_name) > 2) {
            (void)remove(tool_path(entry->d_name));
        }
    }
    if (folder) {
        (void)closedir(folder);
    }
    return rmdir(tool_folder);
}

#endif
