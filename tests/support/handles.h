/* Scenes and devices that end with their block, the last made first: SCOPED_SCENE *scene = empty_scene(1); and
 * information about devices and loops. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_HANDLES_H
#define KNURL_TEST_HANDLES_H

#include "support/suite.h"

#include <knurl/knurl.h>
#include <string.h>

static inline void scoped_scene(knurl_scene **scene) {
    knurl_scene_destroy(*scene);
}

static inline void scoped_device(knurl_device **device) {
    knurl_device_close(*device);
}

#define SCOPED_SCENE  __attribute__((cleanup(scoped_scene))) knurl_scene
#define SCOPED_DEVICE __attribute__((cleanup(scoped_device))) knurl_device

static inline knurl_device_info device_info(const knurl_device *device) {
    knurl_device_info info;
    knurl_device_info_init(&info, sizeof info);
    assert_int_equal(knurl_device_get_info(device, &info), KNURL_OK);
    return info;
}

/** The listing of the first device whose URI begins with `driver`. */
static inline knurl_device_listing listing_of(const char *driver) {
    static knurl_device_listing all[32];
    const uint32_t count = knurl_device_list(all, 32);
    for (uint32_t i = 0; i < count && i < 32; i++) {
        if (strncmp(all[i].uri, driver, strlen(driver)) == 0) {
            return all[i];
        }
    }
    fail_msg("no %s is listed", driver);
    return all[0];
}

static inline knurl_device_status device_status(const knurl_device *device) {
    knurl_device_status status;
    knurl_device_status_init(&status, sizeof status);
    assert_int_equal(knurl_device_get_status(device, &status), KNURL_OK);
    return status;
}

static inline knurl_loop_stats loop_stats(const knurl_loop *loop) {
    knurl_loop_stats stats;
    knurl_loop_stats_init(&stats, sizeof stats);
    assert_int_equal(knurl_loop_get_stats(loop, &stats), KNURL_OK);
    return stats;
}

/** A force callback that plays the force (N) at `user`, 3 numbers. */
static inline void push_force(uint64_t tick, const knurl_device_sample *sample, double force[3], void *user) {
    (void)tick;
    (void)sample;
    memcpy(force, user, 3 * sizeof *force);
}

/** Of a loop that plays `force` on a device; it is kept. */
static inline knurl_loop_desc push_desc(knurl_device *device, double force[3]) {
    knurl_loop_desc desc;
    knurl_loop_desc_init(&desc, sizeof desc);
    desc.device = device;
    desc.force_callback = push_force;
    desc.user = force;
    return desc;
}

static inline knurl_loop *start_push(const knurl_loop_desc *desc) {
    knurl_loop *loop = NULL;
    assert_int_equal(knurl_loop_create(desc, &loop), KNURL_OK);
    assert_int_equal(knurl_loop_start(loop), KNURL_OK);
    return loop;
}

#endif
