/* Torque, gripper, joints and gravity compensation of Force Dimension's devices, over the stand-in library.
 * SPDX-License-Identifier: MIT */
#include "device/dhd/dhd_double.h"
#include "support/close.h"
#include "support/wait.h"

#include "base/atomic.h"
#include "device/driver.h"
#include "device/port.h"

#include <knurl/device.h>
#include <knurl/loop.h>
#include <knurl/scene.h>
#include <math.h>

#define SIGMA7 104
#define OMEGA3 33

/* Of a sigma.7: a third of CHAI3D's 0.2 N m and 8 N. */
#define MOST_TORQUE (0.2 / 3.0)
#define MOST_GRIP   (8.0 / 3.0)

static knurl_device *device;
static knurl_loop *loop;

static int end(void **state) {
    (void)state;
    knurl_loop_destroy(loop);
    loop = NULL;
    knurl_device_close(device);
    device = NULL;
    return 0;
}

/* The stand-in is reset when the double opens, so the type is set then and the driver opened again. */
static void open_model(int type, int is_left, const char *uri) {
    (void)end(NULL);
    device = dhd_double.open();
    if (!device) {
        fail_msg("%s", knurl_error_message());
    }
    dhd_double.close(device);
    dhd_stub.set(STUB_DHD_TYPE, type);
    dhd_stub.set(STUB_DHD_LEFT, is_left);
    device = NULL;
    assert_int_equal(knurl_device_open(uri, &device), KNURL_OK);
}

/* What the callbacks ask for; `is_wild` varies it. */
static struct {
    double force, torque[3], grip;
    int is_wild;
    uint64_t random;
} asked;

static const double odd[] = {0.0, 1e-9, 0.03, -0.05, 2.0, -5.0, 1e9, -1e300, (double)NAN, (double)INFINITY};

static double one_of(void) {
    return odd[random_bits(&asked.random) % COUNT_OF(odd)];
}

static void push(uint64_t tick, const knurl_device_sample *sample, double force[3], void *user) {
    (void)tick;
    (void)sample;
    (void)user;
    force[1] = asked.is_wild && random_bits(&asked.random) % 50 == 0 ? (double)NAN : asked.force;
}

static void turn(uint64_t tick, const knurl_device_sample *sample, knurl_device_torque *torque, void *user) {
    (void)tick;
    (void)sample;
    (void)user;
    for (int axis = 0; axis < 3; axis++) {
        assert_true(torque->torque[axis] == 0.0);
        torque->torque[axis] = asked.is_wild ? one_of() : asked.torque[axis];
    }
    torque->grip = asked.is_wild ? one_of() : asked.grip;
}

/* scene: gives the force in place of the callback, or null. */
static void start(double ramp_s, knurl_scene *scene) {
    const double force[3] = {0.0, asked.force, 0.0};
    knurl_loop_desc desc;
    knurl_loop_desc_init(&desc, sizeof desc);
    desc.device = device;
    desc.scene = scene;
    desc.force_callback = scene ? NULL : push;
    desc.torque_callback = turn;
    desc.ramp_s = ramp_s;
    assert_int_equal(knurl_loop_create(&desc, &loop), KNURL_OK);
    assert_int_equal(scene ? knurl_loop_set_force(loop, force) : KNURL_OK, KNURL_OK);
    assert_int_equal(knurl_loop_start(loop), KNURL_OK);
}

static stub_dhd_torque ask(void) {
    stub_dhd_torque told;
    dhd_stub.tell_torque(&told);
    return told;
}

static void ask_for(double force, double x, double y, double z, double grip) {
    memset(&asked, 0, sizeof asked);
    asked.force = force;
    asked.torque[0] = x;
    asked.torque[1] = y;
    asked.torque[2] = z;
    asked.grip = grip;
}

/* The library's x is Knurl's z, its y is x, its z is y; a left-handed gripper opens to the other side (the maker's own
 * example turns its sign). */
TEST_WITH(a_torque_and_a_grippers_force_reach_the_device_in_its_axes, NULL, end) {
    for (int is_left = 0; is_left < 2; is_left++) {
        ask_for(1.0, 0.01, 0.02, 0.03, 1.5);
        open_model(SIGMA7, is_left, "dhd");
        start(0.02, NULL);
        sleep_ms(200.0);
        const stub_dhd_torque told = ask();
        CHECK_CLOSE(told.torque[0], 0.03, 1e-15);
        CHECK_CLOSE(told.torque[1], 0.01, 1e-15);
        CHECK_CLOSE(told.torque[2], 0.02, 1e-15);
        CHECK_CLOSE(told.grip, is_left ? -1.5 : 1.5, 1e-15);
        knurl_loop_destroy(loop);
        loop = NULL;
        assert_true(ask().grip == 0.0);
    }
}

TEST_WITH(a_grippers_angle_and_the_joints_are_in_the_sample_and_the_angle_in_the_status, NULL, end) {
    for (int is_left = 0; is_left < 2; is_left++) {
        knurl_device_sample sample;
        open_model(SIGMA7, is_left, "dhd");
        sleep_ms(20.0);
        assert_int_equal(knurl_device_read(device, &sample), KNURL_OK);
        CHECK_CLOSE(sample.grip, 0.2, 1e-15);
        assert_int_equal(sample.joint_count, 7);
        CHECK_CLOSE(sample.joints[6], 0.7, 1e-15);
        CHECK_SAME(sample.joints[7], 0.0L);
        CHECK_CLOSE(device_status(device).grip, 0.2, 1e-15);
    }
}

TEST_WITH(a_device_without_a_wrist_or_a_gripper_gets_no_torque, NULL, end) {
    ask_for(1.0, 0.05, 0.05, 0.05, 2.0);
    open_model(OMEGA3, 0, "dhd");
    const knurl_device_info info = device_info(device);
    CHECK_SAME(info.max_torque, 0.0L);
    CHECK_SAME(info.max_grip, 0.0L);
    start(0.02, NULL);
    sleep_ms(200.0);
    const stub_dhd_torque told = ask();
    double force[3];
    double others[3];
    CHECK_SAME(told.most_torque, 0.0L);
    CHECK_SAME(told.most_grip, 0.0L);
    dhd_stub.ask(force, others);
    CHECK_CLOSE(force[1], 1.0, 1e-12); /* the callbacks were called */
}

TEST_WITH(gravity_compensation_is_switched_by_the_uri_and_otherwise_left_alone, NULL, end) {
    static const struct {
        const char *uri;
        int gravity;
    } cases[] = {{"dhd", -1}, {"dhd:?gravity=1", 1}, {"dhd:0?gravity=0", 0}};
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        open_model(SIGMA7, 0, cases[i].uri);
        assert_int_equal(ask().gravity, cases[i].gravity);
    }
    (void)end(NULL);
    CHECK_REFUSED(knurl_device_open("dhd:?gravity=2", &device), KNURL_ERROR_ARGUMENT, device);
    check_message("gravity: expected 0 or 1, found '2'");
}

/* With a steady request a torque is to the force as requested, through every ramp: 0.05 N m and 2 N to 1.25 N. */
static void follow(knurl_scene *scene) {
    static const double reached[] = {1.25, 0.0, 1.25, 1.25 / 3.0, 0.0}; /* N */
    ask_for(1.25, 0.0, 0.05, 0.0, 2.0);
    open_model(SIGMA7, 0, "dhd");
    start(0.2, scene);
    sleep_ms(300.0);
    for (int k = 0; k < 150; k++) { /* up, down by a pause, up, down to a third, and the ramp at the end */
        double force[3];
        double others[3];
        if (k == 30) {
            knurl_loop_pause(loop);
        } else if (k == 60) {
            knurl_loop_resume(loop);
        } else if (k == 90) {
            assert_int_equal(knurl_loop_set_gain(loop, 1.0 / 3.0), KNURL_OK);
        } else if (k == 120) {
            knurl_loop_request_stop(loop);
        }
        sleep_ms(10.0);
        dhd_stub.ask(force, others);
        const stub_dhd_torque told = ask();
        CHECK_CLOSE(told.torque[2], force[1] * 0.04, 1e-3 * 0.05 + 0.05 / 200.0); /* an exchange may come in between */
        CHECK_CLOSE(told.grip, force[1] * 1.6, 1e-3 * 2.0 + 2.0 / 200.0);
        assert_int_equal(told.alone, 0);
        if (k % 30 == 29) { /* each ramp has ended */
            CHECK_CLOSE(force[1], reached[k / 30], 1e-12);
        }
    }
}

TEST_WITH(a_torque_follows_every_ramp_of_the_force, NULL, end) {
    knurl_scene *scene = NULL;
    follow(NULL);
    assert_int_equal(knurl_scene_create(NULL, &scene), KNURL_OK);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    follow(scene);
    (void)end(NULL);
    knurl_scene_destroy(scene);
}

static const knurl_device_torque some = {.torque = {0.0, 0.02, 0.0}, .grip = 1.0};
static const double no_force[3];

/* Without a force the age of a torque counts as a force's does: 10 ms. */
TEST_WITH(a_torque_is_played_for_one_write_and_no_longer_than_a_force, NULL, end) {
    open_model(SIGMA7, 0, "dhd");
    sleep_ms(20.0);
    for (int writes = 1; writes <= 2; writes++) {
        knurl_port_release_halt(device);
        knurl_port_set_torque(device, 1.0, &some);
        assert_int_equal(knurl_device_write(device, no_force), KNURL_OK);
        sleep_ms(5.0);
        CHECK_CLOSE(ask().grip, 1.0, 1e-15);
        if (writes == 2) {
            assert_int_equal(knurl_device_write(device, no_force), KNURL_OK);
        }
        sleep_ms(writes == 2 ? 5 : 15);
        CHECK_SAME(ask().grip, 0.0L);
    }
}

TEST(a_halt_just_before_a_send_zeroes_the_torque_too) {
    knurl_device halted;
    double force[KNURL_FORCES] = {0.0, 0.0, 0.0, 0.0, 0.01, 0.0, 1.0};
    memset(&halted, 0, sizeof halted);
    knurl_store_relaxed(&halted.quiet, 1u);
    knurl_device_before_force(&halted, force);
    assert_int_equal(knurl_load_relaxed(&halted.quiet), 0);
    CHECK_SAME(force[6], 1.0L);
    knurl_store_relaxed(&halted.halted, KNURL_HALTED);
    knurl_device_before_force(&halted, force);
    assert_true(knurl_force_is_zero(force));
}

/* Something that may happen to a loop, or to its device. */
static void disturb(uint64_t *random) {
    static const int faults[] = {DOUBLE_MUTE, DOUBLE_HANG, DOUBLE_NAN, DOUBLE_JUMP, DOUBLE_UNHOMED, DOUBLE_OFF};
    switch (random_bits(random) % 6) {
    case 0:
        knurl_loop_pause(loop);
        break;
    case 1:
        knurl_loop_resume(loop);
        break;
    case 2:
        assert_int_equal(knurl_loop_set_gain(loop, (double)(random_bits(random) % 3) / 2.0), KNURL_OK);
        break;
    case 3:
        knurl_device_halt(device);
        break;
    case 4:
        dhd_double.inject(faults[random_bits(random) % COUNT_OF(faults)]);
        break;
    default:
        dhd_double.inject(DOUBLE_WELL);
    }
}

/* Requests are zeros, small and huge numbers, NaN and infinity; forces are NaN now and then, so that they are zero. */
TEST_WITH(a_torque_is_bounded_and_zero_whenever_the_force_is, NULL, end) {
    double most_torque = 0.0;
    double most_grip = 0.0;
    for (uint64_t seed = 1; seed <= 20; seed++) {
        memset(&asked, 0, sizeof asked);
        asked.force = 1.0;
        asked.is_wild = 1;
        asked.random = seed * 0x9E3779B97F4A7C15u; /* the haptic thread's */
        uint64_t random = ~asked.random;
        open_model(SIGMA7, (int)(seed % 2), "dhd");
        start(seed % 3 ? 0.02 : 0.0, NULL);
        (void)ask();
        for (int k = 0; k < 60; k++) {
            sleep_ms((int)(random_bits(&random) % 20));
            disturb(&random);
            const stub_dhd_torque told = ask();
            if (told.alone > 0 || !(told.most_torque <= MOST_TORQUE * (1.0 + 1e-12)) ||
                !(told.most_grip <= MOST_GRIP * (1.0 + 1e-12))) {
                fail_msg("seed %d, step %d: %d times without a force, up to %g N m and %g N", (int)seed, k, told.alone,
                         told.most_torque, told.most_grip);
            }
            most_torque = fmax(most_torque, told.most_torque);
            most_grip = fmax(most_grip, told.most_grip);
        }
        knurl_device_halt(device);
        knurl_loop_destroy(loop);
        loop = NULL;
        assert_true(ask().grip == 0.0);
    }
    CHECK_CLOSE(most_torque, MOST_TORQUE, 1e-9); /* the limits were reached */
    CHECK_CLOSE(most_grip, MOST_GRIP, 1e-9);
}
