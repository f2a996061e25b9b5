/* A process that forks while a loop runs: its child has the memory, but no threads.
 * SPDX-License-Identifier: MIT */
#include "support/close.h"
#include "support/idle_device.h"

#include <knurl/knurl.h>

#include <sys/wait.h>
#include <unistd.h>

#define PATIENCE 5 /* s */

static knurl_result get_position(void *user, knurl_device_sample *sample) {
    (void)user;
    (void)sample;
    return KNURL_OK;
}

/* One with an I/O thread, too. */
static knurl_device *blocking_device(void) {
    knurl_device_functions functions = idle_functions();
    knurl_device *device = NULL;
    functions.read = get_position;
    functions.blocking = 1;
    functions.motors_known = 1;
    assert_int_equal(knurl_device_open_functions(&functions, &device), KNURL_OK);
    return device;
}

static int stop_loop(knurl_loop *loop, knurl_device *device) {
    (void)device;
    knurl_loop_stop(loop);
    return 0;
}

static int wait_long(knurl_loop *loop, knurl_device *device) {
    (void)device;
    return knurl_loop_wait(loop, 100.0) == 1 ? 0 : 1;
}

static int free_all(knurl_loop *loop, knurl_device *device) {
    knurl_loop_destroy(loop);
    knurl_device_close(device);
    return 0;
}

/* The child's exit code; a negative signal if it was ended by one. */
static int in_a_child(int (*what)(knurl_loop *loop, knurl_device *device), knurl_loop *loop, knurl_device *device) {
    int status = 0;
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        (void)alarm(PATIENCE);
        _exit(what(loop, device));
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}

TEST(a_forked_child_waits_for_no_thread_and_the_loop_of_its_parent_goes_on) {
    double none[3] = {0.0, 0.0, 0.0};
    SCOPED_DEVICE *device = blocking_device();
    const knurl_loop_desc desc = push_desc(device, none);
    knurl_loop *loop = start_push(&desc);
    assert_int_equal(in_a_child(stop_loop, loop, device), 0);
    assert_int_equal(in_a_child(wait_long, loop, device), 0);
    assert_int_equal(in_a_child(free_all, loop, device), 0);
    const uint64_t ticks = loop_stats(loop).ticks;
    assert_int_equal(knurl_loop_wait(loop, 0.05), 0);
    assert_true(loop_stats(loop).ticks > ticks);
    knurl_loop_destroy(loop);
}
