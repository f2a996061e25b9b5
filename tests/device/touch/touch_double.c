/* The Touch's double. HD is a call interface without a visible wire, so messages cannot be cut, mixed up or delayed
 * here. SPDX-License-Identifier: MIT */
#include "device/doubles.h"

#include "device/touch/stub.h"

static knurl_device *open_double(void) {
    knurl_device *device = NULL;
    if (stub_load(NULL)) {
        (void)knurl_fail(KNURL_ERROR_UNSUPPORTED, "%s cannot be loaded", KNURL_TEST_STUB);
        return NULL;
    }
    stub.reset();
    stub.set(STUB_DEFAULT, STUB_STROKE, KNURL_STROKE_REST);
    if (knurl_device_open("touch", &device)) {
        (void)stub_unload(NULL);
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
    (void)stub_unload(NULL);
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
