/* A HIP held still in a wall by a device that only has a position and records its forces: the Touch's 3.3 N, 0.88 N
 * continuous, with a time constant of 60 s. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_LOOP_BENCH_H
#define KNURL_TEST_LOOP_BENCH_H

#include "support/scenes.h"

#include "base/vec3.h"
#include "device/driver.h"

#include <knurl/knurl.h>

#define BENCH_ROOM 4096

typedef struct bench {
    knurl_device device; /* first: the driver's functions get it */
    double position[3];
    double written[BENCH_ROOM][3];
    double told[BENCH_ROOM][3]; /* by the scene while the force of the same index was written */
    uint64_t writes;
    uint64_t writes_left; /* until the device is lost; UINT64_MAX: never */
    uint32_t watches_writes;
    knurl_tick_output seen; /* the recorder's last */
    knurl_clock clock;
    int64_t now;
    int64_t late;       /* ns: by so much */
    uint64_t late_for;  /* sleeps, from now on, the last of them is late */
    knurl_scene *scene; /* a wall of 400 N/m across y = 0, front up */
    knurl_loop_desc desc;
    knurl_loop *loop;
} bench;

static bench b; /* opened by a test, closed by end_bench() */

static inline bench *bench_of(void *device) {
    return device;
}

static inline void bench_close_device(knurl_device *device) {
    (void)device;
}

static inline void bench_info(const knurl_device *device, knurl_device_info *info) {
    info->max_force = device->max_force;
    info->continuous_force = 0.88;
    info->heat_time = 60.0;
    info->delay = 1.0;
    info->max_stiffness = 1020.0;
}

static inline knurl_result bench_read(knurl_device *device, knurl_device_sample *sample) {
    memset(sample, 0, sizeof *sample);
    memcpy(sample->position, bench_of(device)->position, sizeof sample->position);
    return KNURL_OK;
}

static inline knurl_result bench_write(knurl_device *device, const double force[3]) {
    bench *self = bench_of(device);
    if (self->writes_left == 0) {
        return KNURL_ERROR_DEVICE_LOST;
    }
    self->writes_left -= self->writes_left != UINT64_MAX;
    if (self->watches_writes) {
        knurl_tick_output now;
        assert_int_equal(knurl_scene_get_tick(self->scene, 0, &now, NULL), KNURL_OK);
        memcpy(self->told[self->writes % BENCH_ROOM], now.device_force, sizeof now.device_force);
    }
    memcpy(self->written[self->writes++ % BENCH_ROOM], force, sizeof self->written[0]);
    return KNURL_OK;
}

static const knurl_driver bench_driver = {
    .uri = "bench", .close = bench_close_device, .get_info = bench_info, .read = bench_read, .write = bench_write};

static inline void bench_record(const knurl_tick_output *output, void *user) {
    bench_of(user)->seen = *output;
}

static inline int64_t bench_now(void *user) {
    return bench_of(user)->now;
}

static inline void bench_sleep(int64_t deadline_ns, void *user) {
    bench *self = bench_of(user);
    self->now = deadline_ns + (self->late_for == 1 ? self->late : 0);
    self->late_for -= self->late_for > 0;
}

/** A wall and a HIP `depth` (m) below its surface; a loop's description to change before bench_create(). */
static inline void bench_open(double depth) {
    knurl_workspace workspace;
    knurl_hip_desc hip;
    surface_parts wall = surface_plane();
    memset(&b, 0, sizeof b);
    knurl_device_init(&b.device, &bench_driver);
    b.device.max_force = 3.3;
    b.writes_left = UINT64_MAX;
    b.position[1] = -depth;
    b.now = INT64_C(1000000000);
    b.clock.now_ns = bench_now;
    b.clock.sleep_until_ns = bench_sleep;
    b.clock.user = &b;
    wall.desc.normal[1] = 1.0;
    b.scene = empty_scene(1);
    (void)add_surface(b.scene, &wall);
    knurl_workspace_set_identity(&workspace);
    knurl_hip_desc_init(&hip, sizeof hip);
    hip.workspace = &workspace;
    assert_int_equal(knurl_scene_configure_hip(b.scene, 0, &hip), KNURL_OK);
    assert_int_equal(knurl_scene_commit(b.scene), KNURL_OK);
    knurl_loop_desc_init(&b.desc, sizeof b.desc);
    b.desc.device = &b.device;
    b.desc.scene = b.scene;
    b.desc.tick_callback = bench_record;
    b.desc.user = &b;
    b.desc.clock = &b.clock;
}

static inline void bench_create(void) {
    assert_int_equal(knurl_loop_create(&b.desc, &b.loop), KNURL_OK);
}

/** A loop of a callback's forces, without the scene. */
static inline void bench_create_callback(knurl_force_callback callback, void *user) {
    b.desc.scene = NULL;
    b.desc.tick_callback = NULL;
    b.desc.force_callback = callback;
    b.desc.user = user;
    bench_create();
}

static inline void bench_end_loop(void) {
    knurl_loop_destroy(b.loop);
    b.loop = NULL;
}

static inline void bench_close(void) {
    bench_end_loop();
    knurl_scene_destroy(b.scene);
    b.scene = NULL;
}

static inline int end_bench(void **state) {
    (void)state;
    bench_close();
    return 0;
}

/** So many ticks; it creates the loop if there is none. */
static inline void step(uint64_t ticks) {
    if (!b.loop) {
        bench_create();
    }
    assert_int_equal(knurl_loop_step(b.loop, ticks), KNURL_OK);
}

static inline knurl_tick_output bench_tick(void) {
    knurl_tick_output now;
    assert_int_equal(knurl_scene_get_tick(b.scene, 0, &now, NULL), KNURL_OK);
    return now;
}

static inline knurl_hip_counts bench_counts(void) {
    knurl_hip_counts counts;
    assert_int_equal(knurl_scene_get_tick(b.scene, 0, NULL, &counts), KNURL_OK);
    return counts;
}

/** The force that was written `back` writes before the last one. */
static inline const double *written(uint64_t back) {
    return b.written[(b.writes - 1 - back) % BENCH_ROOM];
}

/** N: the length of the last one. */
static inline double written_now(void) {
    return vec3_length(written(0));
}

#endif
