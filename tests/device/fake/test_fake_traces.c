/* Traces that the fake device plays instead of a hand. SPDX-License-Identifier: MIT */
#include "support/close.h"
#include "support/fake.h"

#include <stdio.h>

static const double way[][4] = {{0.010, 0.001, 0.002, 0.003},
                                {0.020, 0.011, 0.002, -0.003},
                                {0.0205, 0.012, 0.0, 0.0}, /* three rows in one tick */
                                {0.0206, 0.013, 0.0, 0.0},
                                {0.0210, 0.014, 0.0, 0.0},
                                {0.031, -0.0123456789, 0.00001234567, 0.5}}; /* outside the workspace: no matter */

static knurl_device *open_trace(const char *uri, const double rows[][4], size_t count) {
    knurl_device *device = open_device(uri);
    assert_int_equal(knurl_fake_set_trace(device, rows[0], count), KNURL_OK);
    assert_int_equal(knurl_device_start(device, RATE), KNURL_OK);
    return device;
}

TEST(a_trace_is_played_exactly_interpolated_between_its_rows_and_held_at_its_ends) {
    static const double pull[3] = {3.0, 3.0, 3.0};
    SCOPED_DEVICE *device = open_trace("fake", way, COUNT_OF(way));
    for (int tick = 0; tick < 60; tick++) {
        double expected[3];
        const double *from = tick < 21 ? way[0] : way[4];
        const double *to = tick < 21 ? way[1] : way[5];
        const double part = fmin(fmax((tick * 0.001 - from[0]) / (to[0] - from[0]), 0.0), 1.0);
        for (int axis = 0; axis < 3; axis++) {
            expected[axis] = from[axis + 1] + part * (to[axis + 1] - from[axis + 1]);
        }
        const knurl_device_sample sample = read_one(device);
        for (int axis = 0; axis < 3; axis++) { /* a time is off by 1e-17 s of 0.01 s */
            CHECK_CLOSE(sample.position[axis], expected[axis], 1e-14);
        }
        assert_int_equal(knurl_device_write(device, pull), KNURL_OK); /* no force moves it */
    }
}

TEST(a_trace_of_a_row_a_tick_is_reported_to_the_last_digit) {
    static double rows[2000][4];
    uint64_t random = 4;
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        rows[i][0] = (double)i / RATE;
        for (int axis = 1; axis < 4; axis++) {
            rows[i][axis] = random_between(&random, -0.05, 0.05);
        }
    }
    SCOPED_DEVICE *device = open_trace("fake", (const double (*)[4])rows, COUNT_OF(rows));
    for (size_t tick = 0; tick < COUNT_OF(rows); tick++) {
        const knurl_device_sample sample = read_one(device);
        for (int axis = 0; axis < 3; axis++) { /* not quantised: 55 um would show */
            CHECK_CLOSE(sample.position[axis], rows[tick][axis + 1], 1e-13);
        }
    }
}

TEST(a_trace_is_quantised_only_where_the_uri_names_a_resolution) {
    knurl_device *device = open_trace("fake", way, COUNT_OF(way));
    knurl_device_info info = device_info(device);
    CHECK_SAME(info.resolution, 0.0L);
    knurl_device_close(device);
    device = open_trace("fake:?resolution=0.0001", way, COUNT_OF(way));
    info = device_info(device);
    CHECK_SAME(info.resolution, 0.0001);
    knurl_device_sample sample = read_one(device);
    for (int tick = 1; tick < 60; tick++) {
        sample = read_one(device);
        for (int axis = 0; axis < 3; axis++) {
            const double counts = sample.position[axis] / 0.0001;
            CHECK_CLOSE(counts, round(counts), 1e-9);
        }
    }
    CHECK_CLOSE(sample.position[0], -0.0123, 1e-12); /* -12.346 mm to the nearest */
    CHECK_CLOSE(sample.position[1], 0.0, 1e-12);
    knurl_device_close(device);
}

TEST(a_trace_is_copied_and_starts_anew_with_its_device) {
    double rows[3][4] = {{0.0, 0.01, 0.0, 0.0}, {0.2, 0.012, 0.0, 0.0}, {1.0, 0.02, 0.0, 0.0}};
    SCOPED_DEVICE *device = open_trace("fake", (const double (*)[4])rows, COUNT_OF(rows));
    memset(rows, 0, sizeof rows);
    for (int turn = 0; turn < 2; turn++) {
        assert_int_equal(knurl_device_start(device, RATE), KNURL_OK);
        for (int tick = 0; tick < 500; tick++) {
            CHECK_CLOSE(read_one(device).position[0], 0.01 + 0.01 * tick / RATE, 1e-12);
        }
    }
    stand(device); /* a stroke brings the hand back */
    CHECK_CLOSE(read_one(device).position[0], 0.0, 1e-3);
}

TEST(a_bad_trace_is_refused_in_a_sentence_that_names_its_row) {
    static const double flaws[] = {NAN, HUGE_VAL, -HUGE_VAL};
    SCOPED_DEVICE *device = open_device("fake");
    double rows[3][4] = {{0.0, 0.0, 0.0, 0.0}, {0.001, 0.0, 0.0, 0.0}, {0.002, 0.0, 0.0, 0.0}};
    for (size_t i = 0; i < 3 * COUNT_OF(flaws) * 4; i++) {
        char row[16];
        double *cell = &rows[i / 4 % 3][i % 4];
        const double before = *cell;
        (void)snprintf(row, sizeof row, "row %d", (int)(i / 4 % 3) + 1);
        *cell = flaws[i / 12];
        CHECK_REFUSED(knurl_fake_set_trace(device, rows[0], 3), KNURL_ERROR_ARGUMENT, rows);
        assert_non_null(strstr(knurl_error_message(), row));
        *cell = before;
    }
    rows[2][0] = 0.001; /* twice the same time */
    CHECK_REFUSED(knurl_fake_set_trace(device, rows[0], 3), KNURL_ERROR_ARGUMENT, rows);
    assert_non_null(strstr(knurl_error_message(), "row 3"));
    CHECK_REFUSED(knurl_fake_set_trace(device, rows[0], 0), KNURL_ERROR_ARGUMENT, rows);
    CHECK_REFUSED(knurl_fake_set_trace(device, NULL, 3), KNURL_ERROR_ARGUMENT, rows);
}
