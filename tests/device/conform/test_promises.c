/* What a device's write() must never see, whatever a game does. SPDX-License-Identifier: MIT */
#include "stage.h"

static stage s; /* set up anew by each test */

TEST(a_gain_of_0_that_is_set_while_there_is_no_position_holds_when_there_is_one_again) {
    static const double held[3] = {0.0, 0.0, STAGE_FORCE};
    stage_open(&s, 0.0, 0.0, 0.02, 0, 0.0);
    assert_int_equal(knurl_loop_set_force(s.loop, held), KNURL_OK);
    stage_step(&s, 20);
    s.position[1] = (double)NAN;
    s.j.gain = 0.0;
    assert_int_equal(knurl_loop_set_gain(s.loop, 0.0), KNURL_OK);
    for (int k = 0; k < 60; k++) {
        s.j.absent = 1;
        stage_step(&s, 1);
    }
    s.position[1] = 0.0;
    for (int k = 0; k < 60; k++) {
        s.j.absent = k < 20; /* positions must stay for 20 ms */
        stage_step(&s, 1);
    }
    assert_true(stage_held(&s, "a gain of 0"));
    stage_close(&s);
}
