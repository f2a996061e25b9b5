/* A rig (support/rig.h) whose device can be lost, found again, absent for a while or moving. SPDX-License-Identifier:
 * MIT */
#ifndef KNURL_TEST_FAULT_RIG_H
#define KNURL_TEST_FAULT_RIG_H

#include "home.h"
#include "support/rig.h"
#include "support/scenes.h"

/* Additional behaviour of this rig's device. */
static struct {
    uint64_t reopens;        /* atomic: tries */
    uint64_t fails;          /* tries that fail */
    int64_t tried_at[64];    /* ns, of each */
    uint64_t not_ready_from; /* reads from here to there bring nothing */
    uint64_t not_ready_to;
    double speed; /* m/s along x by the rig's clock; 0: as in every rig */
    int64_t start;
} extra;

static knurl_result extra_read(knurl_device *device, knurl_device_sample *sample) {
    rig *self = rig_of(device);
    const knurl_result result = rig_read(device, sample);
    if (result == KNURL_OK && extra.speed > 0.0) {
        sample->position[0] = extra.speed * 1e-9 * (double)(self->now - extra.start);
    }
    return result == KNURL_OK && self->reads > extra.not_ready_from && self->reads <= extra.not_ready_to
               ? KNURL_ERROR_DEVICE_NOT_READY
               : result;
}

static knurl_result extra_reopen(knurl_device *device) {
    rig *self = rig_of(device);
    extra.tried_at[extra.reopens % COUNT_OF(extra.tried_at)] = now_ns();
    knurl_count_up(&extra.reopens);
    if (extra.reopens <= extra.fails) {
        return KNURL_ERROR_DEVICE_LOST;
    }
    self->reads_left = self->writes_left = UINT64_MAX;
    return KNURL_OK;
}

static knurl_driver extra_driver;

static void init(void) {
    memset(&extra, 0, sizeof extra);
    rig_init(&r);
    extra_driver = rig_driver;
    extra_driver.read = extra_read;
    extra_driver.reopen = extra_reopen;
    knurl_device_init(&r.device, &extra_driver);
    extra.start = r.now;
}

static int begin(void **state) {
    (void)state;
    init();
    return 0;
}

static void init_real(void) {
    init();
    r.desc.clock = NULL;
    r.desc.watchdog_s = 0.0;
    r.desc.reconnect = 1;
}

static inline void wait_for_ticks(uint64_t ticks) {
    WAIT_FOR(rig_stats(&r).ticks >= ticks);
}

/* The codes of all events so far; 0: none. Overruns depend on the machine. */
#define CHECK_EVENTS(...) CHECK_CODES(&r.device, KNURL_FAULT_OVERRUN, __VA_ARGS__)

/* Checks the ramp from the write after a halt on: zero, then one step more each. */
static void check_ramp_up(uint64_t from) {
    for (uint64_t k = 0; k < 30; k++) {
        CHECK_CLOSE(r.written[from + k][1], fmin(1.0, (double)k / 21.0), 1e-12);
    }
}

#endif
