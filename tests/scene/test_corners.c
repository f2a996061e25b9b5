/* Where surfaces meet: a HIP that is pressed into one and slides into the next is held by both, whether the two are
 * planes, meshes or one mesh, and however their edges are split. SPDX-License-Identifier: MIT */
#include "support/geometry.h"
#include "support/scenes.h"

#include <stdio.h>

#define K     400.0  /* N/m, the default */
#define DEPTH 0.001  /* m, how far the HIP is pressed in */
#define STEP  100e-6 /* m a tick */

/* A triangle list that grows, each triangle with vertices of its own: where they stand in one place they are welded. */
typedef struct patch {
    shape s;
    uint32_t used;
} patch;

static patch patch_new(uint32_t triangles) {
    patch p = {shape_new(3 * triangles, 3 * triangles, 0), 0};
    return p;
}

static void add_triangle(patch *p, const double a[3], const double b[3], const double c[3]) {
    const double *corners[3] = {a, b, c};
    assert_true(p->used + 3 <= p->s.index_count);
    for (int k = 0; k < 3; k++) {
        shape_set(&p->s, p->used, corners[k][0], corners[k][1], corners[k][2]);
        p->s.indices[p->used] = p->used;
        p->used++;
    }
}

/* A parallelogram from `at` along u (in `parts` strips) and v; its front is where u x v points. */
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

/* Its grating runs along y, as the corners and grooves here do. */
static surface_parts surface_shape(const shape *s) {
    surface_parts parts = surface_mesh(s);
    parts.desc.axis[1] = 1.0;
    return parts;
}

static knurl_scene *scene_with(surface_parts *parts, int count, uint32_t full_model) {
    knurl_scene_desc desc;
    knurl_scene *scene = NULL;
    knurl_scene_desc_init(&desc, sizeof desc);
    desc.full_model = full_model;
    assert_int_equal(knurl_scene_create(&desc, &scene), KNURL_OK);
    configure_plainly(scene, 0);
    for (int i = 0; i < count; i++) {
        (void)add_surface(scene, &parts[i]);
    }
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    return scene;
}

/* --- a floor (z = 0, where x > 0) and a wall (x = 0, where z > 0) --- */

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
    parts.desc.rotation[1] = parts.desc.rotation[3] = sqrt(0.5); /* z becomes x */
    return parts;
}

/* The wall is left where the floor's edge is: its bottom is one edge, the floor's may be split. */
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
    const uint32_t models[2] = {0, KNURL_FULL_ALL};
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
    shape floor = floor_shape(1);
    shape wall = wall_shape(1);
    surface_parts parts[2] = {surface_shape(&floor), surface_shape(&wall)};
    check_corner(parts, 2, "two meshes");
    surface_parts mixed[2] = {floor_plane(), surface_shape(&wall)};
    check_corner(mixed, 2, "a plane and a mesh");
    shape_free(&floor);
    shape_free(&wall);
}

TEST(a_floor_that_goes_on_beneath_the_wall_does_not_carry_the_hip_under_it) {
    shape wall = wall_shape(2);
    surface_parts parts[2] = {floor_plane(), wall_plane()};
    parts[0].desc.position[0] = 0.0;
    check_corner(parts, 2, "two planes");
    parts[1] = surface_shape(&wall);
    check_corner(parts, 2, "a plane and a mesh");
    shape_free(&wall);
}

TEST(a_corner_in_one_mesh_holds_with_a_shared_edge_and_with_one_that_is_split) {
    for (int floors = 1; floors <= 3; floors++) {
        for (int walls = 1; walls <= 3; walls++) {
            shape floor = floor_shape(floors);
            shape wall = wall_shape(walls);
            shape both = shape_join(&floor, &wall);
            surface_parts parts = surface_shape(&both);
            char what[64];
            (void)snprintf(what, sizeof what, "one mesh, its edge split in %d and %d", floors, walls);
            check_corner(&parts, 1, what);
            shape_free(&both);
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
    shape s = groove(rise, parts);
    surface_parts mesh = surface_shape(&s);
    knurl_scene *scene = scene_of(&mesh);
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
    knurl_scene_destroy(scene);
    shape_free(&s);
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

/* A steep groove that moves up and across under a HIP at rest: its bottom, where both walls hold the proxy, moves over
 * the place where that was. */
TEST(a_steep_groove_that_moves_keeps_the_hip_out) {
    const double q[4] = {0.0, 0.0, 0.0, 1.0};
    for (int parts = 1; parts <= 3; parts++) {
        shape s = groove(2.0, parts);
        surface_parts mesh = surface_shape(&s);
        knurl_scene *scene = scene_of(&mesh);
        (void)tick_at(scene, 0.0, 0.001, 0.001);
        for (int k = 1; k <= 60; k++) {
            const double up = 0.001 + 0.0005 * (k / 10.0);
            const double position[3] = {k % 20 < 10 ? 0.0002 : -0.0002, 0.0, up};
            if (k % 10 == 0) {
                assert_int_equal(knurl_scene_set_transform(scene, knurl_scene_get_surface(scene, 0), position, q, 0.01),
                                 KNURL_OK);
            }
            const knurl_tick_output out = tick_at(scene, 0.0, 0.001, 0.0);
            if (k > 20 && (out.contacts == 0 || !(out.force[2] > 0.0) || (out.flags & KNURL_TICK_SQUEEZED))) {
                fail_msg("bottom edge split in %d: lost in tick %d", parts, k);
            }
        }
        knurl_scene_destroy(scene);
        shape_free(&s);
    }
}

/* --- uneven sheets --- */

static uint64_t uneven_seed;
static double unevenness;

static double uneven(double x, double y) {
    (void)x;
    (void)y;
    return random_between(&uneven_seed, 0.0, unevenness);
}

/* A sheet of 8 x 8 quads of 5 mm whose middle quad is cut anew: one of its edges is split in two for its own triangles,
 * and not for its neighbour's (a T-junction); offset: m that the new vertex is off the edge's middle, upwards. */
static shape uneven_sheet(uint64_t seed, double height, double offset) {
    uneven_seed = seed;
    unevenness = height;
    shape sheet = shape_sheet(8, 8, (const double[2]){0.02, 0.02}, uneven);
    patch p = patch_new(sheet.index_count / 3 + 1);
    const uint32_t cut = 2 * (8 * 4 + 4); /* the first triangle of the quad at (4, 4): its edge from 0 to 1 is split */
    for (uint32_t i = 0; i < sheet.index_count / 3; i++) {
        double c[3][3];
        shape_corners(&sheet, i, c);
        if (i == cut) {
            const double middle[3] = {0.5 * (c[0][0] + c[1][0]), 0.5 * (c[0][1] + c[1][1]),
                                      0.5 * (c[0][2] + c[1][2]) + offset};
            add_triangle(&p, c[0], middle, c[2]);
            add_triangle(&p, middle, c[1], c[2]);
        } else {
            add_triangle(&p, c[0], c[1], c[2]);
        }
    }
    shape_free(&sheet);
    return p.s;
}

/* Height of a shape over (x, y): of the highest triangle there. */
static double height_at(const shape *s, double x, double y) {
    double highest = -HUGE_VAL;
    for (uint32_t i = 0; i < s->index_count / 3; i++) {
        double c[3][3];
        double n[3];
        double across = 0.0;
        shape_corners(s, i, c);
        (void)normal3((const double (*)[3])c, n);
        for (int k = 0; k < 3; k++) {
            const double *a = c[k], *b = c[(k + 1) % 3];
            across = fmin(across, (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]));
        }
        if (across > -1e-12) {
            highest = fmax(highest, c[0][2] - (n[0] * (x - c[0][0]) + n[1] * (y - c[0][1])) / n[2]);
        }
    }
    return highest;
}

/* Presses and short strokes at random near the split edge; how many were lost of `presses`. */
static int press_uneven(const shape *s, uint64_t seed, int presses) {
    int lost = 0;
    surface_parts parts = surface_shape(s);
    knurl_scene *scene = scene_of(&parts);
    for (int i = 0; i < presses; i++) {
        double at[2] = {0.0025 + random_between(&seed, -0.003, 0.003), random_between(&seed, -0.001, 0.001)};
        const double way[2] = {random_between(&seed, -1e-4, 1e-4), random_between(&seed, -1e-4, 1e-4)};
        const double depth = random_between(&seed, 2e-4, 2e-3);
        int fell = 0;
        (void)tick_at(scene, at[0], at[1], 0.003);
        for (int k = 1; k <= 60; k++) {
            const double z = 0.003 - fmin(1.0, k / 30.0) * (0.003 + depth);
            at[0] += k > 30 ? way[0] : 0.0;
            at[1] += k > 30 ? way[1] : 0.0;
            const knurl_tick_output out = tick_at(scene, at[0], at[1], z);
            fell |= z < height_at(s, at[0], at[1]) - 1e-6 && !(length3(out.force) > 0.0);
        }
        lost += fell;
        (void)tick_at(scene, at[0], at[1], 0.003);
    }
    knurl_scene_destroy(scene);
    return lost;
}

/* From above straight down, then along four legs below all of the sheet. Returns 1 where contact was lost. */
static int stroke_below(knurl_scene *scene, double deep, uint64_t *seed) {
    double at[3] = {random_between(seed, -0.004, 0.004), random_between(seed, -0.004, 0.004), 0.004};
    int lost = 0;
    configure_plainly(scene, 0);
    (void)tick_at(scene, at[0], at[1], at[2]);
    for (int leg = 0; leg < 5 && !lost; leg++) {
        const double to[3] = {leg == 0 ? at[0] : random_between(seed, -0.004, 0.004),
                              leg == 0 ? at[1] : random_between(seed, -0.004, 0.004),
                              leg == 0 ? -deep : random_between(seed, -deep, 0.0)};
        const double from[3] = {at[0], at[1], at[2]};
        const int ticks = (int)(distance3(from, to) / STEP) + 1;
        for (int k = 1; k <= ticks && !lost; k++) {
            for (int i = 0; i < 3; i++) {
                at[i] = from[i] + (to[i] - from[i]) * k / ticks;
            }
            const knurl_tick_output out = tick_at(scene, at[0], at[1], at[2]);
            lost = at[2] < -1e-5 && !(length3(out.force) > 0.0);
        }
    }
    return lost;
}

/* Heights of 2 mm on cells of 1 mm: facets turn by more than 90 degrees. A proxy in such a fold, lifted by a seam off
 * the one facet, was behind the other. */
TEST(a_sheet_of_sharp_folds_holds_deep_strokes) {
    int lost = 0;
    for (uint64_t seed = 1; seed <= 4; seed++) {
        uint64_t random = seed;
        uneven_seed = seed;
        unevenness = 0.002;
        shape sheet = shape_sheet(40, 40, (const double[2]){0.02, 0.02}, uneven);
        surface_parts parts = surface_mesh(&sheet);
        parts.desc.axis[0] = 1.0;
        knurl_scene *scene = scene_of(&parts);
        for (int i = 0; i < 100; i++) {
            lost += stroke_below(scene, 0.002, &random);
        }
        knurl_scene_destroy(scene);
        shape_free(&sheet);
    }
    assert_int_equal(lost, 0);
}

TEST(an_uneven_sheet_with_a_t_junction_holds) {
    const double heights[3] = {20e-6, 200e-6, 1e-3};
    for (int i = 0; i < 3; i++) {
        int lost = 0;
        for (uint64_t seed = 1; seed <= 10; seed++) {
            shape s = uneven_sheet(seed, heights[i], 0.0);
            lost += press_uneven(&s, 100 + seed, 100);
            shape_free(&s);
        }
        if (lost > 0) {
            fail_msg("uneven by %g m: %d of 1000 presses lost", heights[i], lost);
        }
    }
}

/* --- slivers --- */

/* Two triangles, each a surface of its own, flat and so a plane with an outline, share an edge. The HIP comes straight
 * down onto a point of that edge, where rounding puts the crossing beside either outline. Returns 1 where it is held.
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
    knurl_scene *scene = scene_with(parts, 2, 0);
    double at[3];
    const double share = random_between(seed, 0.1, 0.9);
    for (int i = 0; i < 3; i++) {
        at[i] = corners[0][i] + share * (corners[2][i] - corners[0][i]);
    }
    at[1] = at[0]; /* the edge runs where x = y */
    const double speed = random_between(seed, 1e-4, 1e-3);
    knurl_tick_output out;
    for (int k = 3; k >= -1; k--) {
        out = tick_at(scene, at[0], at[1], at[2] + (k + 0.5) * speed);
    }
    knurl_scene_destroy(scene);
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

/* The same sheet with the split vertex lifted by a hair, and a sliver that fills what opens. */
TEST(a_sliver_in_an_uneven_sheet_loses_no_stroke) {
    const double hairs[4] = {1e-9, 1e-8, 1e-7, 1e-6};
    for (int i = 0; i < 4; i++) {
        int lost = 0;
        for (uint64_t seed = 1; seed <= 10; seed++) {
            shape s = uneven_sheet(seed, 20e-6, hairs[i]);
            lost += press_uneven(&s, 200 + seed, 100);
            shape_free(&s);
        }
        if (lost > 0) {
            fail_msg("a vertex off its edge by %g m: %d of 1000 presses lost", hairs[i], lost);
        }
    }
}

TEST(a_triangle_of_no_size_beside_the_hip_is_no_surface) {
    shape tiny = shape_new(3, 3, 0);
    for (uint32_t v = 0; v < 3; v++) {
        tiny.positions[3 * v] = v == 1 ? 1e-33f : 0.0f;
        tiny.positions[3 * v + 1] = v == 2 ? 1e-33f : 0.0f;
        tiny.indices[v] = v;
    }
    surface_parts plate = surface_plane();
    surface_parts parts = surface_shape(&tiny);
    knurl_surface_id id = 0;
    knurl_scene *scene = empty_scene(1);
    configure_plainly(scene, 0);
    (void)add_surface(scene, &plate);
    const knurl_result result = knurl_scene_add_surface(scene, surface_ready(&parts), &id);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    for (int k = 0; k < 40; k++) {
        const knurl_tick_output out = tick_at(scene, 1e-11 * (k - 20), 1e-11, 1e-4 - 1e-5 * k);
        assert_true(isfinite(length3(out.force)));
    }
    assert_int_equal(result, KNURL_ERROR_ARGUMENT);
    knurl_scene_destroy(scene);
    shape_free(&tiny);
}

TEST(a_mesh_that_touches_itself_is_told) {
    for (int parts = 1; parts <= 2; parts++) {
        shape s = groove(0.5, parts);
        surface_parts mesh = surface_shape(&s);
        knurl_surface_info info;
        knurl_scene *scene = scene_of(&mesh);
        knurl_surface_info_init(&info, sizeof info);
        assert_int_equal(knurl_scene_get_surface_info(scene, knurl_scene_get_surface(scene, 0), &info), KNURL_OK);
        assert_int_equal(info.touching_pairs > 0, parts > 1);
        assert_true(info.seam >= 1e-7 && info.seam < 1e-6);
        knurl_scene_destroy(scene);
        shape_free(&s);
    }
}

/* --- steps --- */

/* A floor whose next tile lies `rise` higher, with nothing between the two: what is dragged along steps up. */
TEST(a_step_up_between_two_surfaces_is_climbed) {
    const double rises[4] = {5e-6, 2e-5, 1e-4, 5e-4};
    for (int i = 0; i < 4; i++) {
        surface_parts parts[2] = {surface_plane(), surface_plane()};
        for (int k = 0; k < 2; k++) {
            parts[k].plane.half_extents[0] = parts[k].plane.half_extents[1] = 0.01;
            parts[k].desc.position[0] = k == 0 ? -0.01 : 0.01;
            parts[k].desc.position[2] = k == 0 ? 0.0 : rises[i];
        }
        knurl_scene *scene = scene_with(parts, 2, 0);
        (void)tick_at(scene, -0.004, 0.0, 0.001);
        for (int k = 0; k <= 80; k++) {
            const double x = -0.004 + STEP * k + 3e-6;
            const knurl_tick_output out = tick_at(scene, x, 0.0, -DEPTH);
            if (out.contacts != 1) {
                fail_msg("a step of %g m: lost at %g", rises[i], x);
            }
            CHECK_CLOSE(out.depth, DEPTH + (x > 0.0 ? rises[i] : 0.0), 1e-9L);
        }
        knurl_scene_destroy(scene);
    }
}
