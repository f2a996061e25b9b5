/* knurl study: the numbers behind the figures and charts. SPDX-License-Identifier: MIT */
#include "programs.h"

#include "contender.h"
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
    int own = 0;
    const tool_option options[] = {{"--out", TOOL_TEXT, &folder, 0, 0, ""}, {"--own", TOOL_FLAG, &own, 0, 0, ""}};
    if (tool_parse(argc, argv, options, 2, &name) != TOOL_OK) {
        return TOOL_USAGE;
    }
    if (own && !(name && strcmp(name, "tradeoff") == 0)) {
        return tool_error(TOOL_USAGE, "study: --own: expected tradeoff, found '%s'", name ? name : "none");
    }
    if (own && study_add_own()) {
        return tool_error(TOOL_FAILURE, "study: --own: %s", knurl_error_message());
    }
    for (const study *s = studies; name && s->name; s++) {
        if (strcmp(s->name, name) == 0) {
            return folder ? (s->run(folder) ? TOOL_FAILURE : TOOL_OK)
                          : tool_error(TOOL_USAGE, "study: expected --out DIR, found none");
        }
    }
    return unknown(name);
}
