/* WoodenHaptics and similar devices: a microcontroller with encoders and current-controlled motors, over raw HID.
 * SPDX-License-Identifier: MIT */
#include "device/rawhid/rawhid_device.h"

#include <stdio.h>
#include <stdlib.h>

#define GREET_TRIES 25  /* of 20 ms: the firmware starts slowly after power-up */
#define HOME_MARGIN 100 /* counts that the hand may have moved since the counters were set */

static rawhid *of(knurl_device *device) {
    return (rawhid *)(void *)device; /* first member */
}

/* Sends zero currents until the device answers: it starts with the first report it receives. */
static knurl_result greet(rawhid *r, knurl_rawhid_in *in) {
    static const double none[3] = {0.0, 0.0, 0.0};
    int outcome = RAWHID_NOTHING;
    for (int i = 0; i < GREET_TRIES && outcome == RAWHID_NOTHING; i++) {
        outcome = knurl_rawhid_drain(r) ? RAWHID_NOTHING : RAWHID_GONE;
        (void)(outcome == RAWHID_NOTHING && knurl_rawhid_send_currents(r, none));
        outcome = outcome == RAWHID_NOTHING ? knurl_rawhid_await(r, 20000000, in) : outcome;
    }
    if (outcome == RAWHID_REPORT) {
        return KNURL_OK;
    }
    return knurl_fail(
        KNURL_ERROR_DEVICE_LOST,
        "device '%s' (%04x:%04x): %s: expected reports of %u bytes, found none within 0.5 s and %lu bytes "
        "of other data; switch its power on, or plug it in again",
        r->base.driver->uri, r->wanted.vendor, r->wanted.product,
        outcome == RAWHID_GONE ? "it was unplugged" : "it does not answer", (unsigned)r->report_bytes,
        (unsigned long)r->link.bad_bytes);
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
        (void)knurl_rawhid_send_home(r);
        result = knurl_rawhid_await(r, 20000000, in) == RAWHID_GONE ? KNURL_ERROR_DEVICE_LOST : greet(r, in);
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
    if (!r->wants_guard) {
        return KNURL_OK;
    }
    order.size = (uint32_t)knurl_rawhid_put_currents(order.bytes, r->report_bytes, none);
    const int shared = r->bus->share ? r->bus->share(r->bus->user, found) : -1;
    return knurl_link_start_guard(&r->link, &r->base, shared, &order);
}

static void disconnect(rawhid *r) {
    knurl_link_close(&r->link); /* its last exchanges set the force to zero */
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
                            "it in, or name its port as serial:" KNURL_SERIAL_EXAMPLE,
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
    r->knows_angles = r->link.is_corrupt = r->is_lost = r->strange = r->hold = 0;
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
    result = result ? result : knurl_link_open(&r->link, &r->base, knurl_rawhid_exchange, 1000.0);
    if (result) {
        disconnect(r);
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
    rawhid *made = knurl_device_allocate(driver, sizeof *made);
    if (!made) {
        return KNURL_ERROR_MEMORY;
    }
    made->bus = bus;
    knurl_result result = read_options(options, ports, made);
    made->base.max_force = made->geometry.max_force;
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
    disconnect(of(device));
    knurl_device_free(device);
}

static knurl_result rawhid_reopen(knurl_device *device) {
    disconnect(of(device)); /* the thread has already ended */
    return connect(of(device), 1);
}

static void rawhid_info(const knurl_device *device, knurl_device_info *info) {
    const rawhid *r = (const rawhid *)(const void *)device;
    const knurl_rawhid_geometry *g = &r->geometry;
    (void)snprintf(info->name, sizeof info->name, "%s", g->name);
    knurl_device_info_sphere(info, g->workspace_radius); /* the makers': the joints' stops are not published */
    info->resolution = knurl_rawhid_resolution(&r->arm); /* from its encoders and gears */
    info->max_force = g->max_force;                      /* as far as 2 A reach */
    info->max_stiffness = g->max_stiffness;              /* CHAI3D */
    info->continuous_force = g->continuous_force;        /* assumed: a third of CHAI3D's 5 N */
    info->heat_time = g->heat_time;                      /* assumed: as the Touch's */
    info->mass = g->mass;                                /* assumed */
    info->viscous = g->viscous;                          /* assumed */
    info->coulomb = g->coulomb;                          /* assumed */
    info->delay = 2.0;          /* assumed: the force waits for the next exchange, the position for the next tick */
    info->native_rate = 1000.0; /* its interrupt endpoints are polled every millisecond */
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
    .reopen = rawhid_reopen,
};

static void serial_list(knurl_listings *listings) {
    static const char name[] = "WoodenHaptics on a serial port";
    const knurl_serial_ports *ports = knurl_serial_system();
    char path[64];
    if (ports->find(ports->user, path, sizeof path)) {
        knurl_listings_add(listings, "serial", name, "%s", "");
    } else {
        knurl_listings_add(
            listings, "serial", name,
            "not connected (looked for the serial port of a Teensy, %04x:%04x): plug it in; another port "
            "is opened as serial:PORT, such as serial:" KNURL_SERIAL_EXAMPLE,
            KNURL_SERIAL_VENDOR, KNURL_SERIAL_PRODUCT);
    }
}

static knurl_result serial_open(const char *options, knurl_device **device) {
    return knurl_serial_open(options, knurl_serial_system(), device);
}

const knurl_driver knurl_serial_driver = {
    .uri = "serial",
    .keeps_heat = 1,
    .list = serial_list,
    .open = serial_open,
    .close = rawhid_close,
    .get_info = rawhid_info,
    .reopen = rawhid_reopen,
};
