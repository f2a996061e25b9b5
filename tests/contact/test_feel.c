/* The felt contact at the edges of smooth meshes. SPDX-License-Identifier: MIT */
#include "support/probe.h"

#include "contact/mesh_feel.h"

/* A floor, of which two edges are rims, and a wall down from its third edge. The HIP is below the corner at x = 10 mm,
 * beyond a rim and the wall's edge. Which of them is crossed first depends on the order of the floor's corners. */
TEST(beyond_a_rim_and_a_hard_edge_the_hip_is_held_from_neither) {
    static const double corners[6][3] = {{0.0, 0.0, 0.0},  {0.01, 0.0, 0.0}, {0.0, 0.01, 0.0},
                                         {0.0, 0.01, 0.0}, {0.01, 0.0, 0.0}, {0.01, 0.01, -0.01}};
    static const double normals[4][3] = {{-0.1, -0.1, 0.99}, {0.1, 0.0, 0.995}, {0.0, 0.1, 0.995}, {0.57, 0.57, 0.6}};
    for (int turn = 0; turn < 3; turn++) {
        float positions[18], given[18];
        for (int i = 0; i < 18; i++) {
            const int corner = i < 9 ? (i / 3 + turn) % 3 : i / 3;
            positions[i] = (float)corners[corner][i % 3];
            given[i] = (float)normals[corner < 3 ? corner : 3][i % 3];
        }
        const knurl_mesh_desc desc = {
            .struct_size = sizeof desc, .vertex_count = 6, .positions = positions, .normals = given};
        SCOPED_PROBE p = {.mesh = NULL};
        knurl_facet facet;
        knurl_heap_init(&p.heap, NULL);
        assert_int_equal(knurl_mesh_create(&p.heap, &desc, &p.mesh), KNURL_OK);
        knurl_contact c = {.proxy = {0.01, 0.0, 0.0}, .normal = {-0.6, 0.48, 0.64}, .z = -0.001};
        c.weights[(4 - turn) % 3] = 1.0;
        knurl_mesh_feel(p.mesh, 1, &c, &facet);
        for (int axis = 0; axis < 3; axis++) {
            CHECK_CLOSE(c.normal[axis], normals[1][axis], 2e-4); /* normals are packed */
        }
    }
}
