/* Friction, an elastic-Coulomb element: a spring of the material's K from an anchor on the surface to the proxy, which
 * gives way at mu K times the depth. Expected values from the element's equations. SPDX-License-Identifier: MIT */
#include "scene/ask.h"
#include "support/poses.h"

#define K     400.0  /* N/m, the default */
#define MU    0.5    /* in most tests: slips at half the depth */
#define DEPTH 0.001  /* m, in most tests: loaded by 0.4 N, slips at 0.5 mm and 0.2 N */
#define TOL   1e-12L /* N */

static surface_parts rough_plane(double friction) {
    surface_parts parts = surface_plane();
    parts.plane.half_extents[0] = parts.plane.half_extents[1] = 0.5;
    parts.material.friction = friction;
    return parts;
}

/* A scene whose HIP 0 has come straight down on the origin. */
static knurl_scene *pressed(surface_parts *parts, double depth) {
    knurl_scene *scene = scene_of(parts);
    (void)tick_at(scene, 0.0, 0.0, 0.005);
    (void)tick_at(scene, 0.0, 0.0, -depth);
    return scene;
}

/* The same of most tests. */
static knurl_scene *pressed_plane(void) {
    surface_parts parts = rough_plane(MU);
    return pressed(&parts, DEPTH);
}

TEST(pressed_straight_down_nothing_pulls_sideways) {
    SCOPED_SCENE *scene = pressed_plane();
    for (int k = 0; k < 50; k++) {
        CHECK_VECTOR(tick_at(scene, 0.0, 0.0, -1e-4 * k).force, 0.0, 0.0, K * 1e-4 * k, TOL);
    }
}

TEST(sticks_with_the_stiffness_and_slips_at_mu_times_the_load) {
    for (int way = 0; way < 8; way++) {
        SCOPED_SCENE *scene = pressed_plane();
        const double cx = cos(0.7 * way);
        const double cy = sin(0.7 * way);
        for (int k = 0; k <= 200; k++) {
            const double gone = 1e-5 * k;
            const double pull = K * fmin(gone, MU * DEPTH);
            const knurl_tick_output out = tick_at(scene, cx * gone, cy * gone, -DEPTH);
            CHECK_VECTOR(out.force, -pull * cx, -pull * cy, K * DEPTH, TOL);
            CHECK_VECTOR(out.normal, 0.0, 0.0, 1.0, 0.0L);
            CHECK_CLOSE(out.depth, DEPTH, 1e-15L);
        }
    }
}

TEST(friction_that_is_never_exceeded_only_sticks) {
    surface_parts parts = rough_plane(1e6);
    SCOPED_SCENE *scene = pressed(&parts, DEPTH);
    for (int k = 0; k <= 400; k++) {
        CHECK_VECTOR(tick_at(scene, 1e-4 * k, -2e-4 * k, -DEPTH).force, -K * 1e-4 * k, K * 2e-4 * k, K * DEPTH, 1e-10);
    }
}

/* The element in the plane, step by step. */
typedef struct element {
    double anchor[2];
    double force[2];
} element;

static void step_element(element *e, double x, double y, double friction, double depth) {
    const double limit = friction * depth;
    double dx = x - e->anchor[0];
    double dy = y - e->anchor[1];
    const double length = sqrt(dx * dx + dy * dy);
    if (length > limit) {
        dx *= limit / length;
        dy *= limit / length;
        e->anchor[0] = x - dx;
        e->anchor[1] = y - dy;
    }
    e->force[0] = -K * dx;
    e->force[1] = -K * dy;
}

/* Any path and depth, also with turns and changes of pressure. */
static void compare_with_element(surface_parts *parts, const pose *p, uint64_t seed, long double tolerance) {
    element e = {{0.0, 0.0}, {0.0, 0.0}};
    double local[3] = {0.0, 0.0, 0.005};
    double hip[3];
    place(parts, p);
    SCOPED_SCENE *scene = scene_of(parts);
    pose_point(p, local, hip);
    (void)tick_at(scene, hip[0], hip[1], hip[2]);
    local[2] = -DEPTH;
    pose_point(p, local, hip);
    (void)tick_at(scene, hip[0], hip[1], hip[2]);
    double heading = 0.0;
    for (int k = 0; k < 3000; k++) {
        double force[3];
        const double step = random_between(&seed, 0.0, 1e-4);
        heading += random_between(&seed, -0.3, 0.3) + (random_integer(&seed, 0, 50) == 0 ? 3.0 : 0.0);
        local[0] = fmax(-0.03, fmin(0.03, local[0] + step * cos(heading)));
        local[1] = fmax(-0.03, fmin(0.03, local[1] + step * sin(heading)));
        local[2] = fmax(-0.003, fmin(-0.0001, local[2] + random_between(&seed, -1e-4, 1e-4)));
        step_element(&e, local[0], local[1], parts->material.friction, -local[2]);
        pose_point(p, local, hip);
        turn(p->quaternion, (const double[3]){e.force[0], e.force[1], -K * local[2]}, force);
        CHECK_VECTOR(tick_at(scene, hip[0], hip[1], hip[2]).force, force[0], force[1], force[2], tolerance);
    }
}

TEST(strokes_at_random_follow_the_element) {
    uint64_t seed = 77;
    const pose home = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}};
    for (uint64_t run = 1; run <= 6; run++) {
        surface_parts parts = rough_plane(0.15 * (double)run);
        compare_with_element(&parts, &home, run, TOL);
        const pose there = random_pose(&seed);
        compare_with_element(&parts, &there, run, 1e-10L);
    }
}

/* The same sheet as a mesh, flat (which may become a plane) and kept a mesh. */
TEST(strokes_over_a_turned_mesh_follow_the_element) {
    uint64_t seed = 78;
    SCOPED_SHAPE sheet = shape_sheet(16, 16, (const double[2]){0.0625, 0.0625}, NULL);
    for (uint64_t run = 1; run <= 4; run++) {
        const pose there = random_pose(&seed);
        surface_parts parts = surface_along_x(&sheet);
        parts.material.friction = 0.2 * (double)run;
        compare_with_element(&parts, &there, run, 1e-9L);
    }
}

/* Over a sphere: never above mu times the load, against its motion, and at the limit once it does. */
TEST(friction_on_a_sphere_opposes_the_way_it_slides) {
    SCOPED_SHAPE ball = shape_sphere(0.05, 4);
    surface_parts parts = surface_mesh(&ball);
    parts.material.friction = MU;
    parts.desc.axis[2] = 1.0;
    SCOPED_SCENE *scene = scene_of(&parts);
    for (int turn_index = 0; turn_index < 4; turn_index++) {
        const double tilt = 0.5 * turn_index;
        (void)tick_at(scene, 0.06, 0.0, 0.0);
        for (int k = 0; k < 800; k++) { /* round a great circle, 0.1 mm a tick */
            const double r = 0.048;
            const double angle = 1e-4 * k / r;
            const double along[3] = {-sin(angle), cos(angle) * cos(tilt), cos(angle) * sin(tilt)};
            const knurl_tick_output out =
                tick_at(scene, r * cos(angle), r * sin(angle) * cos(tilt), r * sin(angle) * sin(tilt));
            double tangent[3];
            add3(out.force, -dot3(out.force, out.normal), out.normal, tangent);
            const double load = K * out.depth;
            assert_int_equal(out.contacts, 1);
            assert_true(length3(tangent) <= MU * load * (1.0 + 1e-9));
            CHECK_CLOSE(dot3(out.force, out.normal), load, 1e-9L);
            if (k > 40) { /* some facets' corners later */
                assert_true(dot3(tangent, along) < -0.9 * MU * load);
            }
        }
    }
}

/* --- energy --- */

/* To and fro by X: the loop of an elastic-Coulomb element has the area 4 mu N (X - x0), x0 = mu N/K (Dahl). Summed
 * over whole turns from one turning point to the next, in steps that meet every corner of the loop. */
static void check_loop(double amplitude) {
    enum { TURN = 400, FROM = TURN + TURN / 4, TURNS = 3 };
    SCOPED_SCENE *scene = pressed_plane();
    const double excess = fmax(0.0, amplitude - MU * DEPTH);
    double last_x = 0.0;
    double last_force = 0.0;
    double work = 0.0;
    for (int k = 1; k <= FROM + TURNS * TURN; k++) {
        const int phase = k % TURN;
        const double x = amplitude * 0.01 * (phase <= 100 ? phase : phase <= 300 ? 200 - phase : phase - 400);
        const double force = tick_at(scene, x, 0.0, -DEPTH).force[0];
        work -= k > FROM ? 0.5 * (force + last_force) * (x - last_x) : 0.0;
        last_x = x;
        last_force = force;
    }
    CHECK_CLOSE(work, TURNS * 4.0 * MU * K * DEPTH * excess, 1e-12L);
}

TEST(strokes_to_and_fro_lose_the_area_of_the_hysteresis_loop) {
    check_loop(0.0004); /* below the slip distance: nothing is lost */
    check_loop(0.0010);
    check_loop(0.0020);
    check_loop(0.0050);
}

/* On any path at a constant depth, the surface never returns more energy than it received. */
TEST(no_way_along_the_surface_yields_energy) {
    uint64_t seed = 99;
    for (int run = 0; run < 20; run++) {
        surface_parts parts = rough_plane(random_between(&seed, 0.05, 1.5));
        SCOPED_SCENE *scene = pressed(&parts, DEPTH);
        const double step = run % 2 ? 1e-4 : 3e-3; /* also leaps beyond the slip distance */
        double last[2] = {0.0, 0.0};
        double last_force[2] = {0.0, 0.0};
        double work = 0.0;
        for (int k = 0; k < 2000; k++) {
            double at[2];
            for (int i = 0; i < 2; i++) {
                at[i] = k % 100 == 99 ? 0.0 : fmax(-0.3, fmin(0.3, last[i] + random_between(&seed, -step, step)));
            }
            const knurl_tick_output out = tick_at(scene, at[0], at[1], -DEPTH);
            for (int i = 0; i < 2; i++) {
                work -= 0.5 * (out.force[i] + last_force[i]) * (at[i] - last[i]);
                last[i] = at[i];
                last_force[i] = out.force[i];
            }
            assert_true(work >= -1e-13);
        }
    }
}

/* --- loading and unloading --- */

TEST(letting_up_lets_it_slip) {
    SCOPED_SCENE *scene = pressed_plane();
    (void)tick_at(scene, 0.0004, 0.0, -DEPTH); /* sticks: 0.16 N of 0.2 N */
    knurl_tick_output out = tick_at(scene, 0.0004, 0.0, -0.5 * DEPTH);
    CHECK_VECTOR(out.force, -MU * K * 0.5 * DEPTH, 0.0, K * 0.5 * DEPTH, TOL);
    out = tick_at(scene, 0.0004, 0.0, -DEPTH); /* pressed again: the anchor has come nearer */
    CHECK_VECTOR(out.force, -MU * K * 0.5 * DEPTH, 0.0, K * DEPTH, TOL);
}

TEST(lifted_off_it_is_forgotten) {
    SCOPED_SCENE *scene = pressed_plane();
    (void)tick_at(scene, 0.0004, 0.0, -DEPTH);
    CHECK_VECTOR(tick_at(scene, 0.0004, 0.0, 0.001).force, 0.0, 0.0, 0.0, 0.0L);
    CHECK_VECTOR(tick_at(scene, 0.0004, 0.0, -DEPTH).force, 0.0, 0.0, K * DEPTH, TOL); /* straight down again */
    CHECK_VECTOR(tick_at(scene, 0.0003, 0.0, -DEPTH).force, K * 1e-4, 0.0, K * DEPTH, TOL);
}

/* S1: at x = 0 on a crest, at 5 mm in a trough; the anchor's load is the depth alone. */
TEST(height_does_not_load_it) {
    surface_parts parts = rough_plane(MU);
    set_grating(&parts, KNURL_METHOD_S1, 100.0, 0.0, 0.0005);
    SCOPED_SCENE *scene = pressed(&parts, DEPTH);
    knurl_tick_output out = tick_at(scene, 0.001, 0.0, -DEPTH);
    CHECK_VECTOR(out.force, -MU * K * DEPTH, 0.0, K * (DEPTH + 0.0005), TOL);
    out = tick_at(scene, 0.005, 0.0, -DEPTH);
    CHECK_VECTOR(out.force, -MU * K * DEPTH, 0.0, K * (DEPTH - 0.0005), TOL);
    out = tick_at(scene, 0.010, 0.0, 0.0003); /* on a crest's flank, above the surface: not loaded */
    CHECK_VECTOR(out.force, 0.0, 0.0, K * 0.0002, TOL);
    out = tick_at(scene, 0.0104, 0.0, 0.0003);
    CHECK_VECTOR(out.force, 0.0, 0.0, K * 0.0002, TOL);
}

TEST(damping_does_not_load_it) {
    surface_parts parts = rough_plane(MU);
    parts.material.damping = 5.0;
    SCOPED_SCENE *scene = pressed(&parts, DEPTH);
    const double at[3] = {0.003, 0.0, -DEPTH};
    const double into[3] = {0.0, 0.0, -0.1};
    CHECK_VECTOR(tick_moving(scene, at, into).force, -MU * K * DEPTH, 0.0, K * DEPTH + 0.5, TOL);
}

TEST(friction_leaves_the_normal_force_alone) {
    surface_parts parts = rough_plane(0.0);
    set_grating(&parts, KNURL_METHOD_S2, 700.0, 300.0, 0.0004);
    parts.material.damping = 0.7;
    SCOPED_SCENE *without = pressed(&parts, DEPTH);
    parts.material.friction = 0.8;
    SCOPED_SCENE *with = pressed(&parts, DEPTH);
    uint64_t seed = 6;
    double x = 0.0;
    double y = 0.0;
    for (int k = 0; k < 2000; k++) {
        x += random_between(&seed, 0.0, 3e-4) * (k / 500 % 2 ? -1.0 : 1.0);
        y += random_between(&seed, -2e-4, 2e-4);
        const double z = -0.001 + 0.0012 * sin(0.01 * k);
        const knurl_tick_output a = tick_at(without, x, y, z);
        const knurl_tick_output b = tick_at(with, x, y, z);
        CHECK_SAME(a.force[0], 0.0);
        CHECK_SAME(a.force[2], b.force[2]);
        CHECK_SAME(a.height, b.height);
        assert_int_equal(a.event, b.event);
    }
}

/* Friction 0 is the same as before friction existed: a caller that does not know the key. */
TEST(friction_0_is_bit_for_bit_a_material_without_the_key) {
    SCOPED_SHAPE ball = shape_sphere(0.03, 3);
    for (int mesh = 0; mesh < 2; mesh++) {
        surface_parts parts = mesh ? surface_mesh(&ball) : surface_plane();
        set_grating(&parts, KNURL_METHOD_S2, 900.0, 0.0, 0.0003);
        parts.desc.axis[0] = 1.0;
        parts.desc.position[2] = mesh ? -0.03 : 0.0;
        parts.material.damping = 0.4;
        SCOPED_SCENE *zero = scene_of(&parts);
        parts.material.friction = 7.0; /* not read */
        parts.material.struct_size = offsetof(knurl_material_desc, friction);
        SCOPED_SCENE *older = scene_of(&parts);
        uint64_t seed = 14;
        double x = -0.02;
        for (int k = 0; k < 3000; k++) {
            x += k < 1500 ? 2.6e-5 : -2.6e-5;
            const double z = random_between(&seed, -0.001, 0.0) + 0.001 * cos(0.02 * k);
            const knurl_tick_output a = tick_at(zero, x, 0.3 * x, z);
            const knurl_tick_output b = tick_at(older, x, 0.3 * x, z);
            check_same_output(&a, &b);
        }
    }
}

TEST(friction_taken_away_in_contact_is_gone_at_the_next_tick) {
    surface_parts parts = rough_plane(MU);
    SCOPED_SCENE *scene = pressed(&parts, DEPTH);
    const knurl_surface_id id = knurl_scene_get_surface(scene, 0);
    CHECK_CLOSE(tick_at(scene, 0.003, 0.0, -DEPTH).force[0], -MU * K * DEPTH, TOL);
    parts.material.friction = 0.0;
    assert_int_equal(knurl_scene_set_material(scene, id, &parts.material), KNURL_OK);
    CHECK_VECTOR(tick_at(scene, 0.003, 0.0, -DEPTH).force, 0.0, 0.0, K * DEPTH, TOL);
    parts.material.friction = MU; /* and back: never more than the limit, with any anchor */
    assert_int_equal(knurl_scene_set_material(scene, id, &parts.material), KNURL_OK);
    const knurl_tick_output out = tick_at(scene, 0.02, 0.0, -DEPTH);
    assert_true(out.force[0] <= 0.0 && out.force[0] >= -MU * K * DEPTH * (1.0 + 1e-12));
}

/* --- surfaces that move --- */

TEST(surface_that_slides_drags_a_resting_hip) {
    SCOPED_SCENE *scene = pressed_plane();
    glide_to(scene, 0.01, 0.0, 0.0, 0.2); /* 0.05 mm a tick */
    for (int k = 1; k <= 250; k++) {
        const double gone = fmin(5e-5 * k, 0.01);
        CHECK_VECTOR(tick_at(scene, 0.0, 0.0, -DEPTH).force, K * fmin(gone, MU * DEPTH), 0.0, K * DEPTH, TOL);
    }
    glide_to(scene, 0.0, 0.0, 0.0, 0.2);
    for (int k = 1; k <= 30; k++) { /* and back: first it relaxes, then it drags in the other direction */
        CHECK_CLOSE(tick_at(scene, 0.0, 0.0, -DEPTH).force[0], K * fmax(MU * DEPTH - 5e-5 * k, -MU * DEPTH), TOL);
    }
}

TEST(a_surface_that_moves_with_the_hip_has_no_friction) {
    SCOPED_SCENE *scene = pressed_plane();
    glide_to(scene, 0.05, 0.02, 0.01, 0.1);
    for (int k = 1; k <= 100; k++) {
        const knurl_tick_output out = tick_at(scene, 0.0005 * k, 0.0002 * k, -DEPTH + 0.0001 * k);
        CHECK_VECTOR(out.force, 0.0, 0.0, K * DEPTH, 1e-10L);
    }
}

/* The anchor turns with the surface: from r to R(angle) r, and the spring to it with it. */
TEST(surface_that_turns_takes_the_anchor_along) {
    static const double z[3] = {0.0, 0.0, 1.0};
    const double at[3] = {0.1, 0.02, -DEPTH};
    surface_parts parts = rough_plane(2.0); /* slips at 2 mm */
    SCOPED_SCENE *scene = scene_of(&parts);
    pose end = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}};
    (void)tick_at(scene, at[0], at[1], 0.005);
    (void)tick_at(scene, at[0], at[1], at[2]);
    turn_about(z, 0.015, end.quaternion); /* 1.5 mm of motion */
    move_to(scene, knurl_scene_get_surface(scene, 0), &end, 0.1);
    for (int k = 1; k <= 120; k++) {
        const double angle = 0.00015 * (k < 100 ? k : 100);
        const double anchor[2] = {cos(angle) * at[0] - sin(angle) * at[1], sin(angle) * at[0] + cos(angle) * at[1]};
        CHECK_VECTOR(tick_at(scene, at[0], at[1], at[2]).force, K * (anchor[0] - at[0]), K * (anchor[1] - at[1]),
                     K * DEPTH, 1e-11L);
    }
}

TEST(jump_of_the_surface_starts_friction_anew) {
    SCOPED_SCENE *scene = pressed_plane();
    (void)tick_at(scene, 0.0003, 0.0, -DEPTH);
    glide_to(scene, 0.1, 0.0, 0.0, 0.0);
    CHECK_VECTOR(tick_at(scene, 0.0003, 0.0, -DEPTH).force, 0.0, 0.0, K * DEPTH, TOL);
}
