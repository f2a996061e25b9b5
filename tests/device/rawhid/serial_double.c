/* A simulated WoodenHaptics on a simulated serial port. SPDX-License-Identifier: MIT */
#include "device/rawhid/serial_double.h"

#include "base/system.h"
#include "device/driver.h"
#include "device/rawhid/serial_sim.h"
#include "support/close.h"

#define ROOM 4096

static struct {
    knurl_mutex mutex; /* for all fields */
    hid_sim sim;
    int fault;
    int model;
    const char *line;
    uint32_t opens;
    uint64_t random;
    char heard[SERIAL_SIM_LINE + 1];
    size_t heard_count;
    char said[ROOM];
    size_t said_count;
    int64_t due; /* ns: answers are not delivered earlier */
} d;

static double seconds(void) {
    return 1e-9 * (double)knurl_system_now_ns();
}

static void say(const char *text, size_t length) {
    if (d.fault == DOUBLE_LATE && d.said_count == 0) {
        d.due = knurl_system_now_ns() + 20000000;
    }
    length = d.fault == DOUBLE_SHORT && length > 9 ? length - 9 : length;
    for (size_t i = 0; i < length && d.said_count < ROOM && d.fault != DOUBLE_MUTE; i++) {
        d.said[d.said_count++] = d.fault == DOUBLE_CORRUPT ? (char)random_bits(&d.random) : text[i];
    }
}

static void hear(char c) {
    char text[128];
    if (d.heard_count < SERIAL_SIM_LINE) {
        d.heard[d.heard_count++] = c;
    }
    if (c == ']') {
        d.heard[d.heard_count] = '\0';
        d.heard_count = 0;
        const int length = serial_sim_hear(&d.sim, seconds(), d.heard, text, sizeof text);
        text[1] = (char)('0' + d.model);
        say(d.line ? d.line : text, d.line ? strlen(d.line) : (size_t)length);
    }
}

static int wire_write(void *self, const char *text, size_t size) {
    (void)self;
    knurl_system_mutex_lock(&d.mutex);
    const int works = d.fault != DOUBLE_UNPLUG && d.fault != DOUBLE_HANG;
    for (size_t i = 0; works && i < size; i++) {
        hear(text[i]);
    }
    knurl_system_mutex_unlock(&d.mutex);
    return works;
}

static int take(char *text, size_t room) {
    int got = 0;
    knurl_system_mutex_lock(&d.mutex);
    if (d.fault == DOUBLE_UNPLUG) {
        got = -1;
    } else if (d.said_count > 0 && knurl_system_now_ns() >= d.due && d.fault != DOUBLE_HANG) {
        const size_t most = d.fault == DOUBLE_SPLIT && room > 5 ? 5 : room;
        const size_t count = d.said_count < most ? d.said_count : most;
        memcpy(text, d.said, count);
        d.said_count -= count;
        memmove(d.said, d.said + count, d.said_count);
        got = (int)count;
    }
    knurl_system_mutex_unlock(&d.mutex);
    return got;
}

static int wire_read(void *self, char *text, size_t room, int milliseconds) {
    const int64_t until = knurl_system_now_ns() + (int64_t)milliseconds * 1000000;
    (void)self;
    int got = take(text, room);
    while (got == 0 && knurl_system_now_ns() < until) {
        knurl_system_sleep_until_ns(knurl_system_now_ns() + 100000);
        got = take(text, room);
    }
    return got;
}

static void wire_close(void *self) {
    (void)self;
}

static int ports_find(void *user, char *path, size_t size) {
    (void)user;
    (void)snprintf(path, size, "/dev/ttyACM0");
    return d.fault != DOUBLE_UNPLUG;
}

static int ports_open(void *user, const char *path, knurl_serial_wire *wire, char *why, size_t why_size) {
    const knurl_serial_wire opened = {&d, wire_write, wire_read, wire_close};
    (void)user;
    (void)path;
    (void)snprintf(why, why_size, "no such device");
    *wire = opened;
    d.said_count = d.heard_count = 0;
    d.opens++;
    return d.fault != DOUBLE_UNPLUG;
}

const knurl_serial_ports serial_double_ports = {NULL, ports_find, ports_open};

void serial_double_press(void) {
    knurl_system_mutex_lock(&d.mutex);
    serial_sim_press(&d.sim);
    knurl_system_mutex_unlock(&d.mutex);
}

void serial_double_model(int model) {
    d.model = model;
}

void serial_double_say(const char *line) {
    knurl_system_mutex_lock(&d.mutex);
    d.line = line;
    knurl_system_mutex_unlock(&d.mutex);
}

static void begin(void) {
    memset(&d, 0, sizeof d);
    knurl_system_mutex_init(&d.mutex);
    serial_sim_init(&d.sim, NULL);
    d.sim.time = d.sim.heard_at = d.sim.limp_from = seconds();
    d.model = 3;
    d.random = 88172645463325252u;
}

knurl_device *serial_double_open(const char *options) {
    knurl_device *device = NULL;
    if (knurl_serial_open(options, &serial_double_ports, &device)) {
        return NULL;
    }
    knurl_device_register(device);
    return device;
}

static knurl_device *double_open(void) {
    begin();
    return serial_double_open("?motors_known=1");
}

static knurl_device *double_open_backwards(void) {
    begin();
    d.sim.backwards = 7;
    d.sim.plant.config.hand_stiffness = 200.0; /* loosely held */
    d.sim.plant.config.hand_damping = 2.0;
    return serial_double_open("");
}

/* An unplugged device has lost its power: its counters start at 0, and its button homes it. */
static void double_inject(int fault) {
    knurl_system_mutex_lock(&d.mutex);
    const int was = d.fault;
    const uint32_t opens = d.opens;
    d.fault = fault;
    d.due = 0;
    if (fault == DOUBLE_JUMP) {
        d.sim.shift[0] = 0.05;
        hid_sim_advance(&d.sim, seconds());
    } else if (fault == DOUBLE_UNPLUG) {
        hid_sim_forget(&d.sim);
        d.sim.offset[0] = (int16_t)(d.sim.offset[0] + 40); /* the arm has moved a little since */
    }
    knurl_system_mutex_unlock(&d.mutex);
    if (fault == DOUBLE_WELL && was == DOUBLE_UNPLUG) {
        knurl_system_sleep_until_ns(knurl_system_now_ns() + 600000000); /* a loop finds it again within 250 ms */
        if (d.opens > opens) {
            serial_double_press();
        }
    }
}

static int64_t double_limp_since(void) {
    knurl_system_mutex_lock(&d.mutex);
    const double since = hid_sim_limp_since(&d.sim, seconds());
    knurl_system_mutex_unlock(&d.mutex);
    return since < 0.0 ? 0 : (int64_t)(since * 1e9);
}

static void double_close(knurl_device *device) {
    knurl_device_close(device);
    knurl_system_mutex_destroy(&d.mutex);
}

static void double_hold_grip(int is_held) {
    knurl_system_mutex_lock(&d.mutex);
    double_hold(&d.sim.plant, is_held);
    knurl_system_mutex_unlock(&d.mutex);
}

const device_double serial_double = {"serial",
                                     1u << DOUBLE_WELL | 1u << DOUBLE_UNPLUG | 1u << DOUBLE_MUTE | 1u << DOUBLE_HANG |
                                         1u << DOUBLE_LATE | 1u << DOUBLE_SHORT | 1u << DOUBLE_SPLIT |
                                         1u << DOUBLE_CORRUPT | 1u << DOUBLE_JUMP,
                                     double_open,
                                     double_inject,
                                     double_limp_since,
                                     double_close,
                                     double_open_backwards,
                                     100.0,
                                     double_hold_grip};
