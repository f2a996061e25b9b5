/* Gains for even sensation from a response file. SPDX-License-Identifier: MIT */
#include "support/close.h"

#include <knurl/hip.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define HEAD "# knurl response 1\nfrequency_hz,gain\n"

static knurl_result gains_of(const char *file, size_t size, knurl_gain gains[KNURL_GAINS]) {
    char *exact = malloc(size ? size : 1); /* so that a sanitizer sees a byte read beyond it */
    assert_non_null(exact);
    memcpy(exact, file, size);
    const knurl_result result = knurl_gains_from_response(exact, size, gains);
    free(exact);
    return result;
}

/* A response over which a fingertip feels every frequency equally: its threshold. Only the square wave's harmonics up
 * to the file's end remain: 1/n each. */
TEST(gains_level_the_power_of_all_harmonics_that_the_file_reaches) {
    static char file[32768] = HEAD;
    knurl_gain gains[KNURL_GAINS];
    double last = 0.0;
    for (double hz = 20.0; hz <= 500.0; hz *= 1.01) {
        last = hz;
        const double share = hz < 40.0 ? 0.16 : hz / 250.0;
        const size_t used = strlen(file);
        (void)snprintf(file + used, sizeof file - used, "%.9g,%.9g\r\n", hz,
                       hz < 250.0 ? 1.0 / (share * share) : share * share);
    }
    assert_int_equal(gains_of(file, strlen(file), gains), KNURL_OK);
    for (int i = 0; i < KNURL_GAINS; i++) {
        double power = 0.0;
        CHECK_CLOSE(gains[i].hz, 20.0 * pow(2.0, i / 16.0), 1e-12L);
        for (double n = 1.0; n * gains[i].hz <= last; n += 2.0) {
            power += 1.0 / (n * n);
        }
        CHECK_CLOSE(gains[i].gain, 1.0 / sqrt(power), 5e-3L); /* the rows miss the corner at 40 Hz */
    }
}

/* A resonance of four times at gain 37, 99.3486 Hz, is lowered to its surroundings, gain 48, 160 Hz; weaker gains above
 * 310 Hz stay. Felt: 0.1024 elsewhere up to 250 Hz, so that a third harmonic adds 1e-5 at most. */
TEST(a_peak_is_lowered_and_weaker_gains_above_310_hz_stay) {
    static const char file[] =
        "\xef\xbb\xbf" HEAD "# a comment\n20,4\n25,4\n40,4\n\n90,0.790123\n99.3486,2.594325\n110,0.528926\n250,0.1024\n"
        "400,1e-6\n500,1e-6\n";
    knurl_gain gains[KNURL_GAINS];
    assert_int_equal(gains_of(file, sizeof file - 1, gains), KNURL_OK);
    for (int i = 0; i < KNURL_GAINS; i++) {
        assert_true(gains[i].hz < 310.0 ? gains[i].gain <= 1.0 : gains[i].gain == 1.0);
    }
    CHECK_CLOSE(gains[37].gain / gains[48].gain, 0.25, 1e-3);
}

/* A gap from 301 to 309 Hz: gain 63, 306.4 Hz, is in it and stays; all gains between 25 and 300 Hz are lowered to its
 * strength, 1 % of theirs. */
TEST(ridges_at_300_hz_are_as_strong_although_the_next_gain_above_is_of_a_weaker_frequency) {
    static const char file[] =
        HEAD "20,1\n40,1\n250,0.0256\n301,0.0371\n301.1,0.0003\n309,0.0003\n309.1,0.04\n500,0.1\n";
    knurl_gain gains[KNURL_GAINS];
    assert_int_equal(gains_of(file, sizeof file - 1, gains), KNURL_OK);
    assert_true(gains[62].hz < 300.0 && gains[62].gain < 0.02);
    assert_true(gains[63].hz > 300.0 && gains[63].hz < 310.0);
    CHECK_SAME(gains[63].gain, 1.0);
}

/* Faults of a file, and their messages. */
static const struct {
    const char *file, *sentence;
} bad[] = {
    {"", "expected a response of 1 to 65536 bytes, found 0"},
    {"\xef\xbb\xbf", "expected a response of 1 to 65536 bytes, found 0"},
    {"frequency_hz,gain\n", "line 1: expected '# knurl response 1', found 'frequency_hz,gain'"},
    {"\xff\xfe#", "line 1: expected '# knurl response 1', found '"},
    {"# knurl response 2\n", "line 1: expected version 1, found '# knurl response 2'"},
    {"# knurl response 1\nhz,gain\n20,1\n", "line 2: expected the header frequency_hz,gain, found 'hz,gain'"},
    {HEAD, "expected rows from 25 Hz or less to 300 Hz or more, found 0"},
    {HEAD "20,1\n200,1\n", "expected rows from 25 Hz or less to 300 Hz or more, found 2 from 20 to 200 Hz"},
    {HEAD "26,1\n500,1\n", "found 2 from 26 to 500 Hz"},
    {HEAD "20,1\n30,1\n30,1\n", "line 5: expected frequencies that rise"},
    {HEAD "20,1\n30,1\n29,1\n", "line 5: expected frequencies that rise"},
    {HEAD "20,1\n-30,1\n", "line 4: expected frequencies that rise, from 0.001"},
    {HEAD "20,1\n500,-1\n", "line 4: expected a gain above 0"},
    {HEAD "20,1\n500,0\n", "line 4: expected a gain above 0"},
    {HEAD "20,1\n500,nan\n", "line 4: expected a frequency and a gain, two numbers"},
    {HEAD "20,1\n500,inf\n", "line 4: expected a frequency and a gain, two numbers"},
    {HEAD "20,1\n500\n", "line 4: expected a frequency and a gain, two numbers"},
    {HEAD "20,1\n500,1,1\n", "line 4: expected a frequency and a gain, two numbers"},
    {HEAD "20;1\n500;1\n", "line 3: expected a frequency and a gain, two numbers"},
    {HEAD "20,1\n500,0.0012345678901234567\n", "line 4: expected a frequency and a gain, two numbers of at most 15"},
    {HEAD "20,1\n500,0.5", "expected a line end after the last row, found none"},
};

TEST(a_file_that_is_wrong_is_refused_by_line_and_changes_nothing) {
    knurl_gain gains[KNURL_GAINS] = {{7.0, 0.7}};
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        assert_int_equal(gains_of(bad[i].file, strlen(bad[i].file), gains), KNURL_ERROR_FORMAT);
        if (!strstr(knurl_error_message(), bad[i].sentence)) {
            fail_msg("case %zu: %s", i, knurl_error_message());
        }
        CHECK_SAME(gains[0].gain, 0.7);
    }
}

TEST(text_in_utf_16_and_too_many_rows_are_refused) {
    static const char wide[] = "#\0 \0k\0n\0\n";
    static char long_file[65536] = HEAD;
    knurl_gain gains[KNURL_GAINS];
    assert_int_equal(gains_of(wide, sizeof wide - 1, gains), KNURL_ERROR_FORMAT);
    assert_non_null(strstr(knurl_error_message(), "line 1: expected UTF-8 text"));
    size_t used = strlen(long_file);
    for (int i = 0; i < 1025; i++) {
        used += (size_t)snprintf(long_file + used, sizeof long_file - used, "%d,1\n", 20 + i);
    }
    assert_int_equal(gains_of(long_file, used, gains), KNURL_ERROR_FORMAT);
    assert_non_null(strstr(knurl_error_message(), "line 1027: expected at most 1024 rows"));
    assert_int_equal(knurl_gains_from_response(HEAD, (uint64_t)1 << 40, gains), KNURL_ERROR_FORMAT);
    assert_int_equal(knurl_gains_from_response(NULL, 1, gains), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_gains_from_response(HEAD, 1, NULL), KNURL_ERROR_ARGUMENT);
}

/* A mass on a light grip's spring and damper, 700 N/m and 5 N s/m, under forces that are held for a tick:
 * sinc(f/f_h)/|k - m w^2 + i (b + c) w|. Read as a response, it has the same gains. */
TEST(a_plants_gains_are_those_of_its_response) {
    static char file[16384] = HEAD;
    knurl_gain read[KNURL_GAINS], found[KNURL_GAINS];
    for (int i = 0; i < KNURL_GAINS; i++) {
        const double hz = 20.0 * pow(2.0, i / 16.0), w = 6.283185307179586 * hz, half = 0.5 * w / 2000.0;
        const double real = 700.0 - 0.045 * w * w, imaginary = 5.5 * w;
        const size_t used = strlen(file);
        (void)snprintf(file + used, sizeof file - used, "%.14g,%.14g\n", hz,
                       sin(half) / half / sqrt(real * real + imaginary * imaginary));
    }
    assert_int_equal(gains_of(file, strlen(file), read), KNURL_OK);
    assert_int_equal(knurl_gains_from_plant(0.045, 0.5, 2000.0, found), KNURL_OK);
    for (int i = 0; i < KNURL_GAINS; i++) {
        CHECK_CLOSE(found[i].gain, read[i].gain, 1e-9);
    }
}

TEST(a_plants_numbers_are_checked) {
    knurl_gain gains[KNURL_GAINS] = {{7.0, 0.7}};
    assert_int_equal(knurl_gains_from_plant(0.0, 0.5, 1000.0, gains), KNURL_ERROR_ARGUMENT);
    assert_non_null(strstr(knurl_error_message(), "mass is not known"));
    assert_int_equal(knurl_gains_from_plant((double)NAN, 0.5, 1000.0, gains), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_gains_from_plant(0.045, -1.0, 1000.0, gains), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_gains_from_plant(0.045, 0.5, 99.0, gains), KNURL_ERROR_ARGUMENT);
    CHECK_SAME(gains[0].gain, 0.7);
    assert_int_equal(knurl_gains_from_plant(0.045, 0.5, 100.0, gains), KNURL_OK); /* above f_h/2: the gain there */
    for (int i = 0; i < KNURL_GAINS; i++) {
        assert_true(gains[i].gain > 0.0 && gains[i].gain <= 1.0);
    }
}
