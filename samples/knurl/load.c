/* Loading a glTF file: --budget, and progress on a terminal. SPDX-License-Identifier: MIT */
#include "tool.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { SURFACES, BYTES, VERTICES, TRIANGLES, SECONDS, LIMITS };

/* Parses one NAME=N. 0 if it is invalid. */
static int read_limit(const char *pair, size_t length, double limits[LIMITS]) {
    static const char *const names[LIMITS] = {"surfaces=", "bytes=", "vertices=", "triangles=", "seconds="};
    for (int i = 0; i < LIMITS; i++) {
        if (strncmp(pair, names[i], strlen(names[i])) == 0) {
            char *end = NULL;
            const char *digits = pair + strlen(names[i]);
            limits[i] = strtod(digits, &end);
            if (end == digits || end != pair + length) {
                return 0;
            }
            return i == SECONDS ? limits[i] >= 1e-9 && limits[i] <= 9e15
                                : limits[i] >= 1.0 && limits[i] <= (i == SURFACES ? UINT32_MAX : 9e15) &&
                                      limits[i] == floor(limits[i]);
        }
    }
    return 0;
}

int tool_parse_budget(const char *text, knurl_gltf_options *budget) {
    double limits[LIMITS] = {0.0};
    for (const char *pair = text, *end; pair; pair = *end ? end + 1 : NULL) {
        end = pair + strcspn(pair, ",");
        if (!read_limit(pair, (size_t)(end - pair), limits)) {
            return tool_error(TOOL_USAGE,
                              "--budget: expected surfaces=, bytes=, vertices= or triangles= and a whole number, or "
                              "seconds= and a number, above 0, several with commas between, found '%s'",
                              text);
        }
    }
    knurl_gltf_options_init(budget, sizeof *budget);
    budget->max_surfaces = (uint32_t)limits[SURFACES];
    budget->max_bytes = (uint64_t)limits[BYTES];
    budget->max_vertices = (uint64_t)limits[VERTICES];
    budget->max_triangles = (uint64_t)limits[TRIANGLES];
    budget->max_seconds = limits[SECONDS];
    return TOOL_OK;
}

typedef struct progress {
    double next; /* s: time of the next line */
} progress;

static double now(void) {
    struct timespec t;
    (void)clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int32_t show_progress(void *user, double done) {
    progress *p = user;
    if (now() >= p->next) {
        say_progress("loading: %3.0f %%", 100.0 * done);
        p->next = now() + 0.1;
    }
    return 0;
}

static void tell_file(void *user, const char *path) {
    (void)user;
    out_protect(path);
}

knurl_result tool_load(knurl_scene *scene, const char *path, const knurl_gltf_options *budget, uint32_t *skipped) {
    knurl_gltf_options options = *budget;
    knurl_gltf_report report;
    progress p = {now() + 0.5}; /* shorter loads need no line */
    knurl_gltf_report_init(&report, sizeof report);
    options.file_read = tell_file;
    options.user = &p;
    options.progress = show_progress;
    const knurl_result result = knurl_gltf_load_file(scene, path, &options, &report);
    say_progress_end();
    *skipped = report.skipped;
    return result;
}
