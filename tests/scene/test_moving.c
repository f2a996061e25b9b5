/* Surfaces that move: their pose at each tick, their sliding speed under a HIP, and the force on it.
 * SPDX-License-Identifier: MIT */
#include "moving.h"

TEST(surface_rises_evenly_and_stays) {
    knurl_surface_id id;
    SCOPED_SCENE *scene = stood_on_plane(&id);
    raise_to(scene, id, 0.005, 0.05);
    for (int k = 1; k <= 80; k++) {
        const knurl_tick_output out = stand_at(scene, 0.0, 0.0, -0.001);
        const double depth = 0.001 + 0.005 * (k < 50 ? k : 50) / 50.0;
        CHECK_CLOSE(out.depth, depth, 1e-12L);
        CHECK_VECTOR(out.force, 0.0, 0.0, K * depth, TOL);
        CHECK_VECTOR(out.proxy, 0.0, 0.0, depth - 0.001, 1e-12L);
    }
}

/* Eq. 9's damping: 0.1 m/s towards the HIP are as good as the HIP's own. */
TEST(damping_takes_the_relative_velocity_along_the_normal) {
    surface_parts parts = wide_plane();
    parts.material.damping = 5.0;
    knurl_surface_id id;
    SCOPED_SCENE *scene = stood_on(&parts, &id);
    raise_to(scene, id, 0.005, 0.05);
    for (int k = 1; k <= 60; k++) {
        const knurl_tick_output out = stand_at(scene, 0.0, 0.0, -0.001);
        if (k != 50) { /* at the very end it may still be reported as moving */
            CHECK_CLOSE(out.force[2], K * out.depth + (k < 50 ? 5.0 * 0.1 : 0.0), TOL);
        }
    }
    raise_to(scene, id, 0.0, 0.005); /* 1 m/s away: no pull */
    for (int k = 1; k < 5; k++) {
        CHECK_VECTOR(stand_at(scene, 0.0, 0.0, -0.001).force, 0.0, 0.0, 0.0, 0.0L);
    }
}

/* The surface slides at 0.1 m/s under a HIP that rests: T3 events at f_t = fs v = 100 Hz. */
TEST(sliding_under_a_resting_hip_plays_events) {
    surface_parts parts = wide_plane();
    knurl_vibration_event event;
    knurl_surface_id id;
    set_grating(&parts, KNURL_METHOD_S2, 1000.0, 0.0, 0.0005);
    SCOPED_SCENE *scene = stood_on(&parts, &id);
    const pose end = at_height(0.02, 0.0, 0.0);
    assert_int_equal(knurl_vibration_event_prepare(10.0, 0.0005, &event), KNURL_OK);
    move_to(scene, id, &end, 0.2);
    for (int k = 1; k < 200; k++) {
        const knurl_tick_output out = stand_at(scene, 0.0, 0.0, -0.001);
        CHECK_CLOSE(out.surface_velocity[0], -0.1, 1e-12L);
        CHECK_CLOSE(out.surface_velocity[1], 0.0, 1e-12L);
        CHECK_CLOSE(out.temporal_frequency, 100.0, 1e-8L);
        CHECK_CLOSE(out.height, knurl_vibration_event_height(&event, (k - 1) % 10), 1e-15L);
        assert_int_equal(out.event, (k - 1) / 10);
        CHECK_CLOSE(out.force[2], K * (out.height + 0.001), TOL);
    }
    for (int k = 0; k < 30; k++) {
        const knurl_tick_output out = stand_at(scene, 0.0, 0.0, -0.001);
        if (k > 12) { /* the last event is over */
            assert_int_equal(out.event, KNURL_NO_EVENT);
            CHECK_SAME(out.surface_velocity[0], 0.0);
        }
    }
}

TEST(a_surface_that_moves_with_the_hip_plays_no_ridges) {
    surface_parts parts = wide_plane();
    knurl_surface_id id;
    set_grating(&parts, KNURL_METHOD_S2, 1000.0, 500.0, 0.0005);
    parts.material.damping = 5.0;
    SCOPED_SCENE *scene = stood_on(&parts, &id);
    const pose end = at_height(0.04, 0.02, 0.01);
    move_to(scene, id, &end, 0.2);
    for (int k = 1; k < 200; k++) {
        const double at[3] = {0.0002 * k, 0.0001 * k, -0.001 + 0.00005 * k};
        const knurl_tick_output out = tick_moving(scene, at, (const double[3]){0.2, 0.1, 0.05});
        CHECK_CLOSE(out.surface_velocity[0], 0.0, 1e-12L);
        CHECK_CLOSE(out.surface_velocity[1], 0.0, 1e-12L);
        CHECK_CLOSE(out.force[2], K * 0.001, TOL);
        assert_int_equal(out.event, KNURL_NO_EVENT);
    }
}

/* About an origin at a distance of 0.22 m: omega x r passes the HIP. `turns`: rad in 0.1 s. The long way round: the
 * same target, named by the quaternion's negative, or by an angle beyond half a turn. */
static void rotate_under(double angle, double shown_angle, double sign) {
    static const double z[3] = {0.0, 0.0, 1.0};
    const double hip[3] = {0.2, 0.1, -0.001};
    surface_parts parts = wide_plane();
    SCOPED_SCENE *scene = scene_of(&parts);
    pose end = HOME;
    turn_about(z, shown_angle, end.quaternion);
    for (int i = 0; i < 4; i++) {
        end.quaternion[i] *= sign;
    }
    (void)stand_at(scene, hip[0], hip[1], hip[2]);
    move_to(scene, knurl_scene_get_surface(scene, 0), &end, 0.1);
    const double omega = angle / 0.1;
    for (int k = 1; k <= 120; k++) {
        const knurl_tick_output out = stand_at(scene, hip[0], hip[1], hip[2]);
        const double now = angle * (k < 100 ? k : 100) / 100.0;
        const double v[2] = {k < 100 ? omega * hip[1] : 0.0, k < 100 ? -omega * hip[0] : 0.0}; /* -omega x r */
        if (k != 100) {
            CHECK_CLOSE(out.surface_velocity[0], cos(now) * v[0] + sin(now) * v[1], 1e-9L);
            CHECK_CLOSE(out.surface_velocity[1], cos(now) * v[1] - sin(now) * v[0], 1e-9L);
        }
        CHECK_VECTOR(out.force, 0.0, 0.0, K * 0.001, TOL);
    }
}

TEST(rotation_about_an_origin_elsewhere_slides_by_omega_cross_r) {
    rotate_under(0.5, 0.5, 1.0);
    rotate_under(-1.2, -1.2, 1.0);
    rotate_under(0.002, 0.002, 1.0);
    rotate_under(3.0, 3.0, 1.0);
}

TEST(rotation_goes_the_short_way) {
    const double whole = 8.0 * atan(1.0);
    rotate_under(0.5, 0.5, -1.0);
    rotate_under(0.75 * whole - whole, 0.75 * whole, 1.0);
    rotate_under(-0.3, whole - 0.3, -1.0);
}

/* A plane's motion from one pose to another within 40 ms. */
typedef struct way {
    pose from;
    double axis[3], angle, shift[3];
} way;

static pose pose_at(const way *w, double share) {
    pose p;
    double part[4];
    turn_about(w->axis, w->angle * share, part);
    turn_after(part, w->from.quaternion, p.quaternion);
    add3(w->from.position, share, w->shift, p.position);
    return p;
}

/* Checks a HIP at rest at a share of the plane's motion; returns 0 once the plane has left it. */
static int check_on_the_way(knurl_scene *scene, const double *hip, const way *w, double share) {
    const pose now = pose_at(w, share);
    double normal[3];
    double offset[3];
    double lever[3]; /* p - origin, p the contact point */
    double swept[3];
    double relative[3];
    double x[3];
    double y[3];
    turn(now.quaternion, (const double[3]){0.0, 0.0, 1.0}, normal);
    turn(now.quaternion, (const double[3]){1.0, 0.0, 0.0}, x);
    turn(now.quaternion, (const double[3]){0.0, 1.0, 0.0}, y);
    add3(hip, -1.0, now.position, offset);
    const double depth = -dot3(offset, normal);
    const knurl_tick_output out = stand_at(scene, hip[0], hip[1], hip[2]);
    if (depth < 1e-6) {
        return 0;
    }
    CHECK_CLOSE(out.depth, depth, 1e-9L);
    CHECK_VECTOR(out.normal, normal[0], normal[1], normal[2], 1e-9L);
    add3(offset, depth, normal, lever);
    cross3(w->axis, lever, swept);
    for (int i = 0; i < 3; i++) {
        relative[i] = -w->shift[i] / 0.04 - w->angle / 0.04 * swept[i];
    }
    CHECK_CLOSE(out.surface_velocity[0], dot3(relative, x), 1e-8L);
    CHECK_CLOSE(out.surface_velocity[1], dot3(relative, y), 1e-8L);
    return 1;
}

/* Turned about a slanting axis and moved at once: every tick has the closed form of a screw-free motion, position
 * linear, rotation at a constant angular velocity. */
TEST(place_and_turn_on_the_way_have_their_closed_forms) {
    uint64_t seed = 12;
    for (int run = 0; run < 20; run++) {
        way w;
        random_direction(&seed, w.axis);
        w.from = random_pose(&seed);
        w.angle = random_between(&seed, 0.1, 0.3);
        for (int i = 0; i < 3; i++) {
            w.shift[i] = random_between(&seed, -0.01, 0.01);
        }
        const pose to = pose_at(&w, 1.0);
        surface_parts parts = wide_plane();
        place(&parts, &w.from);
        SCOPED_SCENE *scene = scene_of(&parts);
        double hip[3];
        pose_point(&w.from, (const double[3]){0.001, -0.002, 0.02}, hip); /* first in front: comes in when it is time */
        (void)stand_at(scene, hip[0], hip[1], hip[2]);
        pose_point(&w.from, (const double[3]){0.001, -0.002, -0.008}, hip);
        (void)stand_at(scene, hip[0], hip[1], hip[2]);
        move_to(scene, knurl_scene_get_surface(scene, 0), &to, 0.04);
        int k = 1;
        while (k < 40 && check_on_the_way(scene, hip, &w, k / 40.0)) {
            k++;
        }
    }
}

/* About any axis, exactly or nearly half a turn, in whole or in half: the normal stays in the plane of the turn. */
TEST(half_a_turn_goes_about_its_own_axis) {
    for (int axis = 0; axis < 3; axis++) {
        pose turned = at_height(0.1, 0.2, 0.3);
        surface_parts parts = wide_plane();
        SCOPED_SCENE *scene = scene_of(&parts);
        const knurl_surface_id id = knurl_scene_get_surface(scene, 0);
        turned.quaternion[3] = 0.0;
        turned.quaternion[axis] = 1.0;
        move_to(scene, id, &turned, 0.1);
        for (int tick = 1; tick <= 100; tick++) {
            (void)stand_at(scene, 0.0, 0.0, 2.0);
            const plane_frame now = frame_of(scene, id);
            for (int i = 0; i < 3; i++) {
                CHECK_CLOSE(now.axes[i][i], i == axis ? 1.0 : cos(3.1415926535897932 * tick / 100.0), 1e-9);
            }
        }
    }
}

/* At its target it is exactly like a surface placed there from the start: the same numbers, bit for bit. */
TEST(arrival_is_exactly_at_the_target) {
    uint64_t seed = 31;
    for (int run = 0; run < 20; run++) {
        const pose from = random_pose(&seed);
        const pose to = random_pose(&seed);
        surface_parts parts = wide_plane();
        set_grating(&parts, KNURL_METHOD_S1, 300.0, 170.0, 0.0005);
        place(&parts, &to);
        SCOPED_SCENE *there = scene_of(&parts);
        place(&parts, &from);
        SCOPED_SCENE *moved = scene_of(&parts);
        move_to(moved, knurl_scene_get_surface(moved, 0), &to, 0.003 * run); /* also 0, also not whole ticks */
        for (int k = 0; k < 3 * run + 3; k++) {
            (void)stand_at(moved, 5.0, 5.0, 5.0);
            (void)stand_at(there, 5.0, 5.0, 5.0);
        }
        for (int k = 0; k < 50; k++) {
            double hip[3];
            const double local[3] = {0.003 * k - 0.07, 0.02, k == 0 ? 0.003 : -0.001 + 1e-5 * k};
            pose_point(&to, local, hip);
            const knurl_tick_output expected = stand_at(there, hip[0], hip[1], hip[2]);
            const knurl_tick_output out = stand_at(moved, hip[0], hip[1], hip[2]);
            assert_true(k == 0 || out.contacts == 1);
            check_same_output(&expected, &out);
        }
    }
}

TEST(new_target_on_the_way_goes_on_from_where_it_is) {
    knurl_surface_id id;
    SCOPED_SCENE *scene = stood_on_plane(&id);
    raise_to(scene, id, 0.005, 0.05);
    for (int k = 1; k <= 20; k++) { /* 2 mm up */
        CHECK_CLOSE(stand_at(scene, 0.0, 0.0, -0.001).depth, 0.001 + 0.0001 * k, 1e-12L);
    }
    raise_to(scene, id, 0.001, 0.02);
    for (int k = 1; k <= 30; k++) { /* 1 mm down again in 20 ticks */
        CHECK_CLOSE(stand_at(scene, 0.0, 0.0, -0.001).depth, 0.003 - 0.00005 * (k < 20 ? k : 20), 1e-12L);
    }
}

/* Like a game: a new target every frame, for any frame length, before or after the last one was reached. */
TEST(targets_frame_by_frame_make_no_jumps) {
    uint64_t seed = 5;
    knurl_surface_id id;
    SCOPED_SCENE *scene = stood_on_plane(&id);
    double z = 0.0;
    double last = 0.001;
    double fastest = 0.0;
    int left = 0;
    for (int k = 0; k < 3000; k++) {
        if (left-- == 0) {
            const double frame = random_between(&seed, 0.004, 0.03);
            const double target = random_between(&seed, 0.0, 0.008);
            pose p = at_height(0.0, 0.0, target);
            move_to(scene, id, &p, frame);
            fastest = fabs(target - z) / frame;
            left = (int)random_integer(&seed, 3, 30);
        }
        const knurl_tick_output out = stand_at(scene, 0.0, 0.0, -0.001);
        assert_true(fabs(out.depth - last) <= 1.0001e-3 * fastest + 1e-12);
        last = out.depth;
        z = last - 0.001;
    }
}

/* A new turn half way through another: the normal continues from there. */
TEST(new_turn_on_the_way_goes_on_from_where_it_is) {
    static const double y[3] = {0.0, 1.0, 0.0};
    knurl_surface_id id;
    SCOPED_SCENE *scene = stood_on_plane(&id);
    pose end = HOME;
    turn_about(y, 0.4, end.quaternion);
    move_to(scene, id, &end, 0.1);
    for (int k = 1; k <= 50; k++) {
        const knurl_tick_output out = stand_at(scene, 0.0, 0.0, -0.001);
        CHECK_VECTOR(out.normal, sin(0.004 * k), 0.0, cos(0.004 * k), 1e-12L);
    }
    turn_about(y, -0.1, end.quaternion);
    move_to(scene, id, &end, 0.1);
    for (int k = 1; k <= 120; k++) {
        const double angle = 0.2 - 0.003 * (k < 100 ? k : 100);
        const knurl_tick_output out = stand_at(scene, 0.0, 0.0, -0.001);
        CHECK_VECTOR(out.normal, sin(angle), 0.0, cos(angle), 1e-12L);
    }
}

TEST(before_the_commit_a_way_is_made_at_once) {
    surface_parts parts = wide_plane();
    SCOPED_SCENE *scene = empty_scene(1);
    const knurl_surface_id id = add_surface(scene, &parts);
    configure_plainly(scene, 0);
    raise_to(scene, id, 0.003, 5.0);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    const knurl_tick_output out = stand_at(scene, 0.0, 0.0, 0.001);
    CHECK_VECTOR(out.force, 0.0, 0.0, K * 0.002, TOL);
    CHECK_CLOSE(out.surface_velocity[0], 0.0, 0.0L);
}
