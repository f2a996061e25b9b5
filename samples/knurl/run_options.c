/* Options of knurl run. SPDX-License-Identifier: MIT */
#include "run.h"
#include "stroke.h"

#include <math.h>

int run_read_options(int argc, char **argv, run_options *o) {
    const tool_option options[] = {
        {"--device", TOOL_TEXT, &o->device, 0, 0, ""},
        {"--surface", TOOL_TEXT, &o->surface, 0, 0, ""},
        {"--stroke", TOOL_TEXT, &o->stroke, 0, 0, ""},
        {"--trace", TOOL_TEXT, &o->trace, 0, 0, ""},
        {"--method", TOOL_TEXT, &o->method, 0, 0, ""},
        {"--out", TOOL_TEXT, &o->out, 0, 0, ""},
        {"--budget", TOOL_TEXT, &o->limits, 0, 0, ""},
        {"--wav", TOOL_TEXT, &o->wav, 0, 0, ""},
        {"--response", TOOL_TEXT, &o->response, 0, 0, ""},
        {"--seconds", TOOL_NUMBER, &o->seconds, 0.001, RUN_SECONDS_MAX, "s"},
        {"--rate", TOOL_NUMBER, &o->rate, KNURL_UPDATE_RATE_MIN, KNURL_UPDATE_RATE_MAX, "Hz"},
        {"--fast", TOOL_FLAG, &o->fast, 0, 0, ""},
        {"--exact", TOOL_FLAG, &o->exact, 0, 0, ""},
        {"--view", TOOL_FLAG, &o->view, 0, 0, ""},
        {"--clamp", TOOL_FLAG, &o->clamp, 0, 0, ""},
        {"--even", TOOL_FLAG, &o->even, 0, 0, ""},
        {"--reconnect", TOOL_FLAG, &o->reconnect, 0, 0, ""},
        {"--full-model", TOOL_FLAG, &o->full_model, 0, 0, ""},
        {"--pretty", TOOL_FLAG, &o->pretty, 0, 0, ""}};
    o->seconds = NAN;
    o->rate = 1000.0;
    if (tool_parse(argc, argv, options, sizeof options / sizeof *options, &o->path) != TOOL_OK ||
        tool_parse_budget(o->limits, &o->budget) != TOOL_OK) {
        return TOOL_USAGE;
    }
    if (!o->path || !o->path[0]) {
        return tool_error(TOOL_USAGE, "run: expected a .gltf or .glb file, found none");
    }
    if (o->out && o->wav && strcmp(o->out, o->wav) == 0) {
        return tool_error(TOOL_USAGE, "run: expected two outputs, found '%s' for both --out and --wav", o->out);
    }
    if (o->stroke && o->trace) {
        return tool_error(TOOL_USAGE, "run: expected --stroke or --trace, found both");
    }
    if (o->exact && !o->trace) {
        return tool_error(TOOL_USAGE, "run: --exact: expected --trace, whose positions it is about");
    }
    if (o->view && o->fast) {
        return tool_error(TOOL_USAGE, "run: expected --view or --fast, found both");
    }
    if (tool_check_even("run", o->even, o->response) != TOOL_OK) {
        return TOOL_USAGE;
    }
    if (knurl_stroke_from_name(o->stroke ? o->stroke : "line", &o->stroke_id)) {
        return tool_library_error(TOOL_USAGE, "run");
    }
    if (o->method && knurl_method_from_name(o->method, &o->method_id)) {
        return tool_library_error(TOOL_USAGE, "run");
    }
    return TOOL_OK;
}
