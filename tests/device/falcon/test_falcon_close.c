/* A Falcon whose transfers never end, over a libusb that does nothing. SPDX-License-Identifier: MIT */
#include "support/close.h"

#include "base/system.h"
#include "device/falcon/transport.h"
#include "device/falcon/usb.h"

#include <stdlib.h>

static int LIBUSB_CALL wait_in_vain(libusb_context *context, struct timeval *time, int *completed) {
    (void)context;
    (void)completed;
    knurl_system_sleep_until_ns(knurl_system_now_ns() + (int64_t)time->tv_sec * 1000000000 +
                                (int64_t)time->tv_usec * 1000);
    return 0;
}

static int LIBUSB_CALL cancel(struct libusb_transfer *transfer) {
    (void)transfer;
    return 0;
}

static void LIBUSB_CALL free_nothing(struct libusb_transfer *transfer) {
    (void)transfer;
}

static void LIBUSB_CALL end(libusb_context *context) {
    (void)context;
}

/* knurl_device_close() promises 50 ms, of which its last two exchanges may take 18. */
TEST(closing_does_not_wait_long_for_transfers_that_hang) {
    usb_functions lib = {.handle_events_timeout_completed = wait_in_vain,
                         .cancel_transfer = cancel,
                         .free_transfer = free_nothing,
                         .exit = end};
    usb *u = calloc(1, sizeof *u);
    assert_non_null(u);
    u->lib = &lib;
    u->is_in_pending = u->is_out_pending = 1;
    const int64_t before = knurl_system_now_ns();
    knurl_usb_close(u);
    const double seconds = 1e-9 * (double)(knurl_system_now_ns() - before);
    assert_true(seconds < 0.0301);
}
