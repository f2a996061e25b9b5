/* Novint Falcon: an I/O thread sends a frame of motor commands and receives a frame of encoders. Read exchange() first.
 * SPDX-License-Identifier: MIT */
#include "base/atomic.h"
#include "base/regular_file.h"
#include "base/vec3.h"
#include "device/drivers.h"
#include "device/falcon/firmware.h"
#include "device/falcon/frame.h"
#include "device/falcon/kinematics.h"
#include "device/link.h"
#include "device/number.h"
#include "device/uri.h"

#include <stdio.h>
#include <stdlib.h>
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
#define EXCHANGE_MS 4      /* an answer takes about 0.3 ms, plus up to 1 ms of USB frame in each direction */
#define WRITE_MS    2

/* Answers arrive in order, one per frame, without a number. If this many are missing, the next ones are old: no force
 * may be computed from them, and nothing is sent until all have arrived, or until QUIET_NS pass without an answer. */
#define MOST_OWED 4
#define QUIET_NS  30000000

#define MOST_PACKETS 16 /* packets read at once; the rest waits for the next exchange */

typedef struct falcon {
    knurl_device base;
    knurl_falcon_bus bus;
    knurl_falcon_transport transport;
    char firmware[KNURL_URI_ROOM]; /* "": unknown */
    double gain;
    uint32_t is_gain_set; /* 1: by the URI or KNURL_FALCON_GAIN */
    uint32_t wants_guard;
    uint32_t motors_known;
    knurl_link link;
    /* of the I/O thread */
    knurl_falcon_decoder decoder;
    double position[3]; /* the last one; the search for the next starts here */
    double theta[3];
    uint32_t has_position;
    uint32_t owed;        /* frames without an answer */
    uint32_t is_behind;   /* 1: `owed` reached MOST_OWED */
    uint32_t is_pushing;  /* 1: the last frame had a force */
    uint64_t told_bad;    /* part of decoder.bad_bytes already counted */
    uint64_t unanswering; /* bad bytes not yet counted as an answer */
    uint32_t is_corrupt;  /* 1: already reported; so are the next two */
    uint32_t is_unhomed;
    uint32_t is_nowhere;
    int64_t heard_at;
    int64_t exchanged_at;
    uint64_t bad_bytes; /* atomic */
} falcon;

static falcon *of(knurl_device *device) {
    return (falcon *)(void *)device; /* first member */
}

static const falcon *look_at(const knurl_device *device) {
    return (const falcon *)(const void *)device;
}

static int is_zero(const double force[3]) {
    return !(vec3_dot(force, force) > 0.0);
}

/* Red: not homed. Green: ready. Blue: pushing. As in libnifalcon, every frame has the homing bit: without it a device
 * may lose its homing. */
static int send(falcon *f, const double force[3]) {
    uint8_t frame[KNURL_FALCON_FRAME_BYTES];
    int16_t motors[3] = {0, 0, 0};
    uint32_t light = KNURL_FALCON_RED;
    if (f->has_position) {
        double scaled[3];
        vec3_scale(f->gain, force, scaled);
        (void)knurl_falcon_motors(f->position, f->theta, scaled, motors);
        light = is_zero(force) ? KNURL_FALCON_GREEN : KNURL_FALCON_BLUE;
    }
    knurl_falcon_encode(motors, KNURL_FALCON_HOMING | light, frame);
    const int outcome = f->transport.write(f->transport.self, frame, sizeof frame, WRITE_MS);
    if (outcome == KNURL_FALCON_DONE) {
        f->is_pushing = motors[0] || motors[1] || motors[2];
        f->is_behind |= ++f->owed >= MOST_OWED;
    }
    return outcome;
}

/* Counts bytes that made no frame; sixteen of them replace one lost answer. */
static void count_bad(falcon *f, uint32_t frames) {
    const uint64_t bad = f->decoder.bad_bytes - f->told_bad;
    if (bad == 0) {
        f->is_corrupt = f->is_corrupt && frames == 0; /* a burst ends with the first clean answer */
        return;
    }
    if (!f->is_corrupt) {
        knurl_events_report(&f->base.events, KNURL_FAULT_CORRUPT, (double)bad);
    }
    f->is_corrupt = 1;
    f->told_bad = f->decoder.bad_bytes;
    f->unanswering += bad;
    for (; f->unanswering >= KNURL_FALCON_FRAME_BYTES; f->unanswering -= KNURL_FALCON_FRAME_BYTES) {
        f->owed -= f->owed > 0;
    }
    knurl_store_relaxed(&f->bad_bytes, knurl_load_relaxed(&f->bad_bytes) + bad);
}

/* Reads the next packet and adds its answers to *frames. Returns KNURL_FALCON_. */
static int take_in(falcon *f, uint32_t timeout_ms, uint32_t *frames) {
    uint8_t packet[KNURL_FALCON_PACKET];
    size_t size = 0;
    const int outcome = f->transport.read(f->transport.self, packet, &size, timeout_ms);
    if (outcome == KNURL_FALCON_DONE && size > KNURL_FALCON_STATUS) {
        const uint32_t found =
            knurl_falcon_decode(&f->decoder, packet + KNURL_FALCON_STATUS, size - KNURL_FALCON_STATUS);
        *frames += found;
        f->owed -= found < f->owed ? found : f->owed;
        f->heard_at = knurl_system_now_ns();
        count_bad(f, found);
    }
    return outcome;
}

/* Reads the packets that arrived since the last exchange, so that they are not taken for answers to the next frame. */
static int catch_up(falcon *f, uint32_t *frames) {
    int outcome = KNURL_FALCON_DONE;
    for (int i = 0; i < MOST_PACKETS && outcome == KNURL_FALCON_DONE; i++) {
        outcome = take_in(f, 0, frames);
    }
    return outcome;
}

/* Reads packets until every frame is answered or the deadline passes; adds the answers to *frames. KNURL_FALCON_. */
static int receive(falcon *f, int64_t deadline, uint32_t *frames) {
    while (f->owed > 0) {
        const int64_t left = deadline - knurl_system_now_ns();
        if (left <= 0) {
            return KNURL_FALCON_NOTHING;
        }
        const int outcome = take_in(f, (uint32_t)(left / 1000000) + 1, frames);
        if (outcome == KNURL_FALCON_GONE) {
            return outcome;
        }
    }
    return KNURL_FALCON_DONE;
}

/* Computes the position from the newest answer. Returns KNURL_LINK_. */
static int locate(falcon *f, knurl_device_sample *sample) {
    const knurl_falcon_state *state = &f->decoder.newest;
    double position[3];
    double theta[3];
    if (state->homed != KNURL_FALCON_ALL_HOMED) {
        if (!f->is_unhomed) {
            knurl_events_report(&f->base.events, KNURL_FAULT_UNCALIBRATED, 0.0);
        }
        f->is_unhomed = 1;
        f->has_position = 0;
        knurl_device_halt(&f->base); /* without it the motors get no force; later forces ramp up */
        return KNURL_LINK_NO_POSITION;
    }
    f->is_unhomed = 0;
    memcpy(position, f->position, sizeof position);
    for (int leg = 0; leg < 3; leg++) {
        theta[leg] = knurl_falcon_angle(state->counts[leg]);
    }
    if (!knurl_falcon_forward(theta, position)) { /* no hand can reach this */
        if (!f->is_nowhere) {
            knurl_events_report(&f->base.events, KNURL_FAULT_NOT_FINITE, 0.0);
        }
        f->is_nowhere = 1;
        return KNURL_LINK_NO_POSITION;
    }
    f->is_nowhere = 0;
    f->has_position = 1;
    vec3_copy(position, f->position);
    vec3_copy(theta, f->theta);
    vec3_copy(position, sample->position);
    sample->buttons = state->buttons;
    return KNURL_LINK_POSITION;
}

/* After a long silence the answers to the guard's frames may be among those to this driver's. */
static void mind_the_guard(falcon *f, int64_t now) {
    const int64_t silence = KNURL_GUARD_SILENCE_MS * (int64_t)1000000;
    if (f->link.guard && f->exchanged_at > 0 && now - f->exchanged_at >= silence) {
        f->is_behind = 1;
        f->owed = MOST_OWED;
        f->heard_at = now;
    }
    f->exchanged_at = now;
}

/* Sends a force and receives a position; copes with missing, late and extra answers. */
static int exchange(knurl_device *device, const double force[3], knurl_device_sample *sample) {
    falcon *f = of(device);
    uint32_t frames = 0;
    const int64_t begin = knurl_system_now_ns();
    const int was_held_up = (double)(begin - f->exchanged_at) > 1e9 * KNURL_LINK_PATIENCE;
    mind_the_guard(f, begin);
    int outcome = catch_up(f, &frames);
    if (was_held_up) { /* answers received meanwhile may be as old as that */
        frames = 0;
    }
    if (f->is_behind && begin - f->heard_at > QUIET_NS) { /* missing answers are lost */
        f->is_behind = 0;
        f->owed = 0;
    }
    if (outcome != KNURL_FALCON_GONE) {
        const int listen = f->is_behind && is_zero(force) && !f->is_pushing;
        outcome = listen ? KNURL_FALCON_DONE : send(f, force);
    }
    if (outcome == KNURL_FALCON_DONE) {
        outcome = receive(f, begin + EXCHANGE_MS * 1000000, &frames);
    }
    if (outcome == KNURL_FALCON_GONE) {
        return KNURL_LINK_LOST;
    }
    if (f->is_behind) {
        f->is_behind = f->owed > 0;
        return KNURL_LINK_NOTHING;
    }
    if (frames == 0) {
        return KNURL_LINK_NOTHING;
    }
    f->owed = 0; /* one arrived, and the time for the others is over */
    return locate(f, sample);
}

/* Starts the guard process if the URI requests it. */
static knurl_result start_guard(falcon *f) {
    static const int16_t none[3] = {0, 0, 0};
    knurl_guard_order order = {0, KNURL_FALCON_FRAME_BYTES, {0}};
    char why[256] = "its handle is not available";
    if (!f->wants_guard) {
        return KNURL_OK;
    }
    knurl_falcon_encode(none, KNURL_FALCON_HOMING | KNURL_FALCON_GREEN, order.bytes);
    const int shared = f->transport.share ? f->transport.share(f->transport.self, &order.endpoint) : -1;
    if (shared >= 0) {
        f->link.guard = knurl_guard_process_start(shared, &order, why, sizeof why);
    }
    return f->link.guard ? KNURL_OK : knurl_fail(KNURL_ERROR_UNSUPPORTED, "device 'falcon': guard: %s", why);
}

static void stop_guard(falcon *f) {
    knurl_guard_process_stop(f->link.guard);
    f->link.guard = NULL;
}

/* Opens and prepares the device and starts the thread; on failure closes all of it. */
static knurl_result connect(falcon *f) {
    knurl_falcon_transport transport = {0};
    knurl_result result = f->bus.open(f->bus.user, &transport);
    if (result) {
        return result;
    }
    result = knurl_falcon_prepare(&transport, f->firmware);
    if (!result) {
        f->transport = transport;
        memset(&f->decoder, 0, sizeof f->decoder);
        memset(f->position, 0, sizeof f->position);
        f->has_position = f->owed = f->is_behind = f->is_pushing = 0;
        f->told_bad = f->unanswering = 0;
        f->is_corrupt = f->is_unhomed = f->is_nowhere = 0;
        f->heard_at = knurl_system_now_ns();
        f->exchanged_at = 0;
        result = start_guard(f);
        result = result ? result : knurl_link_open(&f->link, &f->base, exchange, NATIVE_RATE);
    }
    if (result) {
        stop_guard(f);
        transport.close(transport.self);
        memset(&f->transport, 0, sizeof f->transport);
    }
    return result;
}

static void disconnect(falcon *f) {
    knurl_link_close(&f->link); /* its last frames carry no force */
    stop_guard(f);
    if (f->transport.self) {
        f->transport.close(f->transport.self);
        memset(&f->transport, 0, sizeof f->transport);
    }
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
    falcon *made = calloc(1, sizeof *made);
    if (!made) {
        return knurl_fail(KNURL_ERROR_MEMORY, "device 'falcon': could not get %lu bytes", (unsigned long)sizeof *made);
    }
    knurl_device_init(&made->base, &knurl_falcon_driver);
    made->base.max_force = MAX_FORCE;
    made->base.max_speed = KNURL_HAND_SPEED;
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
    const falcon *f = look_at(device);
    (void)snprintf(info->name, sizeof info->name, "Novint Falcon, gain %g%s", f->gain,
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
    info->max_damping = 20.0;     /* CHAI3D */
    info->native_rate = NATIVE_RATE;
}

static void falcon_status(const knurl_device *device, knurl_device_status *status) {
    const falcon *f = look_at(device);
    status->bad_bytes = knurl_load_relaxed(&f->bad_bytes);
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
    .get_status = falcon_status,
    .reopen = falcon_reopen,
};
