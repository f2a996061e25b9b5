/* Without Force Dimension's library, and the tool with the stand-in. SPDX-License-Identifier: MIT */
#include "support/tool.h"

static const char plate[] = KNURL_TEST_ASSETS "/plate_1d.glb";

TEST(without_the_library_the_tool_says_what_helps) {
    assert_int_equal(unsetenv("KNURL_DHD_LIBRARY"), 0);
    process p = RUN_TOOL("run", plate, "--device", "dhd", "--seconds", "1");
    check_refused(&p, 1, "dhd|libdhd.so|SDK|KNURL_DHD_LIBRARY", "run --device dhd");
    p = RUN_TOOL("run", plate, "--device", "dhd:?library=/nowhere/libdhd.so", "--seconds", "1");
    check_refused(&p, 1, "/nowhere/libdhd.so", "run --device dhd");
}

TEST(a_plate_is_felt_with_it) {
    assert_int_equal(setenv("KNURL_DHD_LIBRARY", KNURL_TEST_STUB_DHD, 1), 0);
    SCOPED_PROCESS p = RUN_TOOL("run", plate, "--device", "dhd", "--seconds", "1");
    if (p.exit_code != 0) {
        fail_msg("exit %d, signal %d: %s", p.exit_code, p.signal, p.err);
    }
    assert_non_null(strstr(p.out, "Force Dimension omega.3"));
    assert_true(json_number_of(p.out, "contact_s") > 0.3);
    assert_true(json_number_of(p.out, "force_max_n") > 0.1);
}
