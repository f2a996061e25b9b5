/* The devices that the Haply Inverse Service knows, before one is opened. SPDX-License-Identifier: MIT */
#include "device/inverse3/service.h"

#include <stdio.h>
#include <string.h>

/* Forces, stiffness and radius as tutorial 06 has them. Assumed: the force held for long, a third of the peak (10 N); a
 * Minverse's forces, a quarter of an Inverse3's, because they are not published; an Inverse3x as an Inverse3. */
static const knurl_inverse3_model models[] = {
    {"inverse3", KNURL_INVERSE3_NAME, 4.0, 3.3, 1000.0, 0.1},
    {"inverse3x", "Haply Inverse3x", 4.0, 3.3, 1000.0, 0.1},
    {"minverse", "Haply Minverse", 1.0, 0.8, 500.0, 0.04},
};

const knurl_inverse3_model *knurl_inverse3_find_model(const knurl_inverse3_entry *entry) {
    for (size_t i = 0; i < sizeof models / sizeof *models; i++) {
        if (strcmp(models[i].type, entry->type) == 0) {
            return &models[i];
        }
    }
    return NULL;
}

knurl_result knurl_inverse3_first(const knurl_inverse3_service *service, int port, knurl_inverse3_channel *channel,
                                  knurl_inverse3_state *state) {
    char why[160] = "";
    knurl_inverse3_message message = {NULL, 0};
    memset(state, 0, sizeof *state);
    const knurl_inverse3_filter all = {NULL, NULL};
    if (!service->connect(service->user, port, all, channel, why, sizeof why)) {
        return knurl_fail(KNURL_ERROR_DEVICE_LOST,
                          "device 'inverse3': the Haply Inverse Service does not answer at localhost:%d (%s); start it "
                          "(the Haply Hub does), or name its port by ?port=",
                          port, why);
    }
    const int came = channel->receive(channel->self, KNURL_INVERSE3_HELLO_MS, &message);
    if (came > 0 && knurl_inverse3_read(message.text, message.size, state)) {
        return KNURL_OK;
    }
    channel->close(channel->self);
    channel->self = NULL;
    return knurl_fail(KNURL_ERROR_DEVICE_LOST,
                      "device 'inverse3': the server at localhost:%d is not the Haply Inverse Service 3.5 or newer: "
                      "expected its devices in JSON within %g s, found %s",
                      port, 1e-3 * KNURL_INVERSE3_HELLO_MS, came > 0 ? "something else" : "nothing");
}

/* The reason for the listing; "" if it plays forces. Once the device is open, faults are events. */
static const char *why_not(const knurl_inverse3_entry *entry, const knurl_inverse3_model *model) {
    return !model                ? "its type, and so its force limit, is unknown to this version"
           : entry->is_unpowered ? "its power supply is unplugged: plug it in"
           : entry->is_not_ready ? "its service reports that it is not ready: the Haply Hub shows why"
                                 : "";
}

void knurl_inverse3_list(const knurl_inverse3_service *service, knurl_listings *listings) {
    char uri[32];
    knurl_inverse3_channel channel;
    knurl_inverse3_state state;
    if (knurl_inverse3_first(service, KNURL_INVERSE3_PORT, &channel, &state)) {
        const char *reason = knurl_error_message() + strlen("device 'inverse3': "); /* the listing already has that */
        knurl_listings_add(listings, "inverse3", KNURL_INVERSE3_NAME, "%s", reason);
        return;
    }
    channel.close(channel.self);
    if (!knurl_inverse3_find(&state, "")) {
        knurl_listings_add(listings, "inverse3", KNURL_INVERSE3_NAME, "not connected: " KNURL_INVERSE3_PLUG_IN);
    }
    for (int i = 0; i < KNURL_INVERSE3_DEVICES; i++) {
        const knurl_inverse3_entry *entry = &state.entries[i];
        const knurl_inverse3_model *model = knurl_inverse3_find_model(entry);
        if (entry->id[0]) {
            (void)snprintf(uri, sizeof uri, "inverse3:%s", entry->id);
            knurl_listings_add(listings, uri, model ? model->name : KNURL_INVERSE3_NAME, "%s", why_not(entry, model));
        }
    }
}
