/* Geometry files: their keys, and errors with their messages. SPDX-License-Identifier: MIT */
#include "support/close.h"

#include "base/number.h"
#include "device/rawhid/geometry.h"

#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static knurl_result parse(const char *text, knurl_rawhid_geometry *geometry) {
    return knurl_rawhid_geometry_parse("my.geometry", text, strlen(text), geometry);
}

TEST(the_file_that_is_shipped_says_what_holds_without_one) {
    knurl_rawhid_geometry shipped;
    knurl_rawhid_geometry defaults;
    memset(&shipped, 0xaa, sizeof shipped);
    knurl_rawhid_geometry_init(&defaults);
    assert_int_equal(knurl_rawhid_geometry_load(KNURL_TEST_ASSETS "/devices/woodenhaptics.geometry", &shipped),
                     KNURL_OK);
    assert_memory_equal(&shipped, &defaults, sizeof defaults);
}

/* So that a key left out of it cannot pass for one that agrees. */
TEST(the_file_that_is_shipped_names_every_key) {
    static const char *const names[] = {"name",
#define NAME(name, field, standard, range, kind) #name,
                                        KNURL_RAWHID_KEYS(NAME)
#undef NAME
    };
    static char text[KNURL_RAWHID_FILE_ROOM];
    FILE *file = fopen(KNURL_TEST_ASSETS "/devices/woodenhaptics.geometry", "rb");
    if (!file) {
        fail_msg("no file");
        return;
    }
    text[0] = '\n';
    text[1 + fread(text + 1, 1, sizeof text - 2, file)] = '\0';
    (void)fclose(file);
    for (size_t i = 0; i < COUNT_OF(names); i++) {
        char line[64];
        (void)snprintf(line, sizeof line, "\n%s = ", names[i]);
        if (!strstr(text, line)) {
            fail_msg("no %s in the file", names[i]);
        }
    }
}

/* The makers' published values. */
TEST(the_defaults_are_woodenhaptics_v2015) {
    knurl_rawhid_geometry g;
    assert_int_equal(parse("", &g), KNURL_OK);
    assert_string_equal(g.name, "WoodenHaptics v2015");
    CHECK_SAME(g.length[0], 0.080);
    CHECK_SAME(g.length[1], 0.205);
    CHECK_SAME(g.length[2], 0.245);
    CHECK_SAME(g.origin[0], 0.220);
    CHECK_SAME(g.origin[2], 0.080);
    CHECK_SAME(g.body[0], 0.160);
    CHECK_SAME(g.torque_constant[2], 0.0259);
    CHECK_SAME(g.max_current, 2.0);
    CHECK_SAME(g.home[2], 6000.0);
    CHECK_SAME(g.max_force, 3.0);
    CHECK_SAME(g.max_stiffness, 1000.0);
    CHECK_SAME(g.home_on_open, 0.0);
}

TEST(keys_are_taken_and_the_others_keep_their_defaults) {
    knurl_rawhid_geometry g;
    knurl_rawhid_geometry expected;
    knurl_rawhid_geometry_init(&expected);
    memset(expected.name, 0, sizeof expected.name);
    memcpy(expected.name, "my = own", 8);
    expected.vendor = 0x16c0;
    expected.product = 1158.0;
    expected.length[1] = 0.25;
    expected.sign[2] = -1.0;
    expected.home[1] = -5000.0;
    assert_int_equal(parse("# mine\r\n\r\n  name =  my = own \t\r\nvendor=0x16C0\nproduct = 1158 # 0x0486\n"
                           "length_b = 2.5e-1\nsign_c = -1\nhome_b = -5e3",
                           &g),
                     KNURL_OK);
    assert_memory_equal(&g, &expected, sizeof g);
}

TEST(errors_name_file_line_key_expected_and_found) {
    static const struct {
        const char *text, *named;
    } bad[] = {{"\n\nlength_b = 2,05\n", "line 3: length_b|expected 0.01 to 1 m|'2,05'"},
               {"length_b = 0", "line 1: length_b|expected 0.01 to 1 m|'0'"},
               {"length_b = nan", "length_b|expected |'nan'"},
               {"length_b = inf", "length_b|expected |'inf'"},
               {"length_b =", "length_b|expected |''"},
               {"length_b = 0.2 m", "length_b|0.01 to 1 m|'0.2 m'"},
               {"root:$6$salt$hash", "line 1|key = value|found no '='"},
               {"= 5", "line 1|expected a key of name, vendor|''"},
               {"Length_b = 0.2", "line 1|length_c|'Length_b'"},
               {"mass = 1\nmass = 1", "line 2: mass|once|again"},
               {"name = a\nname = a", "line 2: name|once|again"},
               {"name =", "line 1: name|1 to 63|found 0"},
               {"name = 0123456789012345678901234567890123456789012345678901234567890123", "name|63|found 64"},
               {"name = a\001b", "name|printable|found 3"},
               {"sign_a = 0", "sign_a|-1 or 1|'0'"},
               {"sign_a = 0.5", "sign_a|-1 or 1|'0.5'"},
               {"home_c = 0.5", "home_c|whole|'0.5'"},
               {"home_c = 32768", "home_c|32767 counts|'32768'"},
               {"max_current = 2.001", "max_current|expected 0.001 to 2 A|'2.001'"},
               {"max_current = 0", "max_current|expected 0.001 to 2 A|'0'"},
               {"torque_constant_b = 0", "torque_constant_b|expected 0.0001 to 10 N m/A|'0'"},
               {"torque_constant_b = nan", "torque_constant_b|expected |'nan'"},
               {"vendor = 0x12345", "vendor|0x16c0|'0x12345'"},
               {"vendor = 16c0", "vendor|0x16c0|'16c0'"},
               {"vendor = 5", "my.geometry|both vendor and product|0x5"},
               {"report_bytes = 13", "report_bytes|14 to 64|13"},
               {"continuous_force = 6", "continuous_force|up to max_force (3 N)|6 N"},
               {"origin_x = 0.9", "my.geometry|that the arm reaches|0.9"},
               {"origin_x = 0\norigin_z = 0.1", "my.geometry|that the arm reaches|0.1"}};
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        knurl_rawhid_geometry g;
        memset(&g, 0x55, sizeof g);
        CHECK_REFUSED(parse(bad[i].text, &g), KNURL_ERROR_FORMAT, g);
        check_message("my.geometry: ");
        check_message(bad[i].named);
    }
}

TEST(a_zero_byte_ends_nothing_and_is_refused) {
    static const char text[] = "mass = 1\0\nmass = 2";
    knurl_rawhid_geometry g;
    memset(&g, 0x55, sizeof g);
    CHECK_REFUSED(knurl_rawhid_geometry_parse("my.geometry", text, sizeof text - 1, &g), KNURL_ERROR_FORMAT, g);
}

/* An error of the key itself, or only in combination with others. */
static void check_range(const char *name, double least, double greatest, const char *unit) {
    const double ends[4] = {least, greatest, least - 0.001, greatest + 0.001};
    char word[64];
    (void)snprintf(word, sizeof word, "line 1: %s", name);
    for (int i = 0; i < 4; i++) {
        char line[64];
        knurl_rawhid_geometry g;
        (void)snprintf(line, sizeof line, "%s = %.15g", name, ends[i]);
        const knurl_result result = parse(line, &g);
        const int key_refused = result && strstr(knurl_error_message(), word);
        assert_true(!key_refused || strstr(knurl_error_message(), unit));
        if (!!key_refused != (i > 1)) {
            fail_msg("%s: %d, %s", line, (int)result, knurl_error_message());
        }
    }
}

TEST(every_key_takes_both_ends_of_its_range_and_nothing_beyond) {
#define CHECK_KEY(name, field, standard, range, kind) check_range(#name, range);
    KNURL_RAWHID_KEYS(CHECK_KEY)
#undef CHECK_KEY
}

TEST(numbers_are_the_c_librarys_to_the_last_bit) {
    uint64_t seed = 7;
    for (int i = 0; i < 100000; i++) {
        char text[64];
        double value = 0.0;
        const double wanted = random_between(&seed, -1.0, 1.0) * pow(10.0, (double)random_integer(&seed, -6, 6));
        (void)snprintf(text, sizeof text, i % 2 ? "%.15g" : "%.9f", wanted);
        if (knurl_number(text, strlen(text), &value)) {
            CHECK_SAME(value, strtod(text, NULL));
        } else {
            assert_true(strlen(text) > 15); /* more than 15 digits */
        }
    }
}

TEST(non_numbers_are_refused) {
    static const char *const bad[] = {
        "",    "-",   ".",     "-.", "e5",  "1e",   "1e+", "1e5.",  "0x",   "0x10000",
        "0xg", "1 2", "1.2.3", "+1", "--1", "1e99", "1f",  "1e-99", "-0x1", "1234567890123456"};
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        double value = 7.0;
        if (knurl_number(bad[i], strlen(bad[i]), &value)) {
            fail_msg("'%s' is %g", bad[i], value);
        }
        CHECK_SAME(value, 7.0);
    }
}

TEST(a_locale_with_decimal_commas_changes_nothing) {
    knurl_rawhid_geometry g;
    if (!setlocale(LC_NUMERIC, "de_DE.UTF-8") && !setlocale(LC_NUMERIC, "fr_FR.UTF-8")) {
        print_message("skipped: no locale with decimal commas is installed\n");
        skip();
    }
    const knurl_result result = parse("mass = 0.25", &g);
    (void)setlocale(LC_NUMERIC, "C");
    assert_int_equal(result, KNURL_OK);
    CHECK_SAME(g.mass, 0.25);
}

TEST(a_file_that_is_missing_or_too_long_is_refused_by_its_name) {
    knurl_rawhid_geometry g;
    char path[512];
    memset(&g, 0x55, sizeof g);
    CHECK_REFUSED(knurl_rawhid_geometry_load("/nowhere/my.geometry", &g), KNURL_ERROR_IO, g);
    check_message("'/nowhere/my.geometry'");
    (void)snprintf(path, sizeof path, "%s/long_%ld.geometry", KNURL_TEST_TMP, (long)getpid());
    for (int extra = 0; extra < 2; extra++) {
        FILE *file = fopen(path, "wb");
        if (!file) {
            fail_msg("%s cannot be written", path);
            return;
        }
        for (int i = 0; i < KNURL_RAWHID_FILE_ROOM + extra; i++) {
            (void)fputc(' ', file);
        }
        (void)fclose(file);
        memset(&g, 0x55, sizeof g);
        if (extra) {
            CHECK_REFUSED(knurl_rawhid_geometry_load(path, &g), KNURL_ERROR_FORMAT, g);
            check_message("up to 65536 bytes");
        } else {
            assert_int_equal(knurl_rawhid_geometry_load(path, &g), KNURL_OK);
        }
        (void)remove(path);
    }
}

TEST(a_folder_is_no_file) {
    knurl_rawhid_geometry g;
    memset(&g, 0x55, sizeof g);
    CHECK_REFUSED(knurl_rawhid_geometry_load(KNURL_TEST_ASSETS, &g), KNURL_ERROR_IO, g);
}
