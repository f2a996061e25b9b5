/* knurl study: the numbers behind the figures and charts. SPDX-License-Identifier: MIT */
#include "programs.h"

#include "options.h"
#include "study.h"

#include <string.h>

static int unknown(const char *name) {
    char known[512] = "";
    for (const study *s = studies; s->name; s++) {
        strncat(known, s == studies ? "" : ", ", sizeof known - strlen(known) - 1);
        strncat(known, s->name, sizeof known - strlen(known) - 1);
    }
    return tool_error(TOOL_USAGE, "study: expected one of %s, found '%s'", known, name ? name : "none");
}

int cmd_study(int argc, char **argv) {
    const char *name = NULL;
    const char *folder = NULL;
    const tool_option options[] = {{"--out", TOOL_TEXT, &folder, 0, 0, ""}};
    if (tool_parse(argc, argv, options, 1, &name) != TOOL_OK) {
        return TOOL_USAGE;
    }
    for (const study *s = studies; name && s->name; s++) {
        if (strcmp(s->name, name) == 0) {
            return folder ? (s->run(folder) ? TOOL_FAILURE : TOOL_OK)
                          : tool_error(TOOL_USAGE, "study: expected --out DIR, found none");
        }
    }
    return unknown(name);
}
