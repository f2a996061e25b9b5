/* main() of the programs without their own. SPDX-License-Identifier: MIT */
#include "support/suite.h"

#include <string.h>

int main(int argc, char **argv) {
    const char *slash = argc > 0 ? strrchr(argv[0], '/') : NULL;
    return suite_run(slash ? slash + 1 : "tests");
}
