/* conform: tests a device against the promises of docs/safety.md. See docs/devices.md. SPDX-License-Identifier: MIT */
#include "json.h"
#include "options.h"
#include "trial.h"

#include <string.h>

static const char *uri;

/* One device for all trials: some are homed, or load their firmware, each time they are opened. */
static knurl_device *opened;

static knurl_device *open_uri(uint64_t seed, judge *j) {
    (void)seed;
    (void)j;
    return opened || knurl_device_open(uri, &opened) == KNURL_OK ? opened : NULL;
}

static void keep(knurl_device *device) {
    (void)device;
}

static const subject uri_subject = {open_uri, NULL, 0, NULL, keep, NULL, NULL, 0.0};

static void say(const judge *j) {
    for (int i = 0; i < JUDGE_COUNT; i++) {
        const judge_breach *b = &j->breaches[i];
        if (b->count > 0) {
            fprintf(stderr,
                    "conform: promise '%s' broken %llu times, at worst by %.3g; first after %s: --seed %llu "
                    "--seconds 0. %s\n",
                    judge_promises[i].name, (unsigned long long)b->count, b->worst, b->after,
                    (unsigned long long)b->seed, judge_promises[i].sentence);
        }
    }
}

static int broken(const judge *j) {
    int count = 0;
    for (int i = 0; i < JUDGE_COUNT; i++) {
        count += j->breaches[i].count > 0;
    }
    return count;
}

static void print(const judge *j, const char *name, uint64_t seed, uint64_t ticks) {
    json_writer out;
    json_start(&out, stdout, 1);
    json_open(&out, NULL, '{');
    json_string(&out, "device", name);
    json_number(&out, "seed", (double)seed);
    json_number(&out, "ticks", (double)ticks);
    json_number(&out, "judged", (double)j->ticks);
    json_number(&out, "contacts", (double)j->contacts);
    json_number(&out, "squeezed_ticks", (double)j->squeezed_ticks);
    json_open(&out, "promises", '[');
    for (int i = 0; i < JUDGE_COUNT; i++) {
        const judge_breach *b = &j->breaches[i];
        json_open(&out, NULL, '{');
        json_string(&out, "name", judge_promises[i].name);
        json_number(&out, "broken", (double)b->count);
        if (b->count > 0) {
            json_number(&out, "worst", b->worst);
            json_number(&out, "seed", (double)b->seed);
            json_number(&out, "force", (double)b->tick);
            json_string(&out, "after", b->after);
        }
        json_close(&out, '}');
    }
    json_close(&out, ']');
    json_open(&out, "faults", '{');
    for (int32_t code = 0; code < 64; code++) {
        if (j->faults[code] > 0) {
            json_number(&out, knurl_fault_name(code), (double)j->faults[code]);
        }
    }
    json_close(&out, '}');
    json_close(&out, '}');
}

int main(int argc, char **argv) {
    static judge j;
    double seed = 1.0;
    double seconds = 60.0;
    const tool_option options[] = {{"--device", TOOL_TEXT, (void *)&uri, 0, 0, ""},
                                   {"--seed", TOOL_NUMBER, &seed, 0.0, 9e15, ""},
                                   {"--seconds", TOOL_NUMBER, &seconds, 0.0, 1e9, "s"}};
    tool_name = "conform";
    if (tool_parse(argc, argv, options, 3, NULL) != TOOL_OK) {
        return TOOL_USAGE;
    }
    (void)knurl_device_zero_on_exit(0);
    uint64_t ticks = 0;
    for (uint64_t next = (uint64_t)seed; ticks == 0 || (double)ticks < 1000.0 * seconds; next++) {
        if (trial_run(uri ? &uri_subject : &functions_subject, next, &j, &ticks)) {
            knurl_device_close(opened);
            return tool_library_error(TOOL_FAILURE, uri ? uri : "the functions");
        }
    }
    knurl_device_close(opened);
    say(&j);
    print(&j, uri ? uri : "functions", (uint64_t)seed, ticks);
    return tool_end(broken(&j) ? TOOL_FAILURE : TOOL_OK);
}
