/* Drivers over the doubles of their devices when memory runs out: a complete opening, and a loop on the opened device.
 * SPDX-License-Identifier: MIT */
#include "memory/failing.h"

#include "device/doubles.h"

static const device_double *current;
static knurl_device *device;
static knurl_loop *loop;

static knurl_result open_it(void) {
    device = current->open();
    return device ? KNURL_OK : KNURL_ERROR_MEMORY;
}

static void open_first(void) {
    failing_need(open_it());
}

static void push(uint64_t tick, const knurl_device_sample *sample, double force[3], void *user) {
    (void)tick;
    (void)sample;
    (void)user;
    force[0] = force[1] = force[2] = 0.1;
}

static knurl_result run_it(void) {
    knurl_loop_desc desc;
    knurl_loop_desc_init(&desc, sizeof desc);
    desc.device = device;
    desc.force_callback = push;
    desc.tick_limit = 20;
    knurl_result result = knurl_loop_create(&desc, &loop);
    result = result ? result : knurl_loop_start(loop);
    if (!result) {
        (void)knurl_loop_wait(loop, 1.0);
    }
    knurl_loop_destroy(loop);
    loop = NULL;
    return result;
}

static void close_it(void) {
    if (device) {
        current->close(device);
    }
    device = NULL;
}

TEST(every_driver_opens_and_runs_or_says_why_not_wherever_memory_runs_out) {
    for (size_t i = 0; i < double_count; i++) {
        const failing_call calls[] = {{doubles[i]->name, NULL, open_it, close_it, NULL, 0, 0},
                                      {"... a loop on it", open_first, run_it, close_it, NULL, 0, 0}};
        current = doubles[i];
        failing_run(calls, COUNT_OF(calls));
    }
}
