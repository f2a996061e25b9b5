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
    rig *r = rig_of(device);
    if (r->reads_left == 0) {
        return KNURL_ERROR_DEVICE_LOST;
    }
    r->reads_left -= r->reads_left != UINT64_MAX;
    memset(sample, 0, sizeof *sample);
    sample->position[0] = 0.001 * (double)r->reads++;
    return KNURL_OK;
}

static inline knurl_result rig_write(knurl_device *device, const double force[3]) {
    rig *r = rig_of(device);
    if (r->writes_left == 0) {
        return KNURL_ERROR_DEVICE_LOST;
    }
    r->writes_left -= r->writes_left != UINT64_MAX;
    memcpy(r->written[r->writes % RIG_ROOM], force, sizeof r->written[0]);
    r->writes++;
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
    rig *r = rig_of(user);
    const int64_t late = r->sleeps < r->late_count ? r->late[r->sleeps] : 0;
    r->deadlines[r->sleeps++ % RIG_ROOM] = deadline;
    r->now = (deadline > r->now ? deadline : r->now) + late;
}

static inline void rig_force(uint64_t tick, const knurl_device_sample *sample, double force[3], void *user) {
    rig *r = rig_of(user);
    (void)sample;
    r->out_of_order += tick != r->calls;
    r->called_at[r->calls % RIG_ROOM] = r->now;
    r->now += r->busy;
    memcpy(force, r->force, sizeof r->force);
    if (r->calls++ == r->special_call) {
        r->special(r);
    }
}

/** Sets a rig up, once a test: 2 N motors, a force of 1 N along y, its own clock, no watchdog to need one. */
static inline void rig_init(rig *r) {
    memset(r, 0, sizeof *r);
    knurl_device_init(&r->device, &rig_driver);
    r->device.max_force = 2.0;
    r->reads_left = UINT64_MAX;
    r->writes_left = UINT64_MAX;
    r->special_call = UINT64_MAX;
    r->clock.now_ns = rig_now;
    r->clock.sleep_until_ns = rig_sleep;
    r->clock.user = r;
    r->now = INT64_C(123456789012345);
    r->force[1] = 1.0;
    knurl_loop_desc_init(&r->desc, sizeof r->desc);
    r->desc.device = &r->device;
    r->desc.force_callback = rig_force;
    r->desc.user = r;
    r->desc.clock = &r->clock;
}

static inline void rig_create(rig *r) {
    const knurl_result result = knurl_loop_create(&r->desc, &r->loop);
    if (result) {
        print_error("%s\n", knurl_error_message());
    }
    assert_int_equal(result, KNURL_OK);
}

/** Runs a thread to its end, which must come within 10 s. */
static inline void rig_run(rig *r) {
    assert_int_equal(knurl_loop_start(r->loop), KNURL_OK);
    assert_int_equal(knurl_loop_wait(r->loop, 10.0), 1);
}

static inline knurl_loop_stats rig_stats(const rig *r) {
    const knurl_loop_stats stats = loop_stats(r->loop);
    return stats;
}

/** After the end: zero force, after any last force. */
static inline void rig_check_halted(const rig *r) {
    assert_true(knurl_port_is_halted(&r->device));
}

static inline void rig_destroy(rig *r) {
    knurl_loop_destroy(r->loop);
    r->loop = NULL;
}

#endif
