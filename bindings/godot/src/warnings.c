/* Warnings: stored with their surface, and passed to the editor. SPDX-License-Identifier: MIT */
#include "warnings.h"

#include <stdlib.h>
#include <string.h>

void warnings_keep(surface *s, const char *text) {
    free(s->explanation);
    s->explanation = text ? malloc(strlen(text) + 1) : NULL;
    if (s->explanation) {
        memcpy(s->explanation, text, strlen(text) + 1);
    }
}

void warnings_refresh(const gd_instance *node) {
    gd_call(gd_method.Node_update_configuration_warnings, node->object, NULL, NULL);
}

void warnings_refresh_all(void) {
    for (const surface *s = surfaces; s; s = s->next) {
        warnings_refresh(&s->base);
    }
}

void warnings_append(char *text, void *strings) {
    for (char *line = text, *end; *line; line = end) {
        gd_string string;
        int64_t failed = 0;
        const void *given[1] = {&string};
        end = line + strcspn(line, "\n");
        end += *end == '\n' ? (*end = '\0', 1) : 0;
        gd.string_new_with_utf8_chars(&string, line);
        gd_builtin.PACKED_STRING_ARRAY_append(strings, given, &failed, 1);
        gd_types[GDEXTENSION_VARIANT_TYPE_STRING].end(&string);
    }
}
