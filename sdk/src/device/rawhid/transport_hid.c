/* USB HID over hidapi. SPDX-License-Identifier: MIT */
#include "device/rawhid/transport.h"

#ifndef KNURL_HAVE_HIDAPI

#include <stdio.h>

const knurl_rawhid_bus *knurl_rawhid_hidapi(char *why, size_t why_size) {
    (void)snprintf(why, why_size,
                   "this build has no hidapi: install its headers (Debian: libhidapi-dev), configure and build again");
    return NULL;
}

#else

#include "base/system.h"
#include "device/dynlib.h"

#include <hidapi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifdef __linux__
#include <errno.h>
#include <fcntl.h>
#include <unistd.h>
#endif

/* Functions loaded from hidapi. */
#define FUNCTIONS(X)                                                                                                   \
    X(close)                                                                                                           \
    X(enumerate)                                                                                                       \
    X(error)                                                                                                           \
    X(exit)                                                                                                            \
    X(free_enumeration)                                                                                                \
    X(init)                                                                                                            \
    X(open_path)                                                                                                       \
    X(read_timeout)                                                                                                    \
    X(write)

static struct {
/* NOLINTNEXTLINE(bugprone-macro-parentheses): a member's name */
#define FIELD(name) __typeof__(&hid_##name) name;
    FUNCTIONS(FIELD)
#undef FIELD
} lib;

#if defined(_WIN32)
#define INSTALL "put hidapi.dll into the program's folder"
#elif defined(__APPLE__)
#define INSTALL "install it (Homebrew: hidapi)"
#else
#define INSTALL "install it (Debian: libhidapi-hidraw0)"
#endif

static int load_functions(char *why, size_t why_size) {
#if defined(_WIN32)
    static const char *const files[] = {"hidapi.dll"};
#elif defined(__APPLE__)
    static const char *const files[] = {"libhidapi.0.dylib", "/opt/homebrew/lib/libhidapi.0.dylib"};
#else
    static const char *const files[] = {"libhidapi-hidraw.so.0", "libhidapi-hidraw.so"};
#endif
#define FUNCTION(name) {"hid_" #name, &lib.name},
    static const knurl_dynlib_function functions[] = {FUNCTIONS(FUNCTION)};
#undef FUNCTION
    static uint32_t state;
    return knurl_dynlib_load(&state, files, sizeof files / sizeof *files, functions,
                             sizeof functions / sizeof *functions, why, why_size);
}

/* hidapi's functions that take no device share memory, and lib.exit() affects the whole process. */
static uint32_t locked;
static uint32_t users;

static void lock(void) {
    while (__atomic_exchange_n(&locked, 1u, __ATOMIC_ACQUIRE)) {
        knurl_system_sleep_until_ns(knurl_system_now_ns() + 1000000);
    }
}

static void unlock(void) {
    __atomic_store_n(&locked, 0u, __ATOMIC_RELEASE);
}

/* Both with the lock held. */
static int enter(void) {
    if (users == 0 && lib.init() != 0) {
        return 0;
    }
    users++;
    return 1;
}

static void leave(void) {
    if (--users == 0) {
        (void)lib.exit();
    }
}

/* Copies hidapi's wide characters; those that are not ASCII become '?'. */
static void narrow(const wchar_t *wide, char *text, size_t size) {
    size_t i = 0;
    for (; wide && wide[i] && i + 1 < size; i++) {
        text[i] = wide[i] >= 0x20 && wide[i] < 0x7f ? (char)wide[i] : '?';
    }
    text[i] = '\0';
}

#ifdef __linux__
/* Uses the kernel's copy, because hidapi has no function for the descriptor's size. */
static void ask_sizes(const char *path, knurl_rawhid_sizes *sizes) {
    char where[512];
    uint8_t descriptor[4096]; /* HID_MAX_DESCRIPTOR_SIZE */
    const char *node = strrchr(path, '/');
    (void)snprintf(where, sizeof where, "/sys/class/hidraw/%s/device/report_descriptor", node ? node + 1 : path);
    FILE *file = fopen(where, "rb");
    if (file) {
        const size_t size = fread(descriptor, 1, sizeof descriptor, file);
        (void)knurl_rawhid_measure(descriptor, size, sizes);
        (void)fclose(file);
    }
}

static uint32_t is_denied(const char *path) {
    return access(path, R_OK | W_OK) != 0 && errno == EACCES;
}
#else
static void ask_sizes(const char *path, knurl_rawhid_sizes *sizes) {
    (void)path;
    (void)sizes;
}

static uint32_t is_denied(const char *path) {
    (void)path;
    return 0;
}
#endif

static void describe(const struct hid_device_info *info, knurl_rawhid_found *found) {
    char maker[40];
    char product[52];
    memset(found, 0, sizeof *found);
    narrow(info->manufacturer_string, maker, sizeof maker);
    narrow(info->product_string, product, sizeof product);
    (void)snprintf(found->path, sizeof found->path, "%s", info->path ? info->path : "");
    (void)snprintf(found->name, sizeof found->name, "%s%s%s", maker, maker[0] && product[0] ? " " : "", product);
    found->vendor = info->vendor_id;
    found->product = info->product_id;
    found->usage_page = info->usage_page;
    found->usage = info->usage;
    found->is_denied = is_denied(found->path);
    ask_sizes(found->path, &found->sizes);
}

static size_t hid_look(void *user, uint16_t vendor, uint16_t product, knurl_rawhid_found *found, size_t capacity) {
    (void)user;
    size_t count = 0;
    lock();
    if (enter()) {
        struct hid_device_info *first = lib.enumerate(vendor, product);
        for (const struct hid_device_info *info = first; info && count < capacity; info = info->next) {
            describe(info, &found[count++]);
        }
        lib.free_enumeration(first);
        leave();
    }
    unlock();
    return count;
}

/* An open device. hidapi would open it twice, and two threads or programs would drive its motors. */
typedef struct port {
    hid_device *device;
    intptr_t node; /* knurl_system_take_node() */
} port;

static int port_write(void *self, const uint8_t *bytes, size_t size) {
    return lib.write(((port *)self)->device, bytes, size) >= (int)size; /* Windows pads to the longest report */
}

static int port_read(void *self, uint8_t *bytes, size_t room, int milliseconds) {
    return lib.read_timeout(((port *)self)->device, bytes, room, milliseconds);
}

static void port_close(void *self) {
    port *p = self;
    lock();
    lib.close(p->device);
    leave();
    unlock();
    knurl_system_give_back_node(p->node);
    free(p);
}

/* Returns null and the reason on failure. */
static hid_device *open_path(const char *path, char *why, size_t why_size) {
    hid_device *device = NULL;
    lock();
    if (!enter()) {
        (void)snprintf(why, why_size, "hidapi could not be started");
    } else {
        device = lib.open_path(path);
        if (!device) {
            narrow(lib.error(NULL), why, why_size);
            leave();
        }
    }
    unlock();
    return device;
}

static int hid_bus_open(void *user, const knurl_rawhid_found *found, knurl_rawhid_port *opened, char *why,
                        size_t why_size) {
    (void)user;
    port *p = calloc(1, sizeof *p);
    if (!p) {
        (void)snprintf(why, why_size, "no memory");
        return 0;
    }
    p->node = knurl_system_take_node(found->path);
    if (p->node == 0) {
        (void)snprintf(why, why_size, "it is in use: another program, or this one, has it open; end that");
    } else {
        p->device = open_path(found->path, why, why_size); /* if permission is missing, this fails with the reason */
    }
    if (!p->device) {
        knurl_system_give_back_node(p->node);
        free(p);
        return 0;
    }
    const knurl_rawhid_port made = {p, port_write, port_read, port_close};
    *opened = made;
    return 1;
}

/* hidapi does not expose its descriptor, but a node may be opened more than once. */
static int hid_share(void *user, const knurl_rawhid_found *found) {
    (void)user;
#ifdef __linux__
    return open(found->path, O_WRONLY | O_CLOEXEC);
#else
    (void)found;
    return -1;
#endif
}

const knurl_rawhid_bus *knurl_rawhid_hidapi(char *why, size_t why_size) {
    char reason[384];
    if (!load_functions(reason, sizeof reason)) {
        (void)snprintf(why, why_size, "hidapi cannot be loaded: %s; " INSTALL, reason);
        return NULL;
    }
    static const knurl_rawhid_bus bus = {NULL, hid_look, hid_bus_open, hid_share};
    return &bus;
}

#endif
