/* The Touch's double. HD is a call interface without a visible wire, so messages cannot be cut, mixed up or delayed
 * here. SPDX-License-Identifier: MIT */
#include "device/doubles.h"

#include "base/system.h"
#include "device/touch/stub_hd.h"

#include <knurl/fake.h>

static struct {
    knurl_library *library;
    stub_set_function set;
    stub_limp_function limp_since;
    stub_reset_function reset;
    stub_use_time_function use_time;
} stub;

static knurl_device *open_double(void) {
    char why[256];
    knurl_device *device = NULL;
    stub.library = knurl_system_load_library(KNURL_TEST_STUB, why, sizeof why);
    if (!stub.library || !knurl_system_find_function(stub.library, "stub_set", &stub.set) ||
        !knurl_system_find_function(stub.library, "stub_limp_since", &stub.limp_since) ||
        !knurl_system_find_function(stub.library, "stub_reset", &stub.reset) ||
        !knurl_system_find_function(stub.library, "stub_use_time", &stub.use_time)) {
        (void)knurl_fail(KNURL_ERROR_UNSUPPORTED, "%s: %s", KNURL_TEST_STUB, why);
        return NULL;
    }
    stub.use_time(&stub_program_time);
    stub.reset();
    stub.set(STUB_DEFAULT, STUB_STROKE, KNURL_STROKE_REST);
    if (knurl_device_open("touch:?library=" KNURL_TEST_STUB, &device)) {
        knurl_system_unload_library(stub.library);
    }
    return device;
}

static void inject(int fault) {
    stub.set(STUB_DEFAULT, STUB_ABSENT, fault == DOUBLE_UNPLUG);
    stub.set(STUB_DEFAULT, STUB_NAN, fault == DOUBLE_NAN);
    stub.set(STUB_DEFAULT, STUB_JUMP, fault == DOUBLE_JUMP ? 0.05 : 0.0);
    stub.set(STUB_DEFAULT, STUB_ERROR, fault == DOUBLE_REFUSE ? 0x0200 : 0.0);
    stub.set(STUB_DEFAULT, STUB_CALIBRATION, fault == DOUBLE_UNHOMED ? 0x5002 : 0.0);
}

static int64_t limp_since(void) {
    return stub.limp_since(STUB_DEFAULT);
}

static void close_double(knurl_device *device) {
    knurl_device_close(device);
    knurl_system_unload_library(stub.library);
}

static void hold(int is_held) {
    stub.set(STUB_DEFAULT, STUB_LOOSE, !is_held);
}

const device_double touch_double = {.name = "touch",
                                    .faults = 1u << DOUBLE_WELL | 1u << DOUBLE_UNPLUG | 1u << DOUBLE_NAN |
                                              1u << DOUBLE_JUMP | 1u << DOUBLE_REFUSE | 1u << DOUBLE_UNHOMED,
                                    .open = open_double,
                                    .inject = inject,
                                    .limp_since = limp_since,
                                    .close = close_double,
                                    .hold = hold};
