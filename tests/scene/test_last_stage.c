/* The last stage by itself: slew limit, halt, heat of the motors. The slew limit is 0.66 N per tick: 3.3 N within 5 ms
 * at 1 kHz. SPDX-License-Identifier: MIT */
#include "guard/last_stage.h"

#include "support/scenes.h"

static const knurl_hip_facts facts = {1000.0, 0.0, 3.3, 0.88, 60.0, 0.5, 1.0, 1020.0};

static knurl_last_stage ready(uint32_t protections, const double latest[3]) {
    knurl_last_stage stage;
    memset(&stage, 0, sizeof stage);
    knurl_last_stage_init(&stage, protections, KNURL_DEFAULT, &facts);
    memcpy(stage.force, latest, sizeof stage.force);
    return stage;
}

/* From the last force, shortened to the new length, 0.66 N towards the new one. */
TEST(a_force_that_falls_is_free_and_one_that_grows_or_turns_is_not) {
    static const struct {
        double latest[3], wanted[3], sent[3];
        const char *what;
    } table[] = {
        {{0.0, 0.0, 0.0}, {0.0, 0.0, 3.0}, {0.0, 0.0, 0.66}, "it begins"},
        {{0.0, 0.0, 1.0}, {0.0, 0.0, 3.0}, {0.0, 0.0, 1.66}, "it grows"},
        {{0.0, 0.0, 1.0}, {0.0, 0.0, 1.6}, {0.0, 0.0, 1.6}, "it grows slowly"},
        {{0.0, 0.0, 3.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, "it ends"},
        {{0.0, 0.0, 3.0}, {0.0, 0.0, 0.5}, {0.0, 0.0, 0.5}, "it falls"},
        {{2.0, 0.0, 2.0}, {0.3, 0.0, 0.2}, {0.3, 0.0, 0.2}, "it falls, and leans a little"},
        {{3.3, 0.0, 0.0}, {-3.3, 0.0, 0.0}, {2.64, 0.0, 0.0}, "it is turned round"},
        {{0.6, 0.0, 0.0}, {-0.6, 0.0, 0.0}, {-0.06, 0.0, 0.0}, "a small one is turned round"},
        {{3.3, 0.0, 0.0}, {-0.3, 0.0, 0.0}, {-0.3, 0.0, 0.0}, "it falls and begins anew elsewhere"},
        {{3.3, 0.0, 0.0}, {-1.1, 0.0, 0.0}, {0.44, 0.0, 0.0}, "it falls to a third, and that is turned round"},
        {{0.0, 2.0, 0.0}, {2.0, 0.0, 0.0}, {0.4666905, 1.5333095, 0.0}, "a quarter turn: 0.66/sqrt(2) of each"},
    };
    for (size_t i = 0; i < COUNT_OF(table); i++) {
        knurl_last_stage stage = ready(KNURL_PROTECT_ALL, table[i].latest);
        uint32_t flags = 0;
        double force[3];
        memcpy(force, table[i].wanted, sizeof force);
        (void)knurl_last_stage_limit(&stage, 1.0, 0.0, force, &flags);
        if (!(vec3_distance2(force, table[i].sent) < 1e-14)) {
            fail_msg("%s: expected (%g, %g, %g), found (%g, %g, %g)", table[i].what, table[i].sent[0], table[i].sent[1],
                     table[i].sent[2], force[0], force[1], force[2]);
        }
        assert_int_equal(flags, vec3_distance2(force, table[i].wanted) > 0.0 ? KNURL_TICK_SLEW : 0);
        assert_memory_equal(stage.force, force, sizeof force);
    }
}

TEST(a_texture_is_let_through_by_as_much_as_it_jumps) {
    static const double none[3] = {0.0, 0.0, 0.0};
    static const double gains[] = {1.0, 0.5};
    for (size_t i = 0; i < COUNT_OF(gains); i++) {
        knurl_last_stage stage = ready(KNURL_PROTECT_ALL, none);
        uint32_t flags = 0;
        double force[3] = {0.0, 3.3, 0.0};
        CHECK_CLOSE(knurl_last_stage_limit(&stage, gains[i], 1.0, force, &flags), 0.66 + gains[i], 1e-12);
    }
}

/* Requests 400 N, far above max_force, so that the slew limit acts in every tick. */
TEST(a_squeeze_ramps_the_fall_that_follows_it_and_no_later_one) {
    static const struct {
        int held; /* ticks between the squeeze and the fall */
        double after;
    } table[] = {{0, 2.64}, {1, 0.0}, {20, 0.0}};
    static const double none[3] = {0.0, 0.0, 0.0};
    for (size_t i = 0; i < COUNT_OF(table); i++) {
        knurl_last_stage stage = ready(KNURL_PROTECT_ALL, none);
        double force[3] = {0.0, 0.0, 0.0};
        for (int tick = 0; tick < 10 + table[i].held; tick++) {
            uint32_t flags = tick == 9 ? KNURL_TICK_SQUEEZED : 0;
            force[2] = 400.0;
            CHECK_CLOSE(knurl_last_stage_limit(&stage, 1.0, 0.0, force, &flags), fmin(3.3, 0.66 * (tick + 1)), 1e-12);
        }
        uint32_t flags = 0;
        force[2] = 0.0;
        CHECK_CLOSE(knurl_last_stage_limit(&stage, 1.0, 0.0, force, &flags), table[i].after, 1e-12);
    }
}

/* Afterwards it comes back from zero. */
TEST(without_gain_there_is_no_force_after_any_force) {
    static const double latest[3] = {0.0, 3.3, 0.0};
    for (int squeezed = 0; squeezed < 3; squeezed++) { /* never, a tick ago, now */
        knurl_last_stage stage = ready(KNURL_PROTECT_ALL, latest);
        uint32_t flags = squeezed == 2 ? KNURL_TICK_SQUEEZED : 0;
        double force[3] = {1.0, 3.0, -2.0};
        stage.release = squeezed == 1;
        CHECK_SAME(knurl_last_stage_limit(&stage, 0.0, 0.0, force, &flags), 0.0L);
        CHECK_VECTOR(stage.force, 0.0, 0.0, 0.0, 0.0);
        flags = 0;
        force[1] = 3.0;
        CHECK_CLOSE(knurl_last_stage_limit(&stage, 1.0, 0.0, force, &flags), 0.66, 1e-12);
    }
}

TEST(a_non_finite_force_is_reported_and_not_taken_as_sent) {
    static const double latest[3] = {0.0, 1.0, 0.0};
    static const double wrong[] = {(double)NAN, (double)INFINITY, -(double)INFINITY};
    static const double gains[] = {1.0, 0.5, 0.0};
    for (size_t i = 0; i < COUNT_OF(wrong); i++) {
        for (size_t k = 0; k < COUNT_OF(gains); k++) {
            knurl_last_stage stage = ready(KNURL_PROTECT_ALL & ~(k == 0 ? KNURL_PROTECT_SLEW : 0), latest);
            uint32_t flags = 0;
            double force[3] = {0.0, wrong[i], 0.0};
            assert_true(!isfinite(knurl_last_stage_limit(&stage, gains[k], 0.0, force, &flags)));
            assert_memory_equal(stage.force, latest, sizeof latest);
            assert_true(isfinite(stage.heat.square));
        }
    }
}

TEST(a_limit_that_is_not_a_number_lets_no_force_through) {
    static const double latest[3] = {0.0, 1.0, 0.0};
    knurl_last_stage stage = ready(KNURL_PROTECT_ALL, latest);
    uint32_t flags = 0;
    double force[3] = {0.0, 1.0, 0.0};
    stage.heat.square = (double)NAN;
    assert_true(!isfinite(knurl_last_stage_limit(&stage, 1.0, 0.0, force, &flags)));
}

/* 60 s; 2.64 N for a while before, with a continuous force of 0.88 N: three times the force is nine times the heat. */
TEST(motors_that_are_too_warm_get_the_continuous_force_and_cool_to_it) {
    static const double latest[3] = {0.0, 3.3, 0.0};
    knurl_last_stage stage = ready(KNURL_PROTECT_ALL, latest);
    stage.heat.square = 2.64 * 2.64;
    for (int tick = 1; tick <= 60000; tick++) {
        uint32_t flags = 0;
        double force[3] = {0.0, 3.3, 0.0};
        CHECK_CLOSE(knurl_last_stage_limit(&stage, 1.0, 0.0, force, &flags), 0.88, 1e-12);
        assert_true((flags & KNURL_TICK_HEAT) != 0);
    }
    CHECK_CLOSE(knurl_heat_theta(&stage.heat), 1.0 + 8.0 * exp(-1.0), 1e-9);
}

/* A device may go on playing a force that it was given before. */
TEST(motors_that_are_too_warm_are_not_cooled_by_a_force_that_nothing_limits) {
    static const double latest[3] = {0.0, 3.3, 0.0};
    knurl_last_stage stage = ready(KNURL_PROTECT_ALL, latest);
    stage.heat.square = 2.64 * 2.64;
    knurl_heat_hold(&stage.heat, 3.3 * 3.3, 1000.0);
    CHECK_SAME(stage.heat.square, 2.64 * 2.64);
}
