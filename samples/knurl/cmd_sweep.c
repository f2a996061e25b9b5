/* knurl sweep: measures a device's response and writes it as a file for --response. SPDX-License-Identifier: MIT */
#include "os.h"
#include "sweep.h"
#include "tool.h"
#include "verify.h"

#include <knurl/hip.h>

#include <string.h>

#define LAST_HZ 300.0 /* a response that ends below is of no use */

static volatile sig_atomic_t interrupted;

static void on_signal(int number) {
    interrupted = number;
}

static void print_summary(const sweep *s, uint32_t count, const char *name, int pretty) {
    json_writer json;
    json_start(&json, stdout, pretty);
    json_open(&json, NULL, '{');
    json_string(&json, "device", name);
    json_number(&json, "rate_hz", s->rate);
    json_number(&json, "force_n", s->newtons);
    json_number(&json, "seconds", s->seconds);
    json_number(&json, "overruns", (double)s->overruns);
    json_number(&json, "rows", count);
    json_number(&json, "to_hz", s->rows[count - 1].hz);
    json_close(&json, '}');
}

static int write_out(out_file *file, knurl_device *device, const sweep *s, int pretty) {
    knurl_device_info info;
    const uint32_t count = sweep_count_clear(s);
    knurl_device_info_init(&info, sizeof info);
    (void)knurl_device_get_info(device, &info);
    if (count == 0 || s->rows[count - 1].hz < LAST_HZ) {
        return tool_error(
            TOOL_FAILURE,
            "sweep: expected motions that stand out to %g Hz, found them to %g Hz: positions are too coarse "
            "(%.3g mm) or the hand moved too much",
            LAST_HZ, count ? s->rows[count - 1].hz : 0.0, 1e3 * info.resolution);
    }
    sweep_write(s, file->stream, info.name);
    if (out_keep(file)) {
        return TOOL_FAILURE;
    }
    print_summary(s, count, info.name, pretty);
    return TOOL_OK;
}

static int perform(const char *uri, const char *path, double rate, int fast, int pretty) {
    static sweep result;
    out_file file;
    knurl_device *device = NULL;
    if (out_open(&file, path)) { /* before somebody has held the grip for two minutes */
        return TOOL_FAILURE;
    }
    (void)knurl_device_zero_on_exit(0);
    os_on_interrupt(on_signal);
    const knurl_result opened = verify_open(uri, &device);
    int code = TOOL_OK;
    if (!opened && strncmp(uri, "fake", 4) != 0) {
        say(stderr, "Hold the grip as when you feel a surface, away from its ends. It hums for some two minutes.\n");
    }
    if (opened) {
        const int is_usage = opened == KNURL_ERROR_UNKNOWN || opened == KNURL_ERROR_ARGUMENT;
        code = tool_library_error(is_usage ? TOOL_USAGE : TOOL_FAILURE, "sweep: --device");
    } else if (sweep_run(device, rate, fast, &interrupted, &result)) {
        code = tool_library_error(interrupted ? TOOL_INTERRUPTED + interrupted : TOOL_FAILURE, "sweep");
    } else {
        code = write_out(&file, device, &result, pretty);
    }
    out_discard(&file);
    knurl_device_close(device);
    return code;
}

int cmd_sweep(int argc, char **argv) {
    const char *uri = "fake";
    const char *path = NULL;
    const char *stray = NULL;
    double rate = 1000.0;
    int fast = 0;
    int pretty = 0;
    const tool_option options[] = {{"--device", TOOL_TEXT, (void *)&uri, 0, 0, ""},
                                   {"--out", TOOL_TEXT, (void *)&path, 0, 0, ""},
                                   {"--rate", TOOL_NUMBER, &rate, 1000.0, KNURL_UPDATE_RATE_MAX, "Hz"},
                                   {"--fast", TOOL_FLAG, &fast, 0, 0, ""},
                                   {"--pretty", TOOL_FLAG, &pretty, 0, 0, ""}};
    if (tool_parse(argc, argv, options, sizeof options / sizeof *options, &stray) != TOOL_OK) {
        return TOOL_USAGE;
    }
    if (stray || !path) {
        return tool_error(TOOL_USAGE, "sweep: expected --device URI --out CSV, found %s%s",
                          stray ? "an argument " : "no --out", stray ? stray : "");
    }
    if (fast && strncmp(uri, "fake", 4) != 0) {
        return tool_error(TOOL_USAGE, "sweep: only the fake device takes --fast, found --device %s", uri);
    }
    return perform(uri, path, rate, fast, pretty);
}
