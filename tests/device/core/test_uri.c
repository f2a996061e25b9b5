/* The part after "driver:" in a device's URI. SPDX-License-Identifier: MIT */
#include "support/close.h"

#include "device/driver.h"

static char name[KNURL_URI_ROOM];
static char library[KNURL_URI_ROOM];
static char serial[KNURL_URI_ROOM];
static const knurl_uri_key keys[] = {{"library", library}, {"serial", serial}};

static knurl_result parse(const char *options) {
    memset(name, 'n', sizeof name);
    memset(library, 'l', sizeof library);
    memset(serial, 's', sizeof serial);
    return knurl_uri_parse("touch", options, name, keys, COUNT_OF(keys));
}

TEST(a_uri_is_a_name_and_values) {
    static const struct {
        const char *options, *name, *library, *serial;
    } cases[] = {
        {"", "", "", ""},
        {"Default Device", "Default Device", "", ""},
        {"?", "", "", ""},
        {"left?", "left", "", ""},
        {"?library=/opt/libHD.so", "", "/opt/libHD.so", ""},
        {"left?library=/opt/libHD.so&serial=12", "left", "/opt/libHD.so", "12"},
        {"left?serial=12&library=x", "left", "x", "12"},
        {"?serial=1&serial=2", "", "", "2"}, /* the last one counts */
        {"?serial=", "", "", ""},
        {"?serial=1&serial=", "", "", ""},
        {"?serial=1&", "", "", "1"},
        {"044f:b108?serial=a=b", "044f:b108", "", "a=b"}, /* unchanged */
        {"?library=a?b:c/%20 d", "", "a?b:c/%20 d", ""},
        {"a&b=c", "a&b=c", "", ""}, /* all of it is the name, because there is no '?' */
        {"?library=Ger\xc3\xa4t", "", "Ger\xc3\xa4t", ""},
    };
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        assert_int_equal(parse(cases[i].options), KNURL_OK);
        assert_string_equal(name, cases[i].name);
        assert_string_equal(library, cases[i].library);
        assert_string_equal(serial, cases[i].serial);
    }
}

TEST(a_malformed_option_is_refused_with_the_device_the_text_and_the_known_keys) {
    static const char *const wrong[] = {
        "?libraries=x", "?librar=x", "?Library=x",     "?library",          "?=x",
        "?serial",      "?x",        "left?serial&x=", "?serial=1&other=2", "? serial=1"};
    char nothing = 0;
    for (size_t i = 0; i < COUNT_OF(wrong); i++) {
        CHECK_REFUSED(parse(wrong[i]), KNURL_ERROR_ARGUMENT, nothing);
        check_message("touch|library=|serial=");
    }
    CHECK_REFUSED(parse("?serial=1&other=2&library=3"), KNURL_ERROR_ARGUMENT, nothing);
    check_message("'other=2'");
    CHECK_REFUSED(parse("?&serial=1"), KNURL_ERROR_ARGUMENT, nothing);
}

TEST(names_and_values_up_to_511_bytes_are_taken_and_longer_ones_refused) {
    static char long_one[2 * KNURL_URI_ROOM];
    char nothing = 0;
    for (size_t length = KNURL_URI_ROOM - 2; length < KNURL_URI_ROOM + 2; length++) {
        memset(long_one, 0, sizeof long_one);
        memset(long_one, 'a', length);
        if (length < KNURL_URI_ROOM) {
            assert_int_equal(parse(long_one), KNURL_OK);
            assert_string_equal(name, long_one);
        } else {
            CHECK_REFUSED(parse(long_one), KNURL_ERROR_ARGUMENT, nothing);
            check_message("name");
        }
        memset(long_one, 0, sizeof long_one);
        (void)strcpy(long_one, "?serial=");
        memset(long_one + 8, 'b', length);
        if (length < KNURL_URI_ROOM) {
            assert_int_equal(parse(long_one), KNURL_OK);
            assert_string_equal(serial, long_one + 8);
        } else {
            CHECK_REFUSED(parse(long_one), KNURL_ERROR_ARGUMENT, nothing);
            check_message("serial");
        }
    }
}

TEST(a_device_without_keys_takes_a_name_only) {
    char nothing = 0;
    assert_int_equal(knurl_uri_parse("omega", "left", name, NULL, 0), KNURL_OK);
    assert_string_equal(name, "left");
    CHECK_REFUSED(knurl_uri_parse("omega", "left?a=b", name, NULL, 0), KNURL_ERROR_ARGUMENT, nothing);
    check_message("omega|a=b");
    assert_null(strstr(knurl_error_message(), "expected ,"));
}

/* Like the fuzzer: any input ends, and results are valid texts. */
TEST(random_options_are_taken_or_refused) {
    static const char alphabet[] = "?&=library=serial ab:%\xff";
    uint64_t random = 77;
    int taken = 0;
    for (int k = 0; k < 20000; k++) {
        char options[64] = "";
        const int64_t length = random_integer(&random, 0, 40);
        for (int64_t i = 0; i < length; i++) {
            options[i] = alphabet[random_integer(&random, 0, (int64_t)sizeof alphabet - 2)];
        }
        if (parse(options) == KNURL_OK) {
            taken++;
            assert_non_null(memchr(name, '\0', sizeof name));
            assert_non_null(memchr(library, '\0', sizeof library));
            assert_non_null(memchr(serial, '\0', sizeof serial));
        }
    }
    assert_in_range(taken, 1, 19999);
}
