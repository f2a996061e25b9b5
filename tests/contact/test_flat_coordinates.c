/* Coordinates of flat meshes from UVs, tangents and axes, and coordinates with which a mesh does not become a plane.
 * SPDX-License-Identifier: MIT */
#include "flat_outcome.h"

TEST(uvs_that_are_not_affine_keep_a_mesh) {
    shape bent = shape_sheet(8, 8, (const double[2]){0.05, 0.05}, NULL);
    for (uint32_t v = 0; v < bent.vertex_count; v++) {
        const float u = bent.uvs[2 * v];
        bent.uvs[2 * v] = u + 0.001F * u * u;
    }
    CHECK_STAYS(&bent, "mesh: its uvs are not affine");
    shape seam = DRAWING("####", "####"); /* the right half starts again at 0, as an atlas does */
    shape_unweld(&seam);
    for (uint32_t i = 0; i < seam.index_count; i += 6) {
        for (uint32_t k = i; seam.uvs && seam.positions[3 * i] >= (float)(2.0 * CELL) && k < i + 6; k++) {
            seam.uvs[2 * k] -= 0.0625F;
        }
    }
    CHECK_STAYS(&seam, "mesh: its uvs are not affine");
}

TEST(uvs_without_area_or_mirrored_in_part_keep_a_mesh) {
    const char *const reason = "mesh: some of its uvs have no area, or are mirrored against the rest";
    shape none = DRAWING("####", "####");
    memset(none.uvs, 0, none.vertex_count * 2 * sizeof(float));
    CHECK_STAYS(&none, reason);
    shape folded = DRAWING("####", "####"); /* mirrored about its middle: the map is continuous */
    for (uint32_t v = 0; v < folded.vertex_count; v++) {
        folded.uvs[2 * v] = fabsf(folded.uvs[2 * v] - (float)(16.0 * CELL));
    }
    CHECK_STAYS(&folded, reason);
}

TEST(tangents_that_turn_or_stand_up_keep_a_mesh) {
    SCOPED_SHAPE s = DRAWING("####", "####");
    float tangents[15][4];
    knurl_mesh_desc desc = shape_desc(&s);
    desc.tangents = &tangents[0][0];
    static const struct {
        float wrong[3];
        const char *why;
    } cases[] = {{{1.0F, 3e-4F, 0.0F}, "mesh: its tangents do not all point in one direction"},
                 {{-1.0F, 0.0F, 0.0F}, "mesh: its tangents do not all point in one direction"},
                 {{0.0F, 0.0F, 1.0F}, "mesh: its x direction is perpendicular to it"},
                 {{0.0F, 0.0F, 0.0F}, "mesh: its x direction is perpendicular to it"},
                 {{0.01F, 0.0F, 0.0F}, "plane: a flat mesh, a rectangle"},
                 {{0.5F, 1e-5F, 0.3F}, "plane: a flat mesh, a rectangle"}};
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        for (uint32_t v = 0; v < 15; v++) {
            const float along[4] = {1.0F, 0.0F, 0.0F, 1.0F};
            memcpy(tangents[v], along, sizeof along);
        }
        memcpy(tangents[7], cases[i].wrong, sizeof cases[i].wrong);
        outcome o = decide_with(&desc, NULL);
        assert_string_equal(o.why, cases[i].why);
        forget(&o);
    }
}

TEST(axis_along_the_normal_keeps_a_mesh) {
    const double upright[3] = {0.0, sin(0.009), cos(0.009)};
    shape s = DRAWING("####", "####");
    check_stays(&s, upright, "mesh: its x direction is perpendicular to it", __LINE__);
}

/* A sheet that faces away from y = 0.6 z: nearest to -z, from which u runs along -x and v along y. */
TEST(without_axis_tangents_and_uvs_coordinates_are_projected_along_the_nearest_axis) {
    SCOPED_SHAPE s = DRAWING("####", "####");
    free(s.uvs);
    s.uvs = NULL;
    for (uint32_t v = 0; v < s.vertex_count; v++) {
        const float y = s.positions[3 * v + 1];
        s.positions[3 * v] = -s.positions[3 * v];
        s.positions[3 * v + 1] = 0.75F * y;
        s.positions[3 * v + 2] = -0.5F * y;
    }
    outcome o = decide(&s);
    assert_non_null(o.plane);
    for (uint32_t v = 0; v < s.vertex_count; v++) {
        double p[3], q[2];
        shape_get(&s, v, p);
        for (int i = 0; i < 2; i++) { /* in the plane's axes, the columns of its rotation */
            q[i] = 0.0;
            for (int k = 0; k < 3; k++) {
                q[i] += o.rotation[3 * k + i] * (p[k] - o.position[k]);
            }
        }
        CHECK_CLOSE(o.plane->map[0][0] * q[0] + o.plane->map[0][1] * q[1] + o.plane->map[0][2], -p[0], 1e-8);
        CHECK_CLOSE(o.plane->map[1][0] * q[0] + o.plane->map[1][1] * q[1] + o.plane->map[1][2], p[1], 1e-8);
    }
    CHECK_CLOSE(o.plane->x[0], 1.0, 0.0);
    CHECK_CLOSE(o.rotation[0], -1.0, 1e-6); /* x runs along u */
    CHECK_CLOSE(o.plane->facts.stretch[0][1], 1.0, 1e-6);
    CHECK_CLOSE(o.plane->facts.stretch[1][1], 0.75 / sqrt(0.75 * 0.75 + 0.25), 1e-6);
    forget(&o);
}

TEST(axis_gives_metres_from_the_meshs_origin) {
    const double axis[3] = {0.6, 0.64, 0.48};
    SCOPED_SHAPE s = DRAWING("#...", "#...", "####");
    for (uint32_t v = 0; v < s.vertex_count; v++) {
        s.positions[3 * v + 2] = 0.25F;
    }
    const knurl_mesh_desc desc = shape_desc(&s);
    outcome o = decide_with(&desc, axis);
    const double length = sqrt(0.36 + 0.4096);
    assert_non_null(o.plane);
    CHECK_CLOSE(o.rotation[0], 0.6 / length, 1e-12); /* the plane's x runs along the axis */
    CHECK_CLOSE(o.rotation[3], 0.64 / length, 1e-12);
    CHECK_CLOSE(o.plane->x[0], 1.0, 0.0);
    for (int i = 0; i < 3; i++) {
        CHECK_CLOSE(o.plane->facts.stretch[0][i], length, 1e-12);
    }
    CHECK_CLOSE(o.plane->map[0][0], length, 1e-12);
    CHECK_CLOSE(o.plane->map[0][2], dot3(o.position, axis), 1e-12); /* with the offset of 0.25 m along z */
    CHECK_CLOSE(o.plane->map[1][2], (o.position[1] * 0.6 - o.position[0] * 0.64) / length, 1e-12);
    forget(&o);
}

TEST(tangents_alone_give_no_coordinates) {
    SCOPED_SHAPE s = DRAWING("#...", "#...", "####");
    float tangents[20][4];
    for (uint32_t v = 0; v < 20; v++) {
        const float along[4] = {0.0F, 2.0F, 0.0F, 1.0F};
        memcpy(tangents[v], along, sizeof along);
    }
    knurl_mesh_desc desc = shape_desc(&s);
    desc.tangents = &tangents[0][0];
    desc.uvs = NULL;
    outcome o = decide_with(&desc, NULL);
    const double nothing[6] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    assert_non_null(o.plane);
    assert_int_equal(o.plane->has_coordinates, 0);
    assert_memory_equal(o.plane->map, nothing, sizeof nothing);
    CHECK_CLOSE(o.rotation[3], 1.0, 1e-12); /* its x is the mesh's y */
    CHECK_CLOSE(o.plane->facts.stretch[0][1], 1.0, 0.0);
    forget(&o);
}
