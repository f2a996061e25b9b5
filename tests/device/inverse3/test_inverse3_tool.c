/* The command-line tool with an emulated Haply Inverse Service at a port of this machine, over real WebSockets.
 * SPDX-License-Identifier: MIT */
#include "support/tool.h"

#include <knurl/device.h>
#include <signal.h>
#include <time.h>

#define WITH_SERVICE(fault, ...)                                                                                       \
    run_tool((const char *const[]){EMULATE_INVERSE3, fault, KNURL_TEST_TOOL, __VA_ARGS__, NULL})
#define STROKE(fault, seconds)                                                                                         \
    WITH_SERVICE(fault, "run", plate, "--device", "inverse3:?port=PORT", "--seconds", seconds)

static const char plate[] = KNURL_TEST_ASSETS "/plate_1d.glb";

static double now_s(void) {
    struct timespec now;
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Another one, with another id, is listed before it. */
TEST(a_plate_is_felt_with_it) {
    process p = {0};
    for (int tries = 0; tries == 0 || (p.exit_code != 0 && tries < 4); tries++) { /* one that stalls for 1 s is lost */
        if (tries > 0) {
            print_error("%s", p.err);
            process_free(&p);
        }
        p = WITH_SERVICE("two", "run", plate, "--device", "inverse3:049D?port=PORT", "--seconds", "0.4");
    }
    assert_int_equal(p.exit_code, 0);
    assert_non_null(strstr(p.out, "Haply Inverse3"));
    assert_true(json_number_of(p.out, "contact_s") > 0.1);
    assert_true(json_number_of(p.out, "force_max_n") > 0.1); /* 400 N/m a fraction of a millimetre deep */
    process_free(&p);
}

static int tells(const process *p, const char *word) {
    return strstr(p->err, word) || strstr(p->out, word);
}

/* After 0.1 s; the tool ends with it, or continues without a force. An answer after 5 ms counts as silence: if the
 * machine is too busy to transfer 70 KB within that time, the fault is tried again. */
TEST(faults_of_the_service_are_reported) {
    static const struct {
        const char *fault, *seconds, *words;
    } table[] = {{"unplugged", "0.2", "lost"},
                 {"unpowered", "0.2",
                  "forces off; no force is sent until they are on again: its power supply is unplugged; plug it in"},
                 {"closed", "0.2", "lost"},
                 {"mute", "0.2", "silent"},
                 {"late", "0.2", "silent"},
                 {"garbage", "0.2", "corrupt"},
                 {"long", "0.6", "corrupt"}};
    for (size_t i = 0; i < COUNT_OF(table); i++) {
        process p = STROKE(table[i].fault, table[i].seconds);
        for (int tries = 1; tries < 5 && !tells(&p, table[i].words) && tells(&p, "silent"); tries++) {
            process_free(&p);
            p = STROKE(table[i].fault, table[i].seconds);
        }
        if (!tells(&p, table[i].words)) {
            fail_msg("%s: exit %d, %s%s", table[i].fault, p.exit_code, p.out, p.err);
        }
        process_free(&p);
    }
}

TEST(a_failed_open_is_one_sentence_and_quick) {
    static const struct {
        const char *fault, *words;
    } table[] = {
        {"old", "inverse3|3.5 or newer"}, {"strange", "is not the Haply Inverse Service"}, {"silent", "found nothing"}};
    for (size_t i = 0; i < COUNT_OF(table); i++) {
        process p = STROKE(table[i].fault, "1");
        check_refused(&p, 1, table[i].words, table[i].fault);
    }
    const double begin = now_s();
    process p = RUN_TOOL("run", plate, "--device", "inverse3:?port=9", "--seconds", "1");
    check_refused(&p, 1, "does not answer at localhost:9", "no service");
    assert_true(now_s() - begin < 1.0);
}

/* libwebsockets makes the process ignore it. */
TEST(the_processs_handling_of_SIGPIPE_is_unchanged) {
    struct sigaction now;
    knurl_device *device = NULL;
    CHECK_REFUSED(knurl_device_open("inverse3:?port=9", &device), KNURL_ERROR_DEVICE_LOST, device);
    assert_int_equal(sigaction(SIGPIPE, NULL, &now), 0);
    assert_true(now.sa_handler == SIG_DFL);
}
