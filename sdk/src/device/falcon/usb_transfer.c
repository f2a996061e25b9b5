/* Transfers with a Falcon over libusb. An input transfer is always pending, so that no answer waits for a request. The
 * calling thread handles libusb's events. SPDX-License-Identifier: MIT */
#include "device/falcon/transport.h"

#ifdef KNURL_HAVE_LIBUSB

#include "base/system.h"
#include "device/falcon/usb.h"

#include <stdlib.h>
#include <string.h>
#ifdef __linux__
#include <fcntl.h>
#include <poll.h>
#endif

#define END_IN       0x81
#define END_OUT      0x02
#define REQUEST_TYPE 0x40
#define CONTROL_MS   1000
#define CLOSE_MS     15 /* for the last frame to be sent, and for cancelled transfers to end */

static void keep(usb *u, const unsigned char *bytes, int count) {
    const uint32_t at = (u->first + u->held++) % USB_ROOM;
    u->packets[at].count = (size_t)count;
    memcpy(u->packets[at].bytes, bytes, (size_t)count);
}

static void LIBUSB_CALL on_in(struct libusb_transfer *transfer) {
    usb *u = transfer->user_data;
    u->is_in_pending = 0;
    u->is_gone |= transfer->status == LIBUSB_TRANSFER_NO_DEVICE;
    if (transfer->status == LIBUSB_TRANSFER_COMPLETED && !u->is_closing) {
        if (transfer->actual_length > (int)KNURL_FALCON_STATUS) {
            keep(u, u->in_bytes, transfer->actual_length);
        }
        /* if it fails, the next read or write retries and gets the error */
        u->is_in_pending = u->held < USB_ROOM && u->lib->submit_transfer(transfer) == 0;
    }
}

static void LIBUSB_CALL on_out(struct libusb_transfer *transfer) {
    usb *u = transfer->user_data;
    u->is_out_pending = 0;
    u->is_gone |= transfer->status == LIBUSB_TRANSFER_NO_DEVICE;
    u->has_failed = transfer->status != LIBUSB_TRANSFER_COMPLETED;
}

/* Outcome of a libusb call. */
static int outcome_of(usb *u, int code) {
    u->is_gone |= code == LIBUSB_ERROR_NO_DEVICE;
    return code >= 0 ? KNURL_FALCON_DONE : u->is_gone ? KNURL_FALCON_GONE : KNURL_FALCON_NOTHING;
}

/* Handles events until `deadline`, or until the first event. */
static void wait_for_events(usb *u, int64_t deadline) {
    const int64_t left = deadline - knurl_system_now_ns();
    struct timeval time = {0, 0};
    if (left > 0) {
        time.tv_sec = (long)(left / 1000000000);
        time.tv_usec = (int)(left % 1000000000 / 1000);
    }
    (void)u->lib->handle_events_timeout_completed(u->context, &time, NULL);
}

static int64_t after_ms(uint32_t ms) {
    return knurl_system_now_ns() + (int64_t)ms * 1000000;
}

static int usb_control(void *self, uint8_t request, uint16_t value) {
    usb *u = self;
    return outcome_of(u, u->lib->control_transfer(u->handle, REQUEST_TYPE, request, value, 0, NULL, 0, CONTROL_MS));
}

static int begin_in(usb *u) {
    if (u->is_in_pending || u->is_gone || u->held == USB_ROOM) {
        return u->is_gone ? KNURL_FALCON_GONE : KNURL_FALCON_DONE;
    }
    libusb_fill_bulk_transfer(u->in, u->handle, END_IN, u->in_bytes, sizeof u->in_bytes, on_in, u, 0);
    const int code = u->lib->submit_transfer(u->in);
    u->is_in_pending = code == 0;
    return outcome_of(u, code);
}

static int usb_write(void *self, const uint8_t *bytes, size_t count, uint32_t timeout_ms) {
    usb *u = self;
    const int64_t deadline = after_ms(timeout_ms);
    while (u->is_out_pending && !u->is_gone && knurl_system_now_ns() < deadline) {
        wait_for_events(u, deadline); /* for the previous one */
    }
    if (u->is_gone) {
        return KNURL_FALCON_GONE;
    }
    if (u->is_out_pending || count > sizeof u->out_bytes) {
        return KNURL_FALCON_NOTHING;
    }
    const int outcome = begin_in(u); /* before the answer can arrive */
    if (outcome != KNURL_FALCON_DONE) {
        return outcome;
    }
    const int had_failed = u->has_failed; /* of the previous write: the caller does not wait for this one */
    memcpy(u->out_bytes, bytes, count);
    libusb_fill_bulk_transfer(u->out, u->handle, END_OUT, u->out_bytes, (int)count, on_out, u, 0);
    const int code = u->lib->submit_transfer(u->out);
    u->is_out_pending = code == 0;
    u->has_failed = 0;
    return had_failed && code == 0 ? KNURL_FALCON_NOTHING : outcome_of(u, code);
}

static int usb_read(void *self, uint8_t packet[KNURL_FALCON_PACKET], size_t *count, uint32_t timeout_ms) {
    usb *u = self;
    const int64_t deadline = after_ms(timeout_ms);
    for (int was_asked = 0; u->held == 0; was_asked = 1) { /* at least once: packets may have arrived */
        const int outcome = begin_in(u);
        if (outcome != KNURL_FALCON_DONE) {
            return outcome;
        }
        if (was_asked && knurl_system_now_ns() >= deadline) {
            return KNURL_FALCON_NOTHING;
        }
        wait_for_events(u, deadline);
    }
    *count = u->packets[u->first].count;
    memcpy(packet, u->packets[u->first].bytes, *count);
    u->first = (u->first + 1) % USB_ROOM;
    u->held--;
    return KNURL_FALCON_DONE;
}

void knurl_usb_close(void *self) {
    usb *u = self;
    int64_t deadline = after_ms(CLOSE_MS);
    u->is_closing = 1;
    while (u->is_out_pending && !u->is_gone && knurl_system_now_ns() < deadline) {
        wait_for_events(u, deadline); /* the last frame sets the force to zero */
    }
    if (u->is_in_pending) {
        (void)u->lib->cancel_transfer(u->in);
    }
    if (u->is_out_pending) {
        (void)u->lib->cancel_transfer(u->out);
    }
    deadline = after_ms(CLOSE_MS);
    while ((u->is_in_pending || u->is_out_pending) && knurl_system_now_ns() < deadline) {
        wait_for_events(u, deadline);
    }
    if (u->handle) {
        (void)u->lib->release_interface(u->handle, 0);
        u->lib->close(u->handle); /* drops transfers that are still pending */
    }
    u->lib->free_transfer(u->in);
    u->lib->free_transfer(u->out);
    u->lib->exit(u->context);
    free(u);
}

#ifdef __linux__
/* libusb does not expose a device's descriptor, but those that it polls. Only a device's is polled for writing, and
 * this context has one device. */
static int usb_share(void *self, int32_t *endpoint) {
    const usb *u = self;
    const struct libusb_pollfd **polled = u->lib->get_pollfds(u->context);
    int shared = -1;
    for (size_t i = 0; polled && polled[i]; i++) {
        if (polled[i]->events & POLLOUT) {
            shared = fcntl(polled[i]->fd, F_DUPFD_CLOEXEC, 3);
        }
    }
    u->lib->free_pollfds(polled);
    *endpoint = END_OUT;
    return shared;
}
#else
static int usb_share(void *self, int32_t *endpoint) {
    (void)self;
    (void)endpoint;
    return -1;
}
#endif

knurl_falcon_transport knurl_usb_transport(usb *u) {
    const knurl_falcon_transport made = {u, usb_control, usb_write, usb_read, knurl_usb_close, usb_share};
    return made;
}

#endif
