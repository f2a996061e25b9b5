/* The scratch device of dry cycles (loop/dry.c): its positions are set, its forces are discarded.
 * SPDX-License-Identifier: MIT */
#include "base/atomic.h"
#include "device/link.h"
#include "device/port.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

typedef struct dry {
    knurl_device base;
    double position[3];
    knurl_link link; /* without a thread; in use where the real device has one */
} dry;

static knurl_result read_position(knurl_device *device, knurl_device_sample *sample) {
    memcpy(sample->position, ((const dry *)(const void *)device)->position, sizeof sample->position);
    return KNURL_OK;
}

static knurl_result discard(knurl_device *device, const double force[3]) {
    (void)device;
    (void)force;
    return KNURL_OK;
}

static const knurl_driver dry_driver = {.uri = "dry", .read = read_position, .write = discard};

knurl_device *knurl_port_make_dry(const knurl_device *device) {
    dry *made = calloc(1, sizeof *made);
    if (!made) {
        return NULL;
    }
    knurl_device_init(&made->base, &dry_driver);
    made->base.max_force = device->max_force;
    made->base.max_speed = INFINITY; /* it was no jump when the real device read it */
    made->base.period = device->period;
    if (device->link) {
        made->base.link = &made->link;
        made->link.device = &made->base;
        knurl_mailbox_init(&made->link.positions);
        knurl_mailbox_init(&made->link.orders);
    }
    return &made->base;
}

void knurl_port_free_dry(knurl_device *scratch) {
    if (scratch) {
        knurl_device_free(scratch);
    }
}

/* What a read and a write use. */
static void fetch(const knurl_device *device) {
    knurl_fetch(device, 0, offsetof(knurl_device, motor_check));
    knurl_fetch(device, offsetof(knurl_device, use), sizeof *device);
    if (device->link) {
        const knurl_link *link = device->link; /* not the samples, which its thread writes */
        knurl_fetch(link, offsetof(knurl_link, stale), offsetof(knurl_link, orders));
        knurl_fetch(&link->forces[link->orders.back], 0, sizeof link->forces[0]);
        knurl_fetch(link, offsetof(knurl_link, is_silent), offsetof(knurl_link, durations));
    }
}

void knurl_port_begin_dry(knurl_device *scratch, const knurl_device *device, const double position[3]) {
    dry *d = (dry *)(void *)scratch;
    fetch(device);
    memcpy(d->position, position, sizeof d->position);
    if (d->base.link) {
        knurl_device_sample *sample = &d->link.samples[d->link.positions.back];
        memcpy(sample->position, position, sizeof sample->position);
        knurl_mailbox_post(&d->link.positions);
    }
}
