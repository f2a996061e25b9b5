/* The curved patch over a triangle: its tangents against differences of its points. SPDX-License-Identifier: MIT
 */
#include "support/geometry.h"

#include "contact/patch.h"

/* The patch for some weights, with the HIP at height z over its point there. Moves point to the HIP. */
static knurl_patch_point at_height(const knurl_patch *patch, double w1, double w2, double z) {
    const double w[3] = {1.0 - w1 - w2, w1, w2}, nowhere[3] = {0.0, 0.0, 0.0};
    double hip[3];
    knurl_patch_point at;
    knurl_patch_at(patch, w, nowhere, &at);
    add3(at.point, z, at.normal, hip);
    knurl_patch_at(patch, w, hip, &at);
    CHECK_CLOSE(at.z, z, 1e-15);
    memcpy(at.point, hip, sizeof hip);
    return at;
}

TEST(tangents_are_the_differences_of_points_at_any_height) {
    static const double h = 1e-6;
    uint64_t seed = 3;
    for (int i = 0; i < 500; i++) {
        double corners[3][3] = {{0.0, 0.0, 0.0}, {0.01, 0.001, 0.0}, {0.002, 0.009, 0.0}}, normals[3][3];
        knurl_patch patch;
        for (int k = 0; k < 3; k++) {
            normals[k][0] = random_between(&seed, -0.3, 0.3);
            normals[k][1] = random_between(&seed, -0.3, 0.3);
            normals[k][2] = sqrt(1.0 - normals[k][0] * normals[k][0] - normals[k][1] * normals[k][1]);
        }
        knurl_patch_set((const double (*)[3])corners, (const double (*)[3])normals, &patch);
        const double w1 = random_between(&seed, 0.1, 0.5), w2 = random_between(&seed, 0.1, 0.4);
        const double z = random_between(&seed, -0.001, 0.001); /* m: well below the radii of curvature */
        const knurl_patch_point at = at_height(&patch, w1, w2, z);
        for (int k = 0; k < 2; k++) {
            const knurl_patch_point more = at_height(&patch, w1 + (k ? 0.0 : h), w2 + (k ? h : 0.0), z);
            const knurl_patch_point less = at_height(&patch, w1 - (k ? 0.0 : h), w2 - (k ? h : 0.0), z);
            double change[3];
            add3(more.point, -1.0, less.point, change);
            add3(change, -dot3(change, at.normal), at.normal, change);
            for (int axis = 0; axis < 3; axis++) {
                CHECK_CLOSE(at.tangents[k][axis], change[axis] / (2.0 * h), 1e-9);
            }
        }
    }
}
