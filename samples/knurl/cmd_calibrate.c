/* knurl calibrate falcon: measures a known mass, so that its forces are correct in newtons. SPDX-License-Identifier:
 * MIT */
#include "tool.h"
#include "weigh.h"

#include <math.h>
#include <string.h>

#define GAIN 0.35 /* while weighing: the smallest likely value, see knurl_device_open() */

static void wait_for_enter(const char *text) {
    int c = 0;
    say(stderr, "%s, then press Enter. ", text);
    while (c != '\n' && c != EOF) {
        c = getchar();
    }
}

/* Both weighings, the empty grip first. */
static knurl_result weigh_both(double *heavier) {
    char uri[64];
    double height = NAN;
    double empty = 0.0;
    double loaded = 0.0;
    knurl_device *device = NULL;
    (void)snprintf(uri, sizeof uri, "falcon:?gain=%g&motors_known=1", GAIN);
    knurl_result result = knurl_device_open(uri, &device);
    if (result) {
        return result;
    }
    wait_for_enter("Pull the grip out and push it in, until its light is green. Hold it in the middle");
    say(stderr, "Release it slowly: it moves up and down for %g s.\n", WEIGH_SECONDS);
    result = weigh(device, &height, &empty);
    if (!result) {
        wait_for_enter("Hang the mass from the grip, and hold it in the middle");
        say(stderr, "Release it slowly: it moves up and down for %g s.\n", WEIGH_SECONDS);
        result = weigh(device, &height, &loaded);
    }
    knurl_device_close(device);
    *heavier = loaded - empty;
    return result;
}

static int print_gain(out_file *file, const char *path, double gain, double heavier) {
    say(stdout, "{\"gain\": %.3f, \"newtons\": %.3f}\n", gain, heavier);
    say(file->stream, "%.3f\n", gain);
    if (out_keep(file)) {
        return TOOL_FAILURE;
    }
    say(stderr, "Set KNURL_FALCON_GAIN=%s for programs that use this Falcon.\n", path);
    return TOOL_OK;
}

static int calibrate(double mass, const char *path) {
    out_file file;
    double heavier = 0.0;
    if (out_open(&file, path)) { /* open the file before the user holds the grip for two weighings */
        return TOOL_FAILURE;
    }
    if (weigh_both(&heavier)) {
        out_discard(&file);
        return tool_library_error(TOOL_FAILURE, "calibrate");
    }
    const double gain = weigh_gain(GAIN, mass, heavier);
    if (!(gain >= 0.05 && gain <= 1.0)) {
        out_discard(&file);
        return tool_error(TOOL_FAILURE,
                          "calibrate: the mass took %g N more than the empty grip, which makes a gain of %g; expected "
                          "0.05 to 1: was it %g kg, and did nothing touch it?",
                          heavier, gain, mass);
    }
    return print_gain(&file, path, gain, heavier);
}

int cmd_calibrate(int argc, char **argv) {
    double mass = NAN;
    const char *path = NULL;
    const char *what = NULL;
    const tool_option options[] = {{"--mass", TOOL_NUMBER, &mass, 0.05, 0.4, "kg"},
                                   {"--out", TOOL_TEXT, (void *)&path, 0, 0, ""}};
    if (tool_parse(argc, argv, options, 2, &what) != TOOL_OK) {
        return TOOL_USAGE;
    }
    if (!what || strcmp(what, "falcon") != 0 || isnan(mass) || !path) {
        return tool_error(TOOL_USAGE, "calibrate: expected falcon --mass KG --out FILE");
    }
    return calibrate(mass, path);
}
