/* A loop on a test bench: a device that records its forces, a clock controlled by the test, a callback that returns one
 * force. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_RIG_H
#define KNURL_TEST_RIG_H

#include "support/close.h"

#include "device/driver.h"
#include "device/port.h"

#include <knurl/knurl.h>

/** Forces and deadlines that are kept. */
#define RIG_ROOM 8192

typedef struct rig {
    knurl_device device; /* first: the driver's functions get it */
    /* The device's forces, and the time of its loss. */
    double written[RIG_ROOM][3];
    uint64_t reads, writes, starts;
    double rate;          /* Hz, of the last start */
    uint64_t reads_left;  /* until it is lost; UINT64_MAX: never */
    uint64_t writes_left; /* likewise */
    /* The clock: sleeps end `late` ns after the deadline (0 beyond late_count), each force takes `busy` ns. */
    knurl_clock clock;
    int64_t now;
    int64_t deadlines[RIG_ROOM];
    uint64_t sleeps;
    const int64_t *late;
    uint64_t late_count;
    int64_t busy;
    /* The callback's. */
    double force[3];
    uint64_t calls;
    int64_t called_at[RIG_ROOM]; /* ns on the clock */
    uint64_t out_of_order;       /* calls whose tick was not their number */
    uint64_t special_call;       /* at this call `special` is called; UINT64_MAX: never */
    void (*special)(struct rig *rig);
    uint32_t seen; /* result of `special` */
    knurl_loop_desc desc;
    knurl_loop *loop;
} rig;

static inline rig *rig_of(void *device) {
    return device;
}

static inline void rig_close(knurl_device *device) {
    (void)device;
}

static inline void rig_get_info(const knurl_device *device, knurl_device_info *info) {
    info->max_force = device->max_force;
    info->continuous_force = 0.88; /* a Touch's */
    info->heat_time = 60.0;
}

static inline knurl_result rig_start_device(knurl_device *device, double rate) {
    rig_of(device)->starts++;
    rig_of(device)->rate = rate;
    return KNURL_OK;
}

static inline knurl_result rig_read(knurl_device *device, knurl_device_sample *sample) {
    rig *self = rig_of(device);
    if (self->reads_left == 0) {
        return KNURL_ERROR_DEVICE_LOST;
    }
    self->reads_left -= self->reads_left != UINT64_MAX;
    memset(sample, 0, sizeof *sample);
    sample->position[0] = 0.001 * (double)self->reads++;
    return KNURL_OK;
}

static inline knurl_result rig_write(knurl_device *device, const double force[3]) {
    rig *self = rig_of(device);
    if (self->writes_left == 0) {
        return KNURL_ERROR_DEVICE_LOST;
    }
    self->writes_left -= self->writes_left != UINT64_MAX;
    memcpy(self->written[self->writes % RIG_ROOM], force, sizeof self->written[0]);
    self->writes++;
    return KNURL_OK;
}

static const knurl_driver rig_driver = {
    .uri = "rig",
    .close = rig_close,
    .get_info = rig_get_info,
    .start = rig_start_device,
    .read = rig_read,
    .write = rig_write,
};

static inline int64_t rig_now(void *user) {
    return rig_of(user)->now;
}

static inline void rig_sleep(int64_t deadline, void *user) {
    rig *self = rig_of(user);
    const int64_t late = self->sleeps < self->late_count ? self->late[self->sleeps] : 0;
    self->deadlines[self->sleeps++ % RIG_ROOM] = deadline;
    self->now = (deadline > self->now ? deadline : self->now) + late;
}

static inline void rig_force(uint64_t tick, const knurl_device_sample *sample, double force[3], void *user) {
    rig *self = rig_of(user);
    (void)sample;
    self->out_of_order += tick != self->calls;
    self->called_at[self->calls % RIG_ROOM] = self->now;
    self->now += self->busy;
    memcpy(force, self->force, sizeof self->force);
    if (self->calls++ == self->special_call) {
        self->special(self);
    }
}

/** Sets a rig up, once a test: 2 N motors, a force of 1 N along y, its own clock, no watchdog to need one. */
static inline void rig_init(rig *self) {
    memset(self, 0, sizeof *self);
    knurl_device_init(&self->device, &rig_driver);
    self->device.max_force = 2.0;
    self->reads_left = UINT64_MAX;
    self->writes_left = UINT64_MAX;
    self->special_call = UINT64_MAX;
    self->clock.now_ns = rig_now;
    self->clock.sleep_until_ns = rig_sleep;
    self->clock.user = self;
    self->now = INT64_C(123456789012345);
    self->force[1] = 1.0;
    knurl_loop_desc_init(&self->desc, sizeof self->desc);
    self->desc.device = &self->device;
    self->desc.force_callback = rig_force;
    self->desc.user = self;
    self->desc.clock = &self->clock;
}

static inline void rig_create(rig *self) {
    const knurl_result result = knurl_loop_create(&self->desc, &self->loop);
    if (result) {
        print_error("%s\n", knurl_error_message());
    }
    assert_int_equal(result, KNURL_OK);
}

/** Runs a thread to its end, which must come within 10 s; it creates the loop if there is none. */
static inline void rig_run(rig *self) {
    if (!self->loop) {
        rig_create(self);
    }
    assert_int_equal(knurl_loop_start(self->loop), KNURL_OK);
    assert_int_equal(knurl_loop_wait(self->loop, 10.0), 1);
}

static inline knurl_loop_stats rig_stats(const rig *self) {
    const knurl_loop_stats stats = loop_stats(self->loop);
    return stats;
}

/** After the end: zero force, after any last force. */
static inline void rig_check_halted(const rig *self) {
    assert_true(knurl_port_is_halted(&self->device));
}

/** So many ticks; it creates the loop if there is none. */
static inline void rig_step(rig *self, uint64_t ticks) {
    if (!self->loop) {
        rig_create(self);
    }
    assert_int_equal(knurl_loop_step(self->loop, ticks), KNURL_OK);
}

/** Runs so many ticks: on its thread, to its end, or step by step. */
static inline void rig_go(rig *self, int threaded, uint64_t ticks) {
    if (threaded) {
        rig_run(self);
    } else {
        rig_step(self, ticks);
    }
}

static inline void rig_destroy(rig *self) {
    knurl_loop_destroy(self->loop);
    self->loop = NULL;
}

static rig r; /* 400 KiB; reset by begin_rig() */

static inline int begin_rig(void **state) {
    (void)state;
    rig_init(&r);
    return 0;
}

/** Also after a failed test: no thread may still use the rig that the next test resets. */
static inline int end_rig(void **state) {
    (void)state;
    rig_destroy(&r);
    return 0;
}

#endif
