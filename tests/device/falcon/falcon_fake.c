/* A simulated Falcon in place of the driver's transport. SPDX-License-Identifier: MIT */
#include "falcon_fake.h"

#include "device/driver.h"

#include <string.h>

#define STATUS_NS 1000000 /* the chip's latency timer: so often it sends a packet without data */
#define NAP_NS    50000
#define LATE_NS   20000000

static uint32_t random_below(falcon_fake *fake, uint32_t end) {
    fake->random ^= fake->random << 13;
    fake->random ^= fake->random >> 7;
    fake->random ^= fake->random << 17;
    return (uint32_t)(fake->random >> 33) % end;
}

static int fake_control(void *self, uint8_t request, uint16_t value) {
    falcon_fake *fake = self;
    knurl_system_mutex_lock(&fake->lock);
    const int outcome = fake->is_gone                                        ? KNURL_FALCON_GONE
                        : falcon_sim_control(&fake->sim, request, value) < 0 ? KNURL_FALCON_NOTHING
                                                                             : KNURL_FALCON_DONE;
    if (request == 0 && value == 1) {
        fake->held = 0;
    }
    knurl_system_mutex_unlock(&fake->lock);
    return outcome;
}

/* Sends the device's answer, altered by the fault. */
static void dispatch(falcon_fake *fake) {
    falcon_sim *sim = &fake->sim;
    if (fake->fault == DOUBLE_MUTE || fake->held == FALCON_FAKE_QUEUE) {
        sim->said_count = 0;
    }
    while (sim->said_count > 0 && fake->held < FALCON_FAKE_QUEUE) {
        uint8_t packet[64];
        const uint32_t at = (fake->first + fake->held++) % FALCON_FAKE_QUEUE;
        size_t count = falcon_sim_in(sim, packet, sizeof packet) - 2;
        if (fake->fault == DOUBLE_SHORT) {
            count = count > 7 ? count - 7 : count;
        }
        for (int i = 0; i < 4 && fake->fault == DOUBLE_CORRUPT; i++) {
            packet[2 + random_below(fake, (uint32_t)count)] = (uint8_t)random_below(fake, 256);
            packet[3] |= 0x80; /* never by chance a whole frame with another position */
        }
        memcpy(fake->queue[at].bytes, packet + 2, count);
        fake->queue[at].count = count;
        fake->queue[at].taken = 0;
        fake->queue[at].due = knurl_system_now_ns() + (fake->fault == DOUBLE_LATE ? LATE_NS : fake->late_ns);
    }
}

/* Records the start of the motors' zero force. */
static void note_motors(falcon_fake *fake) {
    const int16_t *m = fake->sim.motors;
    const int is_limp = !m[0] && !m[1] && !m[2];
    fake->limp_at = !is_limp ? 0 : fake->limp_at ? fake->limp_at : knurl_system_now_ns();
}

static int fake_write(void *self, const uint8_t *bytes, size_t count, uint32_t timeout_ms) {
    falcon_fake *fake = self;
    (void)timeout_ms;
    knurl_system_mutex_lock(&fake->lock);
    const int is_gone = fake->is_gone;
    if (!is_gone) {
        falcon_sim_out(&fake->sim, bytes, count);
        note_motors(fake);
        dispatch(fake);
    }
    knurl_system_mutex_unlock(&fake->lock);
    return is_gone ? KNURL_FALCON_GONE : KNURL_FALCON_DONE;
}

/* 1: a packet's data was there. */
static int fetch(falcon_fake *fake, uint8_t *packet, size_t *count) {
    if (fake->held == 0 || fake->queue[fake->first].due > knurl_system_now_ns()) {
        return 0;
    }
    const size_t left = fake->queue[fake->first].count - fake->queue[fake->first].taken;
    const size_t size = fake->fault == DOUBLE_SPLIT && left > 5 ? 5 : left;
    packet[0] = 0x01;
    packet[1] = 0x60;
    memcpy(packet + 2, fake->queue[fake->first].bytes + fake->queue[fake->first].taken, size);
    fake->queue[fake->first].taken += size;
    *count = size + 2;
    if (size == left) {
        fake->first = (fake->first + 1) % FALCON_FAKE_QUEUE;
        fake->held--;
    }
    return 1;
}

static int fake_read(void *self, uint8_t packet[KNURL_FALCON_PACKET], size_t *count, uint32_t timeout_ms) {
    falcon_fake *fake = self;
    const int64_t begin = knurl_system_now_ns();
    for (;;) {
        knurl_system_mutex_lock(&fake->lock);
        const int is_gone = fake->is_gone;
        const int hangs = fake->fault == DOUBLE_HANG;
        const int found = !is_gone && !hangs && fetch(fake, packet, count);
        const int64_t stall_until = fake->stall_until;
        knurl_system_mutex_unlock(&fake->lock);
        const int64_t now = knurl_system_now_ns();
        if (is_gone || found) {
            return is_gone ? KNURL_FALCON_GONE : KNURL_FALCON_DONE;
        }
        if (now - begin >= (int64_t)timeout_ms * 1000000) {
            return KNURL_FALCON_NOTHING;
        }
        if (!hangs && now - begin >= STATUS_NS) {
            *count = 2;
            knurl_system_sleep_until_ns(stall_until);
            return KNURL_FALCON_DONE;
        }
        knurl_system_sleep_until_ns(now + NAP_NS);
    }
}

static void fake_close(void *self) {
    falcon_fake *fake = self;
    knurl_system_mutex_lock(&fake->lock);
    fake->closes++;
    knurl_system_mutex_unlock(&fake->lock);
}

static knurl_result fake_open(void *user, knurl_falcon_transport *transport) {
    falcon_fake *fake = user;
    const knurl_falcon_transport made = {fake, fake_control, fake_write, fake_read, fake_close, NULL};
    knurl_system_mutex_lock(&fake->lock);
    const int is_there = fake->fault != DOUBLE_UNPLUG;
    if (is_there && !fake->denied) {
        fake->is_gone = 0;
        fake->held = 0;
        fake->opens++;
    }
    const int denied = fake->denied;
    knurl_system_mutex_unlock(&fake->lock);
    if (!is_there || denied) {
        return knurl_fail(denied ? KNURL_ERROR_SYSTEM : KNURL_ERROR_DEVICE_LOST, "simulated: %s",
                          denied ? "not permitted" : "none is there");
    }
    *transport = made;
    return KNURL_OK;
}

static void fake_list(void *user, knurl_listings *listings) {
    (void)user;
    knurl_listings_add(listings, "falcon", "a simulated Falcon", "%s", "");
}

void falcon_fake_init(falcon_fake *fake, const knurl_stroke_desc *stroke) {
    memset(fake, 0, sizeof *fake);
    knurl_system_mutex_init(&fake->lock);
    falcon_sim_init(&fake->sim, stroke);
    fake->random = 0x9e3779b97f4a7c15u;
    fake->limp_at = knurl_system_now_ns();
}

void falcon_fake_free(falcon_fake *fake) {
    knurl_system_mutex_destroy(&fake->lock);
}

knurl_falcon_bus falcon_fake_bus(falcon_fake *fake) {
    const knurl_falcon_bus bus = {fake_list, fake_open, fake};
    return bus;
}

void falcon_fake_inject(falcon_fake *fake, int fault) {
    knurl_system_mutex_lock(&fake->lock);
    falcon_sim *sim = &fake->sim;
    fake->fault = fault;
    sim->homed = fault == DOUBLE_UNHOMED ? 0 : 7;
    memset(sim->jump, 0, sizeof sim->jump);
    if (fault == DOUBLE_JUMP) {
        sim->jump[0] = sim->plant.position[0] > 0.0 ? -0.05 : 0.05;
    }
    if (fault == DOUBLE_UNPLUG) { /* without a host its motors rest: assumed */
        fake->is_gone = 1;
        fake->held = sim->said_count = sim->heard_count = 0;
        memset(sim->motors, 0, sizeof sim->motors);
        note_motors(fake);
    }
    knurl_system_mutex_unlock(&fake->lock);
}

falcon_sim falcon_fake_look(falcon_fake *fake) {
    knurl_system_mutex_lock(&fake->lock);
    const falcon_sim copy = fake->sim;
    knurl_system_mutex_unlock(&fake->lock);
    return copy;
}
