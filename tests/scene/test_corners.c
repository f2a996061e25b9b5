/* Corners: a HIP that is pressed into one surface and slides into the next is held by both, for planes, meshes or one
 * mesh, with any split of their edges. SPDX-License-Identifier: MIT */
#include "scene/ask.h"
#include "scene/patch.h"
#include "support/geometry.h"

#include <stdio.h>

#define K     400.0  /* N/m, the default */
#define DEPTH 0.001  /* m, how far the HIP is pressed in */
#define STEP  100e-6 /* m a tick */

/* A parallelogram from `at` along u (in `parts` strips) and v; its front is towards u x v. */
static void add_strips(patch *p, const double at[3], const double u[3], const double v[3], int parts) {
    for (int i = 0; i < parts; i++) {
        double a[3], b[3], c[3], d[3];
        add3(at, (double)i / parts, u, a);
        add3(at, (double)(i + 1) / parts, u, b);
        add3(b, 1.0, v, c);
        add3(a, 1.0, v, d);
        add_triangle(p, a, b, c);
        add_triangle(p, a, c, d);
    }
}

static knurl_scene *scene_with(surface_parts *parts, int count, uint32_t full_model) {
    knurl_scene *scene = scene_of_model(full_model);
    for (int i = 0; i < count; i++) {
        (void)add_surface(scene, &parts[i]);
    }
    return commit_plainly(scene);
}

/* --- a floor (z = 0, x > 0) and a wall (x = 0, z > 0) --- */

static surface_parts floor_plane(void) {
    surface_parts parts = surface_plane();
    parts.plane.half_extents[0] = parts.plane.half_extents[1] = 0.05;
    parts.desc.position[0] = 0.05;
    return parts;
}

static surface_parts wall_plane(void) {
    surface_parts parts = surface_plane();
    parts.plane.half_extents[0] = parts.plane.half_extents[1] = 0.05;
    parts.desc.position[2] = 0.05;
    parts.desc.normal[0] = 1.0; /* z becomes x */
    return parts;
}

/* The wall ends at the floor's edge: its bottom is one edge, the floor's may be split. */
static shape floor_shape(int parts) {
    patch p = patch_new(2 * (uint32_t)parts);
    add_strips(&p, (const double[3]){0.0, 0.05, 0.0}, (const double[3]){0.0, -0.1, 0.0},
               (const double[3]){0.1, 0.0, 0.0}, parts);
    return p.s;
}

static shape wall_shape(int parts) {
    patch p = patch_new(2 * (uint32_t)parts);
    add_strips(&p, (const double[3]){0.0, -0.05, 0.0}, (const double[3]){0.0, 0.1, 0.0},
               (const double[3]){0.0, 0.0, 0.1}, parts);
    return p.s;
}

/* From the floor, pressed in by DEPTH, 3 mm into the wall along several lines, there along the wall, and out again.
 * Returns the ticks in which the corner did not hold the HIP; *worst: the force's farthest error, N. */
static int slide_into_wall(knurl_scene *scene, double *worst) {
    int lost = 0;
    for (int line = -10; line <= 10; line++) {
        const double y = 0.0017 * line + 1e-5;
        (void)tick_at(scene, 0.004, y, 0.001);
        for (int k = 0; k <= 100; k++) {
            const double x = 0.004 - (k < 70 ? STEP * k : 0.007);
            const double along = k < 70 ? 0.0 : STEP * (k - 70);
            const knurl_tick_output out = tick_at(scene, x, y + along, -DEPTH);
            const double push = x < 0.0 ? -K * x : 0.0;
            lost += out.contacts == 0 || out.force[2] < 0.5 * K * DEPTH || out.force[0] < 0.5 * push;
            *worst = fmax(*worst, fmax(fabs(out.force[2] - K * DEPTH), fabs(out.force[0] - push)));
        }
        const knurl_tick_output after = tick_at(scene, 0.002, y, 0.001);
        assert_int_equal(after.contacts, 0);
    }
    return lost;
}

static void check_corner(surface_parts *parts, int count, const char *what) {
    const uint32_t models[2] = {0, 1};
    for (int i = 0; i < 2; i++) {
        double worst = 0.0;
        knurl_scene *scene = scene_with(parts, count, models[i]);
        const int lost = slide_into_wall(scene, &worst);
        knurl_scene_destroy(scene);
        if (lost > 0 || worst > 1e-6 * K) {
            fail_msg("%s, full model %d: %d of %d ticks lost, force off by up to %g N", what, i, lost, 21 * 101, worst);
        }
    }
}

TEST(a_hip_pressed_into_a_plane_is_held_by_the_plane_that_it_slides_into) {
    surface_parts parts[2] = {floor_plane(), wall_plane()};
    check_corner(parts, 2, "two planes");
}

TEST(a_hip_pressed_into_a_mesh_is_held_by_the_mesh_that_it_slides_into) {
    SCOPED_SHAPE floor = floor_shape(1);
    SCOPED_SHAPE wall = wall_shape(1);
    surface_parts parts[2] = {surface_shape(&floor), surface_shape(&wall)};
    check_corner(parts, 2, "two meshes");
    surface_parts mixed[2] = {floor_plane(), surface_shape(&wall)};
    check_corner(mixed, 2, "a plane and a mesh");
}

TEST(a_floor_that_goes_on_beneath_the_wall_does_not_carry_the_hip_under_it) {
    SCOPED_SHAPE wall = wall_shape(2);
    surface_parts parts[2] = {floor_plane(), wall_plane()};
    parts[0].desc.position[0] = 0.0;
    check_corner(parts, 2, "two planes");
    parts[1] = surface_shape(&wall);
    check_corner(parts, 2, "a plane and a mesh");
}

TEST(a_corner_in_one_mesh_holds_with_a_shared_edge_and_with_one_that_is_split) {
    for (int floors = 1; floors <= 3; floors++) {
        for (int walls = 1; walls <= 3; walls++) {
            shape floor = floor_shape(floors);
            shape wall = wall_shape(walls);
            SCOPED_SHAPE both = shape_join(&floor, &wall);
            surface_parts parts = surface_shape(&both);
            char what[64];
            (void)snprintf(what, sizeof what, "one mesh, its edge split in %d and %d", floors, walls);
            check_corner(&parts, 1, what);
        }
    }
}

/* --- a groove --- */

/* Walls that rise by `rise` from x = 0, y along the groove; the left one's bottom edge is in `parts` pieces. */
static shape groove(double rise, int parts) {
    patch p = patch_new(2 + 2 * (uint32_t)parts);
    add_strips(&p, (const double[3]){0.0, 0.03, 0.0}, (const double[3]){0.0, -0.06, 0.0},
               (const double[3]){0.03, 0.0, 0.03 * rise}, 1);
    add_strips(&p, (const double[3]){0.0, -0.03, 0.0}, (const double[3]){0.0, 0.06, 0.0},
               (const double[3]){-0.03, 0.0, 0.03 * rise}, parts);
    return p.s;
}

/* Presses from above to 2 mm below the groove's bottom edge; how many fell through. */
static int press_groove(double rise, int parts) {
    int lost = 0;
    SCOPED_SHAPE s = groove(rise, parts);
    surface_parts mesh = surface_shape(&s);
    SCOPED_SCENE *scene = scene_of(&mesh);
    for (int line = 0; line < 210; line++) {
        const double y = 0.00023 * (line - 105) + 3e-6;
        int fell = 0;
        for (int k = 0; k <= 60; k++) {
            const double x = 0.001 * ((line % 7) - 3) * (1.0 - k / 60.0);
            const knurl_tick_output out = tick_at(scene, x, y, 0.004 - STEP * k);
            const int inside = 0.004 - STEP * k < rise * fabs(x) - 1e-6;
            fell |= inside && (out.contacts == 0 || !(length3(out.force) > 0.0) || out.proxy[2] < -1e-6);
        }
        lost += fell;
        (void)tick_at(scene, 0.0, y, 0.02);
    }
    return lost;
}

TEST(a_groove_holds_whose_bottom_edge_is_split_on_one_side) {
    const double rises[2] = {0.5, 1.0};
    for (int i = 0; i < 2; i++) {
        for (int parts = 1; parts <= 3; parts++) {
            const int lost = press_groove(rises[i], parts);
            if (lost > 0) {
                fail_msg("walls that rise %g, split in %d: %d of 210 presses fell through", rises[i], parts, lost);
            }
        }
    }
}

/* A steep groove that moves up and across under a HIP at rest: its bottom, at which both walls hold the proxy, moves
 * over the proxy's last position. */
TEST(a_steep_groove_that_moves_keeps_the_hip_out) {
    for (int parts = 1; parts <= 3; parts++) {
        SCOPED_SHAPE s = groove(2.0, parts);
        surface_parts mesh = surface_shape(&s);
        SCOPED_SCENE *scene = scene_of(&mesh);
        (void)tick_at(scene, 0.0, 0.001, 0.001);
        for (int k = 1; k <= 60; k++) {
            const double up = 0.001 + 0.0005 * (k / 10.0);
            if (k % 10 == 0) {
                glide_to(scene, k % 20 < 10 ? 0.0002 : -0.0002, 0.0, up, 0.01);
            }
            const knurl_tick_output out = tick_at(scene, 0.0, 0.001, 0.0);
            if (k > 20 && (out.contacts == 0 || !(out.force[2] > 0.0) || (out.flags & KNURL_TICK_SQUEEZED))) {
                fail_msg("bottom edge split in %d: lost in tick %d", parts, k);
            }
        }
    }
}

/* --- edges that touch --- */

/* Two triangles, each a surface of its own, flat and so a plane with an outline, share an edge. The HIP comes straight
 * down onto a point of that edge, where rounding puts the crossing outside of both outlines. Returns 1 if it is held.
 */
static int press_shared_edge(uint64_t *seed) {
    double corners[4][3]; /* the edge runs from the first to the third */
    surface_parts parts[2];
    shape shapes[2];
    for (int i = 0; i < 4; i++) {
        corners[i][0] = (double)(float)(i == 1 || i == 2 ? 0.024 : 0.012);
        corners[i][1] = (double)(float)(i >= 2 ? 0.024 : 0.012);
        corners[i][2] = (double)(float)random_between(seed, -0.003, 0.003);
    }
    for (int i = 0; i < 2; i++) {
        patch p = patch_new(1);
        add_triangle(&p, corners[0], corners[i + 1], corners[i + 2]);
        shapes[i] = p.s;
        parts[i] = surface_shape(&shapes[i]);
    }
    SCOPED_SCENE *scene = scene_with(parts, 2, 0);
    double at[3];
    const double share = random_between(seed, 0.1, 0.9);
    for (int i = 0; i < 3; i++) {
        at[i] = corners[0][i] + share * (corners[2][i] - corners[0][i]);
    }
    at[1] = at[0]; /* the edge is along x = y */
    const double speed = random_between(seed, 1e-4, 1e-3);
    knurl_tick_output out;
    for (int k = 3; k >= -1; k--) {
        out = tick_at(scene, at[0], at[1], at[2] + (k + 0.5) * speed);
    }
    shape_free(&shapes[0]);
    shape_free(&shapes[1]);
    return out.contacts > 0 && out.force[2] > 0.0;
}

TEST(a_press_onto_the_edge_that_two_flat_meshes_share_holds) {
    uint64_t seed = 14190;
    int held = 0;
    for (int i = 0; i < 200; i++) {
        held += press_shared_edge(&seed);
    }
    assert_int_equal(held, 200);
}

TEST(a_mesh_that_touches_itself_is_reported) {
    for (int parts = 1; parts <= 2; parts++) {
        SCOPED_SHAPE s = groove(0.5, parts);
        surface_parts mesh = surface_shape(&s);
        SCOPED_SCENE *scene = scene_of(&mesh);
        const knurl_surface_info info = first_info(scene);
        assert_int_equal(info.touching_pairs > 0, parts > 1);
        assert_true(info.seam >= 1e-7 && info.seam < 1e-6);
    }
}

/* --- steps --- */

/* A floor whose next tile is `rise` higher, without a wall in between: a dragged HIP steps up, whether tiles have one
 * side or two. */
TEST(a_step_up_between_two_surfaces_is_climbed) {
    const double rises[4] = {5e-6, 2e-5, 1e-4, 5e-4};
    for (int i = 0; i < 8; i++) {
        const double rise = rises[i / 2];
        surface_parts parts[2] = {surface_plane(), surface_plane()};
        for (int k = 0; k < 2; k++) {
            parts[k].plane.half_extents[0] = parts[k].plane.half_extents[1] = 0.01;
            parts[k].desc.position[0] = k == 0 ? -0.01 : 0.01;
            parts[k].desc.position[2] = k == 0 ? 0.0 : rise;
            parts[k].desc.double_sided = (uint32_t)i % 2;
        }
        SCOPED_SCENE *scene = scene_with(parts, 2, 0);
        (void)tick_at(scene, -0.004, 0.0, 0.001);
        for (int k = 0; k <= 80; k++) {
            const double x = -0.004 + STEP * k + 3e-6;
            const knurl_tick_output out = tick_at(scene, x, 0.0, -DEPTH);
            if (out.contacts != 1) {
                fail_msg("a step of %g m: lost at %g", rise, x);
            }
            CHECK_CLOSE(out.depth, DEPTH + (x > 0.0 ? rise : 0.0), 1e-9L);
        }
    }
}
