/* The driver over the stand-in library. SPDX-License-Identifier: MIT */
#include "device/dhd/dhd_double.h"

#include "base/system.h"

#include <stdio.h>
#include <stdlib.h>

struct dhd_stub dhd_stub;

static int load(void) {
    char why[256];
    knurl_library *library = knurl_system_load_library(KNURL_TEST_STUB_DHD, why, sizeof why);
    if (!library || !knurl_system_find_function(library, "stub_dhd_reset", &dhd_stub.reset) ||
        !knurl_system_find_function(library, "stub_dhd_inject", &dhd_stub.inject) ||
        !knurl_system_find_function(library, "stub_dhd_ask", &dhd_stub.ask) ||
        !knurl_system_find_function(library, "stub_dhd_set", &dhd_stub.set) ||
        !knurl_system_find_function(library, "stub_dhd_limp_since", &dhd_stub.limp_since) ||
        !knurl_system_find_function(library, "stub_dhd_tell_torque", &dhd_stub.tell_torque) ||
        !knurl_system_find_function(library, "stub_dhd_opens", &dhd_stub.opens)) {
        (void)fprintf(stderr, "%s: %s\n", KNURL_TEST_STUB_DHD, library ? "not all functions are there" : why);
        return 0;
    }
    return setenv("KNURL_DHD_LIBRARY", KNURL_TEST_STUB_DHD, 1) == 0;
}

static knurl_device *double_open(void) {
    static const stub_dhd_time time = {knurl_system_now_ns, knurl_system_sleep_until_ns};
    knurl_device *device = NULL;
    if (!dhd_stub.reset && !load()) {
        return NULL;
    }
    dhd_stub.reset(&time, 0);
    return knurl_device_open("dhd", &device) ? NULL : device;
}

static void double_inject(int fault) {
    dhd_stub.inject(fault);
}

static int64_t double_limp_since(void) {
    return dhd_stub.limp_since();
}

static void double_close(knurl_device *device) {
    knurl_device_close(device);
}

static void double_hold_grip(int is_held) {
    dhd_stub.set(STUB_DHD_LOOSE, !is_held);
}

/* The library exposes no bytes, and it is not known to refuse forces. */
const device_double dhd_double = {"dhd",
                                  1u << DOUBLE_WELL | 1u << DOUBLE_UNPLUG | 1u << DOUBLE_MUTE | 1u << DOUBLE_HANG |
                                      1u << DOUBLE_NAN | 1u << DOUBLE_JUMP | 1u << DOUBLE_UNHOMED | 1u << DOUBLE_OFF,
                                  double_open,
                                  double_inject,
                                  double_limp_since,
                                  double_close,
                                  NULL,
                                  20.0, /* while a call blocks, the force stays */
                                  double_hold_grip};
