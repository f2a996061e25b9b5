/* Even sensation: a gain of ridges' amplitude over f_t. SPDX-License-Identifier: MIT */
#include "scene/ask.h"
#include "support/bandlimited.h"

#define A  0.001
#define FS 1000.0

static const knurl_gain falling[] = {{10.0, 1.0}, {100.0, 0.4}, {300.0, 0.1}};

static knurl_scene *even_scene(const knurl_gain *gains, uint32_t count) {
    surface_parts parts = surface_plane();
    set_grating(&parts, KNURL_METHOD_BANDLIMITED, FS, 0.0, A);
    knurl_scene *scene = scene_of(&parts);
    assert_int_equal(knurl_scene_set_gains(scene, 0, gains, count), KNURL_OK);
    return scene;
}

/* H divided by its value without gains, at a frequency between 100 and 480 Hz. */
static double gain_at(knurl_scene *scene, double hz) {
    knurl_tick_output out;
    (void)tick_moving(scene, (const double[3]){0.0, 0.0, 0.01}, (const double[3]){0.0, 0.0, 0.0});
    out = tick_moving(scene, (const double[3]){0.05e-3, 0.0, -0.003}, (const double[3]){hz / FS, 0.0, 0.0});
    return out.height / (A * band_harmonics(0.05, hz / 1000.0));
}

/* Linear in log hz between two pairs; a tick looks it up in a table of 16 values an octave. */
TEST(a_gain_is_straight_in_log_frequency_between_pairs_and_constant_beyond) {
    static const knurl_gain late[] = {{192.0, 0.4}, {320.0, 0.1}}; /* both in the table */
    for (int i = 0; i < 2; i++) {
        const double first = i ? 192.0 : 100.0, last = i ? 320.0 : 300.0;
        SCOPED_SCENE *scene = i ? even_scene(late, COUNT_OF(late)) : even_scene(falling, COUNT_OF(falling));
        for (double hz = 100.0; hz < 480.0; hz *= 1.013) {
            const double share = fmax(0.0, fmin(1.0, log(hz / first) / log(last / first)));
            CHECK_CLOSE(gain_at(scene, hz), 0.4 + (0.1 - 0.4) * share, 3e-3);
        }
    }
}

TEST(without_gains_nothing_changes_and_they_stay_until_they_are_taken_off) {
    SCOPED_SCENE *scene = even_scene(NULL, 0);
    CHECK_CLOSE(gain_at(scene, 200.0), 1.0, BAND_EXACT);
    assert_int_equal(knurl_scene_set_gains(scene, 0, falling, 2), KNURL_OK);
    configure_plainly(scene, 0);
    CHECK_CLOSE(gain_at(scene, 200.0), 0.4, BAND_EXACT);
    assert_int_equal(knurl_scene_set_gains(scene, 0, NULL, 0), KNURL_OK);
    CHECK_CLOSE(gain_at(scene, 200.0), 1.0, BAND_EXACT);
}

TEST(a_check_tells_the_lowest_gain_and_where_the_amplitude_is_lowered) {
    SCOPED_SCENE *scene = even_scene(falling, COUNT_OF(falling));
    knurl_surface_check check = first_check(scene);
    CHECK_CLOSE(check.lowest_gain, 0.1, 1e-12L);
    CHECK_SAME(check.lowered_hz[0], 100.0);
    CHECK_SAME(check.lowered_hz[1], 300.0);
    assert_int_equal(knurl_scene_set_gains(scene, 0, NULL, 0), KNURL_OK);
    check = first_check(scene);
    CHECK_SAME(check.lowest_gain, 1.0);
    CHECK_SAME(check.lowered_hz[1], 0.0);
}

TEST(gains_that_are_wrong_are_refused_by_number_and_change_nothing) {
    static const struct {
        knurl_gain pairs[2];
        const char *sentence;
    } bad[] = {{{{10.0, 0.5}, {10.0, 0.5}}, "gain 1: expected frequencies that rise"},
               {{{20.0, 0.5}, {10.0, 0.5}}, "gain 1: expected frequencies that rise"},
               {{{0.0, 0.5}, {10.0, 0.5}}, "gain 0: expected frequencies"},
               {{{NAN, 0.5}, {10.0, 0.5}}, "gain 0: expected frequencies"},
               {{{10.0, 1.01}, {20.0, 0.5}}, "gain 0: expected 0 to 1, found 1.01"},
               {{{10.0, 1.0}, {20.0, NAN}}, "gain 1: expected 0 to 1"}};
    SCOPED_SCENE *scene = even_scene(falling, 2);
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        assert_int_equal(knurl_scene_set_gains(scene, 0, bad[i].pairs, 2), KNURL_ERROR_ARGUMENT);
        check_message(bad[i].sentence);
        CHECK_CLOSE(gain_at(scene, 200.0), 0.4, BAND_EXACT);
    }
    assert_int_equal(knurl_scene_set_gains(scene, 7, NULL, 0), KNURL_ERROR_ARGUMENT);
    assert_int_equal(knurl_scene_set_gains(NULL, 0, NULL, 0), KNURL_ERROR_ARGUMENT);
}
