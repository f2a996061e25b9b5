/* Windows: the guard process is not implemented. SPDX-License-Identifier: MIT */
#include "base/guard_process.h"

#include <stdio.h>

knurl_guard_process *knurl_guard_process_start(int device, const knurl_guard_order *order, char *why, size_t why_size) {
    (void)device;
    (void)order;
    (void)snprintf(why, why_size, "the guard process is available on Linux only");
    return NULL;
}

int knurl_guard_process_tell(knurl_guard_process *guard) {
    (void)guard;
    return 0;
}

void knurl_guard_process_stop(knurl_guard_process *guard) {
    (void)guard;
}
