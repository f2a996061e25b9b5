/* An encoder's counts in recorded positions: found in traces that are rounded here, not in exact ones.
 * SPDX-License-Identifier: MIT */
#include "support/close.h"

#include "device/fake/counts.h"

#include <stdio.h>
#include <stdlib.h>

enum { ROWS = 3000 };

static double rows[ROWS][4];

/* The motions, m at s. */
typedef enum motion { STEADY, SWEEP, CIRCLE, STROKES, MOTIONS } motion;

static const char *const names[MOTIONS] = {"steady", "sweep", "circle", "strokes"};

static double ramp(double t, double speed) { /* back and forth over 40 mm */
    const double way = fmod(speed * t, 0.08);
    return way < 0.04 ? way : 0.08 - way;
}

static void place(motion m, double t, double speed, double p[3]) {
    const double pi = 3.14159265358979323846;
    const double press = 0.005 * exp(-t / 0.05) - 0.001;
    p[0] = m == STEADY ? speed * t : m == SWEEP ? 0.04 * sin(speed / 0.04 * t) : ramp(t, speed);
    p[1] = press;
    p[2] = 0.0;
    if (m == CIRCLE) {
        p[0] = 0.02 * cos(speed / 0.02 * t);
        p[2] = 0.02 * sin(speed / 0.02 * t);
    } else if (m == SWEEP) {
        p[2] = 0.002 * sin(2.0 * pi * 0.7 * t);
    }
}

/* Writes a number with so many decimals, and reads it again; more than 12: exactly. */
static double as_text(double value, int decimals) {
    char text[64];
    (void)snprintf(text, sizeof text, "%.*f", decimals > 12 ? 25 : decimals, value);
    return strtod(text, NULL);
}

/* quantum 0: exact. origin: of the scene, m, added after the text was read, as in the tool. */
static void record(motion m, double rate, double speed, double quantum, int decimals, double origin) {
    for (int i = 0; i < ROWS; i++) {
        double p[3];
        rows[i][0] = i / rate;
        place(m, rows[i][0], speed, p);
        for (int axis = 0; axis < 3; axis++) {
            const double counted = quantum > 0.0 ? floor(p[axis] / quantum + 0.5) * quantum : p[axis];
            rows[i][axis + 1] = as_text(counted + 0.25, decimals) - origin;
        }
    }
}

static double find(void) {
    double quantum = -1.0;
    assert_int_equal(knurl_counts_find(rows[0], ROWS, &quantum), KNURL_OK);
    return quantum;
}

TEST(counts_are_found_in_every_motion_speed_and_text_that_shows_them) {
    static const double quanta[] = {0.055e-3, 0.06e-3, 0.1e-3, 0.0127e-3};
    static const double speeds[] = {0.0123, 0.097, 0.2471};
    static const int decimals[] = {17, 9, 7, 6};
    for (size_t q = 0; q < COUNT_OF(quanta); q++) {
        for (size_t v = 0; v < COUNT_OF(speeds); v++) {
            for (size_t d = 0; d < COUNT_OF(decimals); d++) {
                for (motion m = STEADY; m < MOTIONS; m++) {
                    record(m, 1000.0, speeds[v], quanta[q], decimals[d], 0.0371829);
                    const double found = find();
                    if (!(fabs(found / quanta[q] - 1.0) < 1e-3)) {
                        fail_msg("%s at %g m/s, %g m written with %d decimals: found %g", names[m], speeds[v],
                                 quanta[q], decimals[d], found);
                    }
                }
            }
        }
    }
}

/* 0.055 mm written to 0.01 mm: 5 or 6 of the last digit. */
TEST(counts_of_five_and_a_half_of_the_last_digit_are_found) {
    record(SWEEP, 1000.0, 0.1, 0.055e-3, 5, 0.0);
    CHECK_CLOSE(find(), 0.055e-3, 0.055e-6);
}

TEST(exact_positions_have_no_resolution) {
    static const double speeds[] = {0.01, 0.05, 0.1, 0.2471};
    static const double rates[] = {1000.0, 100.0};
    for (size_t v = 0; v < COUNT_OF(speeds); v++) {
        for (size_t r = 0; r < COUNT_OF(rates); r++) {
            for (motion m = STEADY; m < MOTIONS; m++) {
                record(m, rates[r], speeds[v], 0.0, 17, 0.0371829);
                CHECK_SAME(find(), 0.0L);
                record(m, rates[r], speeds[v], 0.0, 9, 0.0); /* a nanometre: as good as exact */
                CHECK_SAME(find(), 0.0L);
            }
        }
    }
}

/* Steps of one length are a lattice, and no counts: a line, strokes back and forth, stop and go. */
TEST(steady_speeds_are_no_counts) {
    for (int pause = 0; pause < 3; pause++) {
        double x = 0.0;
        for (int i = 0; i < ROWS; i++) {
            const int phase = i % 60;
            x += phase < 20 ? 1.0 : phase < 20 + 10 * pause ? 0.0 : -1.0;
            rows[i][0] = i / 1000.0;
            rows[i][1] = 1e-4 * (pause ? x : i);
            rows[i][2] = rows[i][3] = 0.0;
        }
        CHECK_SAME(find(), 0.0L);
    }
}

/* A text of few digits rounds as an encoder does, and its last digit is the quantum. */
TEST(a_text_s_last_digit_counts) {
    record(SWEEP, 1000.0, 0.1, 0.0, 5, 0.0);
    CHECK_CLOSE(find(), 1e-5, 1e-8);
    record(SWEEP, 1000.0, 0.1, 0.0, 6, 0.25);
    CHECK_CLOSE(find(), 1e-6, 1e-9);
}

TEST(if_one_axis_is_exact_there_are_no_counts) {
    record(SWEEP, 1000.0, 0.1, 0.055e-3, 17, 0.0);
    for (int i = 0; i < ROWS; i++) {
        rows[i][3] = 0.001 * sin(0.003 * i);
    }
    CHECK_SAME(find(), 0.0L);
}

TEST(the_coarsest_axis_counts) {
    record(CIRCLE, 1000.0, 0.1, 0.055e-3, 17, 0.0);
    for (int i = 0; i < ROWS; i++) {
        double p[3];
        place(CIRCLE, i / 1000.0, 0.1, p);
        rows[i][3] = floor(p[2] / 0.1e-3 + 0.5) * 0.1e-3;
    }
    CHECK_CLOSE(find(), 0.1e-3, 1e-9);
}

TEST(few_or_still_rows_have_no_resolution) {
    double quantum = -1.0;
    record(SWEEP, 1000.0, 0.1, 0.055e-3, 17, 0.0);
    assert_int_equal(knurl_counts_find(rows[0], 1, &quantum), KNURL_OK);
    CHECK_SAME(quantum, 0.0L);
    assert_int_equal(knurl_counts_find(rows[0], 8, &quantum), KNURL_OK);
    CHECK_SAME(quantum, 0.0L);
    for (int i = 0; i < ROWS; i++) {
        rows[i][1] = rows[i][2] = rows[i][3] = 0.1;
    }
    CHECK_SAME(find(), 0.0L);
}

/* 0, 2 and 5 of the last digit are on a lattice of 2.5, within that digit. */
TEST(few_values_on_a_lattice_by_chance_are_no_counts) {
    static const double values[] = {0.0, 2.0, 2.0, 5.0, 2.0, 2.0};
    for (int i = 0; i < ROWS; i++) {
        rows[i][0] = i / 1000.0;
        rows[i][1] = 1e-5 * values[i % 6];
        rows[i][2] = rows[i][3] = 0.0;
    }
    CHECK_SAME(find(), 0.0L);
}
