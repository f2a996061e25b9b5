/* Sessions with even sensation. SPDX-License-Identifier: MIT */
#include "session_rig.h"

/* Flat, but for a resonance of 100 at 160 Hz. */
static const char response[] = "# knurl response 1\nfrequency_hz,gain\n20,1\n150,1\n160,100\n170,1\n310,1\n";

static double lowest_gain(knurl_session *s) {
    knurl_surface_check check;
    knurl_surface_check_init(&check, sizeof check);
    const knurl_scene *scene = knurl_session_get_scene(s);
    assert_int_equal(knurl_scene_check_surface(scene, 0, knurl_scene_get_surface(scene, 0), &check), KNURL_OK);
    return check.lowest_gain;
}

static double lowest_of(const knurl_gain *gains) {
    double lowest = 1.0;
    for (int i = 0; i < KNURL_GAINS; i++) {
        lowest = fmin(lowest, gains[i].gain);
    }
    return lowest;
}

TEST(even_sensation_is_the_plants_or_the_responses_and_off_at_the_next_open) {
    knurl_gain gains[KNURL_GAINS];
    knurl_session_desc desc = describe("fake", "");
    SCOPED_SESSION *s = make_session();
    (void)add_plate(s, 0.0, 0.0, 0.0);
    desc.even = 1;
    open_session(s, &desc);
    assert_int_equal(knurl_gains_from_plant(0.045, 0.5, 1000.0, gains), KNURL_OK);
    CHECK_CLOSE(lowest_gain(s), lowest_of(gains), 1e-3); /* of a table at other frequencies */
    assert_int_equal(knurl_session_start(s, NULL, 0), KNURL_OK);
    knurl_session_close(s);
    desc.response = response;
    desc.response_size = sizeof response - 1;
    open_session(s, &desc);
    assert_int_equal(knurl_gains_from_response(response, sizeof response - 1, gains), KNURL_OK);
    CHECK_CLOSE(lowest_gain(s), lowest_of(gains), 0.02);
    assert_true(lowest_gain(s) < 0.05);
    knurl_session_close(s);
    desc.even = 0;
    open_session(s, &desc);
    CHECK_SAME(lowest_gain(s), 1.0);
}

TEST(a_mouse_has_no_mass_and_plays_without) {
    knurl_session_desc desc = describe("mouse", "");
    SCOPED_SESSION *s = make_session();
    (void)add_plate(s, 0.0, 0.0, 0.0);
    desc.even = 1;
    open_session(s, &desc);
    CHECK_SAME(lowest_gain(s), 1.0);
}

TEST(a_response_that_is_wrong_leaves_the_session_closed) {
    knurl_session_desc desc = describe("fake", "");
    SCOPED_SESSION *s = make_session();
    desc.even = 1;
    desc.response = "nothing\n";
    desc.response_size = 8;
    assert_int_equal(knurl_session_open(s, &desc), KNURL_ERROR_FORMAT);
    check_message("line 1: expected '# knurl response 1', found 'nothing'");
    assert_null(knurl_session_get_device(s));
    desc.even = 2;
    assert_int_equal(knurl_session_open(s, &desc), KNURL_ERROR_ARGUMENT);
    desc.even = 0;
    open_session(s, &desc);
}
