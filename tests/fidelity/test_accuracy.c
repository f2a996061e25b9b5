/* The yardstick over all speeds, at 1 kHz: against closed forms if a method has one, and within the goals set for
 * bandlimited before it was built. SPDX-License-Identifier: MIT */
#include "accuracy.h"
#include "support/close.h"

#include <math.h>

static accuracy measure(int32_t method, int velocity, double resolution, double ridge) {
    study_contender c;
    accuracy found;
    for (size_t i = 0; study_contender_at(i, &c); i++) {
        if (c.method->spatial && c.method->id == method && c.update_rate_hz == 1000.0 &&
            (!c.method->uses_velocity || c.velocity == velocity) && (c.resolution > 0.0) == (resolution > 0.0)) {
            c.ridge = ridge;
            assert_true(accuracy_measure(&c, &found));
            return found;
        }
    }
    fail_msg("no such contender");
    return found;
}

/* Of 3 ticks a cycle two are up. A square wave: its crest is 1, and it crosses as many edges as there are. */
TEST(s1_pushes_by_a_third) {
    const accuracy a = measure(KNURL_METHOD_S1, STUDY_IDEAL, 0.0, 1e-3);
    CHECK_CLOSE(a.mean_worst, 1.0 / 3.0, 1e-6);
    CHECK_CLOSE(a.crest, 1.0, 0.0);
    CHECK_CLOSE(a.wavering_worst, 0.0, 1e-6);
    CHECK_CLOSE(a.step, 0.0, 1e-9);
}

/* Near 440 Hz it plays the mix of 2 and 3 ticks, whose strongest line is at 2 of its 6 ticks' cycles. */
TEST(s2_plays_another_frequency) {
    const accuracy a = measure(KNURL_METHOD_S2, STUDY_IDEAL, 0.0, 1e-3);
    CHECK_CLOSE(a.frequency_worst, 1.0 - 1000.0 / 3.0 / 439.7, 1e-3);
    CHECK_CLOSE(a.felt_worst, 1.0, 1e-3);
    CHECK_CLOSE(a.crest, (2.0 + 3.0 * sqrt(2.0)) / sqrt(13.0), 1e-9);
    assert_true(a.mean_worst < 1e-3 && a.step > 10.0);
}

/* A sine and its image at f_h - f_t, at the fastest speed that counts, 439.7 Hz. It is uneven by their beat. */
TEST(bandlimited_is_felt_with_its_image_alone) {
    const double f = 439.7;
    const double pi = 3.141592653589793;
    const double plant =
        (pow(700.0 - 0.045 * pow(2.0 * pi * f, 2.0), 2.0) + pow(11.0 * pi * f, 2.0)) /
        (pow(700.0 - 0.045 * pow(2.0 * pi * (1000.0 - f), 2.0), 2.0) + pow(11.0 * pi * (1000.0 - f), 2.0));
    const double image = pow(f / (1000.0 - f), 2.0 + 4.0) * plant; /* the hold's and the threshold's share of power */
    const accuracy a = measure(KNURL_METHOD_BANDLIMITED, STUDY_IDEAL, 0.0, 1e-3);
    CHECK_CLOSE(a.felt_worst, image / (1.0 + image), 1e-3);
    CHECK_CLOSE(a.crest, 4.0 / pi, 1e-3);
    assert_true(a.mean_worst < 1e-4 && a.false_worst < 0.02 && a.frequency_worst < 1e-4);
}

/* Through an encoder of 0.055 mm, within the goals that were set before it was built. */
TEST(bandlimited_through_counts_keeps_its_goals) {
    const accuracy mm = measure(KNURL_METHOD_BANDLIMITED, STUDY_FOAW, 1.0, 1e-3);
    const accuracy half = measure(KNURL_METHOD_BANDLIMITED, STUDY_FOAW, 1.0, 0.5e-3);
    assert_true(mm.false_worst < 0.02 && half.false_worst < 0.08);
    assert_true(mm.felt_worst < 0.09 && half.felt_worst < 0.09);
    assert_true(mm.mean_worst < 0.01 && half.mean_worst < 0.01);
    assert_true(mm.crest < 1.28 && half.crest < 1.28);
    assert_true(mm.step < 0.055 && half.step < 0.11); /* a count */
}

/* A triangle's first harmonic is 8/pi^2, its ninth and so on push at 3 ticks a cycle: from 0.123 cycles on its heights
 * are 0.508, -0.824 and 0.156. */
TEST(an_own_method_is_measured_by_the_same_formulas) {
    const double pi = 3.141592653589793;
    int32_t method = 0;
    assert_int_equal(study_add_own(), KNURL_OK);
    assert_int_equal(knurl_method_from_name("triangle", &method), KNURL_OK);
    const accuracy a = measure(method, STUDY_IDEAL, 0.0, 1e-3);
    CHECK_CLOSE(a.level, 1.0 - 8.0 / (pi * pi) / (4.0 / pi), 1e-3);
    CHECK_CLOSE(a.mean_worst, 0.16 / 3.0, 1e-3);
    CHECK_CLOSE(a.crest, 1.0, 1e-4);
    CHECK_CLOSE(a.step, 0.0, 1e-9);
}
