/* The command-line tool with a WoodenHaptics on an emulated serial port. SPDX-License-Identifier: MIT */
#include "support/terminal.h"
#include "support/tool.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/file.h>
#include <unistd.h>

#define ON_EMULATED(...)                                                                                               \
    run_tool((const char *const[]){EMULATE_SERIAL, tool_path("port"), "--", KNURL_TEST_TOOL, __VA_ARGS__, NULL})

static const char plate[] = KNURL_TEST_ASSETS "/plate_1d.glb";

static const char *uri_of_port(void) {
    static char uri[1100];
    (void)snprintf(uri, sizeof uri, "serial:%s", tool_path("port"));
    return uri;
}

TEST(a_plate_is_felt_with_it) {
    need_terminal();
    process p = ON_EMULATED("run", plate, "--device", uri_of_port(), "--seconds", "1");
    for (int tries = 1; p.exit_code != 0 && tries < 4; tries++) { /* an emulation that stalls for a second is lost */
        print_error("%s", p.err);
        process_free(&p);
        p = ON_EMULATED("run", plate, "--device", uri_of_port(), "--seconds", "1");
    }
    assert_int_equal(p.exit_code, 0);
    assert_non_null(strstr(p.out, "WoodenHaptics v2015"));
    assert_true(json_number_of(p.out, "contact_s") > 0.3);
    assert_true(json_number_of(p.out, "force_max_n") > 0.1); /* 400 N/m a fraction of a millimetre deep */
    process_free(&p);
}

TEST(a_port_that_is_not_there_is_named) {
    SCOPED_PROCESS p = RUN_TOOL("run", plate, "--device", "serial:/dev/nowhere", "--seconds", "0.1");
    assert_true(p.exit_code != 0);
    assert_non_null(strstr(p.err, "/dev/nowhere could not be opened"));
}

TEST(a_file_that_is_no_port_is_told_apart_from_one_in_use) {
    process p = RUN_TOOL("run", plate, "--device", "serial:/dev/null", "--seconds", "0.1");
    check_refused(&p, 1, "/dev/null could not be opened|expected a serial port", "serial:/dev/null");
}

TEST(a_port_that_another_program_has_locked_is_refused) {
    need_terminal();
    const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
    assert_true(terminal >= 0 && grantpt(terminal) == 0 && unlockpt(terminal) == 0);
    const int other = open(ptsname(terminal), O_RDWR | O_NOCTTY);
    assert_true(other >= 0 && flock(other, LOCK_EX) == 0);
    char uri[128];
    (void)snprintf(uri, sizeof uri, "serial:%s", ptsname(terminal));
    process p = RUN_TOOL("run", plate, "--device", uri, "--seconds", "0.1");
    check_refused(&p, 1, "could not be opened|busy; end other programs that use it", uri);
    (void)close(other);
    (void)close(terminal);
}

SUITE_FIXTURES(make_folder, remove_folder)
