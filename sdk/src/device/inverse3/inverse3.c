/* Haply's Inverse3, through its maker's service: an I/O thread sends a force and waits for the state in reply. Read
 * exchange() first. SPDX-License-Identifier: MIT */
#include "device/inverse3/service.h"

#include "base/atomic.h"
#include "base/format.h"
#include "base/number.h"
#include "base/system.h"
#include "device/driver.h"
#include "device/link.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define NATIVE_RATE 1000.0  /* Hz; the service allows more, up to 4000 */
#define EVENTS_PORT 10020   /* the same for its events */
#define ANSWER_NS   5000000 /* to wait for an answer in an exchange */

#define LOW_BATTERY 0.15 /* assumed: the service's threshold is not published */
#define RADIAN      0.017453292519943295

/* Consecutive states without the device after which it counts as lost: by then its force has been zero for a while,
 * because a device without a position counts as silent after 10 ms. */
#define LEFT_OUT_LIMIT 15u

typedef struct inverse3 {
    knurl_device base;
    knurl_link link;
    const knurl_inverse3_service *service;
    knurl_inverse3_channel channel;
    knurl_inverse3_channel events; /* self: null without a connection */
    int port;
    char id[KNURL_INVERSE3_ID_ROOM];   /* "": the first */
    char grip[KNURL_INVERSE3_ID_ROOM]; /* the handle's; "": the first */
    char gravity[2];                   /* its compensation: "1", "0"; "": as it is */
    const knurl_inverse3_model *model;
    double force_gate; /* as knurl_inverse3_entry */
    /* of the I/O thread */
    uint32_t unanswered; /* messages sent but not answered; each is answered once, in order */
    uint32_t left_out;   /* consecutive states without the device */
    uint32_t is_braked;  /* 1: by an event of its emergency brake */
    uint32_t is_empty;   /* 1: the handle's battery is almost empty, and was reported */
} inverse3;

static inverse3 *of(knurl_device *device) {
    return (inverse3 *)(void *)device; /* first member */
}

/* --- the exchange --- */

static void count_answers(inverse3 *d, int came) {
    const uint32_t count = came > 0 ? (uint32_t)came : 0;
    d->unanswered -= count < d->unanswered ? count : d->unanswered;
}

/* Waits for the answer to the last message: KNURL_LINK_POSITION. Answers to earlier messages are too old. */
static int await_answer(inverse3 *d, int64_t until, knurl_inverse3_message *message) {
    int came = 0;
    do {
        const int64_t left = until - knurl_system_now_ns();
        came = d->channel.receive(d->channel.self, left > 0 ? (int)((left + 999999) / 1000000) : 0, message);
        count_answers(d, came);
    } while (came >= 0 && d->unanswered > 0 && knurl_system_now_ns() < until);
    return came < 0 ? KNURL_LINK_LOST : d->unanswered == 0 ? KNURL_LINK_POSITION : KNURL_LINK_NOTHING;
}

static int report_corrupt(inverse3 *d, const knurl_inverse3_message *message) {
    if (!d->link.is_corrupt) {
        knurl_device_halt(&d->base);
    }
    knurl_link_count_bad(&d->link, &d->base, message->size);
    return KNURL_LINK_NOTHING;
}

/* KNURL_FAULT_ why it plays no forces, and the cause if it is KNURL_FAULT_FORCE_OFF; 0 if it plays them. */
static int32_t find_trouble(const inverse3 *d, const knurl_inverse3_entry *entry, int32_t *cause) {
    *cause = 0;
    if (entry->is_uncalibrated && !entry->is_unpowered) {
        return KNURL_FAULT_UNCALIBRATED;
    }
    *cause = entry->is_unpowered   ? KNURL_FORCE_OFF_POWER
             : d->is_braked        ? KNURL_FORCE_OFF_BRAKE
             : entry->is_not_ready ? KNURL_FORCE_OFF_NOT_READY
                                   : 0;
    return *cause ? KNURL_FAULT_FORCE_OFF : 0;
}

/* Takes the handle's state. */
static void take_grip(inverse3 *d, const knurl_inverse3_state *state, knurl_device_sample *sample) {
    knurl_inverse3_grip grip;
    knurl_inverse3_find_grip(state, d->grip, &grip);
    memcpy(sample->orientation, grip.orientation, sizeof sample->orientation);
    sample->buttons = grip.buttons;
    knurl_store_double(&d->base.battery, grip.battery);
    if (grip.battery > 0.0 && grip.battery < LOW_BATTERY && !d->is_empty) {
        d->is_empty = 1;
        knurl_events_report(&d->base.events, KNURL_FAULT_BATTERY, grip.battery);
    } else if (grip.battery > 2.0 * LOW_BATTERY) {
        d->is_empty = 0;
    }
}

/* Takes the device's state from an answer. */
static int take_state(inverse3 *d, const knurl_inverse3_message *message, knurl_device_sample *sample) {
    int32_t cause = 0;
    knurl_inverse3_state state;
    if (!knurl_inverse3_read(message->text, message->size, &state)) {
        return report_corrupt(d, message);
    }
    const knurl_inverse3_entry *entry = knurl_inverse3_find(&state, d->id);
    if (!entry) {
        return ++d->left_out < LEFT_OUT_LIMIT ? KNURL_LINK_NOTHING : KNURL_LINK_LOST;
    }
    d->left_out = 0;
    if (!entry->has_position) {
        return report_corrupt(d, message);
    }
    d->link.is_corrupt = 0;
    knurl_inverse3_to_knurl(entry->position, sample->position);
    sample->joint_count = 3;
    for (int i = 0; i < 3; i++) {
        sample->joints[i] = RADIAN * entry->joints[i];
    }
    take_grip(d, &state, sample);
    const int32_t trouble = find_trouble(d, entry, &cause);
    return knurl_link_take_trouble(&d->link, trouble, cause);
}

static int is_own_brake(const void *self, const char *text, size_t size) {
    const inverse3 *d = self;
    return knurl_inverse3_read_brake(text, size, d->id) >= 0;
}

/* Without an event, also after their server's end, the brake's state stays the one reported last. */
static void hear_events(inverse3 *d) {
    knurl_inverse3_message message = {NULL, 0};
    const int came = d->events.self ? d->events.receive(d->events.self, 0, &message) : 0;
    const int brake = came > 0 ? knurl_inverse3_read_brake(message.text, message.size, d->id) : -1;
    d->is_braked = brake >= 0 ? (uint32_t)brake : d->is_braked;
}

static int exchange(knurl_device *device, const double force[3], knurl_device_sample *sample) {
    inverse3 *d = of(device);
    knurl_inverse3_message message = {NULL, 0};
    char text[KNURL_INVERSE3_COMMAND];
    const int came = d->channel.receive(d->channel.self, 0, &message); /* late answers */
    if (came < 0) {
        return KNURL_LINK_LOST;
    }
    count_answers(d, came);
    hear_events(d);
    const int64_t until = knurl_system_now_ns() + ANSWER_NS;
    if (!d->channel.send(d->channel.self, text, knurl_inverse3_command(text, d->id, force, ""))) {
        return await_answer(d, until, &message) == KNURL_LINK_LOST ? KNURL_LINK_LOST : KNURL_LINK_NOTHING;
    }
    d->unanswered++;
    const int outcome = await_answer(d, until, &message);
    return outcome == KNURL_LINK_POSITION ? take_state(d, &message, sample) : outcome;
}

/* --- opening --- */

static void disconnect(inverse3 *d) {
    knurl_link_close(&d->link); /* its last exchanges carry no force */
    if (d->channel.self) {
        d->channel.close(d->channel.self);
        d->channel.self = NULL;
    }
    if (d->events.self) {
        d->events.close(d->events.self);
        d->events.self = NULL;
    }
}

static knurl_result choose(inverse3 *d, const knurl_inverse3_state *state) {
    const knurl_inverse3_entry *first = knurl_inverse3_find(state, "");
    const knurl_inverse3_entry *entry = knurl_inverse3_find(state, d->id);
    if (!first) {
        return knurl_fail(KNURL_ERROR_DEVICE_LOST,
                          "device 'inverse3': its service lists no Inverse3: " KNURL_INVERSE3_PLUG_IN);
    }
    if (!entry) {
        return knurl_fail(KNURL_ERROR_DEVICE_LOST,
                          "device 'inverse3': its service lists no Inverse3 '%s', only '%s': " KNURL_INVERSE3_PLUG_IN,
                          d->id, first->id);
    }
    if (!entry->has_preset) {
        return knurl_fail(KNURL_ERROR_UNSUPPORTED,
                          "device 'inverse3': expected the Haply Inverse Service 3.5 or newer, found one that lists "
                          "no preset of its devices; update it (the Haply Hub does)");
    }
    const knurl_inverse3_model *model = knurl_inverse3_find_model(entry);
    if (!model) {
        return knurl_fail(
            KNURL_ERROR_UNSUPPORTED,
            "device 'inverse3:%s': expected an inverse3, inverse3x or minverse, found '%s': its force limit is "
            "unknown to this version",
            entry->id, entry->type);
    }
    (void)snprintf(d->id, sizeof d->id, "%s", entry->id); /* a reopen must find the same device */
    if (d->base.max_force == 0.0) {                       /* once: other threads may read it later */
        d->model = model;
        d->force_gate = entry->force_gate;
        d->base.max_force = model->max_force;
    }
    return KNURL_OK;
}

/* Sets no force, positions from the middle of the workspace, no damping, and no profile: if one were set, the Hub would
 * set axes of its own. The service's other filters stay: its oscillation damper cannot be set, and the meaning of its
 * force gate's gain is not published. */
static knurl_result configure(inverse3 *d) {
    static const double none[3] = {0.0, 0.0, 0.0};
    char text[KNURL_INVERSE3_COMMAND];
    knurl_inverse3_message message = {NULL, 0};
    d->unanswered = 1;
    const char *configuration = knurl_inverse3_configuration(d->gravity);
    if (d->channel.send(d->channel.self, text, knurl_inverse3_command(text, d->id, none, configuration)) &&
        await_answer(d, knurl_system_now_ns() + KNURL_INVERSE3_HELLO_MS * INT64_C(1000000), &message) ==
            KNURL_LINK_POSITION) {
        return KNURL_OK;
    }
    return knurl_fail(KNURL_ERROR_DEVICE_LOST,
                      "device 'inverse3:%s': its service does not answer a command within %g s; start it again", d->id,
                      1e-3 * KNURL_INVERSE3_HELLO_MS);
}

static knurl_result connect(inverse3 *d) {
    knurl_inverse3_state state;
    char ignored[160];
    d->left_out = d->is_braked = 0;
    knurl_result result = knurl_inverse3_first(d->service, d->port, &d->channel, &state);
    result = result ? result : choose(d, &state);
    result = result ? result : configure(d);
    if (!result) { /* without it all else works */
        const knurl_inverse3_filter brakes = {is_own_brake, d};
        (void)d->service->connect(d->service->user, EVENTS_PORT, brakes, &d->events, ignored, sizeof ignored);
    }
    result = result ? result : knurl_link_open(&d->link, &d->base, exchange, NATIVE_RATE);
    if (result) {
        disconnect(d);
    }
    return result;
}

static knurl_result parse(const char *options, inverse3 *d) {
    char id[KNURL_URI_ROOM];
    char port[KNURL_URI_ROOM];
    char grip[KNURL_URI_ROOM];
    char gravity[KNURL_URI_ROOM];
    double number = KNURL_INVERSE3_PORT;
    uint32_t is_on;
    const knurl_uri_key keys[] = {{"port", port}, {"grip", grip}, {"gravity", gravity}};
    knurl_result result = knurl_uri_parse("inverse3", options, id, keys, sizeof keys / sizeof *keys);
    result = result ? result : knurl_uri_flag("inverse3", "gravity", gravity, &is_on);
    if (result) {
        return result;
    }
    if (port[0] && !(knurl_number(port, strlen(port), &number) && knurl_is_within(number, 1.0, 65535.0) &&
                     number == floor(number))) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "device 'inverse3': port: expected 1 to 65535, found '%.100s'", port);
    }
    if (strlen(id) >= sizeof d->id || strlen(grip) >= sizeof d->grip) {
        return knurl_fail(KNURL_ERROR_ARGUMENT,
                          "device 'inverse3': expected an id such as 049D, as the Haply Hub shows it, found '%.100s'",
                          strlen(id) >= sizeof d->id ? id : grip);
    }
    d->port = (int)number;
    memcpy(d->id, id, strlen(id) + 1);
    memcpy(d->grip, grip, strlen(grip) + 1);
    memcpy(d->gravity, gravity, strlen(gravity) + 1);
    return KNURL_OK;
}

knurl_result knurl_inverse3_open(const char *options, const knurl_inverse3_service *service, knurl_device **device) {
    inverse3 *made = knurl_device_allocate(&knurl_inverse3_driver, sizeof *made);
    if (!made) {
        return KNURL_ERROR_MEMORY;
    }
    made->service = service;
    knurl_result result = parse(options, made);
    result = result ? result : connect(made);
    return knurl_device_finish_open(&made->base, result, device);
}

/* --- the driver --- */

static knurl_result inverse3_open(const char *options, knurl_device **device) {
    char why[512];
    const knurl_inverse3_service *service = knurl_inverse3_websocket(why, sizeof why);
    return service ? knurl_inverse3_open(options, service, device)
                   : knurl_fail(KNURL_ERROR_UNSUPPORTED, "device 'inverse3': %s", why);
}

static knurl_result inverse3_reopen(knurl_device *device) {
    disconnect(of(device)); /* the thread has already ended */
    return connect(of(device));
}

static void inverse3_close(knurl_device *device) {
    disconnect(of(device));
    knurl_device_free(device);
}

static void inverse3_list(knurl_listings *listings) {
    char why[512];
    const knurl_inverse3_service *service = knurl_inverse3_websocket(why, sizeof why);
    if (service) {
        knurl_inverse3_list(service, listings);
    } else {
        knurl_listings_add(listings, "inverse3", KNURL_INVERSE3_NAME, "%s", why);
    }
}

static void inverse3_info(const knurl_device *device, knurl_device_info *info) {
    const inverse3 *d = (const inverse3 *)(const void *)device;
    (void)snprintf(info->name, sizeof info->name, "%s", d->model->name);
    if (d->force_gate != 0.0) {
        (void)knurl_format(info->name, sizeof info->name, "%s (force gate %g)", d->model->name, d->force_gate);
    }
    knurl_device_info_sphere(info, d->model->radius);
    info->resolution = 0.00001; /* data sheet of the Inverse3 */
    info->max_force = device->max_force;
    info->max_stiffness = d->model->max_stiffness;
    info->continuous_force = d->model->continuous_force;
    info->heat_time = 60.0; /* assumed */
    info->mass = 0.2;       /* assumed */
    info->viscous = 0.5;    /* assumed */
    info->coulomb = 0.3;    /* assumed */
    info->delay = 2.0;      /* assumed: the service's threads are in between */
    info->native_rate = NATIVE_RATE;
}

const knurl_driver knurl_inverse3_driver = {
    .uri = "inverse3",
    .keeps_heat = 1,
    .list = inverse3_list,
    .open = inverse3_open,
    .close = inverse3_close,
    .get_info = inverse3_info,
    .reopen = inverse3_reopen,
};
