/* Converts between lines of text and reports. Read port_read() and port_write() first. SPDX-License-Identifier: MIT */
#include "device/rawhid/serial.h"

#include "base/format.h"
#include "base/system.h"
#include "device/rawhid/report.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MODEL        3 /* "model_woody_raw" */
#define NUMBERS      8 /* in a line from the device */
#define LINE_ROOM    128
#define REPORT_BYTES KNURL_RAWHID_LEAST_BYTES
#define SENSOR_BITS  7 /* of its error: a gimbal sensor, not used here */
#define HELLO_TRIES  25
#define HELLO_MS     20

typedef struct serial_port {
    knurl_serial_wire wire;
    int32_t offset[3]; /* counts, added to the device's own */
    int32_t raw[3];    /* last counts of the device */
    uint32_t is_homed; /* 0: counts mean nothing until its button is pressed */
    uint32_t has_raw;
    int32_t model; /* of the last line */
    char text[LINE_ROOM];
    size_t count; /* characters received of the next line */
} serial_port;

/* Parses "[n,n,...]" with `count` whole numbers, and nothing else. */
static int parse_line(const char *line, int32_t *numbers, int count) {
    const char *at = line;
    for (int i = 0; i < count; i++) {
        char *end = NULL;
        if (*at != (i == 0 ? '[' : ',')) {
            return 0;
        }
        const long value = strtol(at + 1, &end, 10);
        if (end == at + 1 || value < -1000000000 || value > 1000000000) {
            return 0;
        }
        numbers[i] = (int32_t)value;
        at = end;
    }
    return strcmp(at, "]") == 0;
}

/* Its button sets all its encoders to 0 at once, from any pose. */
static int was_homed(const serial_port *p, const int32_t raw[3]) {
    const int was_away = abs(p->raw[0]) > 2 || abs(p->raw[1]) > 2 || abs(p->raw[2]) > 2;
    return p->has_raw && was_away && raw[0] == 0 && raw[1] == 0 && raw[2] == 0;
}

/* Converts a line to a report of REPORT_BYTES; returns 0 if the line is invalid. */
static int make_report(serial_port *p, const char *line, uint8_t *bytes) {
    int32_t numbers[NUMBERS];
    int32_t words[7] = {0};
    if (!parse_line(line, numbers, NUMBERS)) {
        return 0;
    }
    p->model = numbers[0];
    if (p->model != MODEL || (numbers[7] & ~SENSOR_BITS) != 0) {
        return 0;
    }
    words[6] = was_homed(p, &numbers[1]);
    p->is_homed |= (uint32_t)words[6];
    for (int i = 0; i < 3; i++) {
        p->raw[i] = numbers[1 + i];
        words[i] = p->is_homed ? p->raw[i] + p->offset[i] : 0;
        if (words[i] < INT16_MIN || words[i] > INT16_MAX) {
            return 0;
        }
    }
    p->has_raw = 1;
    for (int i = 0; i < 7; i++) {
        bytes[2 * i] = (uint8_t)((uint32_t)words[i] & 0xffu);
        bytes[2 * i + 1] = (uint8_t)((uint32_t)words[i] >> 8 & 0xffu);
    }
    return 1;
}

/* Removes the first complete line from the received text. Returns 1 and a report, or -1 if it is invalid. */
static int take_line(serial_port *p, uint8_t *bytes) {
    char *end = memchr(p->text, ']', p->count);
    if (!end && p->count < LINE_ROOM - 1) {
        return 0;
    }
    const size_t length = end ? (size_t)(end - p->text) + 1 : p->count;
    char line[LINE_ROOM];
    const char *begin = line + strspn(memcpy(line, p->text, length), "\r\n");
    line[length] = '\0';
    p->count -= length;
    memmove(p->text, p->text + length, p->count);
    return end && make_report(p, begin, bytes) ? 1 : -1;
}

/* As knurl_rawhid_port.read; reads one byte in place of an invalid line. */
static int port_read(void *self, uint8_t *bytes, size_t room, int milliseconds) {
    serial_port *p = self;
    const int64_t until = knurl_system_now_ns() + (int64_t)milliseconds * 1000000;
    for (;;) {
        const int taken = room < REPORT_BYTES ? 0 : take_line(p, bytes);
        if (taken != 0) {
            return taken > 0 ? REPORT_BYTES : 1;
        }
        const int64_t left = until - knurl_system_now_ns();
        const int got = p->wire.read(p->wire.self, p->text + p->count, LINE_ROOM - 1 - p->count,
                                     left > 0 ? (int)((left + 999999) / 1000000) : 0);
        if (got <= 0) {
            return got;
        }
        p->count += (size_t)got;
    }
}

static int word(const uint8_t *report, int which) {
    const int value = report[2 * which] | report[2 * which + 1] << 8;
    return value < 32768 ? value : value - 65536;
}

/* As knurl_rawhid_port.write. Counters are set on this side, because the device has no such command. */
static int port_write(void *self, const uint8_t *bytes, size_t size) {
    serial_port *p = self;
    char text[64];
    if (size != REPORT_BYTES + 1) {
        return 0;
    }
    const uint8_t *report = bytes + 1; /* after its ID */
    const int sets_counters = word(report, 3) == 1;
    for (int i = 0; i < 3 && sets_counters && p->has_raw; i++) {
        p->offset[i] = word(report, 4 + i) - p->raw[i];
        p->is_homed = 1;
    }
    const int length = snprintf(text, sizeof text, "[%d,%d,%d]\n", sets_counters ? 0 : word(report, 0),
                                sets_counters ? 0 : word(report, 1), sets_counters ? 0 : word(report, 2));
    return p->wire.write(p->wire.self, text, (size_t)length);
}

static void port_close(void *self) {
    serial_port *p = self;
    p->wire.close(p->wire.self);
    free(p);
}

/* Checks the firmware's model in its first line. Returns 1, or 0 and the reason. */
static int say_hello(serial_port *p, char *why, size_t why_size) {
    static const char zero[] = "[0,0,0]\n";
    uint8_t report[REPORT_BYTES];
    for (int i = 0; i < HELLO_TRIES; i++) {
        (void)p->wire.write(p->wire.self, zero, sizeof zero - 1);
        const int got = port_read(p, report, sizeof report, HELLO_MS);
        if (got == REPORT_BYTES) {
            return 1;
        }
        if (got == 1 && p->model != 0 && p->model != MODEL) {
            (void)snprintf(why, why_size,
                           "its firmware reports model %d (1: Polhem, 2: Phantom); expected %d, WoodenHaptics",
                           (int)p->model, MODEL);
            return 0;
        }
    }
    (void)knurl_format(why, why_size,
                       "no line such as [3,0,0,0,0,0,0,0] comes back within %g s; load the makers' firmware "
                       "woody_teensy_mini",
                       1e-3 * HELLO_TRIES * HELLO_MS);
    return 0;
}

static int bus_open(void *user, const knurl_rawhid_found *found, knurl_rawhid_port *port, char *why, size_t why_size) {
    const knurl_serial_bus *bus = user;
    serial_port *made = calloc(1, sizeof *made);
    if (!made) {
        (void)snprintf(why, why_size, "no memory");
        return 0;
    }
    if (!bus->ports->open(bus->ports->user, found->path, &made->wire, why, why_size)) {
        free(made);
        return 0;
    }
    made->is_homed = !bus->is_again;
    for (int i = 0; i < 3; i++) {
        made->offset[i] = bus->home[i];
    }
    if (!say_hello(made, why, why_size)) {
        port_close(made);
        return 0;
    }
    const knurl_rawhid_port opened = {made, port_write, port_read, port_close};
    *port = opened;
    return 1;
}

static size_t bus_look(void *user, uint16_t vendor, uint16_t product, knurl_rawhid_found *found, size_t capacity) {
    const knurl_serial_bus *bus = user;
    (void)vendor;
    (void)product;
    if (capacity == 0) {
        return 0;
    }
    memset(found, 0, sizeof *found);
    (void)snprintf(found->path, sizeof found->path, "%.255s", bus->path);
    if (!bus->path[0] && !bus->ports->find(bus->ports->user, found->path, sizeof found->path)) {
        return 0;
    }
    found->vendor = KNURL_SERIAL_VENDOR;
    found->product = KNURL_SERIAL_PRODUCT;
    found->sizes.in = found->sizes.out = REPORT_BYTES;
    return 1;
}

void knurl_serial_bus_init(knurl_serial_bus *bus, const knurl_serial_ports *ports, const char *path,
                           const int16_t home[3]) {
    const knurl_rawhid_bus made = {bus, bus_look, bus_open, NULL};
    bus->bus = made;
    bus->ports = ports;
    bus->is_again = 0;
    (void)snprintf(bus->path, sizeof bus->path, "%s", path);
    memcpy(bus->home, home, sizeof bus->home);
}
