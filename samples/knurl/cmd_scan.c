/* knurl scan: a grating under given motion, as CSV. SPDX-License-Identifier: MIT */
#include "tool.h"

#include <knurl/knurl.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The HIP's motion at one tick: missing columns are derived from the others. */
typedef struct motion {
    double position[2];
    double velocity[2];
} motion;

static void next_motion(const double *row, int is_position, uint64_t tick, double rate, motion *m) {
    for (int i = 0; i < 2; i++) {
        if (is_position) {
            m->velocity[i] = tick > 0 ? (row[i] - m->position[i]) * rate : 0.0;
            m->position[i] = row[i];
        } else {
            m->velocity[i] = row[i];
            m->position[i] += row[i] / rate; /* from 0 */
        }
    }
}

static void print_scan(const knurl_grating *grating, const tool_table *table, int is_position) {
    knurl_grating_state state;
    csv_writer csv;
    motion m;
    memset(&state, 0, sizeof state);
    memset(&m, 0, sizeof m);
    csv_start(&csv, stdout, "tick,height,fs,ft,event");
    for (uint64_t tick = 0; tick < table->row_count; tick++) {
        knurl_grating_output output;
        next_motion(&table->cells[2 * tick], is_position, tick, grating->update_rate_hz, &m);
        knurl_grating_step(grating, &state, m.position, m.velocity, &output);
        csv_number(&csv, (double)tick);
        csv_number(&csv, output.height);
        csv_number(&csv, output.spatial_frequency);
        csv_number(&csv, output.temporal_frequency);
        if (output.event == KNURL_NO_EVENT) {
            csv_word(&csv, "none");
        } else {
            csv_number(&csv, (double)output.event);
        }
        csv_end_row(&csv);
    }
}

/* Reads the options into a checked grating and the path of its motion. */
static int read_options(int argc, char **argv, knurl_grating *grating, const char **path) {
    const char *method = NULL;
    const char *fs = NULL;
    double amplitude = NAN;
    double rate = 1000.0;
    const tool_option options[] = {{"--method", TOOL_TEXT, &method, 0, 0, ""},
                                   {"--fs", TOOL_TEXT, &fs, 0, 0, ""},
                                   {"--amplitude", TOOL_NUMBER, &amplitude, 0.0, 1e6, "m"},
                                   {"--rate", TOOL_NUMBER, &rate, 1.0, 100000.0, "Hz"},
                                   {"--in", TOOL_TEXT, path, 0, 0, ""}};
    if (tool_parse(argc, argv, options, 5, NULL) != TOOL_OK) {
        return TOOL_USAGE;
    }
    const char *missing = !method            ? "--method"
                          : !fs              ? "--fs"
                          : isnan(amplitude) ? "--amplitude"
                          : *path            ? NULL
                                             : "--in";
    if (missing) {
        return tool_error(TOOL_USAGE, "scan: expected --method, --fs, --amplitude and --in, found no %s", missing);
    }
    if (!tool_parse_pair(fs, grating->spatial_frequency)) {
        return tool_error(TOOL_USAGE, "scan: --fs: expected FSX,FSY in cycles/m, found '%s'", fs);
    }
    if (knurl_method_from_name(method, &grating->method)) {
        return tool_library_error(TOOL_USAGE, "scan");
    }
    grating->amplitude = amplitude;
    grating->update_rate_hz = rate;
    const knurl_result result = knurl_grating_check(grating);
    return result ? tool_library_error(result == KNURL_ERROR_UNSUPPORTED ? TOOL_FAILURE : TOOL_USAGE, "scan") : TOOL_OK;
}

int cmd_scan(int argc, char **argv) {
    static const char *const positions[] = {"x", "y"};
    static const char *const velocities[] = {"vx", "vy"};
    const char *path = NULL;
    knurl_grating grating;
    tool_table table;
    memset(&grating, 0, sizeof grating);
    int code = read_options(argc, argv, &grating, &path);
    if (code != TOOL_OK) {
        return code;
    }
    if (strcmp(path, "-") == 0) { /* its header is read twice */
        return tool_error(TOOL_USAGE, "scan: expected a CSV file, found '-'; only run's --trace reads standard input");
    }
    const int is_position = !tool_csv_has(path, "vx");
    code = tool_read_csv(path, is_position ? positions : velocities, 2, &table);
    if (code == TOOL_OK) {
        print_scan(&grating, &table, is_position);
        free(table.cells);
    }
    return code;
}
