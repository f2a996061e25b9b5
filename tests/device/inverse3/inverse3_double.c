/* A simulated service, without sockets. SPDX-License-Identifier: MIT */
#include "device/inverse3/inverse3_double.h"

#include "base/system.h"
#include "device/driver.h"
#include "support/close.h"

#include <stdio.h>
#include <string.h>

#define QUEUE   512
#define LATE_NS 20000000

static struct {
    knurl_mutex mutex; /* over all of it */
    inverse3_sim sim;
    int fault;
    int is_ended;
    int connections;
    const char *said; /* instead of every answer */
    size_t said_size;
    const char *events[2];        /* to be told at the port of events, the first before the second; or null */
    knurl_inverse3_filter filter; /* of that port */
    uint64_t random;
    int64_t due[QUEUE]; /* ns: when answers come */
    uint32_t first, count;
    char newest[INVERSE3_SIM_ROOM];
    size_t newest_size;
    char given[INVERSE3_SIM_ROOM];
} d;

static double seconds(void) {
    return 1e-9 * (double)knurl_system_now_ns();
}

static void answer(int length) {
    if (d.fault == DOUBLE_MUTE || d.count == QUEUE) {
        return;
    }
    d.newest_size = (size_t)length;
    if (d.said) {
        memcpy(d.newest, d.said, d.said_size);
        d.newest_size = d.said_size;
    }
    if (d.fault == DOUBLE_SHORT) {
        d.newest_size -= 9;
    }
    for (size_t i = 0; i < d.newest_size && d.fault == DOUBLE_CORRUPT; i++) {
        d.newest[i] = (char)random_bits(&d.random);
    }
    d.due[(d.first + d.count++) % QUEUE] = knurl_system_now_ns() + (d.fault == DOUBLE_LATE ? LATE_NS : 100000);
}

static int channel_send(void *self, const char *text, size_t size) {
    char message[KNURL_INVERSE3_COMMAND + 1];
    (void)self;
    knurl_system_mutex_lock(&d.mutex);
    const int works = !d.is_ended;
    memcpy(message, text, size);
    message[size] = '\0';
    if (works) {
        answer(inverse3_sim_hear(&d.sim, seconds(), message, d.newest));
    }
    knurl_system_mutex_unlock(&d.mutex);
    return works;
}

/* Takes the answer that is due. The newest one replaces all that arrive at once. */
static int take(knurl_inverse3_message *message) {
    int came = 0;
    knurl_system_mutex_lock(&d.mutex);
    while (d.count > 0 && d.due[d.first] <= knurl_system_now_ns() && d.fault != DOUBLE_HANG) {
        d.first = (d.first + 1) % QUEUE;
        d.count--;
        came++;
    }
    if (came > 0) {
        memcpy(d.given, d.newest, d.newest_size);
        message->text = d.given;
        message->size = d.newest_size;
    }
    came = d.is_ended ? -1 : came;
    knurl_system_mutex_unlock(&d.mutex);
    return came;
}

static int channel_receive(void *self, int milliseconds, knurl_inverse3_message *message) {
    knurl_system_mutex_lock(&d.mutex);
    const int hangs = d.fault == DOUBLE_HANG && milliseconds > 0;
    knurl_system_mutex_unlock(&d.mutex);
    const int64_t blocks = hangs ? 20000000 : (int64_t)milliseconds * 1000000;
    const int64_t until = knurl_system_now_ns() + blocks;
    (void)self;
    int came = take(message);
    while (came == 0 && knurl_system_now_ns() < until) {
        knurl_system_sleep_until_ns(knurl_system_now_ns() + 100000);
        came = take(message);
    }
    return came;
}

static void channel_close(void *self) {
    (void)self;
    knurl_system_mutex_lock(&d.mutex);
    d.connections--;
    knurl_system_mutex_unlock(&d.mutex);
}

static int event_receive(void *self, int milliseconds, knurl_inverse3_message *message) {
    (void)self;
    (void)milliseconds;
    knurl_system_mutex_lock(&d.mutex);
    int came = 0;
    for (int i = 0; i < 2 && d.events[i]; i++) {
        if (d.filter.takes(d.filter.self, d.events[i], strlen(d.events[i]))) {
            came++;
            message->text = d.events[i];
            message->size = strlen(d.events[i]);
        }
    }
    d.events[0] = d.events[1] = NULL;
    knurl_system_mutex_unlock(&d.mutex);
    return came;
}

static int service_connect(void *user, int port, knurl_inverse3_filter filter, knurl_inverse3_channel *channel,
                           char *why, size_t why_size) {
    const int is_events = port == 10020;
    const knurl_inverse3_channel opened = {&d, channel_send, is_events ? event_receive : channel_receive,
                                           channel_close};
    (void)user;
    (void)snprintf(why, why_size, "conn fail: 111");
    knurl_system_mutex_lock(&d.mutex);
    const int works = !d.is_ended;
    if (works) {
        d.connections++;
        if (is_events) {
            d.filter = filter;
        } else {
            d.first = d.count = 0;
            answer(inverse3_sim_greet(&d.sim, seconds(), d.newest));
        }
        *channel = opened;
    }
    knurl_system_mutex_unlock(&d.mutex);
    return works;
}

const knurl_inverse3_service *inverse3_double_service(void) {
    static const knurl_inverse3_service service = {NULL, service_connect};
    return &service;
}

inverse3_sim *inverse3_double_sim(void) {
    return &d.sim;
}

inverse3_sim *inverse3_double_take(void) {
    knurl_system_mutex_lock(&d.mutex);
    return &d.sim;
}

void inverse3_double_give_back(void) {
    knurl_system_mutex_unlock(&d.mutex);
}

void inverse3_double_begin(void) {
    memset(&d, 0, sizeof d);
    knurl_system_mutex_init(&d.mutex);
    inverse3_sim_init(&d.sim, seconds(), 0);
    d.random = 88172645463325252u;
}

knurl_device *inverse3_double_open(const char *options) {
    knurl_device *device = NULL;
    inverse3_double_begin();
    if (knurl_inverse3_open(options, inverse3_double_service(), &device)) {
        return NULL;
    }
    knurl_device_register(device);
    return device;
}

void inverse3_double_say(const char *text, size_t size) {
    knurl_system_mutex_lock(&d.mutex);
    d.said = text;
    d.said_size = size;
    knurl_system_mutex_unlock(&d.mutex);
}

void inverse3_double_tell(const char *event) {
    knurl_system_mutex_lock(&d.mutex);
    d.events[d.events[0] != NULL] = event;
    knurl_system_mutex_unlock(&d.mutex);
}

int inverse3_double_connections(void) {
    return d.connections;
}

void inverse3_double_end_service(int is_ended) {
    knurl_system_mutex_lock(&d.mutex);
    d.is_ended = is_ended;
    knurl_system_mutex_unlock(&d.mutex);
}

static knurl_device *double_open(void) {
    return inverse3_double_open("");
}

static void double_inject(int fault) {
    knurl_system_mutex_lock(&d.mutex);
    d.fault = fault;
    d.sim.is_endless = fault == DOUBLE_NAN;
    d.sim.is_unhomed = fault == DOUBLE_UNHOMED;
    inverse3_sim_power(&d.sim, seconds(), fault != DOUBLE_OFF);
    if (fault == DOUBLE_JUMP) {
        d.sim.jump = 0.05;
    } else if (fault == DOUBLE_UNPLUG) {
        inverse3_sim_unplug(&d.sim, seconds());
    } else {
        d.sim.is_gone = 0;
    }
    knurl_system_mutex_unlock(&d.mutex);
}

static int64_t double_limp_since(void) {
    knurl_system_mutex_lock(&d.mutex);
    const double since = d.sim.limp_since;
    knurl_system_mutex_unlock(&d.mutex);
    return since < 0.0 ? 0 : (int64_t)(since * 1e9);
}

static void double_hold_grip(int is_held) {
    knurl_system_mutex_lock(&d.mutex);
    double_hold(&d.sim.plant, is_held);
    knurl_system_mutex_unlock(&d.mutex);
}

const device_double inverse3_double = {"inverse3",
                                       1u << DOUBLE_WELL | 1u << DOUBLE_UNPLUG | 1u << DOUBLE_MUTE | 1u << DOUBLE_HANG |
                                           1u << DOUBLE_LATE | 1u << DOUBLE_SHORT | 1u << DOUBLE_CORRUPT |
                                           1u << DOUBLE_NAN | 1u << DOUBLE_JUMP | 1u << DOUBLE_UNHOMED |
                                           1u << DOUBLE_OFF,
                                       double_open,
                                       double_inject,
                                       double_limp_since,
                                       knurl_device_close,
                                       NULL,
                                       20.0, /* while a call blocks, the force stays */
                                       double_hold_grip};
