/* One tick on one surface: Eq. 9 with S1 and S2, damping, limits, frames and coordinates.
 * SPDX-License-Identifier: MIT */
#include "scene/ask.h"
#include "support/poses.h"

#define PI  3.14159265358979323846
#define K   400.0  /* N/m, the default */
#define A   0.0005 /* m */
#define TOL 1e-9L  /* N: far below the threshold of feeling, far above rounding */

static surface_parts grating_plane(int32_t method, double fsx, double fsy) {
    surface_parts parts = surface_plane();
    set_grating(&parts, method, fsx, fsy, A);
    return parts;
}

TEST(smooth_surface_pushes_with_stiffness_times_depth) {
    SCOPED_SCENE *scene = scene_of_plane();
    for (int k = -20; k <= 100; k++) {
        const double depth = 1e-5 * k;
        const knurl_tick_output out = tick_at(scene, 0.01, -0.02, -depth);
        const int touched = k > 0;
        CHECK_VECTOR(out.force, 0.0, 0.0, touched ? K * depth : 0.0, TOL);
        CHECK_VECTOR(out.device_force, out.force[0], out.force[1], out.force[2], 0.0L);
        CHECK_VECTOR(out.hip, 0.01, -0.02, -depth, 0.0L);
        if (k != 0) {
            CHECK_VECTOR(out.proxy, 0.01, -0.02, touched ? 0.0 : -depth, 0.0L);
            CHECK_VECTOR(out.normal, 0.0, 0.0, touched ? 1.0 : 0.0, 0.0L);
            CHECK_SAME(out.depth, touched ? depth : 0.0);
            assert_int_equal(out.contacts, touched);
            assert_int_equal(out.flags, touched ? KNURL_TICK_CONTACT : 0);
            assert_true(out.surface == (touched ? knurl_scene_get_surface(scene, 0) : 0));
        }
        CHECK_SAME(out.height, 0.0);
        assert_int_equal(out.event, KNURL_NO_EVENT);
        assert_int_equal(out.tick, k + 20);
    }
}

TEST(s1_follows_equations_9_and_11_at_points) {
    static const struct {
        double x, y; /* mm on a grating of 1000 x 500 cycles/m: phases x and y/2 cycles */
        int sign;
    } points[] = {
        {0.0, 0.0, 1},  {0.2, 0.0, 1},   {0.3, 0.0, -1}, {0.7, 0.0, -1},   {0.8, 0.0, 1},   {7.2, 0.0, 1},
        {-0.2, 0.0, 1}, {-0.3, 0.0, -1}, {0.0, 0.4, 1},  {0.0, 0.6, -1},   {0.0, -0.6, -1}, {0.3, 0.6, 1},
        {0.8, 1.4, -1}, {0.3, 1.4, 1},   {0.3, 1.6, -1}, {-9.3, -8.1, -1}, {12.6, 9.0, 1},
    };
    surface_parts parts = grating_plane(KNURL_METHOD_S1, 1000.0, 500.0);
    SCOPED_SCENE *scene = scene_of(&parts);
    for (size_t i = 0; i < COUNT_OF(points); i++) {
        const double height = A * points[i].sign;
        knurl_tick_output out = tick_at(scene, 1e-3 * points[i].x, 1e-3 * points[i].y, -0.001);
        CHECK_CLOSE(out.height, height, 1e-15L);
        CHECK_VECTOR(out.force, 0.0, 0.0, points[i].sign > 0 ? 0.6 : 0.2, TOL); /* 400 (0.001 +- 0.0005) */
        out = tick_at(scene, 1e-3 * points[i].x, 1e-3 * points[i].y, -0.0003);  /* above a trough's floor */
        CHECK_VECTOR(out.force, 0.0, 0.0, points[i].sign > 0 ? 0.32 : 0.0, TOL);
    }
}

TEST(cycles_tell_where_on_the_grating) {
    surface_parts parts = grating_plane(KNURL_METHOD_BANDLIMITED, 1000.0, 500.0);
    knurl_scene *scene = scene_of(&parts);
    knurl_tick_output out = tick_at(scene, 0.0123, -0.004, -0.001);
    CHECK_CLOSE(out.cycles[0], 12.3, 1e-12L);
    CHECK_CLOSE(out.cycles[1], -2.0, 1e-12L);
    out = tick_at(scene, 0.0123, -0.004, 0.1);
    CHECK_SAME(out.cycles[0], 0.0);
    CHECK_SAME(out.cycles[1], 0.0);
    knurl_scene_destroy(scene);
    parts.material.orientation = 0.5 * PI; /* x runs along the plane's y, y along its -x */
    scene = scene_of(&parts);
    out = tick_at(scene, 0.0123, -0.004, -0.001);
    CHECK_CLOSE(out.cycles[0], -4.0, 1e-12L);
    CHECK_CLOSE(out.cycles[1], -6.15, 1e-12L);
    knurl_scene_destroy(scene);
}

/* S2 at a constant speed is T3 at rate/(fs v), for all kinds of events: even, odd, mixed, above f_h/2. */
static void compare_with_events(double rate, double fs, const double velocity[3], double frequency) {
    surface_parts parts = grating_plane(KNURL_METHOD_S2, fs, 0.5 * fs);
    knurl_hip_desc hip = hip_in_scene_axes();
    knurl_vibration_event event;
    hip.update_rate_hz = rate;
    hip.max_force = 1e3;
    hip.protections = 0; /* it is 2 mm in at its first tick */
    SCOPED_SCENE *scene = scene_with_hip(&parts, &hip);
    assert_int_equal(knurl_vibration_event_prepare(rate / frequency, A, &event), KNURL_OK);
    for (int32_t k = 0; k < 5 * event.length; k++) {
        const double hip_at[3] = {0.01 * sin(k), 0.02 * cos(k), -0.002}; /* its position makes no difference */
        const knurl_tick_output out = tick_moving(scene, hip_at, velocity);
        const double height = knurl_vibration_event_height(&event, k % event.length);
        CHECK_CLOSE(out.height, height, 1e-15L);
        CHECK_VECTOR(out.force, 0.0, 0.0, K * (height + 0.002), TOL);
        assert_int_equal(out.event, k / event.length);
        CHECK_CLOSE(out.temporal_frequency, frequency, 1e-9L * frequency);
        CHECK_CLOSE(out.spatial_frequency, frequency / sqrt(velocity[0] * velocity[0] + velocity[1] * velocity[1]),
                    1e-9L * fs);
        assert_int_equal((out.flags & KNURL_TICK_ABOVE_NYQUIST) != 0, frequency > 0.5 * rate);
    }
}

TEST(s2_at_constant_speed_plays_t3_events) {
    compare_with_events(1000.0, 1000.0, (const double[3]){0.1, 0.0, 0.0}, 100.0);
    compare_with_events(1000.0, 1000.0, (const double[3]){-0.2, 0.1, 5.0}, 200.0); /* 500 x 0.1 is less */
    compare_with_events(1000.0, 1000.0, (const double[3]){0.05, -0.4, 0.0}, 200.0);
    compare_with_events(1000.0, 700.0, (const double[3]){0.2, 0.0, 0.0}, 140.0);  /* 7.14 ticks: 7 */
    compare_with_events(1000.0, 1000.0, (const double[3]){0.4, 0.0, 0.0}, 400.0); /* 2.5 ticks: the mix */
    compare_with_events(1000.0, 1000.0, (const double[3]){0.6, 0.0, 0.0}, 600.0); /* above f_h/2 */
    compare_with_events(3000.0, 1000.0, (const double[3]){0.6, 0.0, 0.0}, 600.0);
}

TEST(s2_at_rest_is_the_plain_surface) {
    surface_parts parts = grating_plane(KNURL_METHOD_S2, 1000.0, 0.0);
    SCOPED_SCENE *scene = scene_of(&parts);
    const double position[3] = {0.0, 0.0, -0.002};
    static const double still[3][3] = {{0.0, 0.0, 0.0}, {0.00099, 0.0, 0.0}, {0.0, 0.2, 0.0}}; /* or along its ridges */
    for (int i = 0; i < 3; i++) {
        const knurl_tick_output out = tick_moving(scene, position, still[i]);
        CHECK_VECTOR(out.force, 0.0, 0.0, K * 0.002, TOL);
        assert_int_equal(out.event, KNURL_NO_EVENT);
    }
}

TEST(contact_begins_at_the_crest_without_a_jump) {
    surface_parts parts = grating_plane(KNURL_METHOD_S1, 1000.0, 0.0);
    SCOPED_SCENE *scene = scene_of(&parts);
    double last = 0.0;
    for (int k = 0; k <= 200; k++) { /* down onto a crest in steps of 0.01 mm, from 0.2 mm above it */
        const double z = 0.0007 - 1e-5 * k;
        const knurl_tick_output out = tick_at(scene, 0.0, 0.0, z);
        CHECK_CLOSE(out.force[2], fmax(0.0, K * (A - z)), TOL);
        assert_true(out.force[2] - last <= K * 1.001e-5);
        if (fabs(z - A) > 1e-9) {
            assert_int_equal(out.flags & KNURL_TICK_CONTACT, z < A);
        }
        last = out.force[2];
    }
}

/* S2's highest crest is that of the 400 Hz mix, (2 + 3 sqrt(1/2))/sqrt(13) A = 1.143 A. */
TEST(contact_with_s2_begins_at_its_highest_crest) {
    surface_parts parts = grating_plane(KNURL_METHOD_S2, 1000.0, 0.0);
    SCOPED_SCENE *scene = scene_of(&parts);
    const double crest = (2.0 + 3.0 * sqrt(0.5)) / sqrt(13.0) * A;
    const double velocity[3] = {0.4, 0.0, 0.0};
    const double above[3] = {0.0, 0.0, 1.001 * crest};
    const double below[3] = {0.0, 0.0, crest - 1e-6};
    knurl_tick_output out = tick_moving(scene, above, velocity);
    CHECK_VECTOR(out.force, 0.0, 0.0, 0.0, 0.0L);
    out = tick_moving(scene, below, velocity);
    CHECK_CLOSE(out.height, crest, 1e-12L);
    CHECK_VECTOR(out.force, 0.0, 0.0, K * 1e-6, 1e-9L);
}

TEST(damping_acts_along_the_normal_and_never_pulls) {
    surface_parts parts = grating_plane(KNURL_METHOD_S1, 1000.0, 0.0);
    parts.material.damping = 5.0;
    SCOPED_SCENE *scene = scene_of(&parts);
    const double pressed[3] = {0.0, 0.0, -0.001};      /* on a crest: 0.6 N */
    const double hovering[3] = {0.0003, 0.0, -0.0003}; /* over a trough: no contact with it */
    static const struct {
        double velocity[3];
        double expected;
    } cases[] = {
        {{0.0, 0.0, 0.0}, 0.6}, {{0.0, 0.0, -0.1}, 1.1}, {{0.3, -0.2, -0.1}, 1.1}, {{0.3, 0.2, 0.0}, 0.6},
        {{0.0, 0.0, 0.1}, 0.1}, {{0.0, 0.0, 0.12}, 0.0}, {{0.0, 0.0, 0.2}, 0.0},   {{0.0, 0.0, 50.0}, 0.0},
    };
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        knurl_tick_output out = tick_moving(scene, pressed, cases[i].velocity);
        CHECK_VECTOR(out.force, 0.0, 0.0, cases[i].expected, TOL);
        out = tick_moving(scene, hovering, cases[i].velocity);
        CHECK_VECTOR(out.force, 0.0, 0.0, 0.0, 0.0L);
    }
}

/* The same stroke over a surface at the origin and over one elsewhere. */
static void compare_poses(surface_parts *parts, uint64_t seed) {
    const pose there = random_pose(&seed);
    SCOPED_SCENE *here = scene_of(parts);
    memcpy(parts->desc.position, there.position, sizeof there.position);
    memcpy(parts->desc.rotation, there.quaternion, sizeof there.quaternion);
    SCOPED_SCENE *moved = scene_of(parts);
    for (int k = 0; k < 200; k++) {
        const double hip[3] = {0.02 * sin(0.031 * k) + 1.3e-5, 0.02 * cos(0.047 * k), 0.002 * cos(0.05 * k)};
        const double velocity[3] = {0.2 * cos(0.031 * k), -0.1 * sin(0.047 * k), 0.05};
        double hip_there[3];
        double velocity_there[3];
        double force_there[3];
        const knurl_tick_output expected = tick_moving(here, hip, velocity);
        turn(there.quaternion, hip, hip_there);
        turn(there.quaternion, velocity, velocity_there);
        turn(there.quaternion, expected.force, force_there);
        for (int axis = 0; axis < 3; axis++) {
            hip_there[axis] += there.position[axis];
        }
        const knurl_tick_output out = tick_moving(moved, hip_there, velocity_there);
        CHECK_VECTOR(out.force, force_there[0], force_there[1], force_there[2], TOL);
        CHECK_CLOSE(out.depth, expected.depth, 1e-12L);
        CHECK_CLOSE(out.height, expected.height, 1e-15L);
        CHECK_CLOSE(out.surface_velocity[0], expected.surface_velocity[0], 1e-12L);
        CHECK_CLOSE(out.surface_velocity[1], expected.surface_velocity[1], 1e-12L);
        assert_int_equal(out.flags, expected.flags);
        assert_int_equal(out.event, expected.event);
    }
}

TEST(surface_elsewhere_feels_the_same) {
    SCOPED_SHAPE box = shape_box((const double[3]){0.05, 0.05, 0.01}, 0);
    for (uint64_t i = 1; i <= 8; i++) {
        surface_parts plane = grating_plane(i % 2 ? KNURL_METHOD_S1 : KNURL_METHOD_S2, 900.0, 400.0);
        plane.material.orientation = 0.3 * (double)i;
        plane.material.damping = 0.5;
        plane.desc.double_sided = i > 4;
        compare_poses(&plane, i);
        surface_parts mesh = surface_mesh(&box);
        set_grating(&mesh, i % 2 ? KNURL_METHOD_S1 : KNURL_METHOD_S2, 900.0, 400.0, A);
        mesh.desc.axis[0] = 0.8;
        mesh.desc.axis[1] = 0.6;
        compare_poses(&mesh, 10 + i);
    }
}

TEST(velocity_is_reported_in_the_surface_frame) {
    const double position[3] = {0.0, 0.0, -0.001};
    const double velocity[3] = {0.3, 0.1, 0.05};
    for (int k = 0; k < 8; k++) {
        const double angle = 0.4 * k;
        surface_parts parts = surface_plane();
        if (k < 4) {
            parts.material.orientation = angle;
        } else { /* the same by an axis, of any length, that does not lie in the plane */
            const double axis[3] = {7.0 * cos(angle), 7.0 * sin(angle), 3.0};
            memcpy(parts.desc.axis, axis, sizeof axis);
        }
        SCOPED_SCENE *scene = scene_of(&parts);
        const knurl_tick_output out = tick_moving(scene, position, velocity);
        CHECK_CLOSE(out.surface_velocity[0], 0.3 * cos(angle) + 0.1 * sin(angle), 1e-12L);
        CHECK_CLOSE(out.surface_velocity[1], 0.1 * cos(angle) - 0.3 * sin(angle), 1e-12L);
    }
}

TEST(velocity_from_behind_keeps_a_right_handed_frame) {
    surface_parts parts = surface_plane();
    parts.desc.double_sided = 1;
    SCOPED_SCENE *scene = scene_of(&parts);
    (void)tick_at(scene, 0.0, 0.0, -0.020);
    const knurl_tick_output out =
        tick_moving(scene, (const double[3]){0.0, 0.0, 0.001}, (const double[3]){0.3, 0.1, 0.0});
    CHECK_VECTOR(out.force, 0.0, 0.0, -K * 0.001, TOL);
    CHECK_CLOSE(out.surface_velocity[0], 0.3, 1e-12L);
    CHECK_CLOSE(out.surface_velocity[1], -0.1, 1e-12L); /* y = n x x */
}

/* A sheet whose uvs are mirrored or not, with S1: ridges are as painted at (u su, v sv). */
static void compare_with_paint(int mirror_u, int mirror_v, double orientation) {
    SCOPED_SHAPE sheet = shape_sheet(8, 8, (const double[2]){0.0625, 0.03125}, NULL);
    for (uint32_t v = 0; v < sheet.vertex_count; v++) { /* u runs 0 to 5, v 0 to 2: su = 0.025, sv = 0.03125 */
        sheet.uvs[2 * v] = 5.0f * (mirror_u ? 1.0f - sheet.uvs[2 * v] : sheet.uvs[2 * v]);
        sheet.uvs[2 * v + 1] = 2.0f * (mirror_v ? 1.0f - sheet.uvs[2 * v + 1] : sheet.uvs[2 * v + 1]);
    }
    surface_parts parts = surface_mesh(&sheet);
    set_grating(&parts, KNURL_METHOD_S1, 310.0, 170.0, A);
    parts.material.orientation = orientation;
    SCOPED_SCENE *scene = scene_of(&parts);
    uint64_t seed = 9;
    for (int k = 0; k < 3000; k++) {
        const double x = random_between(&seed, -0.06, 0.06);
        const double y = random_between(&seed, -0.03, 0.03);
        const double along_u = mirror_u ? 0.0625 - x : 0.0625 + x;
        const double along_v = mirror_v ? 0.03125 - y : 0.03125 + y;
        /* turned counter-clockwise, seen from the front, independent of v's direction */
        const double across = mirror_u != mirror_v ? -along_v : along_v;
        const double gx = cos(orientation) * along_u + sin(orientation) * across;
        const double gy = cos(orientation) * across - sin(orientation) * along_u;
        const double wave = cos(2.0 * PI * 310.0 * gx) * cos(2.0 * PI * 170.0 * gy);
        const knurl_tick_output out = tick_at(scene, x, y, -0.001);
        if (fabs(wave) > 1e-3) { /* floats hold an edge to some 1e-8 m */
            CHECK_CLOSE(out.height, wave > 0.0 ? A : -A, 1e-15L);
        }
    }
}

TEST(s1_by_uvs_is_felt_where_it_is_painted) {
    for (int mirrored = 0; mirrored < 4; mirrored++) {
        compare_with_paint(mirrored & 1, mirrored >> 1, 0.0);
        compare_with_paint(mirrored & 1, mirrored >> 1, 0.7);
    }
}

/* If u runs twice as fast, painted stripes are half as wide, and so are the ridges. */
TEST(s1_by_uvs_stretches_with_them) {
    SCOPED_SHAPE sheet = shape_sheet(2, 1, (const double[2]){0.05, 0.05}, NULL);
    for (uint32_t v = 0; v < 6; v++) {
        sheet.uvs[2 * v] = v % 3 == 0 ? 0.0f : v % 3 == 1 ? 1.0f : 3.0f;
    }
    surface_parts parts = surface_mesh(&sheet);
    set_grating(&parts, KNURL_METHOD_S1, 300.0, 0.0, A);
    SCOPED_SCENE *scene = scene_of(&parts);
    for (int k = 0; k < 1000; k++) {
        const double x = -0.0499 + 9.97e-5 * k;
        const double u = x < 0.0 ? (x + 0.05) / 0.05 : 1.0 + x / 0.025;
        const double wave = cos(2.0 * PI * 300.0 * u * 0.0375); /* su: half of it at 0.05 m a turn, half at 0.025 */
        if (fabs(wave) > 1e-3) {
            CHECK_CLOSE(tick_at(scene, x, 0.01, -0.001).height, wave > 0.0 ? A : -A, 1e-15L);
        }
    }
}

/* Touched from behind it is the same surface, turned over about its x. */
TEST(grating_from_behind_is_that_of_the_surface_turned_over) {
    surface_parts parts = grating_plane(KNURL_METHOD_S1, 310.0, 170.0);
    parts.material.orientation = 0.7;
    parts.desc.double_sided = 1;
    SCOPED_SCENE *behind = scene_of(&parts);
    parts.desc.double_sided = 0;
    parts.desc.rotation[0] = 1.0;
    parts.desc.rotation[3] = 0.0;
    SCOPED_SCENE *over = scene_of(&parts);
    uint64_t seed = 3;
    (void)tick_at(behind, 0.0, 0.0, -0.020);
    (void)tick_at(over, 0.0, 0.0, -0.020);
    for (int k = 0; k < 2000; k++) {
        const double hip[3] = {random_between(&seed, -0.05, 0.05), random_between(&seed, -0.05, 0.05), 0.001};
        const double velocity[3] = {0.3, 0.1, -0.2};
        const knurl_tick_output expected = tick_moving(over, hip, velocity);
        const knurl_tick_output out = tick_moving(behind, hip, velocity);
        CHECK_VECTOR(out.force, expected.force[0], expected.force[1], expected.force[2], TOL);
        CHECK_SAME(out.height, expected.height);
        CHECK_CLOSE(out.surface_velocity[0], expected.surface_velocity[0], 1e-12L);
        CHECK_CLOSE(out.surface_velocity[1], expected.surface_velocity[1], 1e-12L);
    }
}

/* TEXCOORD_0 gives +x; TANGENT is 30 degrees from it, leans out of the surface, and is not of unit length. */
TEST(tangents_go_before_uvs) {
    float tangents[9 * 4];
    SCOPED_SHAPE sheet = shape_sheet(2, 2, (const double[2]){0.05, 0.05}, NULL);
    for (int v = 0; v < 9; v++) {
        tangents[4 * v] = (float)(2.0 * cos(PI / 6.0));
        tangents[4 * v + 1] = (float)(2.0 * sin(PI / 6.0));
        tangents[4 * v + 2] = 1.0f;
        tangents[4 * v + 3] = -1.0f;
    }
    surface_parts parts = surface_mesh(&sheet);
    parts.mesh.tangents = tangents;
    SCOPED_SCENE *scene = scene_of(&parts);
    const knurl_tick_output out =
        tick_moving(scene, (const double[3]){0.01, 0.02, -0.001}, (const double[3]){0.3, 0.1, 0.0});
    CHECK_CLOSE(out.surface_velocity[0], 0.3 * cos(PI / 6.0) + 0.1 * sin(PI / 6.0), 1e-7L);
    CHECK_CLOSE(out.surface_velocity[1], 0.1 * cos(PI / 6.0) - 0.3 * sin(PI / 6.0), 1e-7L);
}
