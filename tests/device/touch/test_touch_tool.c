/* Programs on a Touch: the tool and the sample, over the stub and without any library. SPDX-License-Identifier: MIT */
#include "support/tool.h"

static const char plate[] = KNURL_TEST_ASSETS "/plate_1d.glb";

#define RUN_SAMPLE(...) run_tool((const char *const[]){KNURL_TEST_SAMPLE, __VA_ARGS__, NULL})

static int use_stub(void **state) {
    (void)state;
    (void)unsetenv("KNURL_STUB_HD");
    return setenv("KNURL_HD_LIBRARY", KNURL_TEST_STUB, 1);
}

static int use_none(void **state) {
    (void)state;
    return unsetenv("KNURL_HD_LIBRARY");
}

/* --- the tool --- */

TEST_WITH(the_tool_feels_the_demo_plate_on_a_touch, use_stub, NULL) {
    SCOPED_PROCESS p = RUN_TOOL("run", plate, "--device", "touch", "--seconds", "0.6");
    if (p.exit_code != 0) {
        fail_msg("exit %d, signal %d: %s", p.exit_code, p.signal, p.err);
    }
    assert_non_null(strstr(p.out, "3D Systems Touch"));
    assert_true(json_number_of(p.out, "contact_s") > 0.3);
    assert_true(json_number_of(p.out, "half_cycles_crossed") > 20.0);
    assert_true(json_number_of(p.out, "force_max_n") > 0.05 && json_number_of(p.out, "force_max_n") <= 3.3);
}

static int lacks_rights(const char *device) {
    process p = RUN_TOOL("run", plate, "--device", device, "--seconds", "0.1");
    const int lacks = strstr(p.err, "real-time scheduling is not permitted") != NULL;
    process_free(&p);
    return lacks;
}

TEST_WITH(real_time_rights_are_missed_on_a_touch_only_where_they_are_on_others, use_stub, NULL) {
    assert_int_equal(lacks_rights("touch"), lacks_rights("fake"));
}

TEST_WITH(the_tool_says_so_when_the_touch_gets_lost, use_stub, NULL) {
    assert_int_equal(setenv("KNURL_STUB_HD", "fail_at=300", 1), 0);
    SCOPED_PROCESS p = RUN_TOOL("run", plate, "--device", "touch", "--seconds", "5");
    assert_int_equal(p.exit_code, 1);
    assert_non_null(strstr(p.err, "the device was lost"));
}

TEST_WITH(without_a_library_the_tool_says_what_helps, use_none, NULL) {
    process p = RUN_TOOL("run", plate, "--device", "touch", "--seconds", "2");
    check_refused(&p, 1, "touch|libHD.so|OpenHaptics|KNURL_HD_LIBRARY", "run --device touch");
}

/* --- the sample --- */

static process start_sample(const char *uri) {
    return process_start((const char *const[]){KNURL_TEST_SAMPLE, "--seconds", "1.9", uri, NULL}, NULL);
}

static void check_sample(process *p) {
    process_finish(p);
    if (p->exit_code != 0) {
        fail_msg("exit %d, signal %d: %s", p->exit_code, p->signal, p->err);
    }
    assert_non_null(strstr(p->out, "grating 0.5 mm"));
    assert_non_null(strstr(p->out, "grating 1 mm"));
    assert_non_null(strstr(p->out, "grating 2 mm"));
    assert_null(strstr(p->out, "lost"));
    process_free(p);
}

TEST_WITH(the_sample_plays_all_three_gratings_on_a_touch_and_on_the_fake_device, use_stub, NULL) {
    process touch = start_sample("touch");
    process fake = start_sample("fake");
    check_sample(&touch);
    check_sample(&fake);
}

TEST_WITH(the_sample_tells_faults_as_they_come_and_waits_for_the_device, use_stub, NULL) {
    assert_int_equal(setenv("KNURL_STUB_HD", "fail_at=300", 1), 0);
    SCOPED_PROCESS p = RUN_SAMPLE("--seconds", "0.7");
    assert_non_null(strstr(p.out, "lost: "));
    assert_non_null(strstr(p.out, "reconnected: ")); /* the stub's cable is plugged in again at once */
    assert_int_equal(p.exit_code, 0);
}

TEST_WITH(the_sample_stops_at_ctrl_c, use_stub, NULL) {
    SCOPED_PROCESS p = process_start((const char *const[]){KNURL_TEST_SAMPLE, "touch", NULL}, NULL);
    const struct timespec nap = {0, 200000000};
    (void)nanosleep(&nap, NULL);
    assert_int_equal(kill(p.pid, SIGINT), 0);
    process_finish(&p);
    assert_int_equal(p.signal, 0);
    assert_int_equal(p.exit_code, 0);
}

TEST_WITH(the_sample_helps_and_refuses, use_none, NULL) {
    process p = RUN_SAMPLE("--help");
    assert_int_equal(p.exit_code, 0);
    assert_non_null(strstr(p.out, "--seconds"));
    process_free(&p);
    p = RUN_SAMPLE("--seconds", "-1");
    assert_int_equal(p.exit_code, 2);
    process_free(&p);
    p = RUN_SAMPLE("--seconds", "1");
    assert_int_equal(p.exit_code, 1);
    assert_non_null(strstr(p.err, "libHD.so"));
    process_free(&p);
}
