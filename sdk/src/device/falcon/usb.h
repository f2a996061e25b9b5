/* Internals of the Falcon's USB transport. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_FALCON_USB_H
#define KNURL_SRC_FALCON_USB_H

#include "device/falcon/transport.h"

#include <libusb.h>

/* Functions loaded from libusb. */
#define USB_FUNCTIONS(X)                                                                                               \
    X(alloc_transfer)                                                                                                  \
    X(cancel_transfer)                                                                                                 \
    X(claim_interface)                                                                                                 \
    X(close)                                                                                                           \
    X(control_transfer)                                                                                                \
    X(exit)                                                                                                            \
    X(free_device_list)                                                                                                \
    X(free_pollfds)                                                                                                    \
    X(free_transfer)                                                                                                   \
    X(get_device_descriptor)                                                                                           \
    X(get_device_list)                                                                                                 \
    X(get_pollfds)                                                                                                     \
    X(handle_events_timeout_completed)                                                                                 \
    X(init)                                                                                                            \
    X(open)                                                                                                            \
    X(release_interface)                                                                                               \
    X(set_auto_detach_kernel_driver)                                                                                   \
    X(strerror)                                                                                                        \
    X(submit_transfer)

typedef struct usb_functions {
/* NOLINTNEXTLINE(bugprone-macro-parentheses): a member's name */
#define USB_FIELD(name) __typeof__(&libusb_##name) name;
    USB_FUNCTIONS(USB_FIELD)
#undef USB_FIELD
} usb_functions;

#define USB_ROOM 16u /* packets received but not read; while full, no more are requested */

typedef struct usb {
    const usb_functions *lib;
    libusb_context *context;
    libusb_device_handle *handle;
    struct libusb_transfer *in, *out;
    unsigned char in_bytes[KNURL_FALCON_PACKET];
    unsigned char out_bytes[KNURL_FALCON_PACKET];
    int is_in_pending, is_out_pending;
    int is_gone, is_closing, has_failed; /* has_failed: the last transfer out */
    struct {
        uint8_t bytes[KNURL_FALCON_PACKET];
        size_t count;
    } packets[USB_ROOM];
    uint32_t first, held;
} usb;

/* usb_transfer.c. The functions of a transport over `u`. */
knurl_falcon_transport knurl_usb_transport(usb *u);

/* Cancels pending transfers and frees everything. self: a usb. */
void knurl_usb_close(void *self);

#endif
