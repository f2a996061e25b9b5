/* A Falcon's kinematics against Stamper's equations solved numerically, finite differences and virtual work.
 * SPDX-License-Identifier: MIT */
#include "support/close.h"

#include "base/vec3.h"
#include "device/falcon/kinematics.h"
#include "falcon_sim.h"

#include <stdlib.h>

#define W KNURL_FALCON_WORKSPACE

/* Position `n` of a grid of 41 a side over the workspace, its edges included. */
#define GRID 41
static void grid_position(int n, double position[3]) {
    const int index[3] = {n % GRID, n / GRID % GRID, n / GRID / GRID};
    for (int axis = 0; axis < 3; axis++) {
        position[axis] = W * (2.0 * index[axis] / (GRID - 1) - 1.0);
    }
}

static void check_round_trip(const double position[3], const double start[3]) {
    double theta[3];
    double found[3] = {start[0], start[1], start[2]};
    assert_true(knurl_falcon_inverse(position, theta));
    assert_true(knurl_falcon_forward(theta, found));
    for (int axis = 0; axis < 3; axis++) {
        CHECK_CLOSE(found[axis], position[axis], 1e-9);
    }
}

TEST(forward_undoes_inverse_everywhere_in_the_workspace_from_the_centre) {
    static const double centre[3] = {0.0, 0.0, 0.0};
    for (int n = 0; n < GRID * GRID * GRID; n++) {
        double position[3];
        grid_position(n, position);
        check_round_trip(position, centre);
    }
}

TEST(forward_finds_any_position_from_any_other) {
    uint64_t seed = 7;
    for (int n = 0; n < 100000; n++) {
        double ends[2][3];
        random_vector(&seed, -W, W, ends[0]);
        random_vector(&seed, -W, W, ends[1]);
        check_round_trip(ends[0], ends[1]);
    }
}

TEST(the_closed_form_solves_stampers_equations) {
    for (int n = 0; n < GRID * GRID * GRID; n += 7) {
        double position[3];
        double theta[3];
        double solved[3];
        grid_position(n, position);
        assert_true(knurl_falcon_inverse(position, theta));
        assert_true(falcon_sim_angles(position, solved));
        for (int leg = 0; leg < 3; leg++) {
            CHECK_CLOSE(theta[leg], solved[leg], 1e-12);
        }
    }
}

/* The other root of the quadratic equation in tan(theta/2) by which libnifalcon solves the same leg, as an independent
 * published form: at the centre all legs have the same angles. */
TEST(at_the_centre_all_legs_stand_alike) {
    const double centre[3] = {0.0, 0.0, 0.0};
    const double a = 0.060, b = 0.1025, c = 0.01443, de = 0.0225, v = -0.00191, u = -0.0400, w = 0.12;
    const double sin3 = sqrt(1.0 - v * v / (b * b));
    const double k = de + b * sin3;
    const double l0 = w * w + u * u + 2 * c * u - 2 * a * u + a * a + c * c - k * k - 2 * a * c;
    const double l1 = -4 * a * w;
    const double l2 = w * w + u * u + 2 * c * u + 2 * a * u + a * a + c * c - k * k + 2 * a * c;
    const double expected = 2.0 * atan((-l1 - sqrt(l1 * l1 - 4 * l0 * l2)) / (2 * l2));
    double theta[3];
    assert_true(knurl_falcon_inverse(centre, theta));
    for (int leg = 0; leg < 3; leg++) {
        CHECK_CLOSE(theta[leg], expected, 1e-12);
    }
}

TEST(a_count_is_0_0364347_degrees_and_zero_is_35) {
    CHECK_CLOSE(knurl_falcon_angle(0.0), 35.0 * 0.017453292519943295, 1e-12);
    CHECK_CLOSE(knurl_falcon_angle(1000.0) - knurl_falcon_angle(0.0), 36.4347 * 0.017453292519943295, 1e-6);
}

TEST(the_jacobian_is_what_finite_differences_give) {
    const double h = 1e-6;
    uint64_t seed = 9;
    for (int n = 0; n < 20000; n++) {
        double position[3];
        double theta[3];
        double jacobian[9];
        random_vector(&seed, -W, W, position);
        assert_true(knurl_falcon_inverse(position, theta));
        assert_true(knurl_falcon_jacobian(position, theta, jacobian));
        for (int axis = 0; axis < 3; axis++) {
            double at[3] = {position[0], position[1], position[2]};
            double before[3];
            double after[3];
            at[axis] = position[axis] - h;
            assert_true(knurl_falcon_inverse(at, before));
            at[axis] = position[axis] + h;
            assert_true(knurl_falcon_inverse(at, after));
            for (int leg = 0; leg < 3; leg++) {
                const double difference = (after[leg] - before[leg]) / (2.0 * h);
                CHECK_CLOSE(jacobian[3 * leg + axis], difference, 1e-6 * (1.0 + fabs(difference)));
            }
        }
    }
}

TEST(motors_make_the_force_that_was_asked_for_by_virtual_work) {
    uint64_t seed = 11;
    for (int n = 0; n < 5000; n++) {
        double position[3];
        double theta[3];
        double force[3];
        double made[3];
        double jacobian[9];
        int16_t motors[3];
        random_vector(&seed, -W, W, position);
        random_vector(&seed, -1.0, 1.0, force);
        assert_true(knurl_falcon_inverse(position, theta));
        assert_true(knurl_falcon_motors(position, theta, force, motors));
        falcon_sim_force(position, motors, made);
        assert_true(knurl_falcon_jacobian(position, theta, jacobian));
        for (int axis = 0; axis < 3; axis++) { /* half a unit of each motor is 0.05 mN m */
            const double rounded =
                0.5e-4 * (fabs(jacobian[axis]) + fabs(jacobian[3 + axis]) + fabs(jacobian[6 + axis]));
            CHECK_CLOSE(made[axis], force[axis], 1.01 * rounded + 1e-6);
        }
    }
}

TEST(a_force_beyond_the_motors_keeps_its_direction) {
    uint64_t seed = 13;
    for (int n = 0; n < 2000; n++) {
        const double length = random_between(&seed, 20.0, 1e6);
        double position[3];
        double theta[3];
        double force[3];
        double made[3];
        int16_t motors[3];
        random_vector(&seed, -0.5 * W, 0.5 * W, position);
        random_vector(&seed, -1.0, 1.0, force);
        vec3_scale(length / vec3_length(force), force, force);
        assert_true(knurl_falcon_inverse(position, theta));
        assert_true(knurl_falcon_motors(position, theta, force, motors));
        int most = 0;
        for (int leg = 0; leg < 3; leg++) {
            most = abs(motors[leg]) > most ? abs(motors[leg]) : most;
        }
        assert_int_equal(most, KNURL_FALCON_MOTOR_MOST);
        falcon_sim_force(position, motors, made);
        CHECK_CLOSE(vec3_dot(made, force) / length / vec3_length(made), 1.0, 1e-5);
    }
}

TEST(non_finite_or_unreachable_positions_are_refused) {
    static const double wrong[][3] = {{NAN, 0.0, 0.0},  {0.0, INFINITY, 0.0}, {0.0, 0.0, -INFINITY}, {0.2, 0.0, 0.0},
                                      {0.0, -0.2, 0.0}, {0.0, 0.0, 0.2},      {1e300, 0.0, 0.0}};
    static const double far[][3] = {{NAN, 0.5, 0.5}, {INFINITY, 0.5, 0.5}, {3.1, 3.1, 3.1}, {-3.0, 2.0, 0.5}};
    const double force[3] = {1.0, NAN, 0.0};
    const double centre[3] = {0.0, 0.0, 0.0};
    double angles[3];
    int16_t motors[3] = {1, 2, 3};
    for (size_t i = 0; i < COUNT_OF(wrong); i++) {
        double theta[3] = {1.0, 2.0, 3.0};
        assert_false(knurl_falcon_inverse(wrong[i], theta));
        CHECK_SAME(theta[0] + theta[1] + theta[2], 6.0L);
    }
    for (size_t i = 0; i < COUNT_OF(far); i++) {
        double position[3] = {0.001, 0.002, 0.003};
        assert_false(knurl_falcon_forward(far[i], position));
        CHECK_SAME(position[1], (long double)0.002);
    }
    assert_true(knurl_falcon_inverse(centre, angles));
    assert_false(knurl_falcon_motors(centre, angles, force, motors));
    assert_int_equal(motors[0] | motors[1] | motors[2], 0);
}

/* Every result is a solution: its inverse gives the same angles. */
TEST(forward_kinematics_are_exact_or_fail) {
    uint64_t seed = 17;
    int found = 0;
    for (int n = 0; n < 200000; n++) {
        double position[3];
        double theta[3];
        double back[3];
        random_vector(&seed, -0.06, 0.06, position);
        random_vector(&seed, -2.0, 3.0, theta);
        if (knurl_falcon_forward(theta, position)) {
            found++;
            assert_true(knurl_falcon_inverse(position, back));
            for (int leg = 0; leg < 3; leg++) {
                CHECK_CLOSE(back[leg], theta[leg], 1e-7);
            }
        }
    }
    print_message("%d of 200000 random triples of angles are poses\n", found);
    assert_true(found > 1000);
}
