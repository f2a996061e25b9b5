/* A device made of a caller's functions. SPDX-License-Identifier: MIT */
#include "base/base.h"
#include "base/rule.h"
#include "device/link.h"

#include <knurl/device_functions.h>

#include <stdlib.h>
#include <string.h>

typedef struct custom {
    knurl_device base;
    knurl_device_functions functions;
    knurl_link link; /* if the functions block */
    /* if they do not */
    knurl_device_sample latest;
    uint64_t without; /* reads without a position since `latest` */
    uint32_t has_latest;
} custom;

static custom *of(knurl_device *device) {
    return (custom *)(void *)device; /* first member */
}

/* Fails if reserved fields are not 0, so that later versions can use them. */
static knurl_result read_sample(custom *c, knurl_device_sample *sample) {
    memset(sample, 0, sizeof *sample);
    const knurl_result result = c->functions.read(c->functions.user, sample);
    for (size_t i = 0; !result && i < sizeof sample->reserved / sizeof *sample->reserved; i++) {
        if (sample->reserved[i] != 0) {
            knurl_events_report(&c->base.events, KNURL_FAULT_CORRUPT, (double)sizeof sample->reserved);
            return KNURL_ERROR_DEVICE_NOT_READY;
        }
    }
    return result;
}

static int exchange(knurl_device *device, const double force[3], knurl_device_sample *sample) {
    const knurl_device_functions *f = &of(device)->functions;
    knurl_result result = f->write(f->user, force);
    result = result ? result : read_sample(of(device), sample);
    return result == KNURL_OK                  ? KNURL_LINK_POSITION
           : result == KNURL_ERROR_DEVICE_LOST ? KNURL_LINK_LOST
                                               : KNURL_LINK_NOTHING;
}

static knurl_result open_link(custom *c) {
    knurl_device_info info;
    const knurl_result result = knurl_device_ask(&c->base, &info);
    return result ? result : knurl_link_open(&c->link, &c->base, exchange, info.native_rate);
}

static void custom_close(knurl_device *device) {
    static const double none[3] = {0.0, 0.0, 0.0};
    custom *c = of(device);
    if (c->functions.blocking) {
        knurl_link_close(&c->link);
    } else if (!device->lost) {
        (void)c->functions.write(c->functions.user, none);
    }
    if (c->functions.close) {
        c->functions.close(c->functions.user);
    }
    knurl_device_free(device);
}

static void custom_info(const knurl_device *device, knurl_device_info *info) {
    const knurl_device_functions *f = &((const custom *)(const void *)device)->functions;
    f->get_info(f->user, info);
    info->max_torque = info->max_grip = 0.0; /* `write` gets forces alone */
    info->native_rate = f->blocking && info->native_rate == 0.0 ? 1000.0 : info->native_rate;
}

static knurl_result custom_start(knurl_device *device, double update_rate_hz) {
    const knurl_device_functions *f = &of(device)->functions;
    return f->start ? f->start(f->user, update_rate_hz) : KNURL_OK;
}

/* If there is no new position, the last one stays valid for a while, as with an I/O thread. */
static knurl_result custom_read(knurl_device *device, knurl_device_sample *sample) {
    custom *c = of(device);
    const knurl_result result = read_sample(c, sample);
    if (result == KNURL_OK) {
        c->latest = *sample;
        c->has_latest = 1;
        c->base.check.gap += (double)c->without * c->base.period; /* repeated positions count as a gap */
        c->without = 0;
    }
    if (result == KNURL_OK || result == KNURL_ERROR_DEVICE_LOST) {
        return result;
    }
    const uint64_t patience = (uint64_t)(KNURL_LINK_PATIENCE / c->base.period + 0.5);
    if (++c->without == patience + 1) {
        knurl_events_report(&c->base.events, KNURL_FAULT_SILENT, (double)c->without * c->base.period);
    }
    *sample = c->latest;
    return c->has_latest && c->without <= patience ? KNURL_OK : KNURL_ERROR_DEVICE_NOT_READY;
}

static knurl_result custom_write(knurl_device *device, const double force[3]) {
    const knurl_device_functions *f = &of(device)->functions;
    return f->write(f->user, force);
}

static knurl_result custom_reopen(knurl_device *device) {
    custom *c = of(device);
    if (!c->functions.reopen) {
        return KNURL_ERROR_DEVICE_LOST;
    }
    if (c->functions.blocking) {
        knurl_link_close(&c->link); /* the thread has already ended */
    }
    const knurl_result result = c->functions.reopen(c->functions.user);
    c->has_latest = 0;
    c->without = 0;
    return result || !c->functions.blocking ? result : open_link(c);
}

static const knurl_driver custom_driver = {
    .uri = "custom",
    .close = custom_close,
    .get_info = custom_info,
    .start = custom_start,
    .read = custom_read,
    .write = custom_write,
    .reopen = custom_reopen,
};

void knurl_device_functions_init(knurl_device_functions *functions, uint32_t size) {
    const knurl_device_functions defaults = {0};
    knurl_desc_write(&defaults, sizeof defaults, functions, size);
}

static knurl_result check(const knurl_device_functions *f) {
    if (!f->get_info || !f->read || !f->write) {
        return knurl_fail(KNURL_ERROR_ARGUMENT,
                          "knurl_device_functions: expected get_info, read and write, found no %s",
                          !f->get_info ? "get_info"
                          : !f->read   ? "read"
                                       : "write");
    }
    return KNURL_OK;
}

knurl_result knurl_device_open_functions(const knurl_device_functions *functions, knurl_device **device) {
    KNURL_RULE(GAME, NULL);
    if (KNURL_IS_NULL(functions) || KNURL_IS_NULL(device)) {
        return KNURL_ERROR_ARGUMENT;
    }
    knurl_device_functions f;
    knurl_device_info info;
    knurl_device_functions_init(&f, sizeof f);
    knurl_result result = knurl_desc_read("knurl_device_functions", functions, &f, sizeof f);
    result = result ? result : check(&f);
    if (result) {
        return result;
    }
    custom *made = knurl_device_allocate(&custom_driver, sizeof *made);
    if (!made) {
        return KNURL_ERROR_MEMORY;
    }
    made->functions = f;
    result = knurl_device_ask(&made->base, &info);
    made->base.max_force = result ? 0.0 : info.max_force;
    if (!result && !f.motors_known) {
        knurl_motor_check_init(&made->base.motor_check, info.max_force);
    }
    result = result ? result : knurl_device_start(&made->base, 1000.0);
    result = result || !f.blocking ? result : open_link(made);
    if (result) {
        free(made);
        return result;
    }
    knurl_device_register(&made->base);
    *device = &made->base;
    return KNURL_OK;
}
