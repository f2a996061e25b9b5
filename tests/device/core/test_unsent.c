/* A force that was not sent does not count as sent, and a reopened device starts from a clean state.
 * SPDX-License-Identifier: MIT */
#include "home.h"

#include "device/driver.h"
#include "device/port.h"

static home h;

static const double zero[3] = {0.0, 0.0, 0.0};
static const double push[3] = {1.0, 0.0, 0.0};

static void write_for(knurl_device *device, const double force[3], int ms) {
    for (int k = 0; k < ms; k++) {
        (void)knurl_device_write(device, force);
        sleep_ns(1000000);
    }
}

/* The end of the process waits until each device is quiet: until its zero was sent. */
TEST(a_device_is_quiet_only_after_a_zero_that_it_accepted) {
    for (uint32_t blocking = 0; blocking < 2; blocking++) {
        SCOPED_DEVICE *device = home_open(&h, blocking);
        write_for(device, push, 5);
        assert_int_equal(knurl_load_acquire(&device->quiet), 0);
        knurl_store_release(&h.write_gives, KNURL_ERROR_DEVICE_NOT_READY);
        write_for(device, zero, 5);
        assert_int_equal(knurl_load_acquire(&device->quiet), 0);
        knurl_store_release(&h.write_gives, KNURL_OK);
        write_for(device, zero, 5);
        assert_int_equal(knurl_load_acquire(&device->quiet), 1);
    }
}

TEST(silence_is_reported_again_after_a_reopening) {
    knurl_device_sample sample;
    SCOPED_DEVICE *device = home_open(&h, 0);
    for (int round = 0; round < 2; round++) {
        h.read_gives = KNURL_OK;
        assert_int_equal(knurl_device_read(device, &sample), KNURL_OK);
        h.read_gives = KNURL_ERROR_DEVICE_NOT_READY;
        for (int k = 0; k < 20; k++) {
            (void)knurl_device_read(device, &sample);
        }
        assert_int_equal(next_code(device, 0), KNURL_FAULT_SILENT);
        h.read_gives = KNURL_ERROR_DEVICE_LOST;
        assert_int_equal(knurl_device_read(device, &sample), KNURL_ERROR_DEVICE_LOST);
        assert_int_equal(next_code(device, 0), KNURL_FAULT_LOST);
        assert_int_equal(knurl_device_reopen(device), KNURL_OK);
        assert_int_equal(next_code(device, 0), KNURL_FAULT_RECONNECTED);
        h.read_gives = KNURL_ERROR_DEVICE_NOT_READY;
        for (int k = 0; k < 20; k++) { /* as without any position before: waits 10 ms */
            assert_int_equal(knurl_device_read(device, &sample), KNURL_ERROR_DEVICE_NOT_READY);
        }
        assert_int_equal(next_code(device, 0), KNURL_FAULT_SILENT);
    }
}
