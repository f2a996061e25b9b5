/* Opening, starting and reading a fake device in a test. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_FAKE_H
#define KNURL_TEST_FAKE_H

#include "support/close.h"

#include <knurl/fake.h>

/** Hz: the update rate of the tests' devices. */
#define RATE 1000.0

static inline knurl_device *open_device(const char *uri) {
    knurl_device *device = NULL;
    const knurl_result result = knurl_device_open(uri, &device);
    if (result) {
        print_error("%s: %s\n", uri, knurl_error_message());
    }
    assert_int_equal(result, KNURL_OK);
    return device;
}

/** Gives a device a stroke at rest, 1 mm below y = 0, and restarts it. */
static inline void stand(knurl_device *device) {
    knurl_stroke_desc stroke;
    knurl_stroke_desc_init(&stroke, sizeof stroke);
    stroke.stroke = KNURL_STROKE_REST;
    assert_int_equal(knurl_fake_set_stroke(device, &stroke), KNURL_OK);
    assert_int_equal(knurl_device_start(device, RATE), KNURL_OK);
}

static inline knurl_device_sample read_one(knurl_device *device) {
    knurl_device_sample sample;
    memset(&sample, 0xaa, sizeof sample);
    assert_int_equal(knurl_device_read(device, &sample), KNURL_OK);
    return sample;
}

#endif
