/* CSV cells and warnings. SPDX-License-Identifier: MIT */
#include "tool.h"

#include <string.h>

void tool_print_cell(FILE *stream, const char *name) {
    char text[1024];
    (void)knurl_text_line(text, sizeof text, name); /* standard output may be a terminal */
    if (!strpbrk(text, ",\"\r\n")) {
        fputs(text, stream);
        return;
    }
    fputc('"', stream);
    for (const char *c = text; *c; c++) {
        if (*c == '"') {
            fputc('"', stream);
        }
        fputc(*c, stream);
    }
    fputc('"', stream);
}

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
            fprintf(stderr, "knurl: warning: %.*s\n", (int)(end - line), line);
            end += *end == '\n';
            warnings++;
        }
    }
    return warnings;
}
