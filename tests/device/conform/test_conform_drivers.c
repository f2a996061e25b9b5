/* Every driver passes samples/conform over its double, in real loops on virtual time. SPDX-License-Identifier: MIT */
#include "trial.h"

#include "device/doubles.h"
#include "support/close.h"

#include "base/system.h"

#include <stdio.h>
#include <stdlib.h>

/* After these the motors have no force until all is well. */
#define LASTING                                                                                                        \
    (1u << DOUBLE_UNPLUG | 1u << DOUBLE_MUTE | 1u << DOUBLE_HANG | 1u << DOUBLE_NAN | 1u << DOUBLE_REFUSE |            \
     1u << DOUBLE_UNHOMED)

static const device_double *tried;

static knurl_device *open_double(uint64_t seed, judge *j) {
    (void)seed;
    (void)j;
    return tried->open();
}

static int inject(int which) {
    const uint32_t usable = tried->faults & LASTING;
    int fault = DOUBLE_WELL;
    for (int left = which; left > 0;) {
        left -= usable & 1u << ++fault ? 1 : 0;
    }
    tried->inject(fault);
    return which > 0;
}

/* A transfer that is under way takes up to a millisecond. */
static int is_limp(void) {
    for (int i = 0; i < 30 && tried->limp_since() == 0; i++) {
        knurl_system_sleep_until_ns(knurl_system_now_ns() + 100000);
    }
    return tried->limp_since() > 0;
}

static void close_double(knurl_device *device) {
    tried->close(device);
}

static int count_bits(uint32_t bits) {
    int count = 0;
    for (; bits; bits &= bits - 1) {
        count++;
    }
    return count;
}

/* How many promises were broken. */
static int report(const judge *j, const char *name) {
    int broken = 0;
    for (int i = 0; i < JUDGE_COUNT; i++) {
        const judge_breach *b = &j->breaches[i];
        if (b->count > 0) {
            print_error("%s: %s %d times, by up to %.3g, first after %s, seed %d\n", name, judge_promises[i].sentence,
                        (int)b->count, b->worst, b->after, (int)b->seed);
            broken++;
        }
    }
    return broken;
}

static int try_subject(const subject *on, const char *name, uint64_t wanted) {
    static judge j;
    uint64_t ticks = 0;
    memset(&j, 0, sizeof j);
    for (uint64_t seed = 1; ticks < wanted; seed++) {
        if (trial_run(on, seed, &j, &ticks)) {
            fail_msg("%s: %s", name, knurl_error_message());
        }
    }
    print_message("%s: %d ticks, %d judged, %d in contact\n", name, (int)ticks, (int)j.ticks, (int)j.contacts);
    assert_true(j.contacts > j.ticks / 20);
    return report(&j, name);
}

static uint64_t most_ticks(void) {
    return getenv("KNURL_LONG") ? 200000 : SUITE_SANITIZED ? 3000 : 10000;
}

TEST(every_driver_keeps_every_promise_over_its_double) {
    int broken = 0;
    for (size_t i = 0; i < double_count; i++) {
        tried = doubles[i];
        const subject on = {
            open_double,           inject, count_bits(tried->faults & LASTING), is_limp, close_double, NULL, NULL,
            1e-3 * tried->alone_ms};
        broken += try_subject(&on, tried->name, most_ticks());
    }
    assert_int_equal(broken, 0);
}

static knurl_device *open_fake(uint64_t seed, judge *j) {
    static const char *const presets[] = {"touch", "falcon", "woodenhaptics", "omega", "inverse3"};
    char uri[64];
    knurl_device *device = NULL;
    (void)j;
    (void)snprintf(uri, sizeof uri, "fake:?preset=%s&seed=%d", presets[seed % COUNT_OF(presets)], (int)seed);
    return knurl_device_open(uri, &device) ? NULL : device;
}

TEST(the_fake_device_keeps_every_promise) {
    const subject on = {open_fake, NULL, 0, NULL, knurl_device_close, NULL, NULL, 0.0};
    assert_int_equal(try_subject(&on, "fake", 10 * most_ticks()), 0);
}
