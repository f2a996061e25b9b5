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

/* The result of the last read. */
static knurl_result read_for(knurl_device *device, knurl_result gives, int ms) {
    knurl_device_sample sample;
    knurl_result result = KNURL_OK;
    knurl_store_release(&h.read_gives, gives);
    for (int k = 0; k < ms; k++) {
        sleep_ns(1000000);
        result = knurl_device_read(device, &sample);
    }
    return result;
}

TEST(silence_is_reported_again_after_a_reopening) {
    for (uint32_t blocking = 0; blocking < 2; blocking++) {
        SCOPED_DEVICE *device = home_open(&h, blocking);
        for (int round = 0; round < 2; round++) {
            assert_int_equal(read_for(device, KNURL_OK, 5), KNURL_OK);
            assert_int_equal(read_for(device, KNURL_ERROR_DEVICE_NOT_READY, 20), KNURL_ERROR_DEVICE_NOT_READY);
            assert_int_equal(next_code(device, 0), KNURL_FAULT_SILENT);
            assert_int_equal(read_for(device, KNURL_ERROR_DEVICE_LOST, 5), KNURL_ERROR_DEVICE_LOST);
            assert_int_equal(next_code(device, 0), KNURL_FAULT_LOST);
            knurl_store_release(&h.read_gives, KNURL_ERROR_DEVICE_NOT_READY);
            assert_int_equal(knurl_device_reopen(device), KNURL_OK);
            assert_int_equal(next_code(device, 0), KNURL_FAULT_RECONNECTED);
            /* as if it had never had a position: 10 ms of patience */
            assert_int_equal(read_for(device, KNURL_ERROR_DEVICE_NOT_READY, 20), KNURL_ERROR_DEVICE_NOT_READY);
            assert_int_equal(next_code(device, 0), KNURL_FAULT_SILENT);
        }
    }
}
