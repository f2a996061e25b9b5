/* HD's errors in sentences. The numbers are those of HD's reference. SPDX-License-Identifier: MIT */
#include "support/close.h"

#include "device/touch/hd.h"

static const uint32_t codes[] = {0x0100, 0x0101, 0x0102, 0x0103, 0x0104, 0x0200, 0x0201, 0x0202, 0x0203, 0x0204, 0x0300,
                                 0x0301, 0x0302, 0x0303, 0x0304, 0x0400, 0x0401, 0x0402, 0x0500, 0x0501, 0x0600};

TEST(every_error_has_a_sentence_of_its_own) {
    for (size_t i = 0; i < COUNT_OF(codes); i++) {
        const char *sentence = knurl_hd_error_sentence(codes[i]);
        assert_true(strlen(sentence) > 10);
        assert_string_not_equal(sentence, knurl_hd_error_sentence(0x9999));
        for (size_t j = 0; j < i; j++) {
            assert_string_not_equal(sentence, knurl_hd_error_sentence(codes[j]));
        }
    }
}

TEST(unknown_errors_and_errors_without_a_reason_have_sentences_too) {
    assert_non_null(strstr(knurl_hd_error_sentence(0x9999), "unknown to this version"));
    assert_non_null(strstr(knurl_hd_error_sentence(0xffffffffu), "unknown to this version"));
    assert_non_null(strstr(knurl_hd_error_sentence(0), "no reason"));
}

TEST(the_sentences_say_what_helps) {
    assert_non_null(strstr(knurl_hd_error_sentence(0x0302), "cable"));
    assert_non_null(strstr(knurl_hd_error_sentence(0x0302), "Touch_AdvancedConfig"));
    assert_non_null(strstr(knurl_hd_error_sentence(0x0303), "GTDD_HOME"));
    assert_non_null(strstr(knurl_hd_error_sentence(0x0203), "warm"));
    assert_non_null(strstr(knurl_hd_error_sentence(0x0200), "rest"));
    assert_non_null(strstr(knurl_hd_error_sentence(0x0600), "licence"));
}

TEST(an_error_is_a_loss_or_a_refusal_or_neither) {
    for (size_t i = 0; i < COUNT_OF(codes); i++) {
        const int of_device = (codes[i] & 0xff00) == 0x0300 && codes[i] != 0x0304; /* 0x0304: the scheduler's timer */
        assert_int_equal(knurl_hd_error_is_loss(codes[i]), of_device || codes[i] == 0x0104);
        assert_int_equal(knurl_hd_error_is_refusal(codes[i]), (codes[i] & 0xff00) == 0x0200);
    }
}

/* --- taking them away --- */

static int left;    /* errors that the library still has; negative: for ever */
static int answers; /* calls */

static hd_error HD_CALL next_error(void) {
    const hd_error none = {0, 0, HD_NO_DEVICE};
    const hd_error some = {0x0300u + (uint32_t)(left & 0xff), 0, 3};
    answers++;
    if (left == 0) {
        return none;
    }
    left -= left > 0;
    return some;
}

TEST(errors_are_taken_newest_first_until_there_is_none) {
    hd_error errors[HD_ERRORS_AT_ONCE];
    hd_api api;
    memset(&api, 0, sizeof api);
    api.next_error = next_error;
    left = 3;
    assert_int_equal(knurl_hd_take_errors(&api, errors), 3);
    assert_int_equal(errors[0].code, 0x0303);
    assert_int_equal(errors[2].code, 0x0301);
    assert_int_equal(errors[2].device, 3);
    assert_int_equal(knurl_hd_take_errors(&api, errors), 0);
}

TEST(errors_without_end_are_not_waited_for) {
    hd_error errors[HD_ERRORS_AT_ONCE];
    hd_api api;
    memset(&api, 0, sizeof api);
    api.next_error = next_error;
    left = -1;
    answers = 0;
    assert_int_equal(knurl_hd_take_errors(&api, errors), 16);
    assert_int_equal(answers, 16);
}

TEST(types_have_the_sizes_that_the_library_has) {
    assert_int_equal(sizeof(hd_error), 12);
    assert_int_equal(sizeof(hd_scheduler_code), sizeof(unsigned long));
    assert_int_equal(sizeof(hd_device), 4);
}
