/* A session that a test steps by hand: the same as a started one, without a thread and a clock.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_SESSION_RIG_H
#define KNURL_TEST_SESSION_RIG_H

#include "parts.h"

#include "support/scenes.h"
#include "support/wait.h"

#include "base/system.h"

/** Stiffness of a smooth plate, N/m. */
#define STIFFNESS 400.0

static inline void scoped_session(knurl_session **s) {
    knurl_session_destroy(*s);
}

/** One that ends with its block. */
#define SCOPED_SESSION __attribute__((cleanup(scoped_session))) knurl_session

static inline knurl_session *make_session(void) {
    knurl_session *s = NULL;
    assert_int_equal(knurl_session_create(&s), KNURL_OK);
    assert_non_null(s);
    return s;
}

static inline knurl_session_desc describe(const char *device, const char *stroke) {
    knurl_session_desc desc;
    knurl_session_desc_init(&desc, sizeof desc);
    desc.device = device;
    desc.stroke = stroke;
    return desc;
}

static inline void open_session(knurl_session *s, const knurl_session_desc *desc) {
    const knurl_result result = knurl_session_open(s, desc);
    if (result) {
        print_error("%s: %s\n", desc->device, knurl_error_message());
    }
    assert_int_equal(result, KNURL_OK);
}

static inline void open_with(knurl_session *s, const char *device, const char *stroke) {
    const knurl_session_desc desc = describe(device, stroke);
    open_session(s, &desc);
}

/** A smooth plate of 0.1 x 0.1 m, front towards +z, about (x, y, z). */
static inline knurl_surface_id add_plate(knurl_session *s, double x, double y, double z) {
    surface_parts parts = surface_plane();
    set_grating(&parts, KNURL_METHOD_DEFAULT, 0.0, 0.0, 0.0);
    parts.material.stiffness = STIFFNESS;
    parts.desc.name = "plate";
    parts.desc.position[0] = x;
    parts.desc.position[1] = y;
    parts.desc.position[2] = z;
    return add_surface(knurl_session_get_scene(s), &parts);
}

/** Like knurl_session_start(), but ticks by knurl_loop_step(). */
static inline void begin(knurl_session *s) {
    knurl_surface_id outside = 0;
    knurl_loop_desc desc;
    knurl_hip_desc hip;
    knurl_loop_desc_init(&desc, sizeof desc);
    knurl_hip_desc_init(&hip, sizeof hip);
    hip.workspace = &s->desc.workspace;
    desc.device = s->device;
    desc.scene = s->scene;
    desc.update_rate_hz = s->desc.update_rate_hz;
    desc.tick_callback = knurl_session_take;
    desc.user = s;
    desc.reconnect = s->desc.reconnect;
    (void)knurl_scene_commit(s->scene);
    assert_int_equal(knurl_scene_configure_hip(s->scene, 0, &hip), KNURL_OK);
    assert_int_equal(knurl_session_lay_stroke(s, &outside), KNURL_OK);
    assert_int_equal(knurl_loop_create(&desc, &s->loop), KNURL_OK);
    s->runs = 1;
}

static inline void begin_with(knurl_session *s, const char *device, const char *stroke) {
    open_with(s, device, stroke);
    begin(s);
}

static inline void step(knurl_session *s, uint64_t ticks) {
    assert_int_equal(knurl_loop_step(s->loop, ticks), KNURL_OK);
}

/** Holds the fake device's HIP at a position for some ticks, after a jump that no hand could make. */
static inline void hold(knurl_session *s, double x, double y, double z, uint64_t ticks) {
    const double row[4] = {0.0, x, y, z};
    assert_int_equal(knurl_fake_set_trace(s->device, row, 1), KNURL_OK);
    step(s, ticks);
}

/** Touches the surface around (x, y) at z = 0, from above, and stays 1 mm deep in it. */
static inline void press(knurl_session *s, double x, double y) {
    hold(s, x, y, 0.005, 2);
    hold(s, x, y, -0.001, 10);
}

static inline void lift(knurl_session *s) {
    hold(s, 0.0, 0.0, 0.02, 10);
}

/** The next event is this one. */
static inline void check_event(knurl_session *s, int32_t kind, knurl_surface_id surface) {
    knurl_session_event event;
    assert_int_equal(knurl_session_next_event(s, &event), 1);
    assert_int_equal(event.kind, kind);
    assert_true(event.surface == surface);
}

static inline void check_no_event(knurl_session *s) {
    knurl_session_event event = {-1, -1, -1.0, 7};
    assert_int_equal(knurl_session_next_event(s, &event), 0);
    assert_true(event.kind == -1 && event.surface == 7); /* untouched */
}

/** Waits until `condition` is true, with updates. */
#define CHECK_UNTIL(s, condition) WAIT_FOR((knurl_session_update(s), (condition)))

static inline knurl_session_state state_of(const knurl_session *s) {
    knurl_session_state state;
    memset(&state, 0xaa, sizeof state);
    knurl_session_get_state(s, &state);
    return state;
}

#endif
