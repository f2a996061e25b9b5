/* The passivity controller stays out of strokes that turn, on gratings that rest and on gratings that are moved under
 * the hand: the same forces to the bit. SPDX-License-Identifier: MIT */
#include "support/close.h"

#include <knurl/knurl.h>

#include <stdlib.h>

#define TICKS 3000

/* A stroke over a stiff grating, on a device in a hand. */
typedef struct stroke_case {
    const char *device;
    int32_t method;
    double stiffness; /* N/m: above the passive stiffness, so that the controller is active */
    double speed;     /* m/s, to and fro over 20 mm */
    int moves;        /* 1: a game shakes the surface, 2 mm along its ridges' direction and 0.5 mm up, at 2 Hz */
} stroke_case;

static knurl_scene *make_scene(const stroke_case *c, const knurl_device *device, uint32_t without,
                               knurl_surface_id *surface) {
    knurl_scene *scene = NULL;
    knurl_plane_desc plane;
    knurl_surface_desc desc;
    knurl_material_desc material;
    knurl_hip_desc hip;
    knurl_workspace workspace;
    const knurl_device_info info = device_info(device);
    knurl_plane_desc_init(&plane, sizeof plane);
    knurl_surface_desc_init(&desc, sizeof desc);
    knurl_material_desc_init(&material, sizeof material);
    knurl_hip_desc_init(&hip, sizeof hip);
    knurl_workspace_set_identity(&workspace);
    plane.half_extents[0] = plane.half_extents[1] = 0.05;
    material.method = c->method;
    material.stiffness = c->stiffness;
    material.spatial_frequency[0] = 500.0;
    material.amplitude = 0.0002;
    desc.plane = &plane;
    desc.material = &material;
    desc.normal[1] = 1.0;
    hip.workspace = &workspace; /* and the settings from a loop */
    hip.resolution = info.resolution;
    hip.max_force = info.max_force;
    hip.continuous_force = info.continuous_force;
    hip.heat_time = info.heat_time;
    hip.viscous = info.viscous;
    hip.delay = info.delay;
    hip.max_stiffness = info.max_stiffness;
    hip.protections = KNURL_PROTECT_ALL & ~without;
    assert_int_equal(knurl_scene_create(NULL, &scene), KNURL_OK);
    assert_int_equal(knurl_scene_configure_hip(scene, 0, &hip), KNURL_OK);
    assert_int_equal(knurl_scene_add_surface(scene, &desc, surface), KNURL_OK);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    return scene;
}

/* The forces of a stroke. Returns the ticks with contact. */
static int stroke(const stroke_case *c, uint32_t without, double (*forces)[3]) {
    static const double turned[4] = {-0.70710678118654752, 0.0, 0.0, 0.70710678118654752};
    knurl_surface_id surface;
    knurl_device *device = NULL;
    knurl_stroke_desc hand;
    int touching = 0;
    knurl_stroke_desc_init(&hand, sizeof hand);
    hand.speed = c->speed;
    hand.reach[0] = 0.01;
    hand.depth = 0.002;
    assert_int_equal(knurl_device_open(c->device, &device), KNURL_OK);
    knurl_scene *scene = make_scene(c, device, without, &surface);
    assert_int_equal(knurl_fake_set_stroke(device, &hand), KNURL_OK);
    assert_int_equal(knurl_device_start(device, 1000.0), KNURL_OK);
    for (int k = 0; k < TICKS; k++) {
        knurl_device_sample sample;
        knurl_tick_input input;
        knurl_tick_output out;
        if (c->moves && k % 16 == 0) {
            const double turn = 12.566370614359172 * 0.001 * (k + 16);
            const double position[3] = {0.002 * sin(turn), 0.0005 * sin(turn), 0.0};
            assert_int_equal(knurl_scene_set_transform(scene, surface, position, turned, 0.016), KNURL_OK);
        }
        memset(&input, 0, sizeof input);
        assert_int_equal(knurl_device_read(device, &sample), KNURL_OK);
        memcpy(input.position, sample.position, sizeof input.position);
        assert_int_equal(knurl_scene_tick(scene, 0, &input, &out), KNURL_OK);
        assert_int_equal(knurl_device_write(device, out.device_force), KNURL_OK);
        memcpy(forces[k], out.force, sizeof forces[k]);
        touching += out.contacts > 0;
    }
    knurl_device_close(device);
    knurl_scene_destroy(scene);
    return touching;
}

static void check_strokes(int moves) {
    static const struct {
        const char *device;
        double stiffness;
    } devices[] = {{"fake", 1020.0}, {"fake:?preset=falcon&tremor=0.00002", 1500.0}};
    static const int32_t methods[] = {KNURL_METHOD_S1, KNURL_METHOD_S2, KNURL_METHOD_BANDLIMITED};
    static const double speeds[] = {0.03, 0.1, 0.25};
    static double with[TICKS][3];
    static double without[TICKS][3];
    for (size_t i = 0; i < COUNT_OF(devices) * COUNT_OF(methods) * COUNT_OF(speeds); i++) {
        const size_t device = i % COUNT_OF(devices);
        const stroke_case c = {devices[device].device, methods[i / COUNT_OF(devices) % COUNT_OF(methods)],
                               devices[device].stiffness, speeds[i / (COUNT_OF(devices) * COUNT_OF(methods))], moves};
        assert_true(stroke(&c, 0, with) > TICKS / 2);
        (void)stroke(&c, KNURL_PROTECT_PASSIVITY, without);
        int same = 1;
        for (int k = 0; k < TICKS; k++) {
            same &= with[k][0] == without[k][0] && with[k][1] == without[k][1] && with[k][2] == without[k][2];
        }
        if (!same) {
            fail_msg("%s, %s, %g m/s: not the same forces", c.device, knurl_method_name(c.method), c.speed);
        }
    }
}

TEST(strokes_that_turn_are_left_alone) {
    check_strokes(0);
}

TEST(gratings_that_are_moved_under_a_stroke_are_left_alone) {
    check_strokes(1);
}
