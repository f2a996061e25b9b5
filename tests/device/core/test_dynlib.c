/* Libraries that are loaded at run time: all functions or none, and why not. SPDX-License-Identifier: MIT */
#include "support/close.h"

#include "device/dynlib.h"

static double (*cosine)(double);
static double (*other)(double);

/* The mathematical library is there wherever this test is. */
static const char *const present[] = {"libnothing-of-the-kind.so.7", "libm.so.6"};

TEST(the_first_library_that_is_there_lends_its_functions) {
    const knurl_dynlib_function functions[] = {{"cos", &cosine}, {"exp", &other}};
    char why[256];
    assert_int_equal(knurl_dynlib_load(present, 2, functions, 2, why, sizeof why), 1);
    CHECK_CLOSE(cosine(0.0), 1.0, 0.0);
    CHECK_CLOSE(other(0.0), 1.0, 0.0);
}

TEST(a_library_that_is_nowhere_is_named_with_the_systems_reason) {
    const knurl_dynlib_function functions[] = {{"cos", &cosine}};
    char why[256];
    cosine = NULL;
    assert_int_equal(knurl_dynlib_load(present, 1, functions, 1, why, sizeof why), 0);
    assert_non_null(strstr(why, present[0]));
    assert_non_null(strstr(why, "No such file"));
    assert_null(cosine);
}

TEST(a_library_that_lacks_a_function_lends_none) {
    const knurl_dynlib_function functions[] = {{"cos", &cosine}, {"knurl_no_such_function", &other}};
    char why[256];
    cosine = other = NULL;
    assert_int_equal(knurl_dynlib_load(present, 2, functions, 2, why, sizeof why), 0);
    assert_non_null(strstr(why, "knurl_no_such_function"));
    assert_null(cosine);
    assert_null(other);
}
