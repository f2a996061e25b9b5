/* --even and --response: gains of the amplitude over f_t. SPDX-License-Identifier: MIT */
#include "os.h"
#include "tool.h"

#include <knurl/hip.h>

/* No more of the file than the library takes, and one byte that tells so. */
int tool_read_response(const char *path, knurl_gain gains[KNURL_GAINS]) {
    static char text[65536 + 1];
    const char *why = "";
    FILE *stream = os_open_input(path, &why);
    if (!stream) {
        return tool_error(TOOL_FAILURE, "%s: cannot be read: %s", path, why);
    }
    out_protect_stream(stream);
    const size_t size = fread(text, 1, sizeof text, stream);
    const int failed = ferror(stream);
    (void)fclose(stream);
    if (failed) {
        return tool_error(TOOL_FAILURE, "%s: cannot be read", path);
    }
    return knurl_gains_from_response(text, size, gains) ? tool_library_error(TOOL_FAILURE, path) : TOOL_OK;
}

int tool_check_even(const char *command, int even, const char *response) {
    return even && response ? tool_error(TOOL_USAGE, "%s: expected --even or --response, found both", command)
                            : TOOL_OK;
}

int tool_even(knurl_scene *scene, const char *path, const knurl_device *device, double rate) {
    knurl_gain gains[KNURL_GAINS];
    knurl_device_info info;
    knurl_device_info_init(&info, sizeof info);
    if (path) {
        if (tool_read_response(path, gains) != TOOL_OK) {
            return TOOL_FAILURE;
        }
    } else if (knurl_device_get_info(device, &info) || knurl_gains_from_plant(info.mass, info.viscous, rate, gains)) {
        return tool_library_error(TOOL_FAILURE, "--even");
    }
    return knurl_scene_set_gains(scene, 0, gains, KNURL_GAINS) ? tool_library_error(TOOL_FAILURE, "--even") : TOOL_OK;
}

void tool_print_even(json_writer *json, const knurl_scene *scene) {
    knurl_surface_check check;
    knurl_surface_check_init(&check, sizeof check);
    if (knurl_scene_check_surface(scene, 0, knurl_scene_get_surface(scene, 0), &check) == KNURL_OK &&
        check.lowered_hz[1] > 0.0) {
        json_open(json, "even", '{');
        json_number(json, "lowest_gain", check.lowest_gain);
        json_number(json, "from_hz", check.lowered_hz[0]);
        json_number(json, "to_hz", check.lowered_hz[1]);
        json_close(json, '}');
    }
}
