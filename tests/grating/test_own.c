/* Own methods: arguments and results of the function, and errors. SPDX-License-Identifier: MIT */
#include "support/own.h"

#include <knurl/grating.h>

#include <stdio.h>

#define A 0.3

typedef struct scan {
    knurl_grating grating;
    knurl_grating_state state;
    knurl_grating_output out;
} scan;

static scan scan_with(int32_t method, double fsx, double fsy) {
    scan s = {.grating = {.method = method, .spatial_frequency = {fsx, fsy}, .amplitude = A, .update_rate_hz = 1000.0}};
    assert_int_equal(knurl_grating_check(&s.grating), KNURL_OK);
    return s;
}

static double play(scan *s, double x, double y, double vx, double vy) {
    knurl_grating_step(&s->grating, &s->state, (const double[2]){x, y}, (const double[2]){vx, vy}, &s->out);
    return s->out.height;
}

/* --- arguments --- */

static knurl_method_input seen;
static double looked = -0.5;

static double look(const knurl_method_input *in, double *memory, void *user) KNURL_NONBLOCKING {
    (void)memory;
    seen = *in;
    return *(const double *)user;
}

TEST(it_gets_phases_velocity_frequency_and_period_and_returns_a_height_in_a) {
    scan s = scan_with(own_add("look", 1.0, look, &looked), 1000.0, 400.0);
    CHECK_SAME(play(&s, 0.0123, -0.01, 0.05, -0.2), -0.5 * A);
    CHECK_SAME(seen.cycles[0], 1000.0 * 0.0123);
    CHECK_SAME(seen.cycles[1], 400.0 * -0.01);
    CHECK_SAME(seen.velocity[0], 0.05);
    CHECK_SAME(seen.velocity[1], -0.2);
    CHECK_SAME(seen.spatial_frequency[0], 1000.0);
    CHECK_SAME(seen.spatial_frequency[1], 400.0);
    CHECK_SAME(seen.temporal_frequency, 400.0 * 0.2);
    CHECK_SAME(seen.period, 0.001);
    assert_true(s.out.event == KNURL_NO_EVENT && s.state.sign == -1);
    looked = 1.0;
    (void)play(&s, 0.0, 0.0, 0.0, 0.0);
    assert_int_equal(s.out.turned, 1);
    looked = -0.5;
}

TEST(without_a_position_it_gets_the_integrated_velocity) {
    scan s = scan_with(own_add("look", 1.0, look, &looked), 1000.0, 0.0);
    for (int k = 1; k <= 50; k++) {
        knurl_grating_step(&s.grating, &s.state, NULL, (const double[2]){0.04, 0.0}, &s.out);
        CHECK_CLOSE(seen.cycles[0], 0.04 * k, 1e-12L);
    }
}

TEST(a_velocity_of_over_a_million_metres_a_tick_is_no_distance) {
    scan s = scan_with(own_add("look", 1.0, look, &looked), 1e-6, 0.0);
    knurl_grating_step(&s.grating, &s.state, NULL, (const double[2]){0.9e9, 0.0}, &s.out);
    CHECK_CLOSE(seen.cycles[0], 0.9, 1e-12L);
    knurl_grating_step(&s.grating, &s.state, NULL, (const double[2]){1.1e9, 0.0}, &s.out);
    CHECK_CLOSE(seen.cycles[0], 0.9, 1e-12L);
}

/* --- copies of the library's methods --- */

static void check_copy(int32_t copied, int32_t copy, double fsy, double slowest, double fastest, double tolerance) {
    uint64_t seed = 7;
    scan a = scan_with(copied, 1000.0, fsy), b = scan_with(copy, 1000.0, fsy);
    double x = 0.0, y = 0.0;
    for (int i = 0; i < 100000; i++) {
        const double vx = random_between(&seed, slowest, fastest) * (i % 2000 < 1000 ? 1.0 : -1.0);
        const double vy = random_between(&seed, -fastest, fastest);
        x += 0.001 * vx;
        y += 0.001 * vy;
        CHECK_CLOSE(play(&b, x, y, vx, vy), play(&a, x, y, vx, vy), tolerance);
        assert_int_equal(a.out.turned, b.out.turned);
    }
}

TEST(a_copy_of_s1_plays_what_s1_plays_on_lines_and_on_grids) {
    const int32_t copy = own_add("copy-of-S1", 1.0, own_s1, NULL);
    check_copy(KNURL_METHOD_S1, copy, 0.0, 0.0, 0.6, 0.0);
    check_copy(KNURL_METHOD_S1, copy, 700.0, 0.0, 0.6, 0.0);
}

TEST(a_copy_of_s2_plays_its_events_from_its_own_memory) {
    const int32_t copy = own_add("copy-of-S2", 1.4143, own_s2, NULL);
    check_copy(KNURL_METHOD_S2, copy, 0.0, 0.01, 0.36, 1e-15);
    assert_true(knurl_method_get_faults(copy) == 0);
}

/* --- results --- */

static double say(const knurl_method_input *in, double *memory, void *user) KNURL_NONBLOCKING {
    (void)in, (void)memory;
    return *(const double *)user;
}

TEST(any_result_is_limited_to_its_crest_and_faults_are_counted) {
    static double said;
    static const struct {
        double said, played;
    } cases[] = {{NAN, 0.0},    {INFINITY, 0.0}, {-INFINITY, 0.0}, {1e30, 1.2},  {-1e30, -1.2},
                 {1.2001, 1.2}, {-1.3, -1.2},    {1.2, 1.2},       {-1.2, -1.2}, {-0.0, 0.0}};
    const int32_t method = own_add("say", 1.2, say, &said);
    scan s = scan_with(method, 1000.0, 0.0);
    for (size_t i = 0; i < 1000; i++) { /* another one each tick */
        said = cases[i % COUNT_OF(cases)].said;
        CHECK_SAME(play(&s, 1e-4 * (double)i, 0.0, 0.1, 0.0), A * cases[i % COUNT_OF(cases)].played);
    }
    assert_true(knurl_method_get_faults(method) == 700);
    assert_true(knurl_method_get_faults(KNURL_METHOD_S1) == 0 && knurl_method_get_faults(-1) == 0);
}

TEST(positions_and_velocities_beyond_all_ridges_give_finite_heights) {
    scan s = scan_with(own_add("copy-of-S1", 1.0, own_s1, NULL), 1e9, 1e9);
    for (double x = 1e9; x < 1e300; x *= 1e30) {
        assert_true(fabs(play(&s, x, -x, -x, x)) <= A);
    }
}

/* --- memory --- */

static double count(const knurl_method_input *in, double *memory, void *user) KNURL_NONBLOCKING {
    (void)in, (void)user;
    const double before = memory[0];
    for (int i = 0; i < 4; i++) {
        memory[i] = memory[i] == before ? before + 1.0 : NAN;
    }
    return memory[0];
}

TEST(its_memory_begins_at_zeros_also_after_another_own_method_or_s2) {
    const int32_t method = own_add("count", 10.0, count, NULL), other = own_add("other", 10.0, count, NULL);
    scan s = scan_with(method, 1000.0, 0.0);
    for (int k = 1; k <= 5; k++) {
        CHECK_SAME(play(&s, 0.0, 0.0, 0.25, 0.0), A * k);
    }
    s.grating.method = other;
    CHECK_SAME(play(&s, 0.0, 0.0, 0.25, 0.0), A);
    s.grating.method = method;
    CHECK_SAME(play(&s, 0.0, 0.0, 0.25, 0.0), A);
    s.grating.method = KNURL_METHOD_S2;
    CHECK_SAME(play(&s, 0.0, 0.0, 0.25, 0.0), A); /* 4 ticks: two up, two down */
    s.grating.method = method;
    CHECK_SAME(play(&s, 0.0, 0.0, 0.25, 0.0), A); /* the event's second tick: it plays to its end */
    CHECK_SAME(play(&s, 0.0, 0.0, 0.25, 0.0), -A);
    CHECK_SAME(play(&s, 0.0, 0.0, 0.25, 0.0), -A);
    CHECK_SAME(play(&s, 0.0, 0.0, 0.25, 0.0), A);
    CHECK_SAME(play(&s, 0.0, 0.0, 0.25, 0.0), 2.0 * A);
    memset(&s.state, 0, sizeof s.state);
    CHECK_SAME(play(&s, 0.0, 0.0, 0.25, 0.0), A);
}

TEST(another_method_after_it_is_not_disturbed_by_its_memory) {
    const int32_t others[] = {KNURL_METHOD_S2, KNURL_METHOD_BANDLIMITED};
    for (size_t i = 0; i < COUNT_OF(others); i++) {
        scan s = scan_with(own_add("count", 10.0, count, NULL), 1000.0, 0.0), fresh = scan_with(others[i], 1000.0, 0.0);
        (void)play(&s, 0.0, 0.0, 0.2, 0.0);
        s.grating.method = others[i];
        for (int k = 1; k < 200; k++) {
            CHECK_SAME(play(&s, 2e-4 * k, 0.0, 0.2, 0.0), play(&fresh, 2e-4 * k, 0.0, 0.2, 0.0));
        }
    }
}

/* --- refusals --- */

TEST(invalid_arguments_are_refused_by_name_and_nothing_is_added) {
    static double zero;
    static const char *const names[] = {
        "", "two words", "a\"b", "S2", "bandlimited", "say", "12345678901234567890123456789012", "caf\xc3\xa9"};
    int32_t method = 77;
    for (size_t i = 0; i < COUNT_OF(names); i++) {
        CHECK_REFUSED(knurl_method_add(names[i], 1.0, say, &zero, &method), KNURL_ERROR_ARGUMENT, method);
        check_message("name: expected ");
    }
    static const double crests[] = {0.0, -1.0, 10.1, NAN, INFINITY};
    for (size_t i = 0; i < COUNT_OF(crests); i++) {
        CHECK_REFUSED(knurl_method_add("good", crests[i], say, &zero, &method), KNURL_ERROR_ARGUMENT, method);
        check_message("crest: expected above 0 and up to 10 (A), found ");
    }
    CHECK_REFUSED(knurl_method_add("good", 1.0, NULL, &zero, &method), KNURL_ERROR_ARGUMENT, method);
    check_message("height: expected a function, found null");
    CHECK_REFUSED(knurl_method_from_name("good", &method), KNURL_ERROR_UNKNOWN, method);
    check_message("expected S1, S2, bandlimited, look, copy-of-S1, copy-of-S2, say, count or other, found 'good'");
}

TEST(a_number_that_no_method_has_is_refused) {
    knurl_grating grating = {.spatial_frequency = {1000.0, 0.0}, .amplitude = A, .update_rate_hz = 1000.0};
    for (grating.method = 1; knurl_method_name(grating.method); grating.method++) {
        assert_int_equal(knurl_grating_check(&grating), KNURL_OK);
    }
    CHECK_REFUSED(knurl_grating_check(&grating), KNURL_ERROR_UNKNOWN, grating);
    check_message("or a number from knurl_method_add(), found 10");
}

/* The last test: methods are there until the process ends. */
TEST(there_are_16_and_the_next_is_refused) {
    static double zero;
    int32_t method = 0;
    char name[40];
    knurl_result result = KNURL_OK;
    int added = 0;
    while (!result && added < 100) {
        (void)snprintf(name, sizeof name, "ABCDEFGHIJKLMNOPQRSTUVWXYZ_%04d", added++);
        result = knurl_method_add(name, 1.0, say, &zero, &method);
    }
    assert_int_equal(result, KNURL_ERROR_FULL);
    check_message("expected at most 16 own methods, found another, 'ABCDEFGHIJKLMNOPQRSTUVWXYZ_0010'");
    assert_int_equal(method, KNURL_METHOD_BANDLIMITED + 16);
    CHECK_REFUSED(knurl_method_from_name("nobody", &method), KNURL_ERROR_UNKNOWN, method);
    check_message("ABCDEFGHIJKLMNOPQRSTUVWXYZ_0008 or ABCDEFGHIJKLMNOPQRSTUVWXYZ_0009, found 'nobody'");
}
