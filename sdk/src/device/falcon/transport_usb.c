/* Finds and opens Falcons with libusb, which is loaded at run time. SPDX-License-Identifier: MIT */
#include "device/driver.h"
#include "device/falcon/transport.h"

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

#include "device/dynlib.h"
#include "device/falcon/usb.h"

#include <stdlib.h>

#define VENDOR  0x0403
#define PRODUCT 0xcb48

static usb_functions lib;

static int load_functions(char *why, size_t why_size) {
#if defined(_WIN32)
    static const char *const files[] = {"libusb-1.0.dll"};
#elif defined(__APPLE__) /* Homebrew's folder on arm64 is not among those that are searched */
    static const char *const files[] = {"libusb-1.0.0.dylib", "/opt/homebrew/lib/libusb-1.0.0.dylib"};
#else
    static const char *const files[] = {"libusb-1.0.so.0", "libusb-1.0.so"};
#endif
#define FUNCTION(name) {"libusb_" #name, &lib.name},
    static const knurl_dynlib_function functions[] = {USB_FUNCTIONS(FUNCTION)};
#undef FUNCTION
    static uint32_t state;
    return knurl_dynlib_load(&state, files, sizeof files / sizeof *files, functions,
                             sizeof functions / sizeof *functions, why, why_size);
}

#if defined(_WIN32)
#define NO_LIBRARY "libusb-1.0 cannot be loaded: %s; put libusb-1.0.dll into the program's folder"
#elif defined(__APPLE__)
#define NO_LIBRARY "libusb-1.0 cannot be loaded: %s; install it (Homebrew: libusb)"
#else
#define NO_LIBRARY "libusb-1.0 cannot be loaded: %s; install it (Debian: libusb-1.0-0)"
#endif

static const char permission[] = "it may not be opened: " KNURL_PERMISSION_ADVICE;

static const char in_use[] =
#ifdef __linux__
    "it is in use: by another program, by this one, or by the kernel's ftdi_sio; close the one or unload the other";
#else
    "it is in use: by another program or by this one; close it there";
#endif

static const char no_driver[] = "its driver is not WinUSB, the one that libusb works with; install that with Zadig";

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
    u->lib = &lib;
    const knurl_result result = claim(u);
    if (result) {
        if (u->context) {
            knurl_usb_close(u);
        } else {
            free(u);
        }
        return result;
    }
    *transport = knurl_usb_transport(u);
    return KNURL_OK;
}

#endif

const knurl_falcon_bus knurl_falcon_usb = {usb_list, usb_open, NULL};
