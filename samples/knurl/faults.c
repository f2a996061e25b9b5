/* Device faults, printed as they occur and counted for the summary. SPDX-License-Identifier: MIT */
#include "faults.h"

#include <string.h>
#include <time.h>

void faults_start(faults *f) {
    struct timespec now;
    memset(f, 0, sizeof *f);
#ifdef CLOCK_BOOTTIME
    (void)clock_gettime(CLOCK_BOOTTIME, &now); /* the clock of knurl_device_event.time_ns */
#else
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
#endif
    f->start_ns = (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

void faults_show(faults *f, knurl_device *device, double simulated) {
    knurl_device_event event;
    while (knurl_device_next_event(device, &event)) {
        if (event.code >= 0 && event.code < FAULT_CODES) {
            f->counts[event.code]++;
        }
        const char *unit = knurl_fault_unit(event.code);
        const char *cause = knurl_fault_cause(event.code, event.value);
        if (event.code != KNURL_FAULT_OVERRUN) {
            char value[64] = "";
            if (*unit) {
                (void)snprintf(value, sizeof value, " (%g %s)", event.value, unit);
            }
            tool_tell("note", "after %.3f s: %s: %s%s%s%s",
                      simulated >= 0.0 ? simulated : 1e-9 * (double)(event.time_ns - f->start_ns),
                      knurl_fault_name(event.code), knurl_fault_string(event.code), *cause ? ": " : "", cause, value);
        }
    }
}

void faults_print(const faults *f, json_writer *json) {
    json_open(json, "faults", '{');
    for (int32_t code = 0; code < FAULT_CODES; code++) {
        if (f->counts[code] > 0) {
            json_number(json, knurl_fault_name(code), (double)f->counts[code]);
        }
    }
    json_close(json, '}');
}
