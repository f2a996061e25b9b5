/* knurl_study: the program that runs `knurl study` and `knurl metrics`. SPDX-License-Identifier: MIT */
#include "options.h"
#include "os.h"
#include "programs.h"

#include <string.h>

int main(int argc, char **argv) {
    os_begin(&argc, &argv);
    const char *name = argc > 1 ? argv[1] : "none";
    if (strcmp(name, "study") == 0) {
        return tool_end(cmd_study(argc - 1, argv + 1));
    }
    if (strcmp(name, "metrics") == 0) {
        return tool_end(cmd_metrics(argc - 1, argv + 1));
    }
    return tool_error(TOOL_USAGE, "knurl_study: expected study or metrics, found '%s'; see 'knurl --help'", name);
}
