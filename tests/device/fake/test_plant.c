/* The one simulated plant against closed forms: a mass with viscous and dry friction, held by a spring and a damper.
 * The plant's integrator is of first order with some steps a tick. For a step h, symplectic Euler is off the exact
 * solution of an oscillator of amplitude a by at most a h (w/2 + g) to first order in h (w: its frequency, undamped; g:
 * its decay rate): h w/2 from the skewed ellipse on which it goes round, h g from the decay, which is wrong by g h in
 * itself and shows most after 1/g, 1/e of it. The tests allow this for h = a whole tick.
 * SPDX-License-Identifier: MIT */
#include "free_mass.h"

#define DT 0.001 /* s */

/* One tick under a force along x, the hand's target at the origin. */
static void push(knurl_plant *plant, double force) {
    const double forces[3] = {force, 0.0, 0.0};
    knurl_plant_write(plant, forces);
    knurl_plant_step(plant, DT, nowhere, nowhere);
}

TEST(a_mass_that_nothing_touches_goes_straight_on) {
    const knurl_plant_config config = free_mass(0);
    knurl_plant plant = make_plant(&config, 0.5, 0.25);
    for (int tick = 1; tick <= 1000; tick++) {
        push(&plant, 0.0);
        CHECK_CLOSE(plant.position[0], 0.5 + 0.25 * DT * tick, 1e-12);
        CHECK_SAME(plant.position[1], 0.0L);
    }
}

/* x = F t^2 / 2m. */
TEST(a_constant_force_accelerates_a_free_mass) {
    const knurl_plant_config config = free_mass(0);
    knurl_plant plant = make_plant(&config, 0.0, 0.0);
    for (int tick = 1; tick <= 500; tick++) {
        const double t = tick * DT;
        push(&plant, 0.5);
        CHECK_CLOSE(plant.velocity[0], 10.0 * t, 1e-10);
        CHECK_CLOSE(plant.position[0], 5.0 * t * t,
                    10.0 * t * DT); /* each step's speed is late or early by a h at most */
    }
}

/* v = v0 exp(-b t/m): it stops after m v0/b. */
TEST(viscous_friction_slows_a_free_mass_exponentially) {
    knurl_plant_config config = free_mass(0);
    config.viscous = 0.5; /* a time constant of 0.1 s */
    knurl_plant plant = make_plant(&config, 0.0, 1.0);
    for (int tick = 1; tick <= 3000; tick++) {
        push(&plant, 0.0);
        CHECK_CLOSE(plant.velocity[0], exp(-10.0 * tick * DT), 10.0 * DT); /* g h */
    }
    CHECK_CLOSE(plant.position[0], 0.1, 0.1 * 10.0 * DT);
}

/* The exact path of m x'' + c x' + k x = 0 from x0 at rest. */
static double oscillator(double t, double x0, double w0, double g) {
    const double w = sqrt(w0 * w0 - g * g);
    return x0 * exp(-g * t) * (cos(w * t) + g / w * sin(w * t));
}

TEST(a_mass_released_on_the_hands_spring_swings_as_an_oscillator_does) {
    static const double damping[][2] = {{0.0, 0.0}, {0.2, 0.0}, {0.0, 0.2}, {0.5, 5.0}}; /* device's, hand's: N s/m */
    for (size_t i = 0; i < COUNT_OF(damping); i++) {
        knurl_plant_config config = free_mass(0);
        config.hand_stiffness = 700.0;
        config.viscous = damping[i][0];
        config.hand_damping = damping[i][1];
        const double w0 = sqrt(700.0 / 0.05);
        const double g = (damping[i][0] + damping[i][1]) / (2.0 * 0.05);
        knurl_plant plant = make_plant(&config, 0.01, 0.0);
        for (int tick = 1; tick <= 100; tick++) { /* two cycles */
            push(&plant, 0.0);
            CHECK_CLOSE(plant.position[0], oscillator(tick * DT, 0.01, w0, g), 0.01 * DT * (w0 / 2.0 + g));
        }
    }
}

TEST(without_friction_a_swing_neither_grows_nor_dies) {
    knurl_plant_config config = free_mass(0);
    config.hand_stiffness = 700.0;
    knurl_plant plant = make_plant(&config, 0.01, 0.0);
    for (int tick = 1; tick <= 20000; tick++) { /* 377 cycles */
        push(&plant, 0.0);
        const double energy =
            0.5 * 0.05 * plant.velocity[0] * plant.velocity[0] + 0.5 * 700.0 * plant.position[0] * plant.position[0];
        CHECK_CLOSE(energy, 0.035, 0.035 * 118.4 * DT); /* w h: twice the ellipse's skew, because energy is quadratic */
    }
}

/* x = F/k. */
TEST(a_constant_force_deflects_the_hands_spring_by_force_over_stiffness) {
    static const double stiffness[] = {100.0, 700.0, 3000.0};
    for (size_t i = 0; i < COUNT_OF(stiffness); i++) {
        knurl_plant_config config = free_mass(0);
        config.hand_stiffness = stiffness[i];
        config.hand_damping = 5.0;
        config.viscous = 0.5;
        knurl_plant plant = make_plant(&config, 0.0, 0.0);
        for (int tick = 0; tick < 3000; tick++) {
            push(&plant, -1.5);
        }
        CHECK_CLOSE(plant.position[0], -1.5 / stiffness[i], 1e-12);
    }
}

/* Behind a target at speed v a spring trails by b v/k of the device's viscous friction; the hand's own damper, which
 * moves along, has no effect. The integrator moves the mass after it evaluates the spring: v h. */
TEST(a_moving_hand_drags_the_mass_behind_it_by_its_friction) {
    static const double velocity[3] = {0.2, 0.0, 0.0};
    knurl_plant_config config = free_mass(0);
    config.hand_stiffness = 700.0;
    config.hand_damping = 5.0;
    config.viscous = 20.0;
    knurl_plant plant = make_plant(&config, 0.0, 0.0);
    for (int tick = 1; tick <= 2000; tick++) {
        const double target[3] = {0.2 * tick * DT, 0.0, 0.0};
        knurl_plant_write(&plant, nowhere);
        knurl_plant_step(&plant, DT, target, velocity);
    }
    CHECK_CLOSE(plant.velocity[0], 0.2, 1e-9);
    CHECK_CLOSE(0.4 - plant.position[0], 20.0 * 0.2 / 700.0, 0.2 * DT);
}

TEST(dry_friction_holds_what_is_below_its_limit_and_slides_above) {
    knurl_plant_config config = free_mass(0);
    config.coulomb = 0.26;
    knurl_plant plant = make_plant(&config, 0.0, 0.0);
    for (int tick = 0; tick < 1000; tick++) {
        push(&plant, 0.2599);
    }
    CHECK_SAME(plant.position[0], 0.0L);
    for (int tick = 1; tick <= 500; tick++) {
        push(&plant, 0.31); /* a = (F - Fc)/m = 1 m/s2 */
        CHECK_CLOSE(plant.velocity[0], tick * DT, 1e-10);
    }
}

TEST(dry_friction_holds_against_the_length_of_the_force_and_not_its_parts) {
    static const double diagonal[3] = {0.2, 0.2, 0.2}; /* 0.346 N */
    knurl_plant_config config = free_mass(0);
    config.coulomb = 0.26;
    knurl_plant plant = make_plant(&config, 0.0, 0.0);
    knurl_plant_write(&plant, diagonal);
    for (int tick = 0; tick < 100; tick++) {
        knurl_plant_step(&plant, DT, nowhere, nowhere);
    }
    const double speed = (sqrt(0.12) - 0.26) / 0.05 * 0.1;
    for (int axis = 0; axis < 3; axis++) {
        CHECK_CLOSE(plant.velocity[axis], speed / sqrt(3.0), 1e-10);
    }
}

/* v falls by Fc/m a second: the distance is m v0^2 / 2 Fc. */
TEST(dry_friction_stops_a_slide_where_its_work_has_used_up_the_energy) {
    knurl_plant_config config = free_mass(0);
    config.coulomb = 0.25;
    knurl_plant plant = make_plant(&config, 0.0, 0.5); /* 0.1 s, 25 mm */
    for (int tick = 1; tick <= 100; tick++) {
        push(&plant, 0.0);
        CHECK_CLOSE(plant.velocity[0], 0.5 - 5.0 * tick * DT, 1e-9);
    }
    CHECK_CLOSE(plant.position[0], 0.025, 0.5 * DT);
    const double stands = plant.position[0];
    for (int tick = 0; tick < 100; tick++) {
        push(&plant, 0.0);
    }
    CHECK_CLOSE(plant.position[0], stands, 1e-12);
    CHECK_SAME(plant.velocity[0], 0.0L);
}

/* It comes to rest if the spring's force is at most the friction: |x| <= Fc/k. */
TEST(dry_friction_keeps_the_hand_off_its_target_by_no_more_than_its_limit) {
    knurl_plant_config config = free_mass(0);
    config.hand_stiffness = 700.0;
    config.hand_damping = 5.0;
    config.coulomb = 0.26;
    for (int start = -10; start <= 10; start++) {
        knurl_plant plant = make_plant(&config, 0.001 * start, 0.0);
        for (int tick = 0; tick < 2000; tick++) {
            push(&plant, 0.0);
        }
        CHECK_SAME(plant.velocity[0], 0.0L);
        assert_true(fabs(plant.position[0]) <= 0.26 / 700.0 + 1e-9);
    }
}

TEST(a_force_beyond_what_the_motors_can_do_is_played_at_their_limit) {
    static const double far_too_much[3] = {30.0, -40.0, 0.0};
    knurl_plant_config config = free_mass(0);
    config.max_force = 2.0;
    knurl_plant plant = make_plant(&config, 0.0, 0.0);
    knurl_plant_write(&plant, far_too_much);
    for (int tick = 0; tick < 100; tick++) {
        knurl_plant_step(&plant, DT, nowhere, nowhere);
    }
    CHECK_CLOSE(plant.velocity[0], 1.2 / 0.05 * 0.1, 1e-10); /* 2 N in the same direction */
    CHECK_CLOSE(plant.velocity[1], -1.6 / 0.05 * 0.1, 1e-10);
}

TEST(a_force_acts_exactly_delay_ticks_later) {
    for (int32_t delay = 0; delay <= KNURL_PLANT_MAX_DELAY; delay++) {
        knurl_plant_config config = free_mass(0);
        config.delay = delay;
        knurl_plant plant = make_plant(&config, 0.0, 0.0);
        for (int tick = 0; tick < 60; tick++) {
            push(&plant, tick == 20 ? 1.0 : 0.0); /* one tick's worth: F h/m */
            CHECK_CLOSE(plant.velocity[0], tick < 20 + delay ? 0.0 : 1.0 / 0.05 * DT, 1e-12);
        }
    }
}

/* A force stays until the next one, so ticks without a write count as well. */
TEST(a_force_that_is_written_once_arrives_after_its_delay_and_stays) {
    static const double once[3] = {1.0, 0.0, 0.0};
    for (int32_t delay = 0; delay <= 3; delay++) {
        knurl_plant_config config = free_mass(0);
        config.delay = delay;
        knurl_plant plant = make_plant(&config, 0.0, 0.0);
        knurl_plant_write(&plant, once);
        for (int tick = 0; tick < 10; tick++) {
            knurl_plant_step(&plant, DT, nowhere, nowhere);
            CHECK_CLOSE(plant.velocity[0], fmax(0.0, tick + 1 - delay) * DT / 0.05, 1e-12);
        }
    }
}

TEST(of_two_forces_written_in_one_tick_the_newer_counts) {
    static const double first[3] = {7.0, 0.0, 0.0};
    static const double second[3] = {1.0, 0.0, 0.0};
    for (int32_t delay = 0; delay <= 3; delay++) {
        knurl_plant_config config = free_mass(0);
        config.delay = delay;
        knurl_plant plant = make_plant(&config, 0.0, 0.0);
        for (int tick = 0; tick < 10; tick++) {
            knurl_plant_write(&plant, first);
            knurl_plant_write(&plant, second);
            knurl_plant_step(&plant, DT, nowhere, nowhere);
        }
        CHECK_CLOSE(plant.velocity[0], (10 - delay) * DT / 0.05, 1e-12);
    }
}

TEST(the_workspaces_stops_hold_and_release) {
    knurl_plant_config config = free_mass(0);
    config.half_workspace[0] = 0.08;
    knurl_plant plant = make_plant(&config, 0.0, 0.0);
    for (int side = -1; side <= 1; side += 2) {
        for (int tick = 0; tick < 1000; tick++) {
            push(&plant, 3.0 * side);
            assert_true(fabs(plant.position[0]) <= 0.08);
        }
        CHECK_SAME(plant.position[0], 0.08 * side);
    }
    push(&plant, -3.0);
    assert_true(plant.position[0] < 0.08); /* it does not stick */
}

TEST(positions_are_reported_to_the_nearest_multiple_of_the_resolution) {
    knurl_plant_config config = free_mass(0);
    config.resolution = 0.055e-3;
    uint64_t random = 5;
    for (int i = 0; i < 20000; i++) {
        double told[3];
        knurl_plant plant = make_plant(&config, random_between(&random, -0.08, 0.08), 0.0);
        knurl_plant_measure(&plant, told);
        const double counts = told[0] / 0.055e-3;
        CHECK_CLOSE(counts, round(counts), 1e-9);
        CHECK_CLOSE(told[0], plant.position[0], 0.5 * 0.055e-3 * (1.0 + 1e-9));
    }
    config.resolution = 0.0;
    double told[3];
    const knurl_plant plant = make_plant(&config, 0.0123456789, 0.0);
    knurl_plant_measure(&plant, told);
    CHECK_SAME(told[0], 0.0123456789);
}

TEST(the_same_history_gives_the_same_positions_bit_for_bit) {
    knurl_plant_config config = free_mass(0);
    config.hand_stiffness = 700.0;
    config.coulomb = 0.26;
    config.delay = 2;
    knurl_plant one = make_plant(&config, 0.01, 0.0);
    knurl_plant other = make_plant(&config, 0.01, 0.0);
    uint64_t random = 77;
    for (int tick = 0; tick < 2000; tick++) {
        const double force = random_between(&random, -3.0, 3.0);
        push(&one, force);
        push(&other, force);
    }
    assert_memory_equal(&one, &other, sizeof one);
}
