/* Names with terminal escapes, wherever they are printed. SPDX-License-Identifier: MIT */
#include "support/suite.h"

#include <knurl/base.h>

#include <string.h>

static void check_line(const char *from, const char *expected) {
    char line[256];
    memset(line, 'x', sizeof line);
    const size_t length = knurl_text_line(line, sizeof line, from);
    assert_string_equal(line, expected);
    assert_int_equal(length, strlen(expected));
}

TEST(harmless_characters_stay) {
    check_line("", "");
    check_line("Gr\xC3\xB6\xC3\x9F"
               "e \xE8\xA7\xA6 \xF0\x9F\x98\x80",
               "Gr\xC3\xB6\xC3\x9F"
               "e \xE8\xA7\xA6 \xF0\x9F\x98\x80");
    check_line("\xC2\xA0\xE2\x80\xA6\xE2\x80\xA7\xE2\x80\xAF", "\xC2\xA0\xE2\x80\xA6\xE2\x80\xA7\xE2\x80\xAF");
}

TEST(control_characters_become_spaces) {
    check_line("a\x1b[31mb\nc\rd\te\x7f", "a [31mb c d e ");
}

TEST(c1_controls_separators_and_turns_of_direction_become_question_marks) {
    check_line("a\xC2\x9B"
               "31m",
               "a?31m"); /* CSI in one character */
    check_line("\xC2\x85\xE2\x80\xA8\xE2\x80\xA9", "?\?\?");
    check_line("\xE2\x80\xAE"
               "cod.exe\xE2\x80\xAC\xE2\x81\xA6\xE2\x81\xA9\xD8\x9C\xE2\x80\x8E\xE2\x80\x8F\xEF\xBB\xBF",
               "?cod.exe?\?\?\?\?\?\?");
}

TEST(characters_that_cannot_be_seen_become_question_marks) {
    static const struct {
        const char *text, *what;
    } unseen[] = {{"\xE1\xA0\x8E", "U+180E"},      {"\xE2\x80\x8B", "U+200B"},      {"\xE2\x81\xA0", "U+2060"},
                  {"\xE2\x81\xAA", "U+206A"},      {"\xEF\xBB\xBF", "U+FEFF"},      {"\xEF\xBF\xB9", "U+FFF9"},
                  {"\xF3\xA0\x80\x80", "U+E0000"}, {"\xF3\xA0\x80\x81", "U+E0001"}, {"\xF3\xA0\x81\xBF", "U+E007F"}};
    for (size_t i = 0; i < sizeof unseen / sizeof *unseen; i++) {
        print_message("%s\n", unseen[i].what);
        check_line(unseen[i].text, "?");
    }
    check_line("\xE2\x80\x8D\xF3\xA0\x84\x80", "\xE2\x80\x8D\xF3\xA0\x84\x80"); /* a joiner, a variation selector */
}

TEST(bytes_that_are_no_utf8_become_question_marks) {
    check_line("\x9b"
               "31m",
               "?31m");
    check_line("\xC0\x9B\xED\xA0\x80\xF5\x80\x80\x80\xE2\x80", "?\?\?\?\?\?\?\?\?\?\?");
    check_line("\xE2", "?");
}

TEST(a_long_text_is_cut_between_characters) {
    char line[5];
    assert_int_equal(knurl_text_line(line, sizeof line, "abc\xC3\xA4"), 3);
    assert_string_equal(line, "abc");
    assert_int_equal(knurl_text_line(line, sizeof line, "ab\xC3\xA4"), 4);
    assert_int_equal(knurl_text_line(line, 0, "ab"), 0);
}

TEST(messages_have_gone_through_it) {
    (void)knurl_fail(KNURL_ERROR_FORMAT, "node '%s'", "\x1b]0;x\x07\xC2\x9B\xE2\x80\xAE");
    assert_string_equal(knurl_error_message(), "node ' ]0;x ?\?'");
}
