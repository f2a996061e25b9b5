/* A crease of two walls, however sharp: the same force as of one mesh. SPDX-License-Identifier: MIT */
#include "base/vec3.h"
#include "scene/ask.h"
#include "scene/patch.h"

#define K      800.0
#define DEPTH  0.002  /* m, below the crease */
#define RIDGES 500.0  /* cycles/m */
#define HEIGHT 0.0002 /* m */
#define SEAM   2e-7   /* m: the proxy's distance from each wall, and more at their crease */

enum { ONE_MESH, TWO_MESHES, TWO_FULL_MESHES, TWO_PLANES, CUTS };

/* A wall of 100 x 100 mm that rises from x = z = 0 at half of the angle from z, on the right (1) or left (-1). */
static void add_wall(patch *p, double half, double side) {
    const double up[3] = {side * 0.1 * sin(half), 0.0, 0.1 * cos(half)};
    const double a[3] = {0.0, -0.05 * side, 0.0}, b[3] = {0.0, 0.05 * side, 0.0};
    const double c[3] = {up[0], b[1], up[2]}, d[3] = {up[0], a[1], up[2]};
    add_triangle(p, a, c, b);
    add_triangle(p, a, d, c);
}

/* method: of ridges along the crease; negative: smooth. */
static knurl_scene *crease(int cut, double angle, double stiffness_left, int method) {
    const double half = 0.5 * angle, tilt = 0.5 * (0.5 * acos(-1.0) - half);
    knurl_scene *scene = scene_of_model(cut == TWO_FULL_MESHES);
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
        parts.desc.axis[0] = 0.0;
        parts.desc.axis[1] = 1.0;
        parts.material.stiffness = i ? stiffness_left : K;
        if (method >= 0) {
            set_grating(&parts, method, RIDGES, 0.0, HEIGHT);
            parts.material.damping = 2.0;
            parts.material.friction = 0.3;
        }
        if (cut != ONE_MESH || i == 1) {
            (void)add_surface(scene, &parts);
        }
        shape_free(&one.s);
    }
    shape_free(&both.s);
    return commit_plainly(scene);
}

/* A god-object at the crease holds by K times its distance, in its direction: from above, straight down, then aside and
 * back within the wedge that the crease holds, in steps of 0.1 mm. */
TEST(a_crease_holds_by_the_same_force_however_it_is_cut_and_however_sharp_it_is) {
    for (int degrees = 5; degrees <= 175; degrees += 5) {
        for (int cut = 0; cut < CUTS; cut++) {
            const double half = degrees * acos(-1.0) / 360.0;
            SCOPED_SCENE *scene = crease(cut, 2.0 * half, K, -1);
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
        }
    }
}

/* Walls of different stiffness, nearly parallel: the force is at most that of the stiffer one alone. */
TEST(a_sharp_crease_of_a_soft_and_a_hard_wall_does_not_push_aside) {
    for (int degrees = 5; degrees < 90; degrees += 5) {
        SCOPED_SCENE *scene = crease(TWO_PLANES, degrees * acos(-1.0) / 180.0, 0.25 * K, -1);
        knurl_tick_output out = {0};
        for (int k = 0; k <= 420; k++) {
            out = tick_at(scene, 0.0, 0.0013, 0.04 - 0.0001 * k);
        }
        assert_true(out.force[2] > 0.25 * K * DEPTH && out.force[2] < K * DEPTH);
        assert_true(fabs(out.force[0]) < 0.75 * K * DEPTH);
    }
}

#define APPROACH 420 /* ticks */
#define STROKE   600

/* Moves down to 2 mm below the crease, then along it at 50 mm/s, aside and back within the wedge that it holds. */
static void stroke(int tick, double half, double at[3], double velocity[3]) {
    const int k = tick - APPROACH;
    const double aside = fmin(0.5 * DEPTH / tan(half), 0.0015);
    at[0] = k < 0 ? 0.0 : aside * sin(k * acos(-1.0) / 75.0);
    at[1] = 0.00131 + (k < 0 ? 0.0 : 5e-5 * k); /* no tick on the edge of a ridge, which rounding would move */
    at[2] = k < 0 ? 0.04 - 0.0001 * tick : -DEPTH;
    velocity[0] = 0.0;
    velocity[1] = k < 0 ? 0.0 : 0.05;
    velocity[2] = k < 0 ? -0.1 : 0.0;
}

static void stroke_all_cuts(int degrees, int method) {
    const double half = degrees * acos(-1.0) / 360.0;
    knurl_scene *scenes[CUTS];
    double most = 0.0, least = 1e3;
    for (int cut = 0; cut < CUTS; cut++) {
        scenes[cut] = crease(cut, 2.0 * half, K, method);
    }
    for (int tick = 0; tick < APPROACH + STROKE; tick++) {
        double at[3], velocity[3];
        knurl_tick_output out[CUTS];
        stroke(tick, half, at, velocity);
        for (int cut = 0; cut < CUTS; cut++) {
            out[cut] = tick_moving(scenes[cut], at, velocity);
        }
        for (int cut = 0; cut < CUTS && tick >= APPROACH; cut++) {
            const double depth = sqrt(at[0] * at[0] + DEPTH * DEPTH);
            const double force = (DEPTH * out[cut].force[2] - at[0] * out[cut].force[0]) / depth;
            const double off = sqrt(vec3_distance2(out[cut].force, out[ONE_MESH].force));
            most = fmax(most, force - K * depth);
            least = fmin(least, force - K * depth);
            if (off > 1e-6 * K * DEPTH + K * SEAM / sin(half)) {
                fail_msg("%d degrees, method %d, tick %d: cut %d differs by %g N from one mesh", degrees, method, tick,
                         cut, off);
            }
        }
    }
    assert_true(most > 0.95 * K * HEIGHT && least < -0.95 * K * HEIGHT); /* the ridges were felt, at full height */
    assert_true(most < 1.75 * K * HEIGHT && least > -1.75 * K * HEIGHT); /* S2's highest event is 1.73 A */
    for (int cut = 0; cut < CUTS; cut++) {
        knurl_scene_destroy(scenes[cut]);
    }
}

TEST(ridges_in_a_crease_are_as_strong_however_it_is_cut) {
    static const int methods[] = {KNURL_METHOD_S1, KNURL_METHOD_S2, KNURL_METHOD_BANDLIMITED};
    for (int degrees = 5; degrees <= 175; degrees += 5) {
        for (int i = 0; i < 3; i++) {
            stroke_all_cuts(degrees, methods[i]);
        }
    }
}

/* A smooth floor, and a wall at x = 0 that faces it with a crest all along. */
static knurl_scene *floor_and_wall(void) {
    static const double turned[4] = {0.0, 0.70710678118654752, 0.0, 0.70710678118654752}; /* its z is the scene's x */
    knurl_scene *scene = empty_scene(1);
    surface_parts ground = surface_plane(), wall = surface_plane();
    ground.material.stiffness = wall.material.stiffness = K;
    memcpy(wall.desc.rotation, turned, sizeof turned);
    set_grating(&wall, KNURL_METHOD_S1, RIDGES, 0.0, HEIGHT);
    wall.desc.axis[0] = 0.0;
    wall.desc.axis[1] = 1.0;
    (void)add_surface(scene, &ground);
    (void)add_surface(scene, &wall);
    return commit_plainly(scene);
}

/* From a place to another in steps of 2 um. Returns the largest change of the force in a step, N. */
static double largest_step(knurl_scene *scene, const double from[3], const double to[3], double force[3]) {
    const int steps = (int)(sqrt(vec3_distance2(from, to)) / 2e-6);
    double last[3] = {0.0, 0.0, 0.0}, most = 0.0;
    for (int k = 0; k <= steps; k++) {
        double at[3];
        vec3_sub(to, from, at);
        vec3_madd(from, (double)k / steps, at, at);
        const knurl_tick_output out = tick_at(scene, at[0], at[1], at[2]);
        most = k > 0 ? fmax(most, sqrt(vec3_distance2(out.force, last))) : 0.0;
        vec3_copy(out.force, last);
    }
    vec3_copy(last, force);
    return most;
}

TEST(ridges_of_a_wall_begin_without_a_step_for_a_hip_that_a_floor_holds) {
    SCOPED_SCENE *scene = floor_and_wall();
    const double above[3] = {0.003, 0.0, 0.002}, beside[3] = {0.003, 0.0, -0.001}, within[3] = {-0.001, 0.0, -0.001};
    const double before[3] = {1e-4, 0.0, 0.002}, below[3] = {1e-4, 0.0, -0.001};
    double force[3];
    (void)largest_step(scene, above, beside, force);
    assert_true(largest_step(scene, beside, within, force) < 2.0 * K * 2e-6);
    assert_true(fabs(force[2] - K * 0.001) < 1e-6);                                     /* the floor is smooth */
    assert_true(fabs(force[0] - K * (0.001 + HEIGHT * sqrt(0.5))) < 1e-3 * K * HEIGHT); /* the wall's share */
    (void)largest_step(scene, within, above, force);
    (void)largest_step(scene, above, before, force);
    assert_true(fabs(force[0] - K * (HEIGHT - 1e-4)) < 1e-6); /* the crest alone */
    assert_true(largest_step(scene, before, below, force) < 2.0 * K * 2e-6);
}
