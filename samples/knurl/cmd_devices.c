/* knurl devices: lists the connected devices, and remedies for problems. SPDX-License-Identifier: MIT */
#include "help.h"
#include "tool.h"

#include <knurl/device.h>

#include <stdlib.h>

static void print_for_people(const knurl_device_listing *listings, uint32_t count) {
    for (uint32_t i = 0; i < count; i++) {
        say(stdout, "%-20s %s\n", listings[i].uri, listings[i].name);
        if (listings[i].reason[0]) {
            say(stdout, "%-20s cannot be used: %s\n", "", listings[i].reason);
        }
    }
    say(stdout, "\n");
    say(stdout, "To open one: knurl run FILE --device URI. fake:?key=value&key=value takes\n");
    help_print_fake_keys();
}

static void print_json(const knurl_device_listing *listings, uint32_t count, int pretty) {
    json_writer out;
    json_start(&out, stdout, pretty);
    json_open(&out, NULL, '[');
    for (uint32_t i = 0; i < count; i++) {
        json_open(&out, NULL, '{');
        json_string(&out, "uri", listings[i].uri);
        json_string(&out, "name", listings[i].name);
        json_string(&out, "unusable", listings[i].reason);
        json_close(&out, '}');
    }
    json_close(&out, ']');
}

int cmd_devices(int argc, char **argv) {
    enum { ROOM = 64 };
    int json = 0;
    int pretty = 0;
    const tool_option options[] = {{"--json", TOOL_FLAG, &json, 0, 0, ""}, {"--pretty", TOOL_FLAG, &pretty, 0, 0, ""}};
    if (tool_parse(argc, argv, options, 2, NULL) != TOOL_OK) {
        return TOOL_USAGE;
    }
    knurl_device_listing *listings = calloc(ROOM, sizeof *listings);
    if (!listings) {
        return tool_error(TOOL_FAILURE, "devices: no memory for a list");
    }
    const uint32_t found = knurl_device_list(listings, ROOM);
    const uint32_t count = found < ROOM ? found : ROOM;
    if (json) {
        print_json(listings, count, pretty);
    } else {
        print_for_people(listings, count);
    }
    free(listings);
    return TOOL_OK;
}
