/* The numbers of a HIP: each in the range that hip.h states, or it is not configured; at every end of the ranges the
 * motors' limit holds. SPDX-License-Identifier: MIT */
#include "scene/ask.h"

#include "hip/snapshot.h"

enum { ZERO = 1, ENDLESS = 2 };

static const struct number {
    const char *name;
    size_t at;
    double least, most;
    int or_else;
    const char *range;
} numbers[] = {
#define NUMBER(field) #field, offsetof(knurl_hip_desc, field)
    {NUMBER(update_rate_hz), 100.0, 10000.0, 0, "KNURL_DEFAULT (-1) or 100 to 10000 Hz"},
    {NUMBER(resolution), 1e-9, 0.01, ZERO, "KNURL_DEFAULT (-1) or 0 or 1e-09 to 0.01 m"},
    {NUMBER(max_force), 0.01, 1e6, 0, "KNURL_DEFAULT (-1) or 0.01 to 1000000 N"},
    {NUMBER(continuous_force), 0.01, 1000.0, ENDLESS, "KNURL_DEFAULT (-1) or INFINITY or 0.01 to 1000 N"},
    {NUMBER(heat_time), 0.001, 1e6, 0, "KNURL_DEFAULT (-1) or 0.001 to 1000000 s"},
    {NUMBER(viscous), 0.0, 1000.0, 0, "KNURL_DEFAULT (-1) or 0 to 1000 N s/m"},
    {NUMBER(delay), 0.0, 16.0, 0, "KNURL_DEFAULT (-1) or 0 to 16 ticks"},
    {NUMBER(max_stiffness), 1.0, 1e9, ENDLESS, "KNURL_DEFAULT (-1) or INFINITY or 1 to 1000000000 N/m"},
    {NUMBER(slew_rate), 0.01, 1e9, ENDLESS, "KNURL_DEFAULT (-1) or INFINITY or 0.01 to 1000000000 N/s"},
};

static knurl_result configure(knurl_scene *scene, const struct number *number, double value) {
    knurl_hip_desc d;
    knurl_hip_desc_init(&d, sizeof d);
    memcpy((char *)&d + number->at, &value, sizeof value);
    return knurl_scene_configure_hip(scene, 0, &d);
}

TEST(every_number_of_a_hip_is_in_its_range_or_the_hip_is_as_it_was) {
    SCOPED_SCENE *scene = empty_scene(1);
    char nothing = 0;
    for (size_t i = 0; i < COUNT_OF(numbers); i++) {
        const struct number *n = &numbers[i];
        const struct {
            double value;
            int taken;
        } values[] = {{n->least, 1},
                      {n->most, 1},
                      {n->least * 0.999 - 1e-12, 0},
                      {n->most * 1.001, 0},
                      {5e-324, n->least == 0.0},
                      {1e300, 0},
                      {(double)NAN, 0},
                      {0.0, n->least == 0.0 || n->or_else & ZERO},
                      {KNURL_DEFAULT, 1},
                      {-2.0, 0},
                      {-(double)INFINITY, 0},
                      {(double)INFINITY, n->or_else & ENDLESS}};
        for (size_t k = 0; k < COUNT_OF(values); k++) {
            if (values[k].taken) {
                assert_int_equal(configure(scene, n, values[k].value), KNURL_OK);
                continue;
            }
            CHECK_REFUSED(configure(scene, n, values[k].value), KNURL_ERROR_ARGUMENT, nothing);
            check_message("knurl_hip_desc.");
            check_message(n->name);
            check_message(n->range);
        }
    }
    assert_int_equal(configure(scene, &numbers[3], 5e-324), KNURL_ERROR_ARGUMENT);
    assert_string_equal(knurl_error_message(),
                        "knurl_hip_desc.continuous_force: expected KNURL_DEFAULT (-1) or INFINITY or 0.01 to "
                        "1000 N, found 4.94066e-324");
}

/* A press of a metre for 1000 ticks: no force beyond max_force, a finite heat, and from motors at their final
 * temperature their continuous force. Returns the last force, N. */
static double check_motors(double rate, double max_force, double continuous_force, double heat_time) {
    surface_parts parts = surface_plane();
    parts.material.stiffness = 1e9;
    knurl_hip_desc d;
    double force = 0.0;
    knurl_hip_desc_init(&d, sizeof d);
    d.update_rate_hz = rate;
    d.max_force = max_force;
    d.continuous_force = continuous_force;
    d.heat_time = heat_time;
    SCOPED_SCENE *scene = scene_with_hip(&parts, &d);
    for (int tick = 0; tick < 1000; tick++) {
        const knurl_tick_output out = tick_at(scene, 0.0, 0.0, tick == 0 ? 1.0 : -1.0);
        const knurl_hip_counts counts = counts_of(scene);
        assert_true(out.device_force[2] >= 0.0 && out.device_force[2] <= max_force * (1.0 + 1e-9));
        assert_true(isfinite(counts.heat) && counts.heat >= 0.0 && isfinite(counts.force_max));
        assert_true(max_force <= continuous_force || counts.heat <= 1.0);
        force = out.device_force[2];
    }
    return force;
}

TEST(at_all_ends_of_the_ranges_the_motors_are_protected) {
    static const double rates[] = {100.0, 10000.0}, most[] = {0.01, 1000.0, 1e6};
    static const double continuous[] = {0.01, 1.0, 1000.0, (double)INFINITY}, times[] = {0.001, 1.0, 1e6};
    for (size_t i = 0; i < 2 * 3 * 4 * 3; i++) {
        const double max_force = most[i / 2 % 3], holds = continuous[i / 6 % 4], heat_time = times[i / 24];
        const double force = check_motors(rates[i % 2], max_force, holds, heat_time);
        if (heat_time < 0.01 && max_force <= 1000.0) {
            CHECK_CLOSE(force / fmin(max_force, holds), 1.0, 0.01);
        }
    }
}

TEST(each_flag_of_a_tick_has_a_counter_of_its_own) {
    static const struct {
        uint32_t flag;
        size_t at;
    } counters[] = {
#define COUNTER(flag, field) {KNURL_TICK_##flag, offsetof(knurl_hip_counts, field)}
        COUNTER(FORCE_LIMIT, force_limit_ticks),
        COUNTER(ABOVE_NYQUIST, above_nyquist_ticks),
        COUNTER(NOT_FINITE, non_finite_ticks),
        COUNTER(ENTRY, entry_ticks),
        COUNTER(SLEW, slew_ticks),
        COUNTER(HEAT, heat_ticks),
        COUNTER(PASSIVITY, passivity_ticks),
        COUNTER(SQUEEZED, squeezed_ticks),
        COUNTER(VISIT_LIMIT, visit_limit_ticks),
    };
    for (size_t i = 0; i < COUNT_OF(counters); i++) {
        static const uint64_t one = 1;
        knurl_hip_counts counts, expected;
        memset(&counts, 0, sizeof counts);
        memset(&expected, 0, sizeof expected);
        memcpy((char *)&expected + counters[i].at, &one, sizeof one);
        knurl_counts_add_flags(&counts, counters[i].flag);
        assert_memory_equal(&counts, &expected, sizeof counts);
    }
}
