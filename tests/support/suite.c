/* The tests that have registered. SPDX-License-Identifier: MIT */
#include "support/suite.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MOST_TESTS 256

static struct CMUnitTest tests[MOST_TESTS];
static struct {
    const char *file;
    int line;
} places[MOST_TESTS];
static size_t count;
static CMFixtureFunction group_setup;
static CMFixtureFunction group_teardown;

/** Compilers call a file's constructors in any order: sorts by line. */
void suite_add(const struct CMUnitTest *test, const char *file, int line) {
    if (count == MOST_TESTS) {
        (void)fprintf(stderr, "%s:%d: more than %d tests in a program\n", file, line, MOST_TESTS);
        abort();
    }
    size_t place = count++;
    while (place > 0 && strcmp(places[place - 1].file, file) == 0 && places[place - 1].line > line) {
        tests[place] = tests[place - 1];
        places[place] = places[place - 1];
        place--;
    }
    tests[place] = *test;
    places[place].file = file;
    places[place].line = line;
}

void suite_fixtures(CMFixtureFunction setup, CMFixtureFunction teardown) {
    group_setup = setup;
    group_teardown = teardown;
}

int suite_has(const char *name) {
    for (size_t i = 0; i < count; i++) {
        if (strcmp(tests[i].name, name) == 0) {
            return 1;
        }
    }
    return 0;
}

int suite_run(const char *name) {
    return _cmocka_run_group_tests(name, tests, count, group_setup, group_teardown);
}
