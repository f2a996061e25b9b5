/* The options of `knurl signal` and `knurl metrics`. SPDX-License-Identifier: MIT */
#include "wave_options.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const char *wave_method_name(int32_t method) {
    return method == KNURL_WAVE_T1 ? "T1" : method == KNURL_WAVE_T2 ? "T2" : "T3";
}

int tool_read_wave(int argc, char **argv, const tool_option *more, tool_wave *out) {
    const char *method = NULL;
    double period_ms = NAN;
    int32_t id = 0;
    out->amplitude = 1.0;
    out->rate = 1000.0;
    const tool_option options[] = {{"--method", TOOL_TEXT, &method, 0, 0, ""},
                                   {"--period-ms", TOOL_NUMBER, &period_ms, 1e-6, 10000.0, "ms"},
                                   {"--amplitude", TOOL_NUMBER, &out->amplitude, 0.0, 1e6, ""},
                                   {"--rate", TOOL_NUMBER, &out->rate, 1.0, 100000.0, "Hz"},
                                   *more};
    if (tool_parse(argc, argv, options, sizeof options / sizeof *options, NULL) != TOOL_OK) {
        return TOOL_USAGE;
    }
    if (!method || isnan(period_ms)) {
        return tool_error(TOOL_USAGE, "%s: expected --method and --period-ms, found %s", argv[0],
                          method ? "no --period-ms" : "no --method");
    }
    for (int32_t i = KNURL_WAVE_T1; i <= KNURL_WAVE_T3; i++) {
        id = strcmp(wave_method_name(i), method) == 0 ? i : id;
    }
    if (!id) {
        return tool_error(TOOL_USAGE, "%s: --method: expected T1, T2 or T3, found '%s'", argv[0], method);
    }
    out->period_s = period_ms / 1000.0;
    if (knurl_wave_prepare(id, out->period_s, out->amplitude, out->rate, &out->wave)) {
        return tool_library_error(TOOL_USAGE, argv[0]);
    }
    if (out->wave.above_nyquist) {
        tool_tell("note", "%g ms is below two updates at %g Hz; two updates are played", period_ms, out->rate);
    }
    return TOOL_OK;
}
