/* Motors that were warm when their device was closed are warm when it is opened again. SPDX-License-Identifier: MIT */
#include "device/rawhid/driver_rig.h"

#include <knurl/loop.h>

#define SECONDS 0.3
#define FORCE   3.0

/* Presses for `seconds`. Returns the motors' heat before and after, as reported by the loop. */
static void run(double seconds, double *before, double *after) {
    double force[3] = {0.0, FORCE, 0.0};
    open_ready("");
    const knurl_loop_desc desc = push_desc(device, force);
    knurl_loop *loop = start_push(&desc);
    *before = loop_stats(loop).heat;
    sleep_ms(1000.0 * seconds);
    knurl_loop_stop(loop);
    *after = loop_stats(loop).heat;
    knurl_loop_destroy(loop);
    close_device();
}

/* theta' = ((F/continuous)^2 - theta)/time; the ramps at both ends and late ticks leave more than half of it. */
TEST_WITH(a_device_that_is_opened_again_is_as_warm_as_it_was, set_up, tear_down) {
    const double expected = (FORCE * FORCE / (1.7 * 1.7)) * (1.0 - exp(-SECONDS / 60.0));
    double before;
    double warm;
    double again;
    run(SECONDS, &before, &warm);
    assert_true(before < 0.05 * expected && warm > 0.5 * expected);
    run(0.02, &again, &before);
    assert_true(again > 0.9 * warm); /* it cools by a 60th in a second */
}
