/* A soft ball between the fingers of a gripper, and a wrist that springs back to its first orientation: on Force
 * Dimension's omega.7, sigma.7 and lambda.7. It prints the gripper's angle for ten seconds, then the joints'. usage:
 * gripper [DEVICE], as knurl_device_open() has it; by default dhd. SPDX-License-Identifier: MIT */
#include <knurl/knurl.h>

#include <math.h>
#include <stdio.h>

#define BALL    0.35 /* rad: the gripper's angle at which the fingers touch the ball */
#define FIRM    8.0  /* N/rad */
#define UPRIGHT 0.1  /* N m/rad */

/* Of the haptic thread; main() reads them once that has ended. */
static double first[4]; /* orientation */
static knurl_device_sample last;

static void no_force(uint64_t tick, const knurl_device_sample *sample, double force[3], void *user) {
    (void)tick;
    (void)sample;
    (void)force;
    (void)user;
}

/* The torque of a spring is along the axis of the turn since the first tick: b times a's inverse, twice its x, y, z for
 * small turns. The device's limits apply to both. */
static void squeeze(uint64_t tick, const knurl_device_sample *sample, knurl_device_torque *torque, void *user) {
    const double *a = first;
    const double *b = sample->orientation;
    (void)user;
    last = *sample;
    for (int i = 0; i < 4 && tick == 0; i++) {
        first[i] = b[i];
    }
    const double w = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
    const double k = w < 0.0 ? 2.0 * UPRIGHT : -2.0 * UPRIGHT; /* q and -q are the same turn */
    torque->torque[0] = k * (b[0] * a[3] - b[3] * a[0] - b[1] * a[2] + b[2] * a[1]);
    torque->torque[1] = k * (b[1] * a[3] - b[3] * a[1] - b[2] * a[0] + b[0] * a[2]);
    torque->torque[2] = k * (b[2] * a[3] - b[3] * a[2] - b[0] * a[1] + b[1] * a[0]);
    torque->grip = sample->grip < BALL ? FIRM * (BALL - sample->grip) : 0.0;
}

static knurl_result open_gripper(const char *uri, knurl_device **device) {
    knurl_device_info info;
    knurl_device_info_init(&info, sizeof info);
    knurl_result result = knurl_device_open(uri, device);
    result = result ? result : knurl_device_get_info(*device, &info);
    if (!result && info.max_grip == 0.0) {
        return knurl_fail(KNURL_ERROR_UNSUPPORTED, "expected a device with a gripper, found %s", info.name);
    }
    if (!result) {
        printf("%s: up to %.2f N and %.3f N m\n", info.name, info.max_grip, info.max_torque);
    }
    return result;
}

int main(int argc, char **argv) {
    knurl_device *device = NULL;
    knurl_loop *loop = NULL;
    knurl_loop_desc desc;
    knurl_device_status status;
    (void)knurl_device_zero_on_exit(0); /* zero force however this program ends */
    knurl_loop_desc_init(&desc, sizeof desc);
    knurl_device_status_init(&status, sizeof status);
    knurl_result result = open_gripper(argc > 1 ? argv[1] : "dhd", &device);
    desc.device = device;
    desc.force_callback = no_force;
    desc.torque_callback = squeeze;
    desc.tick_limit = 10000; /* at 1 kHz */
    result = result ? result : knurl_loop_create(&desc, &loop);
    result = result ? result : knurl_loop_start(loop);
    while (!result && !knurl_loop_wait(loop, 0.5)) {
        result = knurl_device_get_status(device, &status);
        printf("gripper %5.1f degrees%s\n", 57.2958 * status.grip, status.grip < BALL ? ", on the ball" : "");
    }
    if (result) {
        fprintf(stderr, "gripper: %s\n", knurl_error_message());
    }
    knurl_loop_destroy(loop);
    for (uint32_t i = 0; i < last.joint_count; i++) {
        printf("joint %u %6.1f degrees\n", (unsigned)i, 57.2958 * last.joints[i]);
    }
    knurl_device_close(device);
    return result != KNURL_OK;
}
