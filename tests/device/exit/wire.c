/* SPDX-License-Identifier: MIT */
#define _DEFAULT_SOURCE 1

#include "wire.h"

#include "base/atomic.h"
#include "base/system.h"
#include "device/falcon/falcon_sim.h"
#include "device/falcon/transport.h"
#include "device/inverse3/channel.h"
#include "device/inverse3/inverse3_sim.h"
#include "device/rawhid/hid_sim.h"
#include "device/rawhid/transport.h"

#include <fcntl.h>
#include <poll.h>
#include <string.h>
#include <sys/socket.h>

#define CONTROL 3 /* bytes: a request to the Falcon's USB chip; frames have 16 */

static int wire_of_child;

/* Receives a message within the time. Returns its size; 0: timeout; -1: the other end is closed. */
static int take(uint8_t *bytes, size_t room, int milliseconds) {
    struct pollfd end = {wire_of_child, POLLIN, 0};
    if (poll(&end, 1, milliseconds) <= 0) {
        return 0;
    }
    const ssize_t got = recv(wire_of_child, bytes, room, 0);
    return got > 0 ? (int)got : -1;
}

static int put(const void *bytes, size_t size) {
    return send(wire_of_child, bytes, size, MSG_NOSIGNAL) == (ssize_t)size;
}

/* --- Falcon --- */

static falcon_sim falcon;

static void falcon_reset(void) {
    falcon_sim_init(&falcon, NULL);
}

static size_t falcon_hear(const uint8_t *bytes, size_t size, uint8_t *answer, int *has_force) {
    if (size == CONTROL) {
        (void)falcon_sim_control(&falcon, bytes[0], (uint32_t)(bytes[1] | bytes[2] << 8));
        return 0;
    }
    *has_force = 0;
    for (size_t i = 1; i < 13 && size == 16; i++) {
        *has_force |= bytes[i] != 'A'; /* a digit of a motor that is not 0 */
    }
    falcon_sim_out(&falcon, bytes, size);
    return falcon_sim_in(&falcon, answer, 64);
}

static int falcon_control(void *self, uint8_t request, uint16_t value) {
    const uint8_t bytes[CONTROL] = {request, (uint8_t)(value & 255), (uint8_t)(value >> 8)};
    (void)self;
    return put(bytes, sizeof bytes) ? KNURL_FALCON_DONE : KNURL_FALCON_GONE;
}

static int falcon_write(void *self, const uint8_t *bytes, size_t count, uint32_t timeout_ms) {
    (void)self;
    (void)timeout_ms;
    return put(bytes, count) ? KNURL_FALCON_DONE : KNURL_FALCON_GONE;
}

static int falcon_read(void *self, uint8_t packet[KNURL_FALCON_PACKET], size_t *count, uint32_t timeout_ms) {
    (void)self;
    const int got = take(packet, KNURL_FALCON_PACKET, (int)timeout_ms);
    *count = got > 0 ? (size_t)got : 0;
    return got > 0 ? KNURL_FALCON_DONE : got == 0 ? KNURL_FALCON_NOTHING : KNURL_FALCON_GONE;
}

static void leave_open(void *self) {
    (void)self;
}

static int share_wire(void) {
    return fcntl(wire_of_child, F_DUPFD_CLOEXEC, 3);
}

static int falcon_share(void *self, int32_t *endpoint) {
    (void)self;
    *endpoint = 0;
    return share_wire();
}

static knurl_result falcon_open_bus(void *user, knurl_falcon_transport *transport) {
    const knurl_falcon_transport made = {user, falcon_control, falcon_write, falcon_read, leave_open, falcon_share};
    *transport = made;
    return KNURL_OK;
}

static knurl_device *falcon_open(int wire, wire_shared *shared, uint32_t guarded) {
    static int self;
    const knurl_falcon_bus bus = {NULL, falcon_open_bus, &self};
    knurl_device *device = NULL;
    (void)shared;
    wire_of_child = wire;
    if (knurl_falcon_open_on(&bus, guarded ? "?guard=1" : "", &device)) {
        return NULL;
    }
    knurl_device_register(device);
    return device;
}

/* --- raw HID --- */

#define REPORT 64

static hid_sim hid;

static double seconds(void) {
    return 1e-9 * (double)knurl_system_now_ns();
}

static void rawhid_reset(void) {
    hid_sim_init(&hid, REPORT, NULL);
    hid.time = hid.heard_at = hid.limp_from = seconds();
}

static size_t rawhid_hear(const uint8_t *bytes, size_t size, uint8_t *answer, int *has_force) {
    *has_force = 0;
    for (size_t i = 1; i < 7 && size == REPORT + 1; i++) {
        *has_force |= bytes[i] != 0; /* three currents */
    }
    if (!hid_sim_hear(&hid, seconds(), bytes + 1, size - 1)) {
        return 0;
    }
    hid_sim_say(&hid, answer);
    return REPORT;
}

static int rawhid_write(void *self, const uint8_t *bytes, size_t size) {
    (void)self;
    return put(bytes, size);
}

static int rawhid_read(void *self, uint8_t *bytes, size_t room, int milliseconds) {
    (void)self;
    return take(bytes, room, milliseconds);
}

static size_t rawhid_look(void *user, uint16_t vendor, uint16_t product, knurl_rawhid_found *found, size_t capacity) {
    static const knurl_rawhid_found one = {"wire", "WoodenHaptics", 0x16c0,           0x0486,
                                           0xffab, 0x0200,          {REPORT, REPORT}, 0};
    (void)user;
    (void)vendor;
    (void)product;
    if (capacity > 0) {
        *found = one;
    }
    return capacity > 0;
}

static int rawhid_open_bus(void *user, const knurl_rawhid_found *found, knurl_rawhid_port *port, char *why,
                           size_t why_size) {
    const knurl_rawhid_port made = {user, rawhid_write, rawhid_read, leave_open};
    (void)found;
    (void)why;
    (void)why_size;
    *port = made;
    return 1;
}

static int rawhid_share(void *user, const knurl_rawhid_found *found) {
    (void)user;
    (void)found;
    return share_wire();
}

static knurl_device *rawhid_open(int wire, wire_shared *shared, uint32_t guarded) {
    static int self;
    static const knurl_rawhid_bus bus = {&self, rawhid_look, rawhid_open_bus, rawhid_share};
    knurl_device *device = NULL;
    (void)shared;
    wire_of_child = wire;
    if (knurl_rawhid_open(guarded ? "?guard=1" : "", &bus, &device)) {
        return NULL;
    }
    knurl_device_register(device);
    return device;
}

/* --- Inverse3 --- */

static const char connecting[] = "connect"; /* its service has the first word */
static inverse3_sim service;

static void inverse3_reset(void) {
    inverse3_sim_init(&service, seconds(), 0);
}

static size_t inverse3_hear(const uint8_t *bytes, size_t size, uint8_t *answer, int *has_force) {
    char message[KNURL_INVERSE3_COMMAND + 1] = "";
    char *text = (char *)answer;
    memcpy(message, bytes, size < sizeof message ? size : 0);
    const int length = strcmp(message, connecting) == 0 ? inverse3_sim_greet(&service, seconds(), text)
                                                        : inverse3_sim_hear(&service, seconds(), message, text);
    *has_force = service.limp_since < 0.0;
    return (size_t)length;
}

static int inverse3_send(void *self, const char *text, size_t size) {
    (void)self;
    return put(text, size);
}

static int inverse3_receive(void *self, int milliseconds, knurl_inverse3_message *message) {
    static uint8_t text[INVERSE3_SIM_ROOM];
    (void)self;
    const int got = take(text, sizeof text, milliseconds);
    if (got > 0) {
        message->text = (const char *)text;
        message->size = (size_t)got;
    }
    return got > 0 ? 1 : got;
}

static int inverse3_connect(void *user, int port, knurl_inverse3_filter filter, knurl_inverse3_channel *channel,
                            char *why, size_t why_size) {
    const knurl_inverse3_channel made = {user, inverse3_send, inverse3_receive, leave_open};
    (void)port;
    (void)filter;
    (void)why;
    (void)why_size;
    *channel = made;
    return put(connecting, sizeof connecting);
}

static knurl_device *inverse3_open(int wire, wire_shared *shared, uint32_t guarded) {
    static int self;
    static const knurl_inverse3_service simulated = {&self, inverse3_connect};
    knurl_device *device = NULL;
    (void)shared;
    (void)guarded;
    wire_of_child = wire;
    if (knurl_inverse3_open("", &simulated, &device)) {
        return NULL;
    }
    knurl_device_register(device);
    return device;
}

/* --- a caller's functions --- */

static void functions_reset(void) {}

static size_t functions_hear(const uint8_t *bytes, size_t size, uint8_t *answer, int *has_force) {
    double force[3] = {0.0, 0.0, 0.0};
    memcpy(force, bytes, size < sizeof force ? size : sizeof force);
    *has_force = force[0] != 0.0 || force[1] != 0.0 || force[2] != 0.0;
    *answer = 1;
    return 1;
}

static void functions_info(void *user, knurl_device_info *info) {
    (void)user;
    info->max_force = 5.0;
}

static knurl_result functions_read(void *user, knurl_device_sample *sample) {
    uint8_t word;
    (void)user;
    memset(sample, 0, sizeof *sample);
    const int got = take(&word, 1, 4);
    return got > 0 ? KNURL_OK : got == 0 ? KNURL_ERROR_DEVICE_NOT_READY : KNURL_ERROR_DEVICE_LOST;
}

static knurl_result functions_write(void *user, const double force[3]) {
    (void)user;
    return put(force, 3 * sizeof *force) ? KNURL_OK : KNURL_ERROR_DEVICE_LOST;
}

static knurl_device *functions_open(int wire, wire_shared *shared, uint32_t guarded) {
    static int self;
    knurl_device_functions f;
    knurl_device *device = NULL;
    (void)shared;
    (void)guarded;
    knurl_device_functions_init(&f, sizeof f);
    f.blocking = 1;
    f.user = &self;
    f.get_info = functions_info;
    f.read = functions_read;
    f.write = functions_write;
    wire_of_child = wire;
    return knurl_device_open_functions(&f, &device) ? NULL : device;
}

/* --- Touch: its library and the motors' state are in the child --- */

static knurl_device *touch_open(int wire, wire_shared *shared, uint32_t guarded) {
    static char why[256];
    stub_mirror_function mirror = NULL;
    stub_set_function set = NULL;
    knurl_device *device = NULL;
    knurl_library *library = knurl_system_load_library(KNURL_TEST_STUB, why, sizeof why);
    (void)wire;
    if (!library || !knurl_system_find_function(library, "stub_mirror", &mirror) ||
        !knurl_system_find_function(library, "stub_set", &set)) {
        return NULL;
    }
    mirror(&shared->told);
    set(STUB_DEFAULT, STUB_STROKE, KNURL_STROKE_REST);
    return knurl_device_open(guarded ? "touch:?guard=1&library=" KNURL_TEST_STUB : "touch:?library=" KNURL_TEST_STUB,
                             &device)
               ? NULL
               : device;
}

const wire_kind wire_kinds[] = {
    {"falcon", falcon_open, falcon_reset, falcon_hear, NULL},
    {"rawhid", rawhid_open, rawhid_reset, rawhid_hear, NULL},
    {"inverse3", inverse3_open, inverse3_reset, inverse3_hear, "its maker's service holds it, in another process"},
    {"touch", touch_open, NULL, NULL, "its maker's library drives it, from inside of the process"},
    {"functions", functions_open, functions_reset, functions_hear, "its handle is the caller's"},
};
const size_t wire_kind_count = sizeof wire_kinds / sizeof *wire_kinds;

/* --- the test's side --- */

static void *run(void *argument) {
    wire_device *device = argument;
    uint8_t bytes[KNURL_INVERSE3_COMMAND]; /* the longest of all */
    uint8_t answer[INVERSE3_SIM_ROOM];
    ssize_t got;
    while ((got = recv(device->wire, bytes, sizeof bytes, 0)) > 0 && device->kind->hear) {
        int has_force = knurl_load_relaxed(&device->shared->told.limp_since) == 0;
        const size_t size = device->kind->hear(bytes, (size_t)got, answer, &has_force);
        if (has_force) {
            knurl_store_release(&device->shared->told.limp_since, (int64_t)0);
        } else if (knurl_load_relaxed(&device->shared->told.limp_since) == 0) {
            knurl_store_release(&device->shared->told.limp_since, knurl_system_now_ns());
        }
        if (size > 0) {
            (void)send(device->wire, answer, size, MSG_NOSIGNAL | MSG_DONTWAIT);
        }
    }
    knurl_store_release(&device->is_closed, 1);
    return NULL;
}

void wire_start(wire_device *device, const wire_kind *kind, int wire, wire_shared *shared) {
    device->kind = kind;
    device->shared = shared;
    device->wire = wire;
    device->is_closed = 0;
    if (kind->reset) {
        kind->reset();
    }
    (void)pthread_create(&device->thread, NULL, run, device);
}

void wire_join(wire_device *device) {
    (void)pthread_join(device->thread, NULL);
}
