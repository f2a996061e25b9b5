/* knurl signal: a temporal vibration as CSV. SPDX-License-Identifier: MIT */
#include "tool.h"
#include "wave_options.h"

#include <math.h>

int cmd_signal(int argc, char **argv) {
    tool_wave signal;
    double ticks = NAN;
    const tool_option option = {"--ticks", TOOL_NUMBER, &ticks, 1.0, 1e9, ""};
    const int code = tool_read_wave(argc, argv, &option, &signal);
    if (code != TOOL_OK) {
        return code;
    }
    if (isnan(ticks)) {
        return tool_error(TOOL_USAGE, "signal: expected --ticks, found none");
    }
    if (ticks != floor(ticks)) {
        return tool_error(TOOL_USAGE, "--ticks: expected a whole number, found %g", ticks);
    }
    csv_writer csv;
    csv_start(&csv, stdout, "tick,value");
    for (uint64_t tick = 0; tick < (uint64_t)ticks; tick++) {
        csv_number(&csv, (double)tick);
        csv_number(&csv, knurl_wave_value(&signal.wave, tick));
        csv_end_row(&csv);
    }
    return TOOL_OK;
}
