/* A temporal signal from the options of `knurl signal` and `knurl metrics`. SPDX-License-Identifier: MIT */
#ifndef KNURL_SAMPLES_WAVE_OPTIONS_H
#define KNURL_SAMPLES_WAVE_OPTIONS_H

#include "options.h"

#include <knurl/vibration.h>

typedef struct tool_wave {
    knurl_wave wave;
    double period_s, amplitude, rate;
} tool_wave;

/* "T1", "T2" or "T3" for KNURL_WAVE_T1 to KNURL_WAVE_T3. */
const char *wave_method_name(int32_t method);

/* Reads --method, --period-ms, --amplitude, --rate and one further option. Returns TOOL_OK or TOOL_USAGE. */
int tool_read_wave(int argc, char **argv, const tool_option *more, tool_wave *out);

#endif
