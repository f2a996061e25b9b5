/* Novint Falcon. Its exchanges are in exchange.c. SPDX-License-Identifier: MIT */
#include "device/falcon/falcon_device.h"

#include "base/format.h"
#include "base/number.h"
#include "base/regular_file.h"
#include "device/driver.h"
#include "device/falcon/firmware.h"
#include "device/falcon/kinematics.h"

#include <stdio.h>
#include <string.h>

/* N at the peak: quoted from Novint's brochure as 2 lbf; CHAI3D has 8. With a gain near 1 the motors' limit is reached
 * first in some directions, see kinematics.h. */
#define MAX_FORCE 8.9

/* Motor commands, as a fraction of those by libnifalcon's gain (kinematics.h). In recorded packets of the maker's own
 * driver it is 0.35 to 0.53; no force has been measured yet. With the smaller value no force is stronger than
 * requested, and no force is weaker than 0.35 / 0.53 = 0.66 of the request. */
#define GAIN       0.35
#define GAIN_LEAST 0.05
#define GAIN_MOST  1.0

#define NATIVE_RATE 1000.0 /* Hz: frames sent; more would queue in the device */

static falcon *of(knurl_device *device) {
    return (falcon *)(void *)device; /* first member */
}

/* Starts the guard process if the URI requests it. */
static knurl_result start_guard(falcon *f) {
    static const int16_t none[3] = {0, 0, 0};
    knurl_guard_order order = {0, KNURL_FALCON_FRAME_BYTES, {0}};
    if (!f->wants_guard) {
        return KNURL_OK;
    }
    knurl_falcon_encode(none, KNURL_FALCON_HOMING | KNURL_FALCON_GREEN, order.bytes);
    const int shared = f->transport.share ? f->transport.share(f->transport.self, &order.endpoint) : -1;
    return knurl_link_start_guard(&f->link, &f->base, shared, &order);
}

static void disconnect(falcon *f) {
    knurl_link_close(&f->link); /* its last frames carry no force */
    if (f->transport.self) {
        f->transport.close(f->transport.self);
        memset(&f->transport, 0, sizeof f->transport);
    }
}

/* Opens and prepares the device and starts the thread; on failure closes all of it. */
static knurl_result connect(falcon *f) {
    knurl_result result = f->bus.open(f->bus.user, &f->transport);
    if (result) {
        return result;
    }
    result = knurl_falcon_prepare(&f->transport, f->firmware);
    memset(&f->decoder, 0, sizeof f->decoder);
    memset(f->position, 0, sizeof f->position);
    f->has_position = f->owed = f->is_behind = f->is_pushing = 0;
    f->told_bad = f->unanswering = 0;
    f->is_unhomed = f->is_nowhere = 0;
    f->heard_at = knurl_system_now_ns();
    f->exchanged_at = 0;
    result = result ? result : start_guard(f);
    result = result ? result : knurl_link_open(&f->link, &f->base, knurl_falcon_exchange, NATIVE_RATE);
    if (result) {
        disconnect(f);
    }
    return result;
}

/* Reads the file that `knurl calibrate falcon` writes: a number and a newline. */
static knurl_result read_gain(const char *path, char *text, size_t size) {
    char why[160];
    uint64_t there = 0;
    FILE *file = knurl_regular_open(NULL, path, &there, why, sizeof why);
    if (!file) {
        return knurl_fail(KNURL_ERROR_IO, "device 'falcon': KNURL_FALCON_GAIN: '%s': %s", path, why);
    }
    text[fread(text, 1, size - 1, file)] = '\0';
    (void)fclose(file);
    text[strcspn(text, "\r\n")] = '\0';
    return KNURL_OK;
}

/* `text`: the URI's gain, or "". */
static knurl_result set_gain(falcon *f, const char *text) {
    char kept[64] = "";
    const char *path = knurl_system_environment("KNURL_FALCON_GAIN");
    const int is_kept = !text[0] && path && path[0];
    const knurl_result result = is_kept ? read_gain(path, kept, sizeof kept) : KNURL_OK;
    if (result) {
        return result;
    }
    const char *said = is_kept ? kept : text;
    f->gain = GAIN;
    f->is_gain_set = is_kept || text[0];
    if (f->is_gain_set &&
        !(knurl_number(said, strlen(said), &f->gain) && knurl_is_within(f->gain, GAIN_LEAST, GAIN_MOST))) {
        return knurl_fail(
            KNURL_ERROR_ARGUMENT,
            "device 'falcon': %s: expected a number from %g to %g, found '%.100s'; it is 0.35 to 0.53 by its maker's "
            "driver, 1 by libnifalcon",
            is_kept ? path : "gain", GAIN_LEAST, GAIN_MOST, said);
    }
    return KNURL_OK;
}

static knurl_result parse(const char *options, falcon *f) {
    char name[KNURL_URI_ROOM];
    char gain[KNURL_URI_ROOM];
    char guard[KNURL_URI_ROOM];
    char known[KNURL_URI_ROOM];
    char *firmware = f->firmware;
    const knurl_uri_key keys[] = {{"firmware", firmware}, {"gain", gain}, {"guard", guard}, {"motors_known", known}};
    knurl_result result = knurl_uri_parse("falcon", options, name, keys, sizeof keys / sizeof *keys);
    result = result ? result : knurl_uri_flag("falcon", "guard", guard, &f->wants_guard);
    result = result ? result : knurl_uri_flag("falcon", "motors_known", known, &f->motors_known);
    if (!result && name[0]) {
        return knurl_fail(KNURL_ERROR_ARGUMENT,
                          "device 'falcon': expected 'falcon' (the first one that is found) or "
                          "'falcon:?firmware=PATH&gain=G', found 'falcon:%s'",
                          options);
    }
    result = result ? result : set_gain(f, gain);
    const char *usual = knurl_system_environment("KNURL_FALCON_FIRMWARE");
    if (!result && !firmware[0] && usual) {
        if (strlen(usual) >= KNURL_URI_ROOM) {
            return knurl_fail(KNURL_ERROR_ARGUMENT,
                              "device 'falcon': KNURL_FALCON_FIRMWARE: expected fewer than %d characters, found %lu",
                              KNURL_URI_ROOM, (unsigned long)strlen(usual));
        }
        (void)snprintf(firmware, KNURL_URI_ROOM, "%s", usual);
    }
    return result;
}

knurl_result knurl_falcon_open_on(const knurl_falcon_bus *bus, const char *options, knurl_device **device) {
    falcon *made = knurl_device_allocate(&knurl_falcon_driver, sizeof *made);
    if (!made) {
        return KNURL_ERROR_MEMORY;
    }
    made->base.max_force = MAX_FORCE;
    made->bus = *bus;
    knurl_result result = parse(options, made);
    if (!made->motors_known) {
        knurl_motor_check_init(&made->base.motor_check, MAX_FORCE);
    }
    result = result ? result : connect(made);
    return knurl_device_finish_open(&made->base, result, device);
}

static knurl_result falcon_open(const char *options, knurl_device **device) {
    return knurl_falcon_open_on(&knurl_falcon_usb, options, device);
}

static void falcon_list(knurl_listings *listings) {
    knurl_falcon_usb.list(knurl_falcon_usb.user, listings);
}

static void falcon_close(knurl_device *device) {
    disconnect(of(device));
    knurl_device_free(device);
}

/* As the fake device's preset "falcon", which has the sources, except for the workspace. */
static void falcon_info(const knurl_device *device, knurl_device_info *info) {
    const falcon *f = (const falcon *)(const void *)device;
    (void)knurl_format(info->name, sizeof info->name, "Novint Falcon, gain %g%s", f->gain,
                       f->is_gain_set ? "" : " (not weighed)");
    for (int axis = 0; axis < 3; axis++) {
        info->workspace_min[axis] = -KNURL_FALCON_WORKSPACE;
        info->workspace_max[axis] = KNURL_FALCON_WORKSPACE;
    }
    info->resolution = 0.000048; /* all three encoders by one count, at the centre, along z; one encoder: 0.041 mm */
    info->max_force = device->max_force;
    info->delay = 2.0;            /* assumed: one transfer in each direction at 1 kHz */
    info->continuous_force = 3.0; /* assumed: a third of the peak */
    info->heat_time = 60.0;       /* assumed */
    info->mass = 0.2;             /* assumed */
    info->viscous = 1.5;          /* assumed */
    info->coulomb = 0.5;          /* assumed */
    info->max_stiffness = 3000.0; /* CHAI3D */
    info->native_rate = NATIVE_RATE;
}

static knurl_result falcon_reopen(knurl_device *device) {
    disconnect(of(device)); /* the thread has already ended */
    return connect(of(device));
}

const knurl_driver knurl_falcon_driver = {
    .uri = "falcon",
    .keeps_heat = 1,
    .list = falcon_list,
    .open = falcon_open,
    .close = falcon_close,
    .get_info = falcon_info,
    .reopen = falcon_reopen,
};
