/* The guard process by itself: its writes, its descriptors, and its end. SPDX-License-Identifier: MIT */
#define _GNU_SOURCE 1

#include "support/close.h"
#include "support/guard.h"
#include "support/wait.h"

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

static rig r; /* started by a test */

static int end(void **state) {
    (void)state;
    if (r.guard) {
        knurl_guard_process_stop(r.guard);
    }
    if (r.device > 0) {
        (void)close(r.device);
    }
    memset(&r, 0, sizeof r);
    return 0;
}

static const knurl_guard_order zero_order = {0, 4, {'z', 'e', 'r', 'o'}};

static void start(void) {
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
}

/* Bytes that the guard has written since the last call; -1: it holds the device no more. */
static int written(void) {
    char bytes[4096];
    const ssize_t got = read(r.device, bytes, sizeof bytes);
    for (ssize_t i = 0; i < got; i++) {
        assert_int_equal(bytes[i], "zero"[i % 4]);
    }
    return got == 0 ? -1 : got < 0 ? 0 : (int)got;
}

static void live_for(int milliseconds) {
    for (int i = 0; i < milliseconds; i += KNURL_GUARD_SIGN_MS) {
        assert_int_equal(knurl_guard_process_tell(r.guard), 1);
        sleep_ms(KNURL_GUARD_SIGN_MS);
    }
}

/* It ends within a second. Returns its last write before that. */
static int wait_for_end(void) {
    int all = 0;
    for (int i = 0; i < 1000; i++) {
        const int some = written();
        if (some < 0) {
            return all;
        }
        all += some;
        sleep_ms(1);
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

TEST_WITH(nothing_is_written_while_the_host_lives_nor_when_it_closes_the_device, NULL, end) {
    start();
    live_for(300);
    assert_int_equal(written(), 0);
    knurl_guard_process_stop(r.guard);
    r.guard = NULL;
    assert_int_equal(written(), -1); /* at once, so that the device can be opened again */
}

TEST_WITH(silence_zeroes_within_100_ms_again_and_again_until_the_host_lives_again, NULL, end) {
    start();
    live_for(100);
    sleep_ms(KNURL_GUARD_SILENCE_MS / 2);
    assert_int_equal(written(), 0);
    sleep_ms(100 - KNURL_GUARD_SILENCE_MS / 2);
    assert_true(written() >= 4);
    sleep_ms(200);
    assert_true(written() >= 8);
    live_for(20);
    (void)written();
    live_for(200);
    assert_int_equal(written(), 0);
}

TEST_WITH(it_holds_two_files_in_a_session_of_its_own_and_no_signal_ends_it, NULL, end) {
    static const int signals[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP, SIGUSR1, SIGPIPE};
    const int inheritable = open("/dev/null", O_RDONLY); /* not O_CLOEXEC */
    start();
    const pid_t pid = find_guard(r.pipe);
    assert_true(pid > 0);
    assert_int_equal(count_files(pid), 2);
    assert_int_not_equal(getsid(pid), getsid(0));
    assert_int_equal(waitpid(pid, NULL, WNOHANG), -1); /* not this process' child */
    for (size_t i = 0; i < COUNT_OF(signals); i++) {
        assert_int_equal(kill(pid, signals[i]), 0);
    }
    live_for(100);
    assert_int_equal(written(), 0);
    (void)close(inheritable);
}

TEST_WITH(its_priority_is_above_that_of_haptic_threads_if_permitted, NULL, end) {
    struct sched_param priority = {71}, none = {0};
    if (sched_setscheduler(0, SCHED_FIFO, &priority) != 0) {
        print_message("real-time priority is not permitted\n");
        skip();
    }
    assert_int_equal(sched_setscheduler(0, SCHED_OTHER, &none), 0);
    start();
    const pid_t pid = find_guard(r.pipe);
    assert_int_equal(sched_getscheduler(pid), SCHED_FIFO);
    assert_int_equal(sched_getparam(pid, &priority), 0);
    assert_int_equal(priority.sched_priority, 71);
}

TEST_WITH(a_guard_that_is_killed_is_noticed, NULL, end) {
    start();
    assert_int_equal(kill(find_guard(r.pipe), SIGKILL), 0);
    (void)wait_for_end();
    assert_int_equal(knurl_guard_process_tell(r.guard), 0);
}

TEST_WITH(when_the_host_is_gone_it_zeroes_and_ends, NULL, end) {
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    const pid_t host = fork();
    if (host == 0) {
        char why[256];
        (void)close(ends[0]);
        knurl_guard_process *guard = knurl_guard_process_start(ends[1], &zero_order, why, sizeof why);
        for (int i = 0; i < 100; i++) {
            (void)knurl_guard_process_tell(guard);
            sleep_ms(KNURL_GUARD_SIGN_MS);
        }
        _exit(1);
    }
    (void)close(ends[1]);
    r.device = ends[0];
    (void)fcntl(r.device, F_SETFL, O_NONBLOCK);
    sleep_ms(200);
    assert_int_equal(written(), 0);
    assert_int_equal(kill(host, SIGKILL), 0);
    assert_int_equal(waitpid(host, NULL, 0), host);
    assert_int_equal(wait_for_end(), 4 * LAST_ZEROS);
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
