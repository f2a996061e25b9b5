/* The command-line tool with a WoodenHaptics, emulated, on the machine. SPDX-License-Identifier: MIT */
#include "support/terminal.h"
#include "support/tool.h"

#define ON_EMULATED(...)                                                                                               \
    run_tool((const char *const[]){UMOCKDEV_WRAPPER, EMULATE_RAWHID, "--", KNURL_TEST_TOOL, __VA_ARGS__, NULL})

static const char plate[] = KNURL_TEST_ASSETS "/plate_1d.glb";

TEST(the_tool_lists_the_device) {
    need_terminal();
    SCOPED_PROCESS p = ON_EMULATED("devices");
    check_done(&p);
    assert_non_null(strstr(p.out, "rawhid:16c0:0486"));
    assert_non_null(strstr(p.out, "Teensyduino WoodenHaptics"));
}

TEST(a_plate_is_felt_with_it) {
    need_terminal();
    process p = ON_EMULATED("run", plate, "--device", "rawhid", "--seconds", "0.6");
    for (int tries = 1; p.exit_code != 0 && tries < 4; tries++) { /* an emulation that stalls for a second is lost */
        print_error("%s", p.err);
        process_free(&p);
        p = ON_EMULATED("run", plate, "--device", "rawhid", "--seconds", "0.6");
    }
    assert_int_equal(p.exit_code, 0);
    assert_true(json_number_of(p.out, "contact_s") > 0.0);
    assert_true(json_number_of(p.out, "force_max_n") > 0.1); /* 400 N/m a fraction of a millimetre deep */
    process_free(&p);
}

TEST(a_run_with_a_device_that_is_not_there_fails_with_a_sentence) {
    need_terminal();
    SCOPED_PROCESS p = ON_EMULATED("run", plate, "--device", "rawhid:1234:6", "--seconds", "0.1");
    assert_true(p.exit_code != 0);
    assert_non_null(strstr(p.err, "looked for a USB HID device 1234:0006 and found none"));
}
