/* A crease of two walls, however sharp: the same force as of one mesh. SPDX-License-Identifier: MIT */
#include "scene/patch.h"

#define K     800.0
#define DEPTH 0.002 /* m, below the crease */
#define SEAM  2e-7  /* m: the proxy's distance from each wall, and more at their crease */

enum { ONE_MESH, TWO_MESHES, TWO_FULL_MESHES, TWO_PLANES, CUTS };

/* A wall of 100 x 100 mm that rises from x = z = 0 at half of the angle from z, on the right (1) or left (-1). */
static void add_wall(patch *p, double half, double side) {
    const double up[3] = {side * 0.1 * sin(half), 0.0, 0.1 * cos(half)};
    const double a[3] = {0.0, -0.05 * side, 0.0}, b[3] = {0.0, 0.05 * side, 0.0};
    const double c[3] = {up[0], b[1], up[2]}, d[3] = {up[0], a[1], up[2]};
    add_triangle(p, a, c, b);
    add_triangle(p, a, d, c);
}

static knurl_scene *crease(int cut, double angle, double stiffness_left) {
    const double half = 0.5 * angle, tilt = 0.5 * (0.5 * acos(-1.0) - half);
    knurl_scene_desc desc;
    knurl_scene *scene = NULL;
    knurl_scene_desc_init(&desc, sizeof desc);
    desc.full_model = cut == TWO_FULL_MESHES ? 1 : 0;
    assert_int_equal(knurl_scene_create(&desc, &scene), KNURL_OK);
    configure_plainly(scene, 0);
    patch both = patch_new(4);
    for (int i = 0; i < 2; i++) {
        const double side = i ? -1.0 : 1.0;
        patch one = patch_new(2);
        add_wall(&one, half, side);
        add_wall(&both, half, side);
        surface_parts parts = cut == TWO_PLANES ? surface_plane() : surface_shape(&one.s);
        if (cut == ONE_MESH && i == 1) {
            parts = surface_shape(&both.s);
        }
        if (cut == TWO_PLANES) {
            parts.desc.position[0] = side * 0.05 * sin(half);
            parts.desc.position[2] = 0.05 * cos(half);
            parts.desc.rotation[1] = -side * sin(tilt);
            parts.desc.rotation[3] = cos(tilt);
            parts.plane.half_extents[0] = parts.plane.half_extents[1] = 0.05;
        }
        parts.material.stiffness = i ? stiffness_left : K;
        if (cut != ONE_MESH || i == 1) {
            (void)add_surface(scene, &parts);
        }
        shape_free(&one.s);
    }
    shape_free(&both.s);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    return scene;
}

/* A god-object at the crease holds by K times its distance, in its direction: from above, straight down, then aside and
 * back within the wedge that the crease holds, in steps of 0.1 mm. */
TEST(a_crease_holds_by_the_same_force_however_it_is_cut_and_however_sharp_it_is) {
    for (int degrees = 5; degrees <= 175; degrees += 5) {
        for (int cut = 0; cut < CUTS; cut++) {
            const double half = degrees * acos(-1.0) / 360.0;
            knurl_scene *scene = crease(cut, 2.0 * half, K);
            const double aside = fmin(0.9 * DEPTH / tan(half), 0.0015);
            for (int k = 0; k <= 420; k++) {
                (void)tick_at(scene, 0.0, 0.0013, 0.04 - 0.0001 * k);
            }
            for (int k = 0; k <= 120; k++) {
                const double x = aside * sin(k * acos(-1.0) / 30.0) * (degrees < 170 ? 1.0 : 0.5);
                const knurl_tick_output out = tick_at(scene, x, 0.0013 + 1e-4 * k, -DEPTH);
                const double off =
                    fmax(fmax(fabs(out.force[0] + K * x), fabs(out.force[1])), fabs(out.force[2] - K * DEPTH));
                if (off > 1e-6 * K * DEPTH + K * SEAM / sin(half)) {
                    fail_msg("%d degrees, cut %d, x %g: expected (%g, 0, %g) N, found (%g, %g, %g)", degrees, cut, x,
                             -K * x, K * DEPTH, out.force[0], out.force[1], out.force[2]);
                }
            }
            knurl_scene_destroy(scene);
        }
    }
}

/* Walls of different stiffness, nearly parallel: the force is at most that of the stiffer one alone. */
TEST(a_sharp_crease_of_a_soft_and_a_hard_wall_does_not_push_aside) {
    for (int degrees = 5; degrees < 90; degrees += 5) {
        knurl_scene *scene = crease(TWO_PLANES, degrees * acos(-1.0) / 180.0, 0.25 * K);
        knurl_tick_output out = {0};
        for (int k = 0; k <= 420; k++) {
            out = tick_at(scene, 0.0, 0.0013, 0.04 - 0.0001 * k);
        }
        assert_true(out.force[2] > 0.25 * K * DEPTH && out.force[2] < K * DEPTH);
        assert_true(fabs(out.force[0]) < 0.75 * K * DEPTH);
        knurl_scene_destroy(scene);
    }
}
