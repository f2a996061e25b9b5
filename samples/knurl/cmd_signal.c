/* knurl signal: a temporal vibration as CSV. SPDX-License-Identifier: MIT */
#include "tool.h"

#include <knurl/knurl.h>

#include <math.h>
#include <string.h>

static int32_t method_of(const char *name) {
    static const char *const names[] = {"T1", "T2", "T3"};
    static const int32_t methods[] = {KNURL_T1, KNURL_T2, KNURL_T3};
    for (int i = 0; i < 3; i++) {
        if (strcmp(names[i], name) == 0) {
            return methods[i];
        }
    }
    return 0;
}

int cmd_signal(int argc, char **argv) {
    const char *method = NULL;
    double period_ms = NAN;
    double amplitude = 1.0;
    double rate = 1000.0;
    double ticks = NAN;
    const tool_option options[] = {{"--method", TOOL_TEXT, &method, 0, 0, ""},
                                   {"--period-ms", TOOL_NUMBER, &period_ms, 1e-6, 10000.0, "ms"},
                                   {"--amplitude", TOOL_NUMBER, &amplitude, 0.0, 1e6, ""},
                                   {"--rate", TOOL_NUMBER, &rate, 1.0, 100000.0, "Hz"},
                                   {"--ticks", TOOL_NUMBER, &ticks, 1.0, 1e9, ""}};
    if (tool_parse(argc, argv, options, 5, NULL) != TOOL_OK) {
        return TOOL_USAGE;
    }
    if (!method || isnan(period_ms) || isnan(ticks)) {
        return tool_error(TOOL_USAGE, "signal: expected --method, --period-ms and --ticks, found %s",
                          method ? "one of the numbers missing" : "no --method");
    }
    if (!method_of(method)) {
        return tool_error(TOOL_USAGE, "signal: --method: expected T1, T2 or T3, found '%s'", method);
    }
    knurl_wave wave;
    if (knurl_wave_init(method_of(method), period_ms / 1000.0, amplitude, rate, &wave)) {
        return tool_library_error(TOOL_USAGE, "signal");
    }
    if (wave.saturated) {
        fprintf(stderr, "knurl: note: %g ms is below two updates at %g Hz; two updates are played\n", period_ms, rate);
    }
    fputs("tick,value\n", stdout);
    for (uint64_t tick = 0; tick < (uint64_t)ticks; tick++) {
        printf("%llu,", (unsigned long long)tick);
        tool_print_number(stdout, knurl_wave_value(&wave, tick));
        putchar('\n');
    }
    return TOOL_OK;
}
