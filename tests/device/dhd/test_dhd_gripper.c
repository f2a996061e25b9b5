/* samples/gripper.c over the stand-in library. SPDX-License-Identifier: MIT */
#include "device/dhd/dhd_double.h"
#include "support/close.h"

#define SIGMA7 104

/* The sample's main(). */
int gripper_main(int argc, char **argv);

/* The double sets the stand-in up as it opens. */
static int run_gripper(int type) {
    static char name[] = "gripper";
    static char *arguments[] = {name, NULL};
    stub_dhd_torque old;
    knurl_device *device = dhd_double.open();
    if (!device) {
        fail_msg("%s", knurl_error_message());
    }
    dhd_double.close(device);
    dhd_stub.set(STUB_DHD_TYPE, type);
    dhd_stub.tell_torque(&old);
    return gripper_main(1, arguments);
}

/* The fingers are at 0.2 rad, 0.15 rad into a ball of 8 N/rad; the wrist rests. */
TEST(the_fingers_feel_the_ball_and_then_no_force) {
    stub_dhd_torque told;
    assert_int_equal(run_gripper(SIGMA7), 0);
    dhd_stub.tell_torque(&told);
    CHECK_CLOSE(told.most_grip, 8.0 * 0.15, 1e-12);
    CHECK_CLOSE(told.most_torque, 0.0, 1e-12);
    assert_true(told.alone > 100); /* without a force at the grip */
    CHECK_SAME(told.grip, 0.0L);
    assert_int_equal(dhd_stub.opens(), 0);
}

TEST(a_device_without_a_gripper_is_refused) {
    stub_dhd_torque told;
    assert_int_equal(run_gripper(0), 1);
    check_message("expected a device with a gripper, found ");
    dhd_stub.tell_torque(&told);
    CHECK_SAME(told.most_grip, 0.0L);
    assert_int_equal(dhd_stub.opens(), 0);
}
