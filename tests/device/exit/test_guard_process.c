/* The guard process by itself: its writes, its descriptors, and its end. SPDX-License-Identifier: MIT */
#define _GNU_SOURCE 1

#include "support/close.h"
#include "support/guard.h"

#include "base/system.h"

/* The guard program, compiled into this one: its system calls are intercepted below. */
#define main guard_main
int guard_main(void);
#include "base/guard_program.c" /* NOLINT(bugprone-suspicious-include): its functions, but not its main() */
#undef main

#include <fcntl.h>
#include <stdarg.h>
#include <sys/wait.h>

typedef struct rig {
    int device; /* receives the guard's writes */
    ino_t pipe;
    knurl_guard_process *guard;
} rig;

static const knurl_guard_order zero_order = {0, 4, {'z', 'e', 'r', 'o'}};

static void nap(int milliseconds) {
    knurl_system_sleep_until_ns(knurl_system_now_ns() + milliseconds * (int64_t)1000000);
}

static rig start(void) {
    rig r;
    int ends[2];
    char why[256] = "";
    struct stat about;
    assert_int_equal(pipe2(ends, O_CLOEXEC), 0);
    r.device = ends[0];
    assert_int_equal(fcntl(r.device, F_SETFL, O_NONBLOCK), 0);
    assert_int_equal(fstat(r.device, &about), 0);
    r.pipe = about.st_ino;
    r.guard = knurl_guard_process_start(ends[1], &zero_order, why, sizeof why); /* has closed it */
    assert_string_equal(why, "");
    assert_non_null(r.guard);
    return r;
}

/* Bytes that the guard has written since the last call; -1: it holds the device no more. */
static int written(const rig *r) {
    char bytes[4096];
    const ssize_t got = read(r->device, bytes, sizeof bytes);
    for (ssize_t i = 0; i < got; i++) {
        assert_int_equal(bytes[i], "zero"[i % 4]);
    }
    return got == 0 ? -1 : got < 0 ? 0 : (int)got;
}

static void live_for(const rig *r, int milliseconds) {
    for (int i = 0; i < milliseconds; i += KNURL_GUARD_SIGN_MS) {
        assert_int_equal(knurl_guard_process_tell(r->guard), 1);
        nap(KNURL_GUARD_SIGN_MS);
    }
}

/* It ends within a second. Returns its last write before that. */
static int wait_for_end(const rig *r) {
    int all = 0;
    for (int i = 0; i < 1000; i++) {
        const int some = written(r);
        if (some < 0) {
            return all;
        }
        all += some;
        nap(1);
    }
    fail_msg("the guard still holds the device");
    return all;
}

static int count_files(pid_t pid) {
    char path[64];
    int count = 0;
    (void)snprintf(path, sizeof path, "/proc/%d/fd", (int)pid);
    DIR *all = opendir(path);
    while (all && readdir(all)) {
        count++;
    }
    if (all) {
        (void)closedir(all);
    }
    return count - 2; /* . and .. */
}

TEST(nothing_is_written_while_the_host_lives_nor_when_it_closes_the_device) {
    const rig r = start();
    live_for(&r, 300);
    assert_int_equal(written(&r), 0);
    knurl_guard_process_stop(r.guard);
    assert_int_equal(written(&r), -1); /* at once, so that the device can be opened again */
    (void)close(r.device);
}

TEST(silence_zeroes_within_100_ms_again_and_again_until_the_host_lives_again) {
    const rig r = start();
    live_for(&r, 100);
    nap(KNURL_GUARD_SILENCE_MS / 2);
    assert_int_equal(written(&r), 0);
    nap(100 - KNURL_GUARD_SILENCE_MS / 2);
    assert_true(written(&r) >= 4);
    nap(200);
    assert_true(written(&r) >= 8);
    live_for(&r, 20);
    (void)written(&r);
    live_for(&r, 200);
    assert_int_equal(written(&r), 0);
    knurl_guard_process_stop(r.guard);
    (void)close(r.device);
}

TEST(it_holds_two_files_in_a_session_of_its_own_and_no_signal_ends_it) {
    static const int signals[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP, SIGUSR1, SIGPIPE};
    const int inheritable = open("/dev/null", O_RDONLY); /* not O_CLOEXEC */
    const rig r = start();
    const pid_t pid = find_guard(r.pipe);
    assert_true(pid > 0);
    assert_int_equal(count_files(pid), 2);
    assert_int_not_equal(getsid(pid), getsid(0));
    assert_int_equal(waitpid(pid, NULL, WNOHANG), -1); /* not this process' child */
    for (size_t i = 0; i < COUNT_OF(signals); i++) {
        assert_int_equal(kill(pid, signals[i]), 0);
    }
    live_for(&r, 100);
    assert_int_equal(written(&r), 0);
    knurl_guard_process_stop(r.guard);
    (void)close(inheritable);
    (void)close(r.device);
}

TEST(its_priority_is_above_that_of_haptic_threads_if_permitted) {
    struct sched_param priority = {71}, none = {0};
    if (sched_setscheduler(0, SCHED_FIFO, &priority) != 0) {
        print_message("real-time priority is not permitted\n");
        skip();
    }
    assert_int_equal(sched_setscheduler(0, SCHED_OTHER, &none), 0);
    const rig r = start();
    const pid_t pid = find_guard(r.pipe);
    assert_int_equal(sched_getscheduler(pid), SCHED_FIFO);
    assert_int_equal(sched_getparam(pid, &priority), 0);
    assert_int_equal(priority.sched_priority, 71);
    knurl_guard_process_stop(r.guard);
    (void)close(r.device);
}

TEST(a_guard_that_is_killed_is_noticed) {
    const rig r = start();
    assert_int_equal(kill(find_guard(r.pipe), SIGKILL), 0);
    (void)wait_for_end(&r);
    assert_int_equal(knurl_guard_process_tell(r.guard), 0);
    knurl_guard_process_stop(r.guard);
    (void)close(r.device);
}

TEST(when_the_host_is_gone_it_zeroes_and_ends) {
    int ends[2];
    rig r = {0, 0, NULL};
    assert_int_equal(pipe(ends), 0);
    const pid_t host = fork();
    if (host == 0) {
        char why[256];
        (void)close(ends[0]);
        knurl_guard_process *guard = knurl_guard_process_start(ends[1], &zero_order, why, sizeof why);
        for (int i = 0; i < 100; i++) {
            (void)knurl_guard_process_tell(guard);
            nap(KNURL_GUARD_SIGN_MS);
        }
        _exit(1);
    }
    (void)close(ends[1]);
    r.device = ends[0];
    (void)fcntl(r.device, F_SETFL, O_NONBLOCK);
    nap(200);
    assert_int_equal(written(&r), 0);
    assert_int_equal(kill(host, SIGKILL), 0);
    assert_int_equal(waitpid(host, NULL, 0), host);
    assert_int_equal(wait_for_end(&r), 4 * LAST_ZEROS);
    (void)close(r.device);
}

/* --- USB --- */

static struct {
    int fd;
    unsigned long kind;
    struct usbdevfs_bulktransfer bulk;
    char bytes[16];
} asked;

int __wrap_ioctl(int fd, unsigned long kind, ...);

int __wrap_ioctl(int fd, unsigned long kind, ...) {
    va_list arguments;
    va_start(arguments, kind);
    asked.fd = fd;
    asked.kind = kind;
    asked.bulk = *va_arg(arguments, struct usbdevfs_bulktransfer *);
    memcpy(asked.bytes, asked.bulk.data, 4);
    va_end(arguments);
    return 4;
}

/* There is no USB device here: checks the arguments of the system call. */
TEST(a_usb_device_gets_a_bulk_transfer_to_its_endpoint) {
    knurl_guard_order order = zero_order;
    order.endpoint = 2;
    zero(&order);
    assert_int_equal(asked.fd, DEVICE);
    assert_true(asked.kind == USBDEVFS_BULK);
    assert_int_equal(asked.bulk.ep, 2);
    assert_int_equal(asked.bulk.len, 4);
    assert_int_equal(asked.bulk.timeout, TIMEOUT_MS);
    assert_memory_equal(asked.bytes, "zero", 4);
}
