/* Surfaces that have another's shape (knurl_surface_desc.shape_of): felt alike, held once, freed with the last.
 * SPDX-License-Identifier: MIT */
#include "scene/ask.h"
#include "support/poses.h"

#include <string.h>

static double wave(double x, double y) {
    return 0.01 * sin(40.0 * x) * cos(30.0 * y);
}

/* A description of a surface like that one. */
static knurl_surface_desc like(surface_parts *parts, knurl_surface_id other) {
    knurl_surface_desc desc = *surface_ready(parts);
    desc.mesh = NULL;
    desc.axis[0] = 0.0;
    desc.shape_of = other;
    return desc;
}

/* The surface at x = 1, with the shape of the one at x = 0 or with a mesh of its own; `alone`: the first is gone. */
static void stroke(int shared, int alone, double forces[200]) {
    SCOPED_SHAPE s = shape_sheet(32, 32, (const double[2]){0.1, 0.1}, wave);
    surface_parts parts = surface_along_x(&s);
    SCOPED_SCENE *scene = empty_scene(1);
    configure_plainly(scene, 0);
    const knurl_surface_id first = add_surface(scene, &parts);
    const knurl_surface_desc own = *surface_ready(&parts);
    knurl_surface_desc second = shared ? like(&parts, first) : own;
    second.position[0] = 1.0;
    assert_int_equal(knurl_scene_add_surface(scene, &second, NULL), KNURL_OK);
    if (alone) {
        assert_int_equal(knurl_scene_remove_surface(scene, first), KNURL_OK);
        knurl_scene_collect(scene);
    }
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    for (int i = 0; i < 200; i++) {
        const double x = 0.01 + 0.0004 * i;
        const knurl_tick_output out = tick_at(scene, 1.0 + x, 0.05, i == 0 ? 0.05 : wave(x, 0.05) - 0.001);
        forces[i] = out.force[2];
    }
}

TEST(a_shared_shape_is_felt_as_its_own_would_be) {
    double own[200];
    double shared[200];
    double alone[200];
    stroke(0, 0, own);
    stroke(1, 0, shared);
    stroke(1, 1, alone);
    assert_true(own[100] > 0.1);
    assert_memory_equal(own, shared, sizeof own);
    assert_memory_equal(own, alone, sizeof own);
}

TEST(a_shared_shape_costs_its_surface_and_no_shape) {
    SCOPED_SHAPE s = shape_sheet(64, 64, (const double[2]){0.1, 0.1}, wave);
    surface_parts parts = surface_along_x(&s);
    SCOPED_SCENE *scene = empty_scene(1);
    knurl_surface_id last = add_surface(scene, &parts);
    const uint64_t one = knurl_scene_get_bytes(scene);
    for (int i = 0; i < 99; i++) {
        const knurl_surface_desc desc = like(&parts, last); /* of one that has it from another */
        assert_int_equal(knurl_scene_add_surface(scene, &desc, &last), KNURL_OK);
    }
    assert_true(one > 300000 && knurl_scene_get_bytes(scene) < one + 99 * 4096);
    uint64_t told = 0;
    for (uint32_t i = 0; i < 100; i++) {
        const knurl_surface_info info = info_of(scene, knurl_scene_get_surface(scene, i));
        told += info.bytes;
        assert_true(info.axis[0] == 1.0);
    }
    assert_true(told <= knurl_scene_get_bytes(scene));
}

TEST(a_plane_is_double_sided_for_those_that_ask_for_it) {
    for (int both = 0; both < 2; both++) {
        surface_parts parts = surface_plane();
        SCOPED_SCENE *scene = empty_scene(1);
        configure_plainly(scene, 0);
        const knurl_surface_id first = add_surface(scene, &parts);
        knurl_surface_desc second = *surface_ready(&parts);
        second.plane = NULL;
        second.shape_of = first;
        second.double_sided = (uint32_t)both;
        second.position[0] = 1.0;
        assert_int_equal(knurl_scene_add_surface(scene, &second, NULL), KNURL_OK);
        assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
        (void)tick_at(scene, 1.0, 0.0, -0.01);
        (void)tick_at(scene, 1.0, 0.0, -0.001);
        CHECK_CLOSE(tick_at(scene, 1.0, 0.0, 0.001).force[2], both ? -0.4 : 0.0, 1e-9);
    }
}

TEST(an_invalid_shape_of_is_refused) {
    SCOPED_SHAPE s = shape_sheet(4, 4, (const double[2]){0.1, 0.1}, wave);
    surface_parts parts = surface_along_x(&s);
    SCOPED_SCENE *scene = empty_scene(1);
    const knurl_surface_id first = add_surface(scene, &parts);
    knurl_surface_desc desc = *surface_ready(&parts);
    const uint64_t before = knurl_scene_get_bytes(scene);
    desc.shape_of = first;
    assert_int_equal(knurl_scene_add_surface(scene, &desc, NULL), KNURL_ERROR_ARGUMENT);
    assert_non_null(strstr(knurl_error_message(), "exactly one of plane, mesh and shape_of"));
    desc.mesh = NULL;
    assert_int_equal(knurl_scene_add_surface(scene, &desc, NULL), KNURL_ERROR_ARGUMENT);
    assert_non_null(strstr(knurl_error_message(), "axis"));
    desc.axis[0] = 0.0;
    desc.rotation[3] = 7.0;
    assert_int_equal(knurl_scene_add_surface(scene, &desc, NULL), KNURL_ERROR_ARGUMENT);
    desc.rotation[3] = 1.0;
    desc.shape_of = first + 1;
    assert_int_equal(knurl_scene_add_surface(scene, &desc, NULL), KNURL_ERROR_STALE_ID);
    assert_int_equal(knurl_scene_get_bytes(scene), before);
    assert_int_equal(knurl_scene_remove_surface(scene, first), KNURL_OK);
    desc.shape_of = first;
    assert_int_equal(knurl_scene_add_surface(scene, &desc, NULL), KNURL_ERROR_STALE_ID);
}
