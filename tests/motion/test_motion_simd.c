/* The library's velocity estimators, with AVX if the machine has it and with it disabled, against the same source
 * compiled without AVX: equal to the bit for any input. SPDX-License-Identifier: MIT */
#include "motion/velocity.h"
#include "support/close.h"

/* velocity.c with KNURL_NO_SIMD and renamed (CMakeLists.txt) */
knurl_result plain_init(int32_t method, double resolution, double update_rate_hz, knurl_velocity *velocity);
void plain_update(knurl_velocity *velocity, const double position[3], double out[3]);

#define QUANTUM 0.055e-3
#define TICKS   120000

/* One axis' next position (m) from the one before; each case of choosing a window. */
typedef double next_position(double before, uint64_t *seed);

static double anywhere(double before, uint64_t *seed) {
    (void)before;
    return random_between(seed, -0.2, 0.2);
}

static double smooth(double before, uint64_t *seed) {
    return before + random_between(seed, -0.2, 0.6) * QUANTUM;
}

/* On counts: samples lie exactly one count off the line in a third of all ticks. */
static double tied(double before, uint64_t *seed) {
    return QUANTUM * (floor(before / QUANTUM + 0.5) + (double)random_integer(seed, -2, 3));
}

/* From below a step to beyond the resolved range, in which slopes round and positions clamp; also NaN and infinities.
 */
static double extreme(double before, uint64_t *seed) {
    static const double others[] = {0.0, -0.0, 1e300, -1e300, 5e-324, (double)INFINITY, -(double)INFINITY, (double)NAN};
    (void)before;
    if (random_integer(seed, 0, 9) == 0) {
        return others[random_integer(seed, 0, 7)];
    }
    return ldexp(random_between(seed, -1.0, 1.0), (int)random_integer(seed, -40, 40));
}

static int same_bits(const double a[3], const double b[3]) {
    uint64_t x[3];
    uint64_t y[3];
    memcpy(x, a, sizeof x);
    memcpy(y, b, sizeof y);
    return x[0] == y[0] && x[1] == y[1] && x[2] == y[2];
}

/* Two estimators in step, library's and plain build's; they end in the same state, except for the selected code path.
 */
static void compare(next_position *next, uint64_t seed, double rate, uint32_t avx) {
    knurl_velocity library;
    knurl_velocity plain;
    double position[3] = {0.0, 0.0, 0.0};
    assert_int_equal(knurl_velocity_prepare(KNURL_VELOCITY_FOAW, QUANTUM, rate, &library), KNURL_OK);
    assert_int_equal(plain_init(KNURL_VELOCITY_FOAW, QUANTUM, rate, &plain), KNURL_OK);
    knurl_velocity_get_state(&library)->avx = avx;
    for (int k = 0; k < TICKS; k++) {
        double out[3];
        double expected[3];
        if (random_integer(&seed, 0, 99) == 0) {
            knurl_velocity_reset(&library);
            knurl_velocity_reset(&plain);
        }
        for (size_t axis = 0; axis < 3; axis++) {
            position[axis] = next(position[axis], &seed);
        }
        knurl_velocity_update(&library, position, out);
        plain_update(&plain, position, expected);
        if (!same_bits(out, expected)) {
            assert_memory_equal(out, expected, sizeof out); /* shows the difference; slow, so only then */
        }
        if (!(isfinite(out[0]) && isfinite(out[1]) && isfinite(out[2]))) {
            fail_msg("tick %d: not finite", k);
        }
    }
    knurl_velocity_get_state(&library)->avx = 0;
    assert_memory_equal(&library, &plain, sizeof plain);
}

static int has_avx(void) {
#if defined(__x86_64__) && defined(__GNUC__)
    return __builtin_cpu_supports("avx") != 0;
#else
    return 0;
#endif
}

static void compare_paths(next_position *next, uint64_t seed) {
    compare(next, seed, 1000.0, 0);
    compare(next, seed, 5000.0, 0);
    if (!has_avx()) {
        print_message("no AVX on this machine: its path is not compared\n");
        skip();
    }
    compare(next, seed, 1000.0, 1);
    compare(next, seed, 5000.0, 1);
}

TEST(init_chooses_avx_where_the_machine_has_it) {
    knurl_velocity velocity;
    assert_int_equal(knurl_velocity_prepare(KNURL_VELOCITY_FOAW, QUANTUM, 1000.0, &velocity), KNURL_OK);
    assert_int_equal(knurl_velocity_get_state(&velocity)->avx, has_avx());
    assert_int_equal(plain_init(KNURL_VELOCITY_FOAW, QUANTUM, 1000.0, &velocity), KNURL_OK);
    assert_int_equal(knurl_velocity_get_state(&velocity)->avx, 0);
}

TEST(all_paths_agree_on_positions_without_order) {
    compare_paths(anywhere, 1);
}

TEST(all_paths_agree_on_smooth_motion_between_counts) {
    compare_paths(smooth, 2);
}

TEST(all_paths_agree_where_samples_lie_one_count_off_the_line) {
    compare_paths(tied, 3);
}

TEST(all_paths_agree_on_extreme_positions_and_stay_finite) {
    compare_paths(extreme, 4);
}
