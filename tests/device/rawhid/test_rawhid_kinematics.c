/* The arm of a WoodenHaptics: against poses that can be drawn, differences, virtual work, and the simulation's own
 * kinematics. SPDX-License-Identifier: MIT */
#include "support/close.h"

#include "base/vec3.h"
#include "device/rawhid/geometry.h"
#include "device/rawhid/hid_sim.h"
#include "device/rawhid/kinematics.h"

#include <stdlib.h>

#define PI   3.14159265358979323846
#define HALF 0.1 /* m: of the cube that poses are taken from, which holds the makers' sphere */

static knurl_rawhid_geometry geometry;
static knurl_rawhid_arm arm;

static int set_up(void **state) {
    (void)state;
    knurl_rawhid_geometry_init(&geometry);
    knurl_rawhid_arm_init(&arm, &geometry);
    return 0;
}

/* Angles at a random position. */
static void random_angles(uint64_t *seed, double angles[3]) {
    double position[3];
    random_vector(seed, -HALF, HALF, position);
    assert_int_equal(knurl_rawhid_inverse(&arm, position, angles), 1);
}

TEST(a_turn_of_a_motor_turns_its_body_by_the_ratio_of_the_diameters) {
    static const int16_t counts[3] = {2000, -1000, 500};
    double angles[3];
    knurl_rawhid_angles(&arm, counts, angles);
    CHECK_CLOSE(angles[0], 2.0 * PI / 16.0, 1e-15);
    CHECK_CLOSE(angles[1], -PI / 12.0, 1e-15);
    CHECK_CLOSE(angles[2], 0.5 * PI / 12.0, 1e-15);
}

/* 6000 counts are three turns of the motor, a quarter of the body's. */
TEST(in_the_home_pose_the_upper_arm_is_upright_and_the_forearm_points_at_the_user) {
    static const int16_t counts[3] = {0, 0, 6000};
    double angles[3];
    double position[3];
    knurl_rawhid_angles(&arm, counts, angles);
    knurl_rawhid_position(&arm, angles, position);
    CHECK_CLOSE(position[0], 0.0, 1e-12);
    CHECK_CLOSE(position[1], 0.080 + 0.205 - 0.080, 1e-12);
    CHECK_CLOSE(position[2], 0.245 - 0.220, 1e-12);
    assert_int_equal(knurl_rawhid_is_pose(&arm, angles), 1);
}

TEST(turning_the_base_to_the_right_takes_the_grip_to_the_right) {
    const double angles[3] = {0.5 * PI, 0.0, 0.5 * PI};
    double position[3];
    knurl_rawhid_position(&arm, angles, position);
    CHECK_CLOSE(position[0], 0.245, 1e-12);
    CHECK_CLOSE(position[1], 0.205, 1e-12);
    CHECK_CLOSE(position[2], -0.220, 1e-12);
}

TEST(a_sign_of_minus_1_turns_a_body_and_its_current_the_other_way) {
    static const int16_t counts[3] = {100, 200, 300};
    const double angles[3] = {0.1, 0.3, 0.7};
    const double force[3] = {1.0, 2.0, -1.0};
    knurl_rawhid_geometry mirrored = geometry;
    knurl_rawhid_arm other;
    double plain[3];
    double turned[3];
    int16_t ma[3];
    int16_t turned_ma[3];
    mirrored.sign[0] = mirrored.sign[1] = mirrored.sign[2] = -1.0;
    knurl_rawhid_arm_init(&other, &mirrored);
    knurl_rawhid_angles(&arm, counts, plain);
    knurl_rawhid_angles(&other, counts, turned);
    knurl_rawhid_currents(&arm, angles, force, ma);
    knurl_rawhid_currents(&other, angles, force, turned_ma);
    for (int i = 0; i < 3; i++) {
        CHECK_CLOSE(turned[i], -plain[i], 0.0);
        assert_int_equal(turned_ma[i], -ma[i]);
        assert_true(ma[i] != 0);
    }
}

TEST(the_position_is_the_simulations_all_over_the_workspace) {
    uint64_t seed = 1;
    for (int i = 0; i < 10000; i++) {
        const double angles[3] = {random_between(&seed, -1.0, 1.0), random_between(&seed, -0.5, 1.5),
                                  random_between(&seed, 0.0, 1.6)};
        double own[3];
        double position[3];
        knurl_rawhid_position(&arm, angles, position);
        hid_sim_grip(angles, own);
        CHECK_CLOSE(position[0], own[1], 1e-15);
        CHECK_CLOSE(position[1], own[2], 1e-15);
        CHECK_CLOSE(position[2], own[0], 1e-15);
    }
}

TEST(forward_of_inverse_is_the_same_place_all_over_the_workspace) {
    uint64_t seed = 2;
    double worst = 0.0;
    for (int i = 0; i < 100000; i++) {
        double position[3];
        double angles[3];
        double back[3];
        random_vector(&seed, -HALF, HALF, position);
        assert_int_equal(knurl_rawhid_inverse(&arm, position, angles), 1);
        assert_int_equal(knurl_rawhid_is_pose(&arm, angles), 1);
        knurl_rawhid_position(&arm, angles, back);
        vec3_sub(back, position, back);
        worst = fmax(worst, vec3_length(back));
    }
    assert_true(worst < 1e-9);
}

TEST(the_inverse_finds_the_angles_that_root_finding_finds) {
    uint64_t seed = 3;
    for (int i = 0; i < 2000; i++) {
        double position[3];
        double angles[3];
        double bent[3];
        random_vector(&seed, -HALF, HALF, position);
        const double own[3] = {position[2], position[0], position[1]};
        assert_int_equal(knurl_rawhid_inverse(&arm, position, angles), 1);
        assert_int_equal(hid_sim_bend(own, bent), 1);
        for (int joint = 0; joint < 3; joint++) {
            CHECK_CLOSE(angles[joint], bent[joint], 1e-9);
        }
    }
}

TEST(no_angles_are_found_for_places_out_of_reach) {
    static const double out[4][3] = {{0.0, 0.0, 0.3}, {0.0, 0.5, 0.0}, {0.0, 0.0, -0.2}, {0.0, 0.0, -0.22}};
    for (size_t i = 0; i < COUNT_OF(out); i++) {
        double angles[3] = {7.0, 7.0, 7.0};
        assert_int_equal(knurl_rawhid_inverse(&arm, out[i], angles), 0);
        CHECK_SAME(angles[0], 7.0);
    }
}

TEST(every_counter_in_the_workspace_has_room_in_16_bits) {
    for (int corner = 0; corner < 8; corner++) {
        const double position[3] = {corner & 1 ? HALF : -HALF, corner & 2 ? HALF : -HALF, corner & 4 ? HALF : -HALF};
        double angles[3];
        assert_int_equal(knurl_rawhid_inverse(&arm, position, angles), 1);
        for (int joint = 0; joint < 3; joint++) {
            assert_true(fabs(angles[joint] / arm.radians[joint]) < 32767.0);
        }
    }
}

TEST(counters_that_lost_their_place_are_no_pose) {
    static const int16_t zero[3] = {0, 0, 0}; /* after power-up: the forearm folded into the upper arm */
    static const double strange[3][3] = {{0.0, 1.5, 1.6}, {0.0, -1.0, 0.5}, {0.0, -0.2, 0.1}};
    double angles[3];
    knurl_rawhid_angles(&arm, zero, angles);
    assert_int_equal(knurl_rawhid_is_pose(&arm, angles), 0);
    for (size_t i = 0; i < COUNT_OF(strange); i++) {
        assert_int_equal(knurl_rawhid_is_pose(&arm, strange[i]), 0);
    }
}

TEST(the_jacobian_is_how_differences_have_it) {
    const double h = 1e-6;
    uint64_t seed = 4;
    for (int i = 0; i < 2000; i++) {
        double angles[3];
        double jacobian[9];
        random_angles(&seed, angles);
        knurl_rawhid_jacobian(&arm, angles, jacobian);
        for (int joint = 0; joint < 3; joint++) {
            double more[3];
            double less[3];
            double bent[3] = {angles[0], angles[1], angles[2]};
            bent[joint] += h;
            knurl_rawhid_position(&arm, bent, more);
            bent[joint] -= 2.0 * h;
            knurl_rawhid_position(&arm, bent, less);
            for (int axis = 0; axis < 3; axis++) {
                CHECK_CLOSE(jacobian[3 * axis + joint], (more[axis] - less[axis]) / (2.0 * h), 1e-9);
            }
        }
    }
}

/* The currents' force, by virtual work over the simulation's kinematics, is the requested one: within half a
 * milliampere per motor, which is 0.4 mN m at a body and some millinewtons at the grip. */
TEST(the_currents_push_with_the_force_that_was_asked_for) {
    uint64_t seed = 5;
    for (int i = 0; i < 2000; i++) {
        double angles[3];
        double pushed[3];
        int16_t ma[3];
        double force[3];
        random_vector(&seed, -1.0, 1.0, force);
        random_angles(&seed, angles);
        knurl_rawhid_currents(&arm, angles, force, ma);
        hid_sim_push(angles, ma, pushed);
        vec3_sub(pushed, force, pushed);
        assert_true(vec3_length(pushed) < 0.01);
    }
}

/* Body a at the middle: 0.22 m off its axis, 16 times the motor's torque, 0.0259 N m/A. */
TEST(a_newton_to_the_right_in_the_middle_takes_531_milliamperes) {
    static const double middle[3] = {0.0, 0.0, 0.0};
    static const double force[3] = {1.0, 0.0, 0.0};
    double angles[3];
    int16_t ma[3];
    assert_int_equal(knurl_rawhid_inverse(&arm, middle, angles), 1);
    knurl_rawhid_currents(&arm, angles, force, ma);
    assert_int_equal(ma[0], 531); /* 1000 * 1 N * 0.22 m / 16 / 0.0259 */
    assert_int_equal(ma[1], 0);
    assert_int_equal(ma[2], 0);
}

TEST(no_motor_gets_more_than_its_limit_and_the_force_keeps_its_direction) {
    uint64_t seed = 6;
    for (int i = 0; i < 5000; i++) {
        double angles[3];
        double pushed[3];
        double across[3];
        int16_t ma[3];
        double force[3];
        random_vector(&seed, -50.0, 50.0, force);
        random_angles(&seed, angles);
        knurl_rawhid_currents(&arm, angles, force, ma);
        int greatest = 0;
        for (int joint = 0; joint < 3; joint++) {
            greatest = abs(ma[joint]) > greatest ? abs(ma[joint]) : greatest;
        }
        assert_true(greatest <= 2000);
        hid_sim_push(angles, ma, pushed);
        assert_true(vec3_dot(pushed, force) > 0.0);
        vec3_cross(pushed, force, across);
        if (vec3_length(force) > 20.0) {
            assert_int_equal(greatest, 2000);
        }
        assert_true(vec3_length(across) < 0.01 * vec3_length(force));
    }
}

TEST(a_force_that_is_no_number_gives_no_current) {
    const double angles[3] = {0.0, 0.35, 0.66};
    const double bad[3][3] = {{NAN, 0.0, 0.0}, {0.0, INFINITY, 0.0}, {1.0, 1.0, -INFINITY}};
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        int16_t ma[3] = {7, 7, 7};
        knurl_rawhid_currents(&arm, angles, bad[i], ma);
        assert_int_equal(ma[0] | ma[1] | ma[2], 0);
    }
}

/* In the middle the upper arm leans by B and the forearm by C: B and C each take the grip towards the user by the
 * elbow's height, 193 mm, a radian; a count of either is 2 pi / 2000 / 12. */
TEST(the_resolution_is_what_the_worst_axis_moves_when_all_encoders_step) {
    const double elbow = sqrt(0.205 * 0.205 - 0.0690909 * 0.0690909);
    CHECK_CLOSE(knurl_rawhid_resolution(&arm), 2.0 * elbow * 2.0 * PI / 2000.0 / 12.0, 1e-9);
}

SUITE_FIXTURES(set_up, NULL)
