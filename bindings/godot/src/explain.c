/* Why surfaces cannot be felt, or not as asked for. SPDX-License-Identifier: MIT */
#include "explain.h"

#include "follow.h"
#include "geometry.h"

#include <stdio.h>
#include <string.h>

static void say(char *text, size_t size, const char *sentence) {
    const size_t length = strlen(text);
    const char *line = length > 0 && sentence[0] ? "\n" : "";
    (void)snprintf(text + length, size - length, "%s%s", line, sentence);
}

void explain_surface(const surface *s, char *text, size_t size) {
    uint8_t is_inside = 0;
    knurl_session_pose at;
    geometry_refuse(follow_parent(s), text, size);
    gd_call(gd_method.Node_is_inside_tree, s->base.object, NULL, &is_inside);
    if (!s->grating) {
        say(text, size, "It has no grating: nothing says how it feels.");
    }
    if (is_inside && !follow_pose(s->base.object, &at)) {
        say(text, size, "It is scaled to nothing.");
    }
    for (int i = 0; i < DEVICE_SLOTS; i++) {
        if (devices[i] && s->ids[i]) {
            char why[4096];
            knurl_session_explain(devices[i]->session, s->ids[i], why, sizeof why);
            say(text, size, why);
        }
    }
}
