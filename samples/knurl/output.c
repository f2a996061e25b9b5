/* Warnings. SPDX-License-Identifier: MIT */
#include "tool.h"

#include <string.h>

uint32_t tool_warn(const knurl_scene *scene) {
    uint32_t warnings = 0;
    for (uint32_t i = 0; i < knurl_scene_get_surface_count(scene); i++) {
        knurl_surface_check check;
        knurl_surface_check_init(&check, sizeof check);
        if (knurl_scene_check_surface(scene, 0, knurl_scene_get_surface(scene, i), &check)) {
            continue;
        }
        for (char *line = check.message, *end; *line; line = end) {
            end = line + strcspn(line, "\n");
            tool_tell("warning", "%.*s", (int)(end - line), line);
            end += *end == '\n';
            warnings++;
        }
    }
    return warnings;
}
