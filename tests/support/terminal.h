/* Tests that need a pseudoterminal: umockdev, too, emulates devices behind one. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_TERMINAL_H
#define KNURL_TEST_TERMINAL_H

#include "support/close.h"

#include <unistd.h>

/** Skips the test on a machine without /dev/pts, such as a bare chroot. */
static inline void need_terminal(void) {
    if (access("/dev/ptmx", R_OK | W_OK) != 0 || access("/dev/pts/ptmx", F_OK) != 0) {
        print_message("SKIPPED: no pseudoterminal can be had here: /dev/pts is not mounted\n");
        skip();
    }
}

#endif
