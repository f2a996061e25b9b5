/* Scenes with a HIP of a given description, and their answers. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_ASK_H
#define KNURL_TEST_ASK_H

#include "support/scenes.h"

/** A HIP's defaults, its device axes the scene's. */
static inline knurl_hip_desc hip_in_scene_axes(void) {
    static knurl_workspace identity;
    knurl_hip_desc hip;
    knurl_workspace_set_identity(&identity);
    knurl_hip_desc_init(&hip, sizeof hip);
    hip.workspace = &identity;
    return hip;
}

/** A surface_mesh() whose grating runs along x. */
static inline surface_parts surface_along_x(const shape *s) {
    surface_parts parts = surface_mesh(s);
    parts.desc.axis[0] = 1.0;
    return parts;
}

/** The scene_of() a plane with defaults. */
static inline knurl_scene *scene_of_plane(void) {
    surface_parts parts = surface_plane();
    return scene_of(&parts);
}

/** A committed scene of one surface, or of none (null), with HIP 0 as described. */
static inline knurl_scene *scene_with_hip(surface_parts *parts, const knurl_hip_desc *hip) {
    knurl_scene *scene = empty_scene(1);
    if (parts) {
        (void)add_surface(scene, parts);
    }
    assert_int_equal(knurl_scene_configure_hip(scene, 0, hip), KNURL_OK);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    return scene;
}

/** An empty scene. full_model: of its description. */
static inline knurl_scene *scene_of_model(uint32_t full_model) {
    knurl_scene_desc desc;
    knurl_scene *scene = NULL;
    knurl_scene_desc_init(&desc, sizeof desc);
    desc.full_model = full_model;
    assert_int_equal(knurl_scene_create(&desc, &scene), KNURL_OK);
    return scene;
}

/** Moves the first surface to a place, not turned. */
static inline void glide_to(knurl_scene *scene, double x, double y, double z, double seconds) {
    const double position[3] = {x, y, z}, rotation[4] = {0.0, 0.0, 0.0, 1.0};
    const knurl_surface_id first = knurl_scene_get_surface(scene, 0);
    assert_int_equal(knurl_scene_set_transform(scene, first, position, rotation, seconds), KNURL_OK);
}

/** With HIP 0 configured plainly. Returns the scene. */
static inline knurl_scene *commit_plainly(knurl_scene *scene) {
    configure_plainly(scene, 0);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    return scene;
}

/** HIP 0's counts. */
static inline knurl_hip_counts counts_of(const knurl_scene *scene) {
    knurl_hip_counts counts;
    assert_int_equal(knurl_scene_get_tick(scene, 0, NULL, &counts), KNURL_OK);
    return counts;
}

static inline knurl_surface_info info_of(const knurl_scene *scene, knurl_surface_id surface) {
    knurl_surface_info info;
    knurl_surface_info_init(&info, sizeof info);
    assert_int_equal(knurl_scene_get_surface_info(scene, surface, &info), KNURL_OK);
    return info;
}

static inline knurl_surface_info first_info(const knurl_scene *scene) {
    return info_of(scene, knurl_scene_get_surface(scene, 0));
}

/** Of the first surface, for HIP 0. */
static inline knurl_surface_check first_check(const knurl_scene *scene) {
    knurl_surface_check check;
    knurl_surface_check_init(&check, sizeof check);
    assert_int_equal(knurl_scene_check_surface(scene, 0, knurl_scene_get_surface(scene, 0), &check), KNURL_OK);
    return check;
}

static inline knurl_material_desc material_of(const knurl_scene *scene, knurl_surface_id surface) {
    knurl_material_desc material;
    knurl_material_desc_init(&material, sizeof material);
    assert_int_equal(knurl_scene_get_material(scene, surface, &material), KNURL_OK);
    return material;
}

#endif
