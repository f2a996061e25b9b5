/* Gratings over scan direction and speed. SPDX-License-Identifier: MIT */
#include "gratings.h"
#include "study.h"

#include <math.h>
#include <string.h>

#define DEGREE 0.017453292519943295
#define ANGLES 182 /* every half degree from 0 to 90, and the diagonal of the cells */

static const double gratings[2][2] = {{1000.0, 500.0}, {1000.0, 1000.0}};

/* A start inside a cell from which no straight scan of this study meets a corner. In cycles. */
static const double generic_start[2] = {0.137, 0.071};

typedef struct direction_row {
    double angle, map, path, played, played_centre; /* degrees; cycles/m */
} direction_row;

/* cycles/m that S1 plays over 1 m at 0.1 m/s, from a start given in cycles; negative: no memory */
static double s1_played(const double fs[2], const double start[2], const double direction[2]) {
    const knurl_grating grating = gratings_make(KNURL_METHOD_S1, fs[0], fs[1]);
    const double from[2] = {start[0] / fs[0], start[1] / fs[1]};
    const double velocity[2] = {0.1 * direction[0], 0.1 * direction[1]};
    study_scan scan;
    if (!gratings_scan_line(&grating, from, velocity, 10000, &scan)) {
        return -1.0;
    }
    const double played = scan.played[scan.ticks];
    study_scan_free(&scan);
    return played;
}

/* All angles of a grating, including the diagonal. 0: out of memory. */
static int direction_rows(const double fs[2], direction_row rows[ANGLES]) {
    static const double centre[2] = {0.0, 0.0};
    const double diagonal = atan2(fs[0], fs[1]) / DEGREE;
    int after = 0;
    for (int i = 0; i < ANGLES; i++) {
        const double next = 0.5 * (i - after);
        const int on_diagonal = !after && next >= diagonal - 1e-9;
        direction_row *row = &rows[i];
        row->angle = on_diagonal ? diagonal : next;
        after |= on_diagonal;
        /* on the diagonal both phases must be exactly equal, without rounding */
        const double length = hypot(fs[0], fs[1]);
        const double c = on_diagonal ? fs[1] / length : cos(row->angle * DEGREE);
        const double s = on_diagonal ? fs[0] / length : sin(row->angle * DEGREE);
        const double direction[2] = {c, s};
        row->map = fs[0] * c + fs[1] * s;
        row->path = knurl_grating_frequency(fs, direction);
        row->played = s1_played(fs, generic_start, direction);
        row->played_centre = s1_played(fs, centre, direction);
        if (row->played < 0.0 || row->played_centre < 0.0) {
            return 0;
        }
    }
    return 1;
}

static void summarise(const direction_row *row, gratings_summary *summary) {
    summary->grid_lost = fmax(summary->grid_lost, 1.0 - row->played / row->map);
    if (row->map / row->path > summary->map_over_path) {
        summary->map_over_path = row->map / row->path;
        summary->angle_of_ratio = row->angle;
        summary->silent_diagonal = row->played_centre;
    }
}

int gratings_directions(json_writer *json, gratings_summary *summary) {
    json_open(json, "directions", '[');
    for (int g = 0; g < 2; g++) {
        direction_row rows[ANGLES];
        const size_t stride = sizeof *rows / sizeof(double);
        if (!direction_rows(gratings[g], rows)) {
            return 0;
        }
        for (int i = 0; g == 1 && i < ANGLES; i++) {
            summarise(&rows[i], summary);
        }
        json_open(json, NULL, '{');
        json_numbers(json, "spatial_frequency", gratings[g], 2, 1);
        json_number(json, "diagonal_deg", atan2(gratings[g][0], gratings[g][1]) / DEGREE);
        json_numbers(json, "angle_deg", &rows[0].angle, ANGLES, stride);
        json_numbers(json, "eq11", &rows[0].map, ANGLES, stride);
        json_numbers(json, "eq12", &rows[0].path, ANGLES, stride);
        json_numbers(json, "s1_played", &rows[0].played, ANGLES, stride);
        json_numbers(json, "s1_played_through_centres", &rows[0].played_centre, ANGLES, stride);
        json_close(json, '}');
    }
    json_close(json, ']');
    return 1;
}

/* One cell of the map: S1's mean dropout over starts, S2's drift and dropout. */
static int map_row(FILE *csv, const double fs[2], double angle, double speed) {
    const double velocity[2] = {speed * cos(angle * DEGREE), speed * sin(angle * DEGREE)};
    const knurl_grating s1 = gratings_make(KNURL_METHOD_S1, fs[0], fs[1]);
    const knurl_grating s2 = gratings_make(KNURL_METHOD_S2, fs[0], fs[1]);
    double dropout = 0.0;
    study_scan scan;
    for (int i = 0; i < 4; i++) {
        const double start[2] = {(generic_start[0] + 0.25 * i) / fs[0], (generic_start[1] + 0.111 * i) / fs[1]};
        if (!gratings_scan_line(&s1, start, velocity, 1000, &scan)) {
            return 0;
        }
        dropout += 0.25 * study_scan_dropout(&scan);
        study_scan_free(&scan);
    }
    if (!gratings_scan_line(&s2, generic_start, velocity, 1000, &scan)) {
        return 0;
    }
    const double row[] = {angle,
                          speed,
                          fs[0] * velocity[0] + fs[1] * velocity[1],
                          knurl_grating_frequency(fs, velocity),
                          dropout,
                          study_scan_drift(&scan),
                          study_scan_dropout(&scan)};
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        fputs(i > 0 ? "," : "", csv);
        out_number(csv, row[i]);
    }
    fputc('\n', csv);
    study_scan_free(&scan);
    return 1;
}

int gratings_map(FILE *csv, json_writer *json) {
    const double *fs = gratings[0];
    json_open(json, "map", '{');
    json_string(json, "rows",
                "gratings.csv: 1 s at a steady speed; S1 from four starts, against Eq. 11; S2 against Eq. 12");
    json_numbers(json, "spatial_frequency", fs, 2, 1);
    json_close(json, '}');
    fputs("angle_deg,speed,eq11_hz,ft,s1_dropout,s2_drift,s2_dropout\n", csv);
    for (int a = 0; a <= 90; a += 2) {
        for (int v = 1; v <= 120; v++) {
            if (!map_row(csv, fs, a, 0.01 * v)) {
                return 0;
            }
        }
        study_progress("gratings", a / 90.0);
    }
    return 1;
}
