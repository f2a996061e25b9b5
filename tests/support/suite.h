/* Tests that register themselves: TEST(name) { ... } is run by the program that it is linked into, in the order of its
 * lines. main() comes from the library if a program has none. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_SUITE_H
#define KNURL_TEST_SUITE_H

#ifdef __cplusplus
#include <csetjmp>
#include <cstdarg>
#include <cstddef>
#include <cstdint>
extern "C" {
#else
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#endif
#include <cmocka.h>

/** cmocka 2 deprecates the name; its own for unsigned numbers casts them to signed ones, which gcc warns of. */
#ifdef assert_int_in_range
#undef assert_in_range
#define assert_in_range assert_int_in_range
#endif

void suite_add(const struct CMUnitTest *test, const char *file, int line);
void suite_fixtures(CMFixtureFunction setup, CMFixtureFunction teardown);

/** Whether a test of that name has registered. */
int suite_has(const char *name);

/** Runs all registered tests; returns cmocka's exit code. For programs with their own main(). */
int suite_run(const char *name);

#ifdef __cplusplus
}
#endif

/** 1 under a sanitizer. Tests that repeat the same code with other numbers use fewer there: each costs four times as
 * much, and the plain run covers them all. */
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SUITE_SANITIZED 1
#else
#define SUITE_SANITIZED 0
#endif

/** A test of cmocka's. */
#define TEST(name) TEST_WITH(name, NULL, NULL)

/** A test that `setup` comes before and `teardown` after; each may be NULL. */
#define TEST_WITH(name, setup, teardown)                                                                               \
    static void name(void **state);                                                                                    \
    __attribute__((constructor)) static void name##_registers(void) {                                                  \
        const struct CMUnitTest test = {#name, name, setup, teardown, NULL};                                           \
        suite_add(&test, __FILE__, __LINE__);                                                                          \
    }                                                                                                                  \
    static void name(void **state __attribute__((unused)))

/** Setup before the first and teardown after the last test of the program; each may be NULL. Once per program. */
#define SUITE_FIXTURES(setup, teardown)                                                                                \
    __attribute__((constructor)) static void suite_registers(void) {                                                   \
        suite_fixtures(setup, teardown);                                                                               \
    }

#endif
