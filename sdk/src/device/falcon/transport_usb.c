/* A Falcon over libusb. An input transfer is always pending, so that no answer waits for a request. The calling thread
 * handles libusb's events. SPDX-License-Identifier: MIT */
#include "device/falcon/transport.h"
#include "device/listings.h"

#ifndef KNURL_HAVE_LIBUSB

static const char missing[] =
    "this build is without libusb-1.0; install its headers (libusb-1.0-0-dev), configure with "
    "KNURL_FALCON=ON and build again";

static void usb_list(void *user, knurl_listings *listings) {
    (void)user;
    knurl_listings_add(listings, "falcon", "Novint Falcon", "%s", missing);
}

static knurl_result usb_open(void *user, knurl_falcon_transport *transport) {
    (void)user;
    (void)transport;
    return knurl_fail(KNURL_ERROR_UNSUPPORTED, "device 'falcon': %s", missing);
}

#else

#include "base/system.h"
#include "device/dynlib.h"

#include <libusb.h>
#include <stdlib.h>
#include <string.h>
#ifdef __linux__
#include <fcntl.h>
#include <poll.h>
#endif

#define VENDOR       0x0403
#define PRODUCT      0xcb48
#define END_IN       0x81
#define END_OUT      0x02
#define REQUEST_TYPE 0x40
#define CONTROL_MS   1000
#define ROOM         16u  /* packets received but not read; while full, no more are requested */
#define CLOSE_MS     1000 /* for pending transfers to end */

/* Functions loaded from libusb. */
#define FUNCTIONS(X)                                                                                                   \
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

static struct {
/* NOLINTNEXTLINE(bugprone-macro-parentheses): a member's name */
#define FIELD(name) __typeof__(&libusb_##name) name;
    FUNCTIONS(FIELD)
#undef FIELD
} lib;

static int load_functions(char *why, size_t why_size) {
#if defined(_WIN32)
    static const char *const files[] = {"libusb-1.0.dll"};
#else
    static const char *const files[] = {"libusb-1.0.so.0", "libusb-1.0.so"};
#endif
#define FUNCTION(name) {"libusb_" #name, &lib.name},
    static const knurl_dynlib_function functions[] = {FUNCTIONS(FUNCTION)};
#undef FUNCTION
    static uint32_t state;
    return knurl_dynlib_load(&state, files, sizeof files / sizeof *files, functions,
                             sizeof functions / sizeof *functions, why, why_size);
}

#if defined(_WIN32)
#define NO_LIBRARY "libusb-1.0 cannot be loaded: %s; put libusb-1.0.dll into the program's folder"

static const char permission[] = "it may not be opened: is it in use by another program, or by this one?";
#else
#define NO_LIBRARY "libusb-1.0 cannot be loaded: %s; install it (Debian: libusb-1.0-0)"

static const char permission[] =
    "it may not be used by this account; copy sdk/udev/70-knurl.rules to /etc/udev/rules.d, run 'udevadm control "
    "--reload' and 'udevadm trigger', and plug it in again";
#endif

static const char in_use[] =
    "it is in use: by another program, by this one, or by the kernel's ftdi_sio; close the one "
    "or unload the other";

static const char no_driver[] = "its driver is not WinUSB, the one that libusb works with; install that with Zadig";

typedef struct usb {
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
    } packets[ROOM];
    uint32_t first, held;
} usb;

static void keep(usb *u, const unsigned char *bytes, int count) {
    const uint32_t at = (u->first + u->held++) % ROOM;
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
        u->is_in_pending = u->held < ROOM && lib.submit_transfer(transfer) == 0;
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
        time.tv_usec = (long)(left % 1000000000 / 1000);
    }
    (void)lib.handle_events_timeout_completed(u->context, &time, NULL);
}

static int64_t after_ms(uint32_t ms) {
    return knurl_system_now_ns() + (int64_t)ms * 1000000;
}

static int usb_control(void *self, uint8_t request, uint16_t value) {
    usb *u = self;
    return outcome_of(u, lib.control_transfer(u->handle, REQUEST_TYPE, request, value, 0, NULL, 0, CONTROL_MS));
}

static int begin_in(usb *u) {
    if (u->is_in_pending || u->is_gone || u->held == ROOM) {
        return u->is_gone ? KNURL_FALCON_GONE : KNURL_FALCON_DONE;
    }
    libusb_fill_bulk_transfer(u->in, u->handle, END_IN, u->in_bytes, sizeof u->in_bytes, on_in, u, 0);
    const int code = lib.submit_transfer(u->in);
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
    const int code = lib.submit_transfer(u->out);
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
    u->first = (u->first + 1) % ROOM;
    u->held--;
    return KNURL_FALCON_DONE;
}

/* Cancels pending transfers and frees everything. */
static void usb_close(void *self) {
    usb *u = self;
    const int64_t deadline = after_ms(CLOSE_MS);
    u->is_closing = 1;
    while (u->is_out_pending && !u->is_gone && knurl_system_now_ns() < deadline) {
        wait_for_events(u, deadline); /* the last frame sets the force to zero */
    }
    if (u->is_in_pending) {
        (void)lib.cancel_transfer(u->in);
    }
    if (u->is_out_pending) {
        (void)lib.cancel_transfer(u->out);
    }
    while ((u->is_in_pending || u->is_out_pending) && knurl_system_now_ns() < deadline) {
        wait_for_events(u, deadline);
    }
    if (u->handle) {
        (void)lib.release_interface(u->handle, 0);
        lib.close(u->handle); /* drops transfers that are still pending */
    }
    lib.free_transfer(u->in);
    lib.free_transfer(u->out);
    lib.exit(u->context);
    free(u);
}

static knurl_result refused(const char *doing, int code) {
    if (code == LIBUSB_ERROR_ACCESS) {
        return knurl_fail(KNURL_ERROR_SYSTEM, "device 'falcon': found (0403:cb48), but %s", permission);
    }
    if (code == LIBUSB_ERROR_BUSY) {
        return knurl_fail(KNURL_ERROR_SYSTEM, "device 'falcon': found (0403:cb48), but %s", in_use);
    }
    if (code == LIBUSB_ERROR_NOT_SUPPORTED) { /* Windows only */
        return knurl_fail(KNURL_ERROR_SYSTEM, "device 'falcon': found (0403:cb48), but %s", no_driver);
    }
    if (code == LIBUSB_ERROR_NO_DEVICE) {
        return knurl_fail(KNURL_ERROR_DEVICE_LOST, "device 'falcon': it was unplugged while it was opened");
    }
    if (code == LIBUSB_ERROR_NO_MEM) {
        return knurl_fail(KNURL_ERROR_MEMORY, "device 'falcon': libusb got no memory to %s", doing);
    }
    return knurl_fail(KNURL_ERROR_SYSTEM, "device 'falcon': libusb could not %s: %s", doing,
                      lib.strerror((enum libusb_error)code));
}

/* Calls `visit` for each Falcon until it returns 0. Returns the number of USB devices, or libusb's error. */
static long visit_falcons(libusb_context *context, int (*visit)(libusb_device *device, void *user), void *user) {
    libusb_device **devices = NULL;
    const ssize_t count = lib.get_device_list(context, &devices);
    int more = 1;
    for (ssize_t i = 0; i < count && more; i++) {
        struct libusb_device_descriptor d;
        if (lib.get_device_descriptor(devices[i], &d) == 0 && d.idVendor == VENDOR && d.idProduct == PRODUCT) {
            more = visit(devices[i], user);
        }
    }
    if (count >= 0) {
        lib.free_device_list(devices, 1);
    }
    return (long)count;
}

static int visit_to_list(libusb_device *device, void *user) {
    knurl_listings *listings = user;
    libusb_device_handle *handle = NULL;
    int code = lib.open(device, &handle);
    if (code == 0) { /* only claiming the interface detects use by another program */
        (void)lib.set_auto_detach_kernel_driver(handle, 1);
        code = lib.claim_interface(handle, 0);
        if (code == 0) {
            (void)lib.release_interface(handle, 0);
        }
        lib.close(handle);
    }
    const char *why = code == LIBUSB_ERROR_ACCESS          ? permission
                      : code == LIBUSB_ERROR_BUSY          ? in_use
                      : code == LIBUSB_ERROR_NOT_SUPPORTED ? no_driver
                      : code                               ? lib.strerror((enum libusb_error)code)
                                                           : "";
    knurl_listings_add(listings, "falcon", "Novint Falcon", "%s", why);
    return 0; /* only the first one can be opened */
}

static void usb_list(void *user, knurl_listings *listings) {
    (void)user;
    char why[512];
    libusb_context *context = NULL;
    const uint32_t before = listings->count;
    if (!load_functions(why, sizeof why)) {
        knurl_listings_add(listings, "falcon", "Novint Falcon", NO_LIBRARY, why);
        return;
    }
    const int code = lib.init(&context);
    if (code) {
        knurl_listings_add(listings, "falcon", "Novint Falcon", "the USB devices cannot be listed: libusb reports '%s'",
                           lib.strerror((enum libusb_error)code));
        return;
    }
    const long count = visit_falcons(context, visit_to_list, listings);
    if (listings->count == before) {
        knurl_listings_add(listings, "falcon", "Novint Falcon",
                           "not connected: 0403:cb48 is not among the %ld USB devices here; plug it in, and its "
                           "power supply as well",
                           count > 0 ? count : 0);
    }
    lib.exit(context);
}

typedef struct search {
    usb *u;
    int found, code;
} search;

static int visit_to_open(libusb_device *device, void *user) {
    search *s = user;
    s->found = 1;
    s->code = lib.open(device, &s->u->handle);
    return 0;
}

static knurl_result claim(usb *u) {
    search s = {u, 0, 0};
    int code = lib.init(&u->context);
    if (code) {
        return refused("be started", code);
    }
    const long count = visit_falcons(u->context, visit_to_open, &s);
    if (!s.found) {
        return knurl_fail(KNURL_ERROR_DEVICE_LOST,
                          "device 'falcon': expected USB device 0403:cb48, found none among %ld; plug it in, and its "
                          "power supply as well",
                          count > 0 ? count : 0);
    }
    if (s.code) {
        return refused("open it", s.code);
    }
    (void)lib.set_auto_detach_kernel_driver(u->handle, 1); /* if a system does not support it, it is not needed */
    code = lib.claim_interface(u->handle, 0);
    if (code) {
        return refused("claim its interface 0", code);
    }
    u->in = lib.alloc_transfer(0);
    u->out = lib.alloc_transfer(0);
    return u->in && u->out ? KNURL_OK : refused("transfer", LIBUSB_ERROR_NO_MEM);
}

#ifdef __linux__
/* libusb does not expose a device's descriptor, but those that it polls. Only a device's is polled for writing, and
 * this context has one device. */
static int usb_share(void *self, int32_t *endpoint) {
    const usb *u = self;
    const struct libusb_pollfd **polled = lib.get_pollfds(u->context);
    int shared = -1;
    for (size_t i = 0; polled && polled[i]; i++) {
        if (polled[i]->events & POLLOUT) {
            shared = fcntl(polled[i]->fd, F_DUPFD_CLOEXEC, 3);
        }
    }
    lib.free_pollfds(polled);
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

static knurl_result usb_open(void *user, knurl_falcon_transport *transport) {
    (void)user;
    char why[512];
    if (!load_functions(why, sizeof why)) {
        return knurl_fail(KNURL_ERROR_UNSUPPORTED, "device 'falcon': " NO_LIBRARY, why);
    }
    usb *u = calloc(1, sizeof *u);
    if (!u) {
        return knurl_fail(KNURL_ERROR_MEMORY, "device 'falcon': could not get %lu bytes", (unsigned long)sizeof *u);
    }
    const knurl_result result = claim(u);
    if (result) {
        if (u->context) {
            usb_close(u);
        } else {
            free(u);
        }
        return result;
    }
    const knurl_falcon_transport made = {u, usb_control, usb_write, usb_read, usb_close, usb_share};
    *transport = made;
    return KNURL_OK;
}

#endif

const knurl_falcon_bus knurl_falcon_usb = {usb_list, usb_open, NULL};
