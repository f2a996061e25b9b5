/* Walls that come to the HIP: nothing tunnels, and a surface that moves feels as a HIP that moves over it does.
 * SPDX-License-Identifier: MIT */
#include "scene/ask.h"
#include "support/poses.h"

#define K    400.0 /* N/m, the default */
#define TICK 0.001 /* s */

static double hills(double x, double y) {
    return 0.004 * sin(50.0 * x) * cos(40.0 * y);
}

/* --- nothing tunnels --- */

/* Flat walls with their front towards +z, at z = 0. */
static surface_parts wall(int kind, shape *s) {
    if (kind == 0) {
        surface_parts parts = surface_plane();
        parts.plane.half_extents[0] = parts.plane.half_extents[1] = 0.1;
        return parts;
    }
    if (kind == 1) {
        *s = shape_sheet(6, 6, (const double[2]){0.1, 0.1}, NULL);
    } else { /* a plate of 1 mm: a fast one is through within a tick */
        *s = shape_box((const double[3]){0.1, 0.1, 0.0005}, 0);
        for (uint32_t v = 0; v < s->vertex_count; v++) {
            s->positions[3 * v + 2] -= 0.0005f;
        }
    }
    surface_parts parts = surface_along_x(s);
    return parts;
}

static knurl_scene *wall_scene(surface_parts *parts, uint32_t full_model) {
    knurl_scene *scene = scene_of_model(full_model);
    (void)add_surface(scene, parts);
    return commit_plainly(scene);
}

/* m in front of a pose's xy plane. */
static double height_over(const pose *p, const double hip[3]) {
    double normal[3];
    double offset[3];
    turn(p->quaternion, (const double[3]){0.0, 0.0, 1.0}, normal);
    add3(hip, -1.0, p->position, offset);
    return dot3(offset, normal);
}

static void check_held(const knurl_tick_output *out, double height) {
    if (height > 1e-7) {
        CHECK_CLOSE(length3(out->force), 0.0, 0.0L);
    } else if (height < -1e-7) {
        assert_int_equal(out->contacts, 1);
        CHECK_CLOSE(out->depth, -height, 1e-7L); /* a mesh's floats */
        CHECK_CLOSE(length3(out->force), -K * height, K * 1e-7L);
    }
}

/* The wall comes at one speed, frame by frame, the HIP at another; up to 2 m/s between them. */
static void meet_head_on(int kind, uint32_t full_model, uint64_t *seed) {
    SCOPED_SHAPE s = {0};
    surface_parts parts = wall(kind, &s);
    const pose from = random_pose(seed);
    double normal[3];
    double drift[3];
    double hip[3];
    double wall_velocity[3];
    double hip_velocity[3];
    turn(from.quaternion, (const double[3]){0.0, 0.0, 1.0}, normal);
    turn(from.quaternion, (const double[3]){random_between(seed, -0.3, 0.3), random_between(seed, -0.3, 0.3), 0.0},
         drift);
    const double approach = random_between(seed, 0.05, 2.0);
    const double share = random_between(seed, -1.0, 2.0); /* beyond 0 to 1: one flees, the other is faster */
    for (int i = 0; i < 3; i++) {
        wall_velocity[i] = share * approach * normal[i] + drift[i];
        hip_velocity[i] = (share - 1.0) * approach * normal[i];
    }
    place(&parts, &from);
    pose_point(&from,
               (const double[3]){random_between(seed, -0.03, 0.03), random_between(seed, -0.03, 0.03),
                                 random_between(seed, 0.0005, 0.01)},
               hip);
    SCOPED_SCENE *scene = wall_scene(&parts, full_model);
    (void)tick_moving(scene, hip, hip_velocity);
    pose now = from;
    const int frame = (int)random_integer(seed, 1, 20); /* ticks */
    const int ticks = (int)(0.02 / (approach * TICK)) + 2;
    for (int k = 0; k < ticks && k < 60; k++) {
        if (k % frame == 0) {
            pose target = now;
            add3(now.position, frame * TICK, wall_velocity, target.position);
            move_to(scene, knurl_scene_get_surface(scene, 0), &target, frame * TICK);
        }
        add3(now.position, TICK, wall_velocity, now.position);
        add3(hip, TICK, hip_velocity, hip);
        const knurl_tick_output out = tick_moving(scene, hip, hip_velocity);
        check_held(&out, height_over(&now, hip));
    }
}

TEST(no_wall_that_comes_head_on_tunnels) {
    uint64_t seed = 21;
    for (int run = 0; run < 300; run++) {
        meet_head_on(run % 3, run % 2 ? 0 : 1, &seed);
    }
}

/* A paddle swings round at the HIP, 2 m/s at its place at most. */
static void swing(int kind, uint32_t full_model, uint64_t *seed) {
    static const double x[3] = {1.0, 0.0, 0.0};
    SCOPED_SHAPE s = {0};
    surface_parts parts = wall(kind, &s);
    const double radius = random_between(seed, 0.02, 0.09);
    const double omega = random_between(seed, 0.5, 2.0) / radius;
    const double hip[3] = {random_between(seed, -0.05, 0.05), radius, 0.0};
    const double start = -random_between(seed, 0.05, 0.4);
    pose from = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}};
    turn_about(x, start, from.quaternion); /* its +y edge is below the HIP and comes up */
    place(&parts, &from);
    SCOPED_SCENE *scene = wall_scene(&parts, full_model);
    (void)tick_moving(scene, hip, (const double[3]){0.0, 0.0, 0.0});
    pose end = from;
    const int ticks =
        (int)fmin(50.0, 2.0 / (omega * TICK)); /* less than half a turn, so that the direction is unique */
    turn_about(x, start + omega * TICK * ticks, end.quaternion);
    move_to(scene, knurl_scene_get_surface(scene, 0), &end, TICK * ticks);
    for (int k = 1; k <= ticks && start + omega * TICK * k < 0.5; k++) {
        pose now = from;
        turn_about(x, start + omega * TICK * k, now.quaternion);
        const knurl_tick_output out = tick_moving(scene, hip, (const double[3]){0.0, 0.0, 0.0});
        check_held(&out, height_over(&now, hip));
    }
}

/* A box that comes along each axis to a HIP that has long stood still there. */
TEST(a_surface_that_reaches_a_resting_hip_from_any_side_is_felt) {
    for (int way = 0; way < 6; way++) {
        const double sign = way % 2 ? -1.0 : 1.0, half[3] = {0.05, 0.05, 0.05};
        SCOPED_SHAPE box = shape_box(half, 0);
        surface_parts parts = surface_along_x(&box);
        SCOPED_SCENE *scene = scene_of(&parts);
        double at[3] = {0.01, 0.01, 0.01}, target[3] = {0.0, 0.0, 0.0};
        at[way / 2] = 0.3 * sign;
        target[way / 2] = 0.251 * sign; /* 1 mm of the box is over the HIP */
        for (int tick = 0; tick < 20; tick++) {
            assert_true(tick_at(scene, at[0], at[1], at[2]).surface == 0);
        }
        glide_to(scene, target[0], target[1], target[2], 0.5);
        for (int tick = 0; tick < 499; tick++) {
            (void)tick_at(scene, at[0], at[1], at[2]);
        }
        const knurl_tick_output out = tick_at(scene, at[0], at[1], at[2]);
        CHECK_CLOSE(out.force[way / 2], 400.0 * 0.001 * sign, 0.01);
    }
}

TEST(no_paddle_that_swings_round_tunnels) {
    uint64_t seed = 22;
    for (int run = 0; run < 300; run++) {
        swing(run % 3, run % 2 ? 0 : 1, &seed);
    }
}

/* From behind a HIP is never held, at any speed. */
TEST(single_sided_wall_that_comes_from_behind_passes) {
    surface_parts parts = surface_plane();
    pose p = {{0.0, 0.0, 0.0203}, {0.0, 0.0, 0.0, 1.0}};
    place(&parts, &p);
    SCOPED_SCENE *scene = scene_of(&parts);
    (void)tick_at(scene, 0.0, 0.0, 0.0);
    p.position[2] = -0.0297;
    move_to(scene, knurl_scene_get_surface(scene, 0), &p, 0.05);
    for (int k = 0; k < 60; k++) {
        assert_int_equal(tick_at(scene, 0.0, 0.0, 0.0).contacts, 0);
    }
}

TEST(double_sided_wall_that_comes_from_behind_pushes) {
    surface_parts parts = surface_plane();
    pose p = {{0.0, 0.0, 0.0205}, {0.0, 0.0, 0.0, 1.0}}; /* farther than a first tick captures */
    parts.desc.double_sided = 1;
    place(&parts, &p);
    SCOPED_SCENE *scene = scene_of(&parts);
    (void)tick_at(scene, 0.0, 0.0, 0.0);
    p.position[2] = -0.0195;
    move_to(scene, knurl_scene_get_surface(scene, 0), &p, 0.04);
    for (int k = 1; k <= 40; k++) {
        const knurl_tick_output out = tick_at(scene, 0.0, 0.0, 0.0);
        CHECK_CLOSE(out.force[2], k > 20 ? -K * (0.001 * k - 0.0205) : 0.0, 1e-9L);
    }
}

/* --- Galilei --- */

static void compare_told(const knurl_tick_output *moving, const knurl_tick_output *resting, const double force[3]) {
    const long double tolerance = 1e-9L * (1.0 + length3(force));
    CHECK_VECTOR(moving->force, force[0], force[1], force[2], tolerance);
    CHECK_CLOSE(moving->depth, resting->depth, 1e-12L);
    CHECK_CLOSE(moving->height, resting->height, 1e-12L);
    CHECK_CLOSE(moving->surface_velocity[0], resting->surface_velocity[0], 1e-9L);
    CHECK_CLOSE(moving->surface_velocity[1], resting->surface_velocity[1], 1e-9L);
    assert_int_equal(moving->contacts, resting->contacts);
    assert_int_equal(moving->event, resting->event);
}

/* A HIP at rest, from 20 mm above the hills straight down to a place in them. */
static void press_down(knurl_scene *scene, const double at[3]) {
    const double above[3] = {at[0], at[1], 0.02};
    const double none[3] = {0.0, 0.0, 0.0};
    (void)tick_moving(scene, above, none);
    (void)tick_moving(scene, at, none);
}

/* Hills glide past a HIP that rests, as the HIP glides over hills that rest. */
static void compare_gliding(int32_t method, const double velocity[3], double friction) {
    SCOPED_SHAPE sheet = shape_sheet(60, 60, (const double[2]){0.1, 0.1}, hills);
    surface_parts parts = surface_along_x(&sheet);
    set_grating(&parts, method, 731.0, 0.0, 0.0003);
    parts.material.damping = 0.5;
    parts.material.friction = friction;
    SCOPED_SCENE *moving = scene_of(&parts);
    SCOPED_SCENE *resting = scene_of(&parts);
    const double at[3] = {0.0131, -0.0173, -0.0062};
    const double none[3] = {0.0, 0.0, 0.0};
    press_down(moving, at);
    press_down(resting, at);
    pose end = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}};
    add3(end.position, -0.2, velocity, end.position);
    move_to(moving, knurl_scene_get_surface(moving, 0), &end, 0.2);
    uint32_t touched = 0;
    for (int k = 1; k < 200; k++) {
        double there[3];
        add3(at, TICK * k, velocity, there);
        const knurl_tick_output expected = tick_moving(resting, there, velocity);
        const knurl_tick_output out = tick_moving(moving, at, none);
        compare_told(&out, &expected, expected.force);
        touched += out.contacts;
    }
    assert_true(touched > 150);
}

TEST(mesh_that_glides_feels_as_a_hip_that_glides_over_it) {
    for (int friction = 0; friction < 2; friction++) {
        compare_gliding(KNURL_METHOD_S2, (const double[3]){0.23, 0.11, -0.003}, 0.4 * friction);
        compare_gliding(KNURL_METHOD_S2, (const double[3]){-0.31, 0.03, 0.004}, 0.4 * friction);
        compare_gliding(KNURL_METHOD_S1, (const double[3]){0.1701, -0.2303, -0.005}, 0.4 * friction);
    }
}

/* Hills turn about the scene's z under a HIP that rests, as the HIP circles over hills that rest. Smooth ones: the
 * velocity over the surface is taken at the proxy, that of a HIP which circles is the HIP's. */
static void compare_turning(double omega, double friction) {
    static const double z[3] = {0.0, 0.0, 1.0};
    SCOPED_SHAPE sheet = shape_sheet(60, 60, (const double[2]){0.1, 0.1}, hills);
    surface_parts parts = surface_along_x(&sheet);
    parts.material.friction = friction;
    SCOPED_SCENE *moving = scene_of(&parts);
    SCOPED_SCENE *resting = scene_of(&parts);
    const double at[3] = {0.0431, -0.0273, -0.0062};
    const double none[3] = {0.0, 0.0, 0.0};
    press_down(moving, at);
    press_down(resting, at);
    pose end = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}};
    turn_about(z, -0.3 * omega, end.quaternion);
    move_to(moving, knurl_scene_get_surface(moving, 0), &end, 0.3);
    for (int k = 1; k < 300; k++) {
        double q[4];
        double there[3];
        double velocity[3];
        double force[3];
        turn_about(z, omega * TICK * k, q);
        turn(q, at, there);
        cross3(z, there, velocity);
        add3(none, omega, velocity, velocity);
        const knurl_tick_output expected = tick_moving(resting, there, velocity);
        const knurl_tick_output out = tick_moving(moving, at, none);
        q[2] = -q[2]; /* back */
        turn(q, expected.force, force);
        assert_int_equal(out.contacts, 1);
        CHECK_VECTOR(out.force, force[0], force[1], force[2], 1e-9L * (1.0 + length3(force)));
    }
}

TEST(mesh_that_turns_feels_as_a_hip_that_circles_over_it) {
    compare_turning(1.7, 0.0);
    compare_turning(-4.1, 0.0);
    compare_turning(2.3, 0.3);
}
