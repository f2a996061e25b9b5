/* Scenes to tick: descriptions filled in for a test to change, and one HIP moved through them.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_SCENES_H
#define KNURL_TEST_SCENES_H

#include "support/shapes.h"

#include <knurl/hip.h>
#include <knurl/query.h>

/** A surface with everything it points to. Its pointers are set by surface_ready(), so that it may be copied. */
typedef struct surface_parts {
    knurl_surface_desc desc;
    knurl_material_desc material;
    knurl_plane_desc plane;
    knurl_mesh_desc mesh;
    int is_mesh;
} surface_parts;

static inline const knurl_surface_desc *surface_ready(surface_parts *parts) {
    parts->desc.material = &parts->material;
    parts->desc.plane = parts->is_mesh ? NULL : &parts->plane;
    parts->desc.mesh = parts->is_mesh ? &parts->mesh : NULL;
    return &parts->desc;
}

/** Defaults: a plane of 0.1 x 0.1 m, smooth, 400 N/m. */
static inline surface_parts surface_plane(void) {
    surface_parts parts;
    memset(&parts, 0, sizeof parts);
    knurl_surface_desc_init(&parts.desc, sizeof parts.desc);
    knurl_material_desc_init(&parts.material, sizeof parts.material);
    knurl_plane_desc_init(&parts.plane, sizeof parts.plane);
    knurl_mesh_desc_init(&parts.mesh, sizeof parts.mesh);
    return parts;
}

/** The same of a shape, which stays the caller's. */
static inline surface_parts surface_mesh(const shape *s) {
    surface_parts parts = surface_plane();
    parts.mesh = shape_desc(s);
    parts.is_mesh = 1;
    return parts;
}

static inline void set_grating(surface_parts *parts, int32_t method, double fsx, double fsy, double amplitude) {
    parts->material.method = method;
    parts->material.spatial_frequency[0] = fsx;
    parts->material.spatial_frequency[1] = fsy;
    parts->material.amplitude = amplitude;
}

static inline knurl_surface_id add_surface(knurl_scene *scene, surface_parts *parts) {
    knurl_surface_id id = 0;
    assert_int_equal(knurl_scene_add_surface(scene, surface_ready(parts), &id), KNURL_OK);
    assert_true(id != 0);
    return id;
}

static inline knurl_scene *empty_scene(uint32_t hips) {
    knurl_scene *scene = NULL;
    knurl_scene_desc desc;
    knurl_scene_desc_init(&desc, sizeof desc);
    desc.hip_count = hips;
    assert_int_equal(knurl_scene_create(&desc, &scene), KNURL_OK);
    assert_non_null(scene);
    return scene;
}

/** A HIP for hand-computed numbers: device axes are the scene's, no quantisation, a very high force limit, and no
 * protections: tests place it inside walls directly. */
static inline void configure_plainly(knurl_scene *scene, uint32_t hip) {
    knurl_hip_desc desc;
    knurl_workspace workspace;
    knurl_workspace_set_identity(&workspace);
    knurl_hip_desc_init(&desc, sizeof desc);
    desc.resolution = 0.0;
    desc.max_force = 1e6;
    desc.protections = 0;
    desc.workspace = &workspace;
    assert_int_equal(knurl_scene_configure_hip(scene, hip, &desc), KNURL_OK);
}

/** A committed scene of one surface with HIP 0 configured plainly. */
static inline knurl_scene *scene_of(surface_parts *parts) {
    knurl_scene *scene = empty_scene(1);
    (void)add_surface(scene, parts);
    configure_plainly(scene, 0);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    return scene;
}

/** One tick of HIP 0 at a place, its velocity estimated. */
static inline knurl_tick_output tick_at(knurl_scene *scene, double x, double y, double z) {
    const knurl_tick_input input = {{x, y, z}, {0.0, 0.0, 0.0}, 0, 0, 0.0, 0, {0}};
    knurl_tick_output output;
    assert_int_equal(knurl_scene_tick(scene, 0, &input, &output), KNURL_OK);
    return output;
}

/** One tick of HIP 0 with a velocity given. */
static inline knurl_tick_output tick_moving(knurl_scene *scene, const double position[3], const double velocity[3]) {
    knurl_tick_input input = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, 1, 0, 0.0, 0, {0}};
    knurl_tick_output output;
    memcpy(input.position, position, sizeof input.position);
    memcpy(input.velocity, velocity, sizeof input.velocity);
    assert_int_equal(knurl_scene_tick(scene, 0, &input, &output), KNURL_OK);
    return output;
}

/** The same output from two scenes, bit for bit; but their surfaces' ids differ in the 20 bits that name the scene. */
static inline void check_same_output(const knurl_tick_output *a, const knurl_tick_output *b) {
    knurl_tick_output from_a = *a;
    knurl_tick_output from_b = *b;
    from_a.surface &= ~(UINT64_C(0xfffff) << 21);
    from_b.surface &= ~(UINT64_C(0xfffff) << 21);
    assert_memory_equal(&from_a, &from_b, sizeof from_a);
}

/** All three of a vector that has a place in memory (not of a function's result). */
#define CHECK_VECTOR(actual, x, y, z, tolerance)                                                                       \
    do {                                                                                                               \
        const double *const actual_ = (actual);                                                                        \
        CHECK_CLOSE(actual_[0], x, tolerance);                                                                         \
        CHECK_CLOSE(actual_[1], y, tolerance);                                                                         \
        CHECK_CLOSE(actual_[2], z, tolerance);                                                                         \
    } while (0)

#endif
