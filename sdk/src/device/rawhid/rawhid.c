/* WoodenHaptics and similar devices: a microcontroller with encoders and current-controlled motors, over raw HID. Read
 * exchange() first. SPDX-License-Identifier: MIT */
#include "device/rawhid/rawhid.h"

#include "base/atomic.h"
#include "device/drivers.h"
#include "device/link.h"
#include "device/listings.h"
#include "device/rawhid/choose.h"
#include "device/rawhid/kinematics.h"
#include "device/rawhid/serial.h"
#include "device/uri.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define ANSWER_NS     4000000 /* to wait for a report: an exchange takes 5 ms at most */
#define QUEUE_ROOM    64      /* reports that the kernel queues */
#define GREET_TRIES   25      /* of 20 ms: the firmware starts slowly after power-up */
#define HOME_MARGIN   100     /* counts that the hand may have moved since the counters were set */
#define STRANGE_LIMIT 3       /* impossible poses in a row after which the counters are not trusted */
#define HOLD_CYCLES   50 /* exchanges without a position after homing: the loop zeroes the force first, then ramps */

typedef struct rawhid {
    knurl_device base;
    knurl_link link;
    const knurl_rawhid_bus *bus;
    knurl_serial_bus serial; /* if on a serial port; `ports` is null on USB HID */
    knurl_rawhid_port port;  /* self is null if closed */
    knurl_rawhid_geometry geometry;
    knurl_rawhid_arm arm;
    knurl_rawhid_wanted wanted;
    size_t report_bytes;
    int16_t home[3];
    uint32_t home_on_open;
    uint32_t motors_known;
    uint32_t wants_guard;
    /* of the I/O thread */
    double angles[3];
    uint32_t knows_angles;
    uint32_t is_corrupt; /* 1: already reported */
    uint32_t is_lost;    /* 1: the counters are wrong until it is homed; reported */
    uint32_t strange;    /* impossible poses in a row */
    uint32_t hold;       /* exchanges still to come without a position */
    uint64_t bad_bytes;  /* atomic */
} rawhid;

static rawhid *of(knurl_device *device) {
    return (rawhid *)(void *)device; /* first member */
}

static const rawhid *look_at(const knurl_device *device) {
    return (const rawhid *)(const void *)device;
}

/* --- reports --- */

enum { GONE = -1, NOTHING = 0, REPORT = 1, BAD = 2 };

static int take_report(rawhid *r, int milliseconds, knurl_rawhid_in *in) {
    uint8_t bytes[KNURL_RAWHID_MOST_BYTES + 1]; /* one more, to detect a report that is too long */
    const int got = r->port.read(r->port.self, bytes, sizeof bytes, milliseconds);
    if (got <= 0) {
        return got < 0 ? GONE : NOTHING;
    }
    if (knurl_rawhid_parse(bytes, (size_t)got, r->report_bytes, in)) {
        r->is_corrupt = 0;
        return REPORT;
    }
    knurl_store_relaxed(&r->bad_bytes, knurl_load_relaxed(&r->bad_bytes) + (uint64_t)got);
    if (!r->is_corrupt) {
        r->is_corrupt = 1;
        knurl_events_report(&r->base.events, KNURL_FAULT_CORRUPT, got);
    }
    return BAD;
}

/* Discards reports that came too late to answer the next one sent. Returns 0 if the device is gone. */
static int drain(rawhid *r) {
    knurl_rawhid_in ignored;
    int outcome = REPORT;
    for (int i = 0; i < QUEUE_ROOM && outcome > NOTHING; i++) {
        outcome = take_report(r, 0, &ignored);
    }
    return outcome != GONE;
}

/* Waits up to `ns` for a valid report. */
static int await_report(rawhid *r, int64_t ns, knurl_rawhid_in *in) {
    const int64_t until = knurl_system_now_ns() + ns;
    for (int i = 0; i < QUEUE_ROOM; i++) {
        const int64_t left = until - knurl_system_now_ns();
        const int outcome = take_report(r, left > 0 ? (int)((left + 999999) / 1000000) : 0, in);
        if (outcome != BAD) {
            return outcome;
        }
    }
    return NOTHING;
}

/* Returns 0 if nothing was sent. */
static int send_currents(rawhid *r, const double force[3]) {
    uint8_t bytes[KNURL_RAWHID_MOST_BYTES + 1];
    int16_t ma[3] = {0, 0, 0};
    if (r->knows_angles) {
        knurl_rawhid_currents(&r->arm, r->angles, force, ma);
    }
    return r->port.write(r->port.self, bytes, knurl_rawhid_put_currents(bytes, r->report_bytes, ma));
}

static int send_home(rawhid *r) {
    uint8_t bytes[KNURL_RAWHID_MOST_BYTES + 1];
    return r->port.write(r->port.self, bytes, knurl_rawhid_put_counters(bytes, r->report_bytes, r->home));
}

/* --- the exchange --- */

/* The grip's position from its counters, unless they cannot be trusted. */
static int locate(rawhid *r, const knurl_rawhid_in *in, knurl_device_sample *sample) {
    if (in->info == 1) { /* its button was pressed: the grip is in the home pose */
        if (r->hold == 0 && !r->is_lost) {
            knurl_events_report(&r->base.events, KNURL_FAULT_UNCALIBRATED, 0.0);
        }
        r->knows_angles = 0;
        r->hold = HOLD_CYCLES;
        r->strange = r->is_lost = 0;
        (void)send_home(r);
        return KNURL_LINK_NO_POSITION;
    }
    knurl_rawhid_angles(&r->arm, in->counts, r->angles);
    r->strange = knurl_rawhid_is_pose(&r->arm, r->angles) ? 0 : r->strange + 1;
    if (r->strange >= STRANGE_LIMIT && !r->is_lost) { /* until it is homed: it lost power, or was never homed */
        r->is_lost = 1;
        knurl_events_report(&r->base.events, KNURL_FAULT_UNCALIBRATED, 0.0);
    }
    r->hold -= r->hold > 0;
    r->knows_angles = r->strange == 0 && !r->is_lost && r->hold == 0;
    if (!r->knows_angles) {
        return KNURL_LINK_NO_POSITION;
    }
    knurl_rawhid_position(&r->arm, r->angles, sample->position);
    return KNURL_LINK_POSITION;
}

/* The firmware answers each report with one. The motor currents are computed for the arm's pose in the last exchange, a
 * millisecond ago. */
static int exchange(knurl_device *device, const double force[3], knurl_device_sample *sample) {
    rawhid *r = of(device);
    knurl_rawhid_in in;
    if (!drain(r)) {
        return KNURL_LINK_LOST;
    }
    if (!send_currents(r, force)) {
        knurl_rawhid_in ignored; /* only a read distinguishes a device that is gone from one that is busy */
        return take_report(r, 0, &ignored) == GONE ? KNURL_LINK_LOST : KNURL_LINK_NOTHING;
    }
    const int outcome = await_report(r, ANSWER_NS, &in);
    return outcome == GONE ? KNURL_LINK_LOST : outcome == REPORT ? locate(r, &in, sample) : KNURL_LINK_NOTHING;
}

/* --- opening --- */

/* Sends zero currents until the device answers: it starts with the first report it receives. */
static knurl_result greet(rawhid *r, knurl_rawhid_in *in) {
    static const double none[3] = {0.0, 0.0, 0.0};
    int outcome = NOTHING;
    for (int i = 0; i < GREET_TRIES && outcome == NOTHING; i++) {
        outcome = drain(r) ? NOTHING : GONE;
        (void)(outcome == NOTHING && send_currents(r, none));
        outcome = outcome == NOTHING ? await_report(r, 20000000, in) : outcome;
    }
    if (outcome == REPORT) {
        return KNURL_OK;
    }
    return knurl_fail(KNURL_ERROR_DEVICE_LOST,
                      "device '%s' (%04x:%04x): it does not answer: expected reports of %u bytes, found %s, and %lu "
                      "bytes that form no report; switch its power on, or plug it in again",
                      r->base.driver->uri, r->wanted.vendor, r->wanted.product, (unsigned)r->report_bytes,
                      outcome == GONE ? "that it was unplugged" : "none within 0.5 s", (unsigned long)r->bad_bytes);
}

static int is_home(const rawhid *r, const knurl_rawhid_in *in) {
    int near = in->info == 0;
    for (int i = 0; i < 3; i++) {
        near &= abs(in->counts[i] - r->home[i]) <= HOME_MARGIN;
    }
    return near;
}

/* Sets the counters, and checks that they are set. */
static knurl_result home(rawhid *r, knurl_rawhid_in *in) {
    knurl_result result = KNURL_OK;
    for (int i = 0; i < GREET_TRIES && !result; i++) {
        (void)send_home(r);
        result = await_report(r, 20000000, in) == GONE ? KNURL_ERROR_DEVICE_LOST : greet(r, in);
        if (!result && is_home(r, in)) {
            return KNURL_OK;
        }
    }
    return knurl_fail(KNURL_ERROR_DEVICE_LOST,
                      "device '%s' (%04x:%04x): homing: expected its encoders at %d, %d, %d, found %d, %d, %d; its "
                      "firmware does not set counters, or the grip was moved",
                      r->base.driver->uri, r->wanted.vendor, r->wanted.product, r->home[0], r->home[1], r->home[2],
                      in->counts[0], in->counts[1], in->counts[2]);
}

/* Starts the guard process if the URI requests it. */
static knurl_result start_guard(rawhid *r, const knurl_rawhid_found *found) {
    static const int16_t none[3];
    knurl_guard_order order = {0, 0, {0}};
    char why[256] = "its handle is not available";
    if (!r->wants_guard) {
        return KNURL_OK;
    }
    order.size = (uint32_t)knurl_rawhid_put_currents(order.bytes, r->report_bytes, none);
    const int shared = r->bus->share ? r->bus->share(r->bus->user, found) : -1;
    if (shared >= 0) {
        r->link.guard = knurl_guard_process_start(shared, &order, why, sizeof why);
    }
    return r->link.guard ? KNURL_OK
                         : knurl_fail(KNURL_ERROR_UNSUPPORTED, "device '%s' (%04x:%04x): guard: %s",
                                      r->base.driver->uri, found->vendor, found->product, why);
}

static void close_port(rawhid *r) {
    knurl_guard_process_stop(r->link.guard);
    r->link.guard = NULL;
    if (r->port.self) {
        r->port.close(r->port.self);
        r->port.self = NULL;
    }
}

/* Finds the device of the URI, and its report length. */
static knurl_result find_port(rawhid *r, knurl_rawhid_found *found) {
    if (!r->serial.ports) {
        return knurl_rawhid_choose(r->bus, &r->wanted, found, &r->report_bytes);
    }
    r->report_bytes = KNURL_RAWHID_LEAST_BYTES;
    return r->bus->look(r->bus->user, 0, 0, found, 1)
               ? KNURL_OK
               : knurl_fail(KNURL_ERROR_DEVICE_LOST,
                            "device 'serial': looked for the serial port of a Teensy (%04x:%04x) and found none; plug "
                            "it in, or name its port as serial:/dev/ttyACM0",
                            KNURL_SERIAL_VENDOR, KNURL_SERIAL_PRODUCT);
}

static knurl_result open_port(rawhid *r, knurl_rawhid_found *chosen) {
    knurl_rawhid_found found;
    char why[256] = "";
    const knurl_result result = find_port(r, &found);
    if (result) {
        return result;
    }
    if (!r->bus->open(r->bus->user, &found, &r->port, why, sizeof why)) {
        return knurl_fail(KNURL_ERROR_SYSTEM, "device '%s' (%04x:%04x): %s could not be opened: %s",
                          r->base.driver->uri, found.vendor, found.product, found.path, why);
    }
    r->wanted.vendor = found.vendor; /* a reopen must find the same kind of device */
    r->wanted.product = found.product;
    *chosen = found;
    return KNURL_OK;
}

/* Finds, greets and homes the device and starts the I/O thread; on failure closes all of it. */
static knurl_result connect(rawhid *r, int is_again) {
    knurl_rawhid_in in = {{0, 0, 0, 0, 0, 0}, 0};
    double angles[3];
    knurl_rawhid_found found;
    r->knows_angles = r->is_corrupt = r->is_lost = r->strange = r->hold = 0;
    r->serial.is_again = (uint32_t)is_again;
    knurl_result result = open_port(r, &found);
    if (result) {
        return result;
    }
    result = greet(r, &in);
    knurl_rawhid_angles(&r->arm, in.counts, angles);
    /* a reopened device kept its counters unless it lost power; it must not be homed in the middle of a stroke */
    if (!result && r->home_on_open && !(is_again && knurl_rawhid_is_pose(&r->arm, angles))) {
        result = home(r, &in);
    }
    result = result ? result : start_guard(r, &found);
    result = result ? result : knurl_link_open(&r->link, &r->base, exchange, 1000.0);
    if (result) {
        close_port(r);
    }
    return result;
}

static knurl_result read_options(const char *options, const knurl_serial_ports *ports, rawhid *r) {
    char id[KNURL_URI_ROOM];
    char geometry[KNURL_URI_ROOM];
    char homing[KNURL_URI_ROOM];
    char guard[KNURL_URI_ROOM];
    char known[KNURL_URI_ROOM];
    uint32_t homes = 0;
    const char *driver = r->base.driver->uri;
    const knurl_uri_key keys[] = {{"geometry", geometry}, {"home", homing}, {"guard", guard}, {"motors_known", known}};
    knurl_result result = knurl_uri_parse(driver, options, id, keys, sizeof keys / sizeof *keys);
    result = result ? result : knurl_uri_flag(driver, "home", homing, &homes);
    result = result ? result : knurl_uri_flag(driver, "guard", guard, &r->wants_guard);
    result = result ? result : knurl_uri_flag(driver, "motors_known", known, &r->motors_known);
    knurl_rawhid_geometry_init(&r->geometry);
    if (ports) { /* hfabapi's for this firmware: motors b and c turn backwards */
        r->geometry.sign[1] = r->geometry.sign[2] = -1.0;
        r->geometry.home[2] = -6000.0;
    }
    if (!result && geometry[0]) {
        result = knurl_rawhid_geometry_load(geometry, &r->geometry);
    }
    result = result ? result : knurl_rawhid_want(ports ? "" : id, &r->geometry, &r->wanted);
    knurl_rawhid_arm_init(&r->arm, &r->geometry);
    for (int i = 0; i < 3; i++) {
        r->home[i] = (int16_t)r->geometry.home[i];
    }
    r->home_on_open = homing[0] ? homes : r->geometry.home_on_open > 0.0;
    if (ports) {
        knurl_serial_bus_init(&r->serial, ports, id, r->home);
        r->bus = &r->serial.bus;
    }
    return result;
}

/* Exactly one of `bus` and `ports` is set. */
static knurl_result open_on(const char *options, const knurl_rawhid_bus *bus, const knurl_serial_ports *ports,
                            knurl_device **device) {
    const knurl_driver *driver = ports ? &knurl_serial_driver : &knurl_rawhid_driver;
    rawhid *made = calloc(1, sizeof *made);
    if (!made) {
        return knurl_fail(KNURL_ERROR_MEMORY, "device '%s': could not get %u bytes", driver->uri,
                          (unsigned)sizeof *made);
    }
    made->bus = bus;
    knurl_device_init(&made->base, driver);
    knurl_result result = read_options(options, ports, made);
    made->base.max_force = made->geometry.max_force;
    made->base.max_speed = KNURL_HAND_SPEED;
    if (!made->motors_known) {
        knurl_motor_check_init(&made->base.motor_check, made->base.max_force);
    }
    result = result ? result : connect(made, 0);
    return knurl_device_finish_open(&made->base, result, device);
}

knurl_result knurl_rawhid_open(const char *options, const knurl_rawhid_bus *bus, knurl_device **device) {
    return open_on(options, bus, NULL, device);
}

knurl_result knurl_serial_open(const char *options, const knurl_serial_ports *ports, knurl_device **device) {
    return open_on(options, NULL, ports, device);
}

/* --- the driver --- */

static void rawhid_close(knurl_device *device) {
    rawhid *r = of(device);
    knurl_link_close(&r->link); /* its last exchanges set the force to zero */
    close_port(r);
    knurl_device_free(device);
}

static knurl_result rawhid_reopen(knurl_device *device) {
    rawhid *r = of(device);
    knurl_link_close(&r->link); /* its thread has already ended */
    close_port(r);
    return connect(r, 1);
}

static void rawhid_info(const knurl_device *device, knurl_device_info *info) {
    const rawhid *r = look_at(device);
    const knurl_rawhid_geometry *g = &r->geometry;
    (void)snprintf(info->name, sizeof info->name, "%s", g->name);
    for (int axis = 0; axis < 3; axis++) { /* the cube inside the makers' sphere: the joints' stops are not published */
        info->workspace_max[axis] = 0.577350269189626 * g->workspace_radius;
        info->workspace_min[axis] = -info->workspace_max[axis];
    }
    info->resolution = knurl_rawhid_resolution(&r->arm); /* from its encoders and gears */
    info->max_force = g->max_force;                      /* as far as 2 A reach */
    info->max_stiffness = g->max_stiffness;              /* CHAI3D */
    info->max_damping = g->max_damping;                  /* CHAI3D */
    info->continuous_force = g->continuous_force;        /* assumed: a third of CHAI3D's 5 N */
    info->heat_time = g->heat_time;                      /* assumed: as the Touch's */
    info->mass = g->mass;                                /* assumed */
    info->viscous = g->viscous;                          /* assumed */
    info->coulomb = g->coulomb;                          /* assumed */
    info->delay = 2.0;          /* assumed: the force waits for the next exchange, the position for the next tick */
    info->native_rate = 1000.0; /* its interrupt endpoints are polled every millisecond */
}

static void rawhid_status(const knurl_device *device, knurl_device_status *status) {
    const rawhid *r = look_at(device);
    status->bad_bytes = knurl_load_relaxed(&r->bad_bytes);
}

static void rawhid_list(knurl_listings *listings) {
    char why[512];
    const knurl_rawhid_bus *bus = knurl_rawhid_hidapi(why, sizeof why);
    if (bus) {
        knurl_rawhid_list(bus, listings);
    } else {
        knurl_listings_add(listings, "rawhid", "raw HID device (WoodenHaptics)", "%s", why);
    }
}

static knurl_result rawhid_open(const char *options, knurl_device **device) {
    char why[512];
    const knurl_rawhid_bus *bus = knurl_rawhid_hidapi(why, sizeof why);
    return bus ? knurl_rawhid_open(options, bus, device)
               : knurl_fail(KNURL_ERROR_UNSUPPORTED, "device 'rawhid': %s", why);
}

const knurl_driver knurl_rawhid_driver = {
    .uri = "rawhid",
    .keeps_heat = 1,
    .list = rawhid_list,
    .open = rawhid_open,
    .close = rawhid_close,
    .get_info = rawhid_info,
    .get_status = rawhid_status,
    .reopen = rawhid_reopen,
};

static void serial_list(knurl_listings *listings) {
    static const char name[] = "WoodenHaptics on a serial port";
    const knurl_serial_ports *ports = knurl_serial_tty();
    char path[64];
    if (!ports) {
        knurl_listings_add(listings, "serial", name, "this build has no serial ports: they are for Linux and macOS");
    } else if (ports->find(ports->user, path, sizeof path)) {
        knurl_listings_add(listings, "serial", name, "%s", "");
    } else {
        knurl_listings_add(listings, "serial", name,
                           "not connected (looked for a Teensy, %04x:%04x, among /dev/ttyACM*): plug it in; another "
                           "port is opened as serial:PATH",
                           KNURL_SERIAL_VENDOR, KNURL_SERIAL_PRODUCT);
    }
}

static knurl_result serial_open(const char *options, knurl_device **device) {
    const knurl_serial_ports *ports = knurl_serial_tty();
    return ports ? knurl_serial_open(options, ports, device)
                 : knurl_fail(KNURL_ERROR_UNSUPPORTED, "device 'serial': this build has no serial ports");
}

const knurl_driver knurl_serial_driver = {
    .uri = "serial",
    .keeps_heat = 1,
    .list = serial_list,
    .open = serial_open,
    .close = rawhid_close,
    .get_info = rawhid_info,
    .get_status = rawhid_status,
    .reopen = rawhid_reopen,
};
