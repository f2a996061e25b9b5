/* A caller's functions over a simulated device. It is in memory shared with children, so that a crash can be observed
 * from outside. SPDX-License-Identifier: MIT */
#define _DEFAULT_SOURCE 1 /* MAP_ANONYMOUS */

#include "functions_double.h"

#include "device/core/home.h"

#include <sys/mman.h>

static struct shared {
    home device;
    int64_t mark;
} *memory; /* for all that are opened, one after the other */

static home *h;

static knurl_device *open_one(uint32_t blocking) {
    knurl_device *device = NULL;
    if (!memory) {
        memory = mmap(NULL, sizeof *memory, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
        assert_true(memory != MAP_FAILED);
    }
    h = &memory->device;
    memset(memory, 0, sizeof *memory);
    h->limp_since = now_ns();
    h->hangs_for = 5000000; /* the caller's time limit */
    h->mute_ns = 2000000;
    h->takes_ns = 300000;
    const knurl_device_functions f = home_functions(h, blocking);
    return knurl_device_open_functions(&f, &device) ? NULL : device;
}

void functions_double_hang(int64_t ns) {
    knurl_store_relaxed(&h->hangs_for, ns);
}

int64_t *functions_double_mark(void) {
    return &memory->mark;
}

static knurl_device *open_blocking(void) {
    return open_one(1);
}

static knurl_device *open_plain(void) {
    return open_one(0);
}

static void inject(int fault) {
    home_inject(h, fault);
}

static int64_t limp_since(void) {
    return knurl_load_acquire(&h->limp_since);
}

#define FAULTS                                                                                                         \
    (1u << DOUBLE_UNPLUG | 1u << DOUBLE_MUTE | 1u << DOUBLE_HANG | 1u << DOUBLE_LATE | 1u << DOUBLE_NAN |              \
     1u << DOUBLE_JUMP)

const device_double functions_double = {"functions",        FAULTS, open_blocking, inject, limp_since,
                                        knurl_device_close, NULL,   0.0,           NULL};
const device_double plain_double = {"functions, not blocking", 0,    open_plain, inject, limp_since,
                                    knurl_device_close,        NULL, 0.0,        NULL};
