/* Results and messages, growable structs, handles, against their headers' promises. SPDX-License-Identifier: MIT */
#include "support/close.h"

#include "base/base.h"
#include "base/handle.h"

#include <pthread.h>
#include <stdio.h>

static const knurl_result results[] = {
#define RESULT_CODE(name, value, text) name,
    KNURL_RESULTS(RESULT_CODE)
#undef RESULT_CODE
};

TEST(every_result_code_has_its_own_sentence) {
    const char *unknown = knurl_result_string(-9999);
    assert_non_null(unknown);
    assert_true(unknown[0] != '\0');
    assert_string_equal(knurl_result_string(1), unknown);
    assert_string_equal(knurl_result_string(INT32_MIN), unknown);
    for (size_t i = 0; i < COUNT_OF(results); i++) {
        const char *text = knurl_result_string(results[i]);
        assert_true(text[0] != '\0');
        assert_string_not_equal(text, unknown);
        for (size_t j = 0; j < i; j++) {
            assert_string_not_equal(text, knurl_result_string(results[j]));
            assert_int_not_equal(results[i], results[j]);
        }
    }
}

TEST(ok_is_zero_and_every_error_is_negative) {
    assert_int_equal(KNURL_OK, 0);
    for (size_t i = 0; i < COUNT_OF(results); i++) {
        assert_true(results[i] == KNURL_OK || results[i] < 0);
    }
}

TEST(fail_returns_its_code_and_keeps_the_sentence) {
    assert_int_equal(knurl_fail(KNURL_ERROR_IO, "%s: expected %d, found %g", "plate", 3, 0.5), KNURL_ERROR_IO);
    assert_string_equal(knurl_error_message(), "plate: expected 3, found 0.5");
    (void)knurl_result_string(KNURL_ERROR_MEMORY); /* a success does not change it */
    (void)knurl_version_string();
    assert_string_equal(knurl_error_message(), "plate: expected 3, found 0.5");
    (void)knurl_fail(KNURL_ERROR_STATE, "next");
    assert_string_equal(knurl_error_message(), "next");
}

TEST(fail_makes_one_line_of_control_characters_and_leaves_utf8_alone) {
    char hostile[40] = "";
    char expected[40] = "";
    for (char c = 1; c < 0x20; c++) {
        hostile[c - 1] = c;
        expected[c - 1] = ' ';
    }
    hostile[31] = 0x7f;
    expected[31] = ' ';
    (void)knurl_fail(KNURL_ERROR_FORMAT, "%s", hostile);
    assert_string_equal(knurl_error_message(), expected);
    (void)knurl_fail(KNURL_ERROR_FORMAT, "caf\xc3\xa9 \xe2\x82\xac");
    assert_string_equal(knurl_error_message(), "caf\xc3\xa9 \xe2\x82\xac");
}

TEST(fail_cuts_a_long_sentence_after_1023_bytes) {
    static char letters[3000];
    memset(letters, 'x', sizeof letters - 1);
    for (size_t length = 1022; length <= 1025; length++) {
        (void)knurl_fail(KNURL_ERROR_FORMAT, "%.*s", (int)length, letters);
        assert_int_equal(strlen(knurl_error_message()), length < 1023 ? length : 1023);
    }
    (void)knurl_fail(KNURL_ERROR_FORMAT, "begin %s", letters);
    assert_int_equal(strlen(knurl_error_message()), 1023);
    assert_memory_equal(knurl_error_message(), "begin xxx", 9);
}

TEST(fail_may_quote_the_sentence_before) {
    (void)knurl_fail(KNURL_ERROR_ARGUMENT, "amplitude: below 0");
    (void)knurl_fail(KNURL_ERROR_ARGUMENT, "surface 'top': %s", knurl_error_message());
    assert_string_equal(knurl_error_message(), "surface 'top': amplitude: below 0");
}

TEST(a_failure_on_the_haptic_path_says_so_in_place_of_the_sentence_before) {
    (void)knurl_fail(KNURL_ERROR_ARGUMENT, "amplitude: below 0");
    assert_int_equal(knurl_fail_static(KNURL_ERROR_DEVICE_LOST, "gone"), KNURL_ERROR_DEVICE_LOST);
    assert_string_equal(knurl_error_message(), "gone");
    (void)knurl_fail(KNURL_ERROR_ARGUMENT, "amplitude: %s", "below 0");
    assert_string_equal(knurl_error_message(), "amplitude: below 0");
}

TEST(fail_without_a_format_still_says_something) {
    const char *format = NULL;
    (void)knurl_fail(KNURL_ERROR_ARGUMENT, "stale");
    assert_int_equal(knurl_fail(KNURL_ERROR_IO, format), KNURL_ERROR_IO);
    assert_string_equal(knurl_error_message(), "no reason was given");
}

static void *fail_elsewhere(void *seen) {
    char (*messages)[32] = seen;
    (void)snprintf(messages[0], 32, "%s", knurl_error_message());
    (void)knurl_fail(KNURL_ERROR_IO, "theirs");
    (void)snprintf(messages[1], 32, "%s", knurl_error_message());
    return NULL;
}

TEST(each_thread_has_its_own_message) {
    char theirs[2][32] = {"?", "?"};
    pthread_t thread;
    (void)knurl_fail(KNURL_ERROR_IO, "ours");
    assert_int_equal(pthread_create(&thread, NULL, fail_elsewhere, theirs), 0);
    assert_int_equal(pthread_join(thread, NULL), 0);
    assert_string_equal(theirs[0], ""); /* before the first failing call */
    assert_string_equal(theirs[1], "theirs");
    assert_string_equal(knurl_error_message(), "ours");
}

TEST(version_is_that_of_the_header) {
    char expected[32];
    (void)snprintf(expected, sizeof expected, "%d.%d.%d", KNURL_VERSION_MAJOR, KNURL_VERSION_MINOR,
                   KNURL_VERSION_PATCH);
    assert_string_equal(knurl_version_string(), expected);
}

/* --- growable structs --- */

typedef struct growable {
    uint32_t struct_size;
    uint32_t first;
    uint32_t second;
    uint32_t third;
} growable;

typedef struct grown {
    growable known;
    unsigned char more[12]; /* no padding: a caller need not clear that */
} grown;

static const growable defaults = {sizeof(growable), 11, 22, 33};

TEST(a_struct_is_written_as_long_as_the_caller_has_it) {
    for (uint32_t size = 4; size <= sizeof(grown); size++) {
        grown caller;
        memset(&caller, 0xaa, sizeof caller);
        knurl_desc_write(&defaults, sizeof defaults, &caller, size);
        const unsigned char *bytes = (const unsigned char *)&caller;
        assert_int_equal(caller.known.struct_size, size);
        for (uint32_t i = 4; i < sizeof caller; i++) {
            const unsigned char known = i < sizeof defaults ? ((const unsigned char *)&defaults)[i] : 0;
            assert_int_equal(bytes[i], i < size ? known : 0xaa);
        }
    }
}

TEST(an_older_callers_missing_fields_keep_their_defaults) {
    const growable caller = {12, 1, 2, 3}; /* knows no `third` */
    growable local = defaults;
    assert_int_equal(knurl_desc_read("growable", &caller, &local, sizeof local), KNURL_OK);
    assert_int_equal(local.first, 1);
    assert_int_equal(local.second, 2);
    assert_int_equal(local.third, 33);
    assert_int_equal(local.struct_size, sizeof local);
}

TEST(a_newer_callers_extra_fields_must_be_zero) {
    grown caller = {{sizeof(grown), 1, 2, 3}, {0}};
    growable local = defaults;
    assert_int_equal(knurl_desc_read("growable", &caller, &local, sizeof local), KNURL_OK);
    assert_int_equal(local.third, 3);
    assert_int_equal(local.struct_size, sizeof local);
    for (size_t i = 0; i < sizeof caller.more; i++) {
        local = defaults;
        caller.more[i] = 1;
        CHECK_REFUSED(knurl_desc_read("growable", &caller, &local, sizeof local), KNURL_ERROR_UNSUPPORTED, local);
        assert_non_null(strstr(knurl_error_message(), "growable"));
        caller.more[i] = 0;
    }
}

TEST(a_struct_whose_size_was_never_set_is_refused) {
    const uint32_t sizes[] = {0, 1, 7, 65537, UINT32_MAX};
    growable local = defaults;
    for (size_t i = 0; i < COUNT_OF(sizes); i++) {
        growable caller = {sizes[i], 1, 2, 3};
        CHECK_REFUSED(knurl_desc_read("growable", &caller, &local, sizeof local), KNURL_ERROR_ARGUMENT, local);
        assert_non_null(strstr(knurl_error_message(), "struct_size"));
        CHECK_REFUSED(knurl_desc_return("growable", &defaults, sizeof defaults, &caller), KNURL_ERROR_ARGUMENT, caller);
    }
    CHECK_REFUSED(knurl_desc_read("growable", NULL, &local, sizeof local), KNURL_ERROR_ARGUMENT, local);
    CHECK_REFUSED(knurl_desc_return("growable", &defaults, sizeof defaults, NULL), KNURL_ERROR_ARGUMENT, local);
}

TEST(an_output_struct_is_filled_as_far_as_its_caller_knows_it) {
    growable caller = {12, 0, 0, 77};
    assert_int_equal(knurl_desc_return("growable", &defaults, sizeof defaults, &caller), KNURL_OK);
    assert_int_equal(caller.struct_size, 12);
    assert_int_equal(caller.first, 11);
    assert_int_equal(caller.second, 22);
    assert_int_equal(caller.third, 77);
}

TEST(a_text_ends_in_whatever_an_older_caller_has_of_it) {
    typedef struct texted {
        uint32_t struct_size, other;
        char text[8];
    } texted;
    const texted full = {sizeof(texted), 0x01020304, "1234567"};
    for (uint32_t size = 8; size <= sizeof full; size++) {
        texted caller;
        memset(&caller, 0x77, sizeof caller);
        caller.struct_size = size;
        assert_int_equal(knurl_desc_return("texted", &full, sizeof full, &caller), KNURL_OK);
        knurl_desc_end_text(&caller, offsetof(texted, text), sizeof caller);
        assert_int_equal(caller.other, full.other);
        for (uint32_t i = 8; i < sizeof full; i++) {
            const uint32_t at = i - 8;
            assert_int_equal(caller.text[at], i >= size ? 0x77 : i == size - 1 ? 0 : full.text[at]);
        }
    }
}

/* --- handles --- */

TEST(a_live_handle_is_told_from_null_from_another_kind_and_from_a_destroyed_one) {
    static uint32_t elsewhere[2];
    uint32_t scene[2] = {KNURL_HANDLE_SCENE, 0};
    const void *none = NULL;
    assert_false(KNURL_BAD_HANDLE(scene, SCENE));
    assert_true(KNURL_IS_HANDLE(scene, SCENE));
    assert_true(KNURL_BAD_HANDLE(none, SCENE));
    assert_string_equal(knurl_error_message(), "none: expected a scene, found null");
    assert_true(KNURL_BAD_HANDLE(scene, DEVICE));
    assert_string_equal(knurl_error_message(), "scene: expected a device, found a scene");
    assert_true(KNURL_BAD_HANDLE((char *)elsewhere + 1, SCENE)); /* there is no object */
    knurl_handle_clear(scene);
    assert_false(KNURL_IS_HANDLE(scene, SCENE));
    assert_true(KNURL_BAD_HANDLE(scene, SCENE));
    assert_string_equal(knurl_error_message(), "scene: expected a scene, found an invalid or destroyed handle");
}

TEST(a_null_parameter_is_named) {
    const double *rows = NULL;
    assert_true(KNURL_IS_NULL(rows));
    assert_string_equal(knurl_error_message(), "rows: expected a pointer, found null");
    assert_false(KNURL_IS_NULL(&rows));
}
