/* The limit of visits in a tick: reaching it is reported and counted, and a held HIP stays held.
 * SPDX-License-Identifier: MIT */
#include "scene/scene.h"

#include "scene/ask.h"
#include "support/geometry.h"

#define K      400.0
#define RADIUS 0.03
#define PI     3.14159265358979323846

/* A sphere of longitudes and latitudes: around its poles, z up and down, `w` triangles meet in a point. n: rows. */
static shape globe(uint32_t w, uint32_t n) {
    shape s = shape_new((n + 1) * (w + 1), 6 * w * n, 0);
    uint32_t at = 0;
    for (uint32_t i = 0; i < (n + 1) * (w + 1); i++) {
        const double a = 2.0 * PI * (i % (w + 1)) / w, b = PI * (i / (w + 1)) / n;
        shape_set(&s, i, RADIUS * sin(b) * cos(a), RADIUS * sin(b) * sin(a), RADIUS * cos(b));
    }
    for (uint32_t i = 0; i < n * w; i++) {
        const uint32_t k = i / w * (w + 1) + i % w;
        at = shape_quad(&s, at, k, k + w + 1, k + w + 2, k + 1);
    }
    return s;
}

/* Triangles that all go through one place, each near 0.1 m wide. */
static shape heap_of_triangles(uint32_t count) {
    shape s = shape_new(3 * count, 3 * count, 0);
    uint64_t seed = 5;
    for (uint32_t i = 0; i < count; i++) {
        double a[3], b[3];
        random_direction(&seed, a);
        random_direction(&seed, b);
        shape_set(&s, 3 * i, 0.05 * a[0], 0.05 * a[1], 0.05 * a[2]);
        shape_set(&s, 3 * i + 1, 0.05 * b[0], 0.05 * b[1], 0.05 * b[2]);
        shape_set(&s, 3 * i + 2, -0.05 * (a[0] + b[0]), -0.05 * (a[1] + b[1]), -0.05 * (a[2] + b[2]));
        for (uint32_t k = 0; k < 3; k++) {
            s.indices[3 * i + k] = 3 * i + k;
        }
    }
    return s;
}

static surface_parts surface_shape(const shape *s, double amplitude) {
    surface_parts parts = surface_along_x(s);
    set_grating(&parts, KNURL_METHOD_S1, amplitude > 0.0 ? 100.0 : 0.0, 0.0, amplitude);
    return parts;
}

static knurl_scene *scene_within(surface_parts *parts, uint32_t max_visits) {
    knurl_scene *scene = scene_of(parts);
    scene->hips[0].contacts.budget.max = max_visits;
    return scene;
}

static uint64_t count_limits(const knurl_scene *scene) {
    return counts_of(scene).visit_limit_ticks;
}

/* All triangles are as near to its middle: 20,480 of them, whose crests reach as far as it is wide. */
TEST(crests_that_reach_through_a_mesh_meet_the_limit_which_is_reported_and_counted) {
    const uint32_t limits[2] = {KNURL_VISITS_MAX, UINT32_MAX - 1};
    SCOPED_SHAPE s = shape_sphere(0.01, 5);
    surface_parts parts = surface_shape(&s, 0.02);
    for (int i = 0; i < 2; i++) {
        SCOPED_SCENE *scene = scene_within(&parts, limits[i]);
        uint64_t met = 0;
        for (int k = 0; k < 50; k++) {
            const knurl_tick_output out = tick_at(scene, 1e-5 * k, 0.0, 0.0);
            met += (out.flags & KNURL_TICK_VISIT_LIMIT) != 0;
            assert_true(isfinite(length3(out.force)));
        }
        assert_int_equal(met > 0, i == 0);
        assert_int_equal(count_limits(scene), met);
    }
}

/* From a meridian over the pole to the next; held in every tick, by a force that is no more than the depth's. */
TEST(a_hip_that_is_held_is_held_on_when_the_visits_are_used_up) {
    SCOPED_SHAPE s = globe(96, 48);
    surface_parts parts = surface_shape(&s, 0.0);
    static const uint32_t limits[2] = {100, 1000}; /* round the pole, 96 triangles: up to five visits each, and more */
    for (int i = 0; i < 2; i++) {
        const uint32_t limit = limits[i];
        SCOPED_SCENE *scene = scene_within(&parts, limit);
        for (int k = 0; k <= 40; k++) { /* in from outside, away from the pole */
            (void)tick_at(scene, (RADIUS + 0.001 - 5e-5 * k) * sin(0.3), 1e-4, (RADIUS + 0.001 - 5e-5 * k) * cos(0.3));
        }
        for (int k = 0; k <= 600; k++) {
            const double a = 0.3 - 0.001 * k;
            const knurl_tick_output out = tick_at(scene, (RADIUS - 0.001) * sin(a), 1e-4, (RADIUS - 0.001) * cos(a));
            const double force = length3(out.force);
            if (out.contacts == 0 || !(force > 0.0) || force > K * distance3(out.hip, out.proxy) + 1e-9) {
                fail_msg("limit %u: %u contacts, %g N in tick %d", (unsigned)limit, (unsigned)out.contacts, force, k);
            }
        }
        assert_int_equal(count_limits(scene) > 0, limit == 100);
    }
}

/* Exactly onto a pole, where the proxy's walk over 96 triangles exceeds a tick's visits. */
TEST(a_contact_begins_although_the_visits_are_used_up) {
    SCOPED_SHAPE s = globe(96, 48);
    surface_parts parts = surface_shape(&s, 0.0);
    SCOPED_SCENE *scene = scene_within(&parts, KNURL_VISITS_MAX);
    for (int k = 0; k < 20; k++) {
        const double z = RADIUS + 0.0002 - 5.5e-5 * k;
        const knurl_tick_output out = tick_at(scene, 0.0, 5.5e-5, z);
        if (z < RADIUS - 1e-4 && (out.contacts == 0 || !(out.force[2] > 0.0))) {
            fail_msg("lost at z = %g", z);
        }
    }
}

/* Presses a HIP into a sphere from 2 mm outside to 1 mm inside, `step` (m) a tick, at an angle (rad) from the pole, and
 * then slides it by 3 mm. It is to be held in each tick from 0.6 mm on, by the force of `most` (m) more than its depth
 * at most. */
static void check_press(knurl_scene *scene, double angle, double step, double most) {
    double radius = RADIUS + 0.002;
    for (int k = 0; k < 160; k++) {
        const double slide = radius > RADIUS - 0.001 ? 0.0 : 0.001;
        radius -= slide > 0.0 ? 0.0 : step;
        angle += slide;
        const knurl_tick_output out = tick_at(scene, radius * sin(angle), 1e-9, radius * cos(angle));
        const double force = length3(out.force);
        if ((radius < RADIUS - 0.0006 && !(force > 0.0)) || force > K * fmax(0.0, RADIUS - radius + most)) {
            fail_msg("step %g, tick %d: %u contacts, %g N", step, k, (unsigned)out.contacts, force);
        }
    }
}

TEST(a_pole_of_any_number_of_triangles_holds_a_hip_that_is_pressed_onto_it) {
    static const uint32_t fans[3] = {256, 512, 1024};
    static const double steps[3] = {5.5e-5, 2.5e-4, 1e-3};
    for (int i = 0; i < 9; i++) {
        SCOPED_SHAPE s = globe(fans[i / 3], 16);
        surface_parts parts = surface_shape(&s, 0.0001);
        SCOPED_SCENE *scene = scene_within(&parts, KNURL_VISITS_MAX);
        check_press(scene, 0.0, steps[i % 3], 0.001);
    }
}

/* 32 spheres of 20,480 triangles each, 10 um beside one another. */
TEST(a_crowd_of_meshes_holds_a_hip_that_is_pressed_into_it) {
    SCOPED_SHAPE s = shape_sphere(RADIUS, 5);
    surface_parts parts = surface_shape(&s, 0.0);
    SCOPED_SCENE *scene = empty_scene(1);
    for (int i = 0; i < 32; i++) {
        parts.desc.position[0] = 1e-5 * i;
        (void)add_surface(scene, &parts);
    }
    (void)commit_plainly(scene);
    check_press(scene, 0.29, 1e-4, 32 * 0.002);
}

/* The crests of six planes are in reach, of which a tick has room for four; the top one, which comes last, is pressed.
 */
TEST(a_surface_that_holds_has_room_before_crests) {
    surface_parts parts = surface_plane();
    SCOPED_SCENE *scene = empty_scene(1);
    set_grating(&parts, KNURL_METHOD_S1, 100.0, 0.0, 0.0005);
    for (int i = 0; i < 6; i++) {
        parts.desc.position[2] = -5e-5 * (5 - i);
        (void)add_surface(scene, &parts);
    }
    (void)commit_plainly(scene);
    (void)tick_at(scene, 0.001, 0.001, 0.002);
    (void)tick_at(scene, 0.001, 0.001, 0.0001);
    const knurl_tick_output out = tick_at(scene, 0.001, 0.001, -0.001);
    CHECK_CLOSE(out.depth, 0.001, 1e-6);
    assert_true((out.flags & KNURL_TICK_CONTACTS_FULL) != 0);
}

/* Through a plane in a tick of 1 mm, for as many visits. The other surfaces that the tick tests first, a plane 1.5 mm
 * beside the path and a sphere 0.3 mm below its end, are not touched; with few visits they are tested a second time,
 * except that plane. Returns 1 if the visits were used up. */
static int check_only_plane_is_touched(const shape *below, uint32_t max_visits) {
    surface_parts plane = surface_plane(), sphere = surface_shape(below, 0.0);
    knurl_hip_contact contacts[KNURL_CONTACTS_MAX];
    const knurl_hip_desc desc = hip_in_scene_axes();
    SCOPED_SCENE *scene = empty_scene(1);
    plane.desc.position[0] = plane.plane.half_extents[0] + 0.0015;
    (void)add_surface(scene, &plane);
    plane.desc.position[0] = 0.0;
    const knurl_surface_id touched = add_surface(scene, &plane);
    sphere.desc.position[2] = -0.0008 - RADIUS;
    (void)add_surface(scene, &sphere);
    assert_int_equal(knurl_scene_configure_hip(scene, 0, &desc), KNURL_OK);
    scene->hips[0].contacts.budget.max = max_visits;
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    (void)tick_at(scene, 0.0, 0.0, 0.0005);
    const knurl_tick_output out = tick_at(scene, 0.0, 0.0, -0.0005);
    const uint32_t count = knurl_scene_get_contacts(scene, 0, contacts, KNURL_CONTACTS_MAX);
    for (uint32_t i = 0; i < count; i++) {
        if (contacts[i].surface != touched) {
            fail_msg("%u visits: contact with what is beside or below", (unsigned)max_visits);
        }
    }
    return (out.flags & KNURL_TICK_VISIT_LIMIT) != 0;
}

TEST(what_is_looked_at_twice_for_want_of_visits_is_not_taken_for_something_else) {
    SCOPED_SHAPE s = shape_sphere(RADIUS, 3);
    int met = 0;
    for (uint32_t limit = 1; limit <= 40; limit++) {
        met += check_only_plane_is_touched(&s, limit);
    }
    assert_true(met > 0);
}

static uint32_t exceeded_by(const shape *s, double amplitude) {
    surface_parts parts = surface_shape(s, amplitude);
    SCOPED_SCENE *scene = scene_of(&parts);
    const knurl_surface_check check = first_check(scene);
    return check.exceeded & KNURL_LIMIT_VISITS;
}

TEST(the_check_at_load_warns_of_meshes_that_meet_the_limit) {
    SCOPED_SHAPE ball = shape_sphere(0.01, 5);
    SCOPED_SHAPE earth = globe(96, 48);
    SCOPED_SHAPE heap = heap_of_triangles(2000);
    assert_int_equal(exceeded_by(&ball, 0.02), KNURL_LIMIT_VISITS);
    assert_int_equal(exceeded_by(&heap, 0.0), KNURL_LIMIT_VISITS);
    assert_int_equal(exceeded_by(&ball, 0.0005), 0);
    assert_int_equal(exceeded_by(&ball, 0.0), 0);
    assert_int_equal(exceeded_by(&earth, 0.0005), 0);
}

/* Spheres one 10 um beside the other, among planes through them: the first one's check. */
static uint32_t exceeded_by_crowd(int count, int planes) {
    SCOPED_SHAPE s = shape_sphere(RADIUS, 3);
    surface_parts parts = surface_shape(&s, 0.0);
    SCOPED_SCENE *scene = empty_scene(1);
    for (int i = 0; i < count; i++) {
        parts.desc.position[0] = 1e-5 * i;
        (void)add_surface(scene, &parts);
        surface_parts plane = surface_plane();
        for (int k = 0; i == 0 && k < planes; k++) {
            (void)add_surface(scene, &plane);
        }
    }
    (void)commit_plainly(scene);
    const knurl_surface_check check = first_check(scene);
    assert_int_equal(strstr(check.message, "16 meshes come within 1 mm") != NULL, count == 16);
    return check.exceeded & KNURL_LIMIT_VISITS;
}

TEST(the_check_at_load_warns_of_crowds_of_meshes) {
    assert_int_equal(exceeded_by_crowd(15, 0), 0);
    assert_int_equal(exceeded_by_crowd(16, 0), KNURL_LIMIT_VISITS);
}

TEST(the_check_at_load_counts_meshes_among_any_number_of_planes) {
    assert_int_equal(exceeded_by_crowd(15, 100), 0);
    assert_int_equal(exceeded_by_crowd(16, 100), KNURL_LIMIT_VISITS);
}

TEST(a_budget_of_visits_can_be_used_up_to_the_last) {
    knurl_visits budget = knurl_visits_of(KNURL_VISITS_MAX);
    assert_true(knurl_visits_take(&budget, KNURL_VISITS_MAX - 1) && knurl_visits_take(&budget, 1));
    assert_true(!budget.exhausted && budget.left > 0);
    assert_false(knurl_visits_take(&budget, 1));
    assert_true(budget.exhausted && budget.left == 0);
    assert_false(knurl_visits_take(&budget, 0));
}
