/* Shared by the studies: files, numbers, progress. SPDX-License-Identifier: MIT */
#include "study_out.h"

#include "os.h"
#include "say.h"

#include <errno.h>
#include <math.h>
#include <string.h>

void study_end_row(FILE *csv, const double *cells, size_t count) {
    for (size_t i = 0; i < count; i++) {
        fputc(',', csv);
        if (isfinite(cells[i])) {
            out_number(csv, cells[i]);
        }
    }
    fputc('\n', csv);
}

int study_open(out_file *file, const char *folder, const char *name) {
    char path[1024];
    const int length = snprintf(path, sizeof path, "%s/%s", folder, name);
    memset(file, 0, sizeof *file);
    if (length < 0 || (size_t)length >= sizeof path) {
        return tool_error(1, "%s: the path is too long", folder);
    }
    if (os_make_folder(folder) != 0 && errno != EEXIST) {
        return tool_error(1, "%s: the folder cannot be made: %s", folder, strerror(errno));
    }
    return out_open(file, path);
}

int study_write(const char *folder, const char *name, int (*write)(FILE *csv, json_writer *json, void *user),
                void *user) {
    char csv_name[64];
    char json_name[64];
    out_file csv;
    out_file json;
    json_writer object;
    (void)snprintf(csv_name, sizeof csv_name, "%s.csv", name);
    (void)snprintf(json_name, sizeof json_name, "%s.json", name);
    if (study_open(&csv, folder, csv_name)) {
        return 1;
    }
    int failed = study_open(&json, folder, json_name);
    if (!failed) {
        json_start(&object, json.stream, 1);
        json_open(&object, NULL, '{');
        failed = write(csv.stream, &object, user);
        json_close(&object, '}');
        if (failed == 1) {
            (void)tool_error(1, "study: %s: no memory", name);
        }
    }
    failed = failed || out_keep(&csv) || out_keep(&json);
    out_discard(&csv);
    out_discard(&json);
    return failed != 0;
}

void study_progress(const char *name, double share) {
    say_progress("  %s: %3.0f %%", name, 100.0 * share);
    if (share >= 1.0) {
        say_progress_end();
    }
}
