/* The plant's exact motion against closed forms, for cases in which plain steps are too coarse; plain steps must not
 * change. SPDX-License-Identifier: MIT */
#include "free_mass.h"

static void push(knurl_plant *plant, double dt, double force) {
    const double forces[3] = {force, 0.0, 0.0};
    knurl_plant_write(plant, forces);
    knurl_plant_step(plant, dt, nowhere, nowhere);
}

/* m x'' + c x' + k x = 0 from x0 at rest, in all three cases of damping. */
static double released(double t, double x0, double k, double c, double m) {
    const double g = c / (2.0 * m);
    const double d = k / m - g * g;
    const double w = sqrt(fabs(d));
    if (fabs(d) < 1e-6) {
        return x0 * exp(-g * t) * (1.0 + g * t);
    }
    return d > 0.0 ? x0 * exp(-g * t) * (cos(w * t) + g / w * sin(w * t))
                   : x0 * (0.5 * (1.0 + g / w) * exp((w - g) * t) + 0.5 * (1.0 - g / w) * exp(-(w + g) * t));
}

TEST(a_swing_is_that_of_the_closed_form_at_any_rate_and_damping) {
    static const double dampings[] = {0.0, 0.5, 11.832159566199232, 40.0}; /* the third: 2 sqrt(k m), critical */
    static const double rates[] = {50.0, 250.0, 1000.0, 10000.0};
    for (size_t i = 0; i < COUNT_OF(dampings); i++) {
        for (size_t j = 0; j < COUNT_OF(rates); j++) {
            knurl_plant_config config = free_mass(1);
            config.hand_stiffness = 700.0;
            config.hand_damping = 0.5 * dampings[i];
            config.viscous = 0.5 * dampings[i];
            knurl_plant plant = make_plant(&config, 0.01, 0.0);
            for (int tick = 1; tick <= 200; tick++) {
                push(&plant, 1.0 / rates[j], 0.0);
                CHECK_CLOSE(plant.position[0], released(tick / rates[j], 0.01, 700.0, dampings[i], 0.05), 1e-11);
            }
        }
    }
}

/* x = F t^2 / 2m: nothing but rounding is left of a held force's half tick. */
TEST(a_held_force_moves_a_free_mass_by_half_a_t_squared) {
    const knurl_plant_config config = free_mass(1);
    knurl_plant plant = make_plant(&config, 0.0, 0.0);
    for (int tick = 1; tick <= 500; tick++) {
        const double t = 1e-3 * tick;
        push(&plant, 1e-3, 0.5);
        CHECK_CLOSE(plant.position[0], 5.0 * t * t, 1e-12);
        CHECK_CLOSE(plant.velocity[0], 10.0 * t, 1e-12);
    }
}

/* Behind a target at speed v it trails by b v/k: without the plain steps' error of v h. */
TEST(a_moving_hand_drags_the_mass_behind_it_by_its_friction_alone) {
    static const double velocity[3] = {0.2, 0.0, 0.0};
    knurl_plant_config config = free_mass(1);
    config.hand_stiffness = 700.0;
    config.hand_damping = 5.0;
    config.viscous = 20.0;
    knurl_plant plant = make_plant(&config, 0.0, 0.0);
    for (int tick = 1; tick <= 2000; tick++) {
        const double target[3] = {0.2e-3 * tick, 0.0, 0.0};
        knurl_plant_write(&plant, nowhere);
        knurl_plant_step(&plant, 1e-3, target, velocity);
    }
    CHECK_CLOSE(0.4 - plant.position[0], 20.0 * 0.2 / 700.0, 1e-12);
}

TEST(dry_friction_holds_exactly_below_its_limit_and_slides_above) {
    knurl_plant_config config = free_mass(1);
    config.coulomb = 0.26;
    knurl_plant plant = make_plant(&config, 0.0, 0.0);
    for (int tick = 0; tick < 1000; tick++) {
        push(&plant, 1e-3, tick % 2 > 0 ? 0.2599 : -0.2599);
    }
    CHECK_SAME(plant.position[0], 0.0L);
    for (int tick = 1; tick <= 500; tick++) {
        push(&plant, 1e-3, 0.31); /* a = (F - Fc)/m = 1 m/s2 */
        CHECK_CLOSE(plant.position[0], 0.5 * 1e-6 * tick * tick, 1e-12);
    }
}

/* v falls by Fc/m a second and stays 0: the distance is m v0^2 / 2 Fc, for an end anywhere in a step. */
TEST(dry_friction_stops_a_slide_where_its_work_has_used_up_the_energy) {
    static const double speeds[] = {0.5, 0.4999, 0.123456, 0.001};
    knurl_plant_config config = free_mass(1);
    config.coulomb = 0.25;
    for (size_t i = 0; i < COUNT_OF(speeds); i++) {
        knurl_plant plant = make_plant(&config, 0.0, speeds[i]);
        for (int tick = 0; tick < 150; tick++) {
            push(&plant, 1e-3, 0.0);
        }
        CHECK_CLOSE(plant.position[0], 0.5 * 0.05 * speeds[i] * speeds[i] / 0.25, 1e-12);
        CHECK_SAME(plant.velocity[0], 0.0L);
    }
}

/* Each half swing of an oscillator with dry friction alone is smaller by 2 fc/k (its sizes are a straight line). */
TEST(dry_friction_takes_twice_its_deflection_a_half_swing) {
    knurl_plant_config config = free_mass(1);
    config.hand_stiffness = 700.0;
    config.coulomb = 0.07; /* 0.1 mm of the spring */
    knurl_plant plant = make_plant(&config, 0.00505, 0.0);
    double expected = 0.00505;
    double largest = 0.0;
    for (int tick = 0; tick < 2000; tick++) {
        const double before = plant.position[0];
        push(&plant, 1e-4, 0.0);
        largest = fmax(largest, fabs(before));
        if (before * plant.position[0] < 0.0) { /* through the middle: the swing before it is known */
            CHECK_CLOSE(largest, expected, 3e-6);
            expected -= 0.0002;
            largest = 0.0;
        }
    }
    assert_true(expected < 0.004); /* five swings and more were seen */
}

/* Across a slide at v, small motions are damped by fc/v N s/m: 1 mm/s across 0.2 m/s decays in m v/fc. */
TEST(dry_friction_of_a_slide_damps_what_goes_across_it) {
    static const double along[3] = {0.0, 0.0, 0.2};
    knurl_plant_config config = free_mass(1);
    config.coulomb = 0.25;
    config.hand_stiffness = 1e-9;
    config.hand_damping = 0.0;
    knurl_plant plant = make_plant(&config, 0.0, 0.001);
    plant.velocity[2] = 0.2;
    config.viscous = 0.0;
    const double balance[3] = {0.0, 0.0, 0.25}; /* keeps the slide going */
    for (int tick = 1; tick <= 40; tick++) {
        knurl_plant_write(&plant, balance);
        knurl_plant_step(&plant, 1e-3, nowhere, nowhere);
        CHECK_CLOSE(plant.velocity[0], 0.001 * exp(-1e-3 * tick * 0.25 / (along[2] * 0.05)), 5e-6);
    }
}

/* --- plain steps too coarse --- */

static double largest_deflection(const knurl_plant_config *config, double dt) {
    knurl_plant plant = make_plant(config, 0.001, 0.0);
    double largest = 0.0;
    for (int tick = 0; tick < 500; tick++) {
        push(&plant, dt, 0.0);
        largest = fmax(largest, fabs(plant.position[0]));
    }
    return largest;
}

TEST(no_device_and_hand_that_can_be_asked_for_is_unstable) {
    static const double masses[] = {0.001, 0.045, 10.0};
    static const double viscous[] = {0.0, 0.5, 1000.0};
    static const double stiffnesses[] = {0.0, 700.0, 10000.0};
    static const double dampings[] = {0.0, 5.0, 100.0};
    static const double rates[] = {1.0, 100.0, 1000.0, 10000.0, 100000.0};
    for (size_t i = 0; i < 81; i++) {
        for (size_t j = 0; j < COUNT_OF(rates); j++) {
            for (int exact = 0; exact < 2; exact++) {
                knurl_plant_config config = free_mass(1);
                config.exact = exact;
                config.mass = masses[i / 27];
                config.viscous = viscous[i / 9 % 3];
                config.hand_stiffness = stiffnesses[i / 3 % 3];
                config.hand_damping = dampings[i % 3];
                const double largest = largest_deflection(&config, 1.0 / rates[j]);
                /* the ellipse of plain steps is skewed by w h/2, at most 1/2 */
                if (!(largest <= 0.001 * (exact ? 1.0 + 1e-9 : 1.5))) {
                    fail_msg("%g kg, %g and %g N s/m, %g N/m at %g Hz: %g m", config.mass, config.viscous,
                             config.hand_damping, config.hand_stiffness, rates[j], largest);
                }
            }
        }
    }
}

/* The plain steps, written down a second time: four a tick, velocity first, then dry friction, then the position. */
static void plain_tick(const knurl_plant_config *c, double dt, double force, double target, double target_velocity,
                       double *x, double *v) {
    const double h = dt / 4;
    for (int step = 0; step < 4; step++) {
        const double reached = target - (dt - h * (step + 1)) * target_velocity;
        const double hand = c->hand_stiffness * (reached - *x) + c->hand_damping * (target_velocity - *v);
        *v += h * (force + hand - c->viscous * *v) / c->mass;
        const double loss = c->coulomb * h / c->mass;
        const double speed = sqrt(*v * *v + 0.0 + 0.0);
        *v = (speed > loss ? 1.0 - loss / speed : 0.0) * *v;
        *x += h * *v;
    }
}

TEST(a_device_that_is_not_exact_takes_four_plain_steps_a_tick_bit_for_bit) {
    static const double rates[] = {100.0, 1000.0, 10000.0};
    for (size_t i = 0; i < COUNT_OF(rates); i++) {
        knurl_plant_config config = free_mass(1);
        config.exact = 0;
        config.mass = 0.045;
        config.viscous = 0.5;
        config.coulomb = 0.26;
        config.hand_stiffness = 700.0;
        config.hand_damping = 5.0;
        knurl_plant plant = make_plant(&config, 0.003, 0.0);
        double x = 0.003;
        double v = 0.0;
        uint64_t random = 5;
        for (int tick = 0; tick < 1000; tick++) {
            const double force[3] = {random_between(&random, -3.0, 3.0), 0.0, 0.0};
            const double target[3] = {random_between(&random, -0.01, 0.01), 0.0, 0.0};
            const double velocity[3] = {random_between(&random, -0.1, 0.1), 0.0, 0.0};
            knurl_plant_write(&plant, force);
            knurl_plant_step(&plant, 1.0 / rates[i], target, velocity);
            plain_tick(&config, 1.0 / rates[i], force[0], target[0], velocity[0], &x, &v);
            CHECK_SAME(plant.position[0], x);
            CHECK_SAME(plant.velocity[0], v);
        }
    }
}
