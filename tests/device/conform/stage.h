/* A device whose hand is moved by the test, and a judge at its write(): a Touch's limits, a plane to press into, a
 * lid to squeeze with. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_STAGE_H
#define KNURL_TEST_STAGE_H

#include "judge.h"

#include "support/scenes.h"

#define STAGE_FORCE 3.3 /* N: the device's greatest */

typedef struct stage {
    judge j;
    double position[3]; /* m: of the hand */
    double latest[3];   /* N: written last */
    uint32_t flags;     /* of the last tick */
    uint32_t blocking;
    knurl_device *device;
    knurl_scene *scene;
    knurl_loop *loop;
    knurl_surface_id lid;
} stage;

static inline void stage_info(void *user, knurl_device_info *info) {
    (void)user;
    info->max_force = STAGE_FORCE;
}

static inline knurl_result stage_read(void *user, knurl_device_sample *sample) {
    memcpy(sample->position, ((stage *)user)->position, sizeof sample->position);
    return KNURL_OK;
}

static inline knurl_result stage_write(void *user, const double force[3]) {
    stage *s = user;
    memcpy(s->latest, force, sizeof s->latest);
    if (!s->blocking) {
        judge_write(&s->j, force);
    }
    return KNURL_OK;
}

static inline void stage_tick(const knurl_tick_output *output, void *user) {
    stage *s = user;
    knurl_hip_contact contacts[KNURL_CONTACTS_MAX];
    s->flags = output->flags;
    if (!s->blocking) {
        judge_tick(&s->j, output, contacts, knurl_scene_get_contacts(s->scene, 0, contacts, KNURL_CONTACTS_MAX));
    }
}

static inline knurl_surface_id stage_add(stage *s, double stiffness, double z, int upside_down) {
    surface_parts parts = surface_plane();
    parts.material.stiffness = stiffness;
    parts.desc.position[2] = z;
    parts.desc.rotation[0] = upside_down ? 1.0 : 0.0;
    parts.desc.rotation[3] = upside_down ? 0.0 : 1.0;
    const knurl_surface_id id = add_surface(s->scene, &parts);
    judge_surface_is(&s->j, id, &parts.material);
    return id;
}

/* A loop on a plane at z = 0 (`stiffness` N/m, front up; 0: no surface) and, if `lid_z` is above 0, a lid over it.
 */
static inline void stage_open(stage *s, double stiffness, double lid_z, double ramp_s, uint32_t blocking,
                              double heartbeat_s) {
    knurl_device_functions f;
    knurl_loop_desc loop;
    knurl_workspace workspace;
    knurl_hip_desc hip;
    memset(s, 0, sizeof *s);
    s->blocking = blocking;
    knurl_device_functions_init(&f, sizeof f);
    f.user = s;
    f.blocking = blocking;
    f.get_info = stage_info;
    f.read = stage_read;
    f.write = stage_write;
    f.motors_known = 1;
    assert_int_equal(knurl_device_open_functions(&f, &s->device), KNURL_OK);
    const knurl_device_info info = device_info(s->device);
    s->j.sees_writes = 1;
    judge_begin(&s->j, &info, 1000.0, ramp_s, 0.0);
    s->scene = empty_scene(1);
    if (stiffness > 0.0) {
        (void)stage_add(s, stiffness, 0.0, 0);
    }
    if (lid_z > 0.0) {
        s->lid = stage_add(s, stiffness, lid_z, 1);
    }
    knurl_workspace_set_identity(&workspace);
    knurl_hip_desc_init(&hip, sizeof hip);
    hip.workspace = &workspace;
    assert_int_equal(knurl_scene_configure_hip(s->scene, 0, &hip), KNURL_OK);
    assert_int_equal(knurl_scene_commit(s->scene), KNURL_OK);
    knurl_loop_desc_init(&loop, sizeof loop);
    loop.device = s->device;
    loop.scene = s->scene;
    loop.tick_callback = stage_tick;
    loop.user = s;
    loop.ramp_s = ramp_s;
    loop.heartbeat_s = heartbeat_s;
    assert_int_equal(knurl_loop_create(&loop, &s->loop), KNURL_OK);
}

static inline void stage_step(stage *s, uint64_t ticks) {
    assert_int_equal(knurl_loop_step(s->loop, ticks), KNURL_OK);
}

static inline double stage_length(const stage *s) {
    const double *f = s->latest;
    return sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
}

static inline void stage_close(stage *s) {
    s->j.ending = 1;
    knurl_loop_destroy(s->loop);
    knurl_device_close(s->device);
    knurl_scene_destroy(s->scene);
}

/* 0 after printing the broken promises. */
static inline int stage_held(const stage *s, const char *what) {
    int held = 1;
    for (int i = 0; i < JUDGE_COUNT; i++) {
        if (s->j.breaches[i].count > 0) {
            print_error("%s: broken %d times, by up to %.3g: %s\n", what, (int)s->j.breaches[i].count,
                        s->j.breaches[i].worst, judge_promises[i].sentence);
            held = 0;
        }
    }
    return held;
}

#endif
