/* Libraries that are loaded at run time: all functions, or an error with the reason. SPDX-License-Identifier: MIT */
#include "support/close.h"

#include "base/system.h"
#include "device/dynlib.h"

static double (*cosine)(double);
static double (*other)(double);

/* The math library is always present. */
static const char *const present[] = {"libnothing-of-the-kind.so.7", "libm.so.6"};

enum { THREADS = 4, ROUNDS = 200 };

/* Requested by several threads at once. */
static uint32_t shared;
static uint32_t refused;

static void ask(void *argument) {
    char why[256];
    const knurl_dynlib_function functions[] = {{"cos", &cosine}, {"exp", &other}};
    (void)argument;
    if (!knurl_dynlib_load(&shared, present, 2, functions, 2, why, sizeof why) || cosine(0.0) != 1.0) {
        __atomic_add_fetch(&refused, 1, __ATOMIC_RELAXED);
    }
}

/* Run by ThreadSanitizer as well: the functions are written by one thread, and read by all when it is done. */
TEST(threads_that_ask_at_once_get_the_same_functions) {
    for (int round = 0; round < ROUNDS; round++) {
        knurl_thread *threads[THREADS];
        shared = 0;
        cosine = other = NULL;
        for (int i = 0; i < THREADS; i++) {
            threads[i] = knurl_system_start_thread(ask, NULL, 1 << 18);
            assert_non_null(threads[i]);
        }
        for (int i = 0; i < THREADS; i++) {
            knurl_system_join_thread(threads[i]);
        }
        assert_int_equal(refused, 0);
    }
}

TEST(the_first_library_that_is_there_lends_its_functions) {
    const knurl_dynlib_function functions[] = {{"cos", &cosine}, {"exp", &other}};
    char why[256];
    uint32_t own = 0;
    assert_int_equal(knurl_dynlib_load(&own, present, 2, functions, 2, why, sizeof why), 1);
    CHECK_CLOSE(cosine(0.0), 1.0, 0.0);
    CHECK_CLOSE(other(0.0), 1.0, 0.0);
}

TEST(a_library_that_is_nowhere_is_named_with_the_systems_reason) {
    const knurl_dynlib_function functions[] = {{"cos", &cosine}};
    char why[256];
    uint32_t own = 0;
    cosine = NULL;
    assert_int_equal(knurl_dynlib_load(&own, present, 1, functions, 1, why, sizeof why), 0);
    assert_non_null(strstr(why, present[0]));
    assert_non_null(strstr(why, "No such file"));
    assert_null(cosine);
}

TEST(a_library_that_lacks_a_function_lends_none) {
    const knurl_dynlib_function functions[] = {{"cos", &cosine}, {"knurl_no_such_function", &other}};
    char why[256];
    uint32_t own = 0;
    cosine = other = NULL;
    assert_int_equal(knurl_dynlib_load(&own, present, 2, functions, 2, why, sizeof why), 0);
    assert_non_null(strstr(why, "knurl_no_such_function"));
    assert_null(cosine);
    assert_null(other);
}
