/* What the studies share: the table, files, numbers, progress. SPDX-License-Identifier: MIT */
#include "study.h"

#include <errno.h>
#include <math.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

const study studies[] = {
    {"signals", "figure 2: T1, T2 and T3 at even, odd, 400 Hz and other periods", study_signals},
    {"coverage", "figure 3: the frequencies that can be reached, and the gaps", study_coverage},
    {"temporal", "figure 4: dominant component, net force and correlation, 2 to 35 ms", study_temporal},
    {"device", "figure 11: the same through a simulated Touch", study_device},
    {"gratings", "figure 6, section III: S1 and S2 over direction, speed and depth", study_gratings},
    {"preferences", "figure 8: what subjects preferred, beside these metrics", study_preferences},
    {"tradeoff", "cost against accuracy, each method at each rate", study_tradeoff},
    {"velocity", "what each velocity estimator gets wrong, and how late it is", study_velocity},
    {"locked", "the method locked: in step with the surface at every speed and in strokes", study_locked},
    {"half_cycles", "the impulse of every half cycle, whatever the speed and the tessellation", study_half_cycles},
    {"transitions", "what becomes of an event when hand, surface or material change in it", study_transitions},
    {"failures", "the catalogue of failures: each method, each way it fails, as a number and a trace", study_failures},
    {"stability", "where walls and gratings run away or buzz: checks against theory, and maps", study_stability},
    {NULL, NULL, NULL}};

int study_open(out_file *file, const char *folder, const char *name) {
    char path[1024];
    const int length = snprintf(path, sizeof path, "%s/%s", folder, name);
    memset(file, 0, sizeof *file);
    if (length < 0 || (size_t)length >= sizeof path) {
        fprintf(stderr, "knurl: %s: the path is too long\n", folder);
        return 1;
    }
    if (mkdir(folder, 0777) != 0 && errno != EEXIST) {
        fprintf(stderr, "knurl: %s: the folder cannot be made: %s\n", folder, strerror(errno));
        return 1;
    }
    return out_open(file, path);
}

int study_write(const char *folder, const char *name, int (*write)(FILE *csv, FILE *json, void *user), void *user) {
    char csv_name[64];
    char json_name[64];
    out_file csv;
    out_file json;
    (void)snprintf(csv_name, sizeof csv_name, "%s.csv", name);
    (void)snprintf(json_name, sizeof json_name, "%s.json", name);
    if (study_open(&csv, folder, csv_name)) {
        return 1;
    }
    int failed = study_open(&json, folder, json_name);
    if (!failed && write(csv.stream, json.stream, user)) {
        fprintf(stderr, "knurl: study: %s: no memory\n", name);
        failed = 1;
    }
    failed = failed || out_keep(&csv) || out_keep(&json);
    out_discard(&csv);
    out_discard(&json);
    return failed;
}

void study_json_number(FILE *stream, double value) {
    if (isfinite(value)) {
        out_number(stream, value);
    } else {
        fputs("null", stream);
    }
}

void study_progress(const char *name, double share) {
    if (isatty(STDERR_FILENO)) {
        fprintf(stderr, "\r  %s: %3.0f %%%s", name, 100.0 * share, share >= 1.0 ? "\n" : "");
    }
}
