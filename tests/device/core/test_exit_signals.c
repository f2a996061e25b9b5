/* knurl_device_zero_on_exit() at signals and at exit(). SPDX-License-Identifier: MIT */
#define _DEFAULT_SOURCE 1 /* MAP_ANONYMOUS */
#define _ISOC11_SOURCE  1 /* quick_exit() */

#include "device/port.h"
#include "exit_child.h"

/* --- signals --- */

static void crash_with_force(int number) {
    (void)open_and_push(1);
    install();
    crash_by(number);
}

TEST_WITH(whatever_signal_ends_the_process_forces_are_zeroed_before, share, unshare) {
    for (size_t i = 0; i < COUNT_OF(ends); i++) {
        check_ended_by(run(crash_with_force, ends[i]), ends[i]);
        check_limp();
    }
}

static void crash_without_help(int number) {
    (void)open_and_push(1);
    crash_by(number);
}

/* Sometimes a starved I/O thread has just zeroed a force that became too old. */
TEST_WITH(without_having_asked_for_it_the_force_stays, share, unshare) {
    for (int k = 0; k < 5 && m->device.motor[1] < 1.0; k++) {
        check_ended_by(run(crash_without_help, SIGTERM), SIGTERM);
    }
    CHECK_SAME(m->device.motor[1], 1.0L);
}

static void fault_with_force(int where) {
    m->crash_inside = (uint32_t)where;
    install();
    (void)open_and_push(1);
    if (where == 0) {
        crash_truly();
    }
    sleep_ns(INT64_C(10000000000));
}

TEST_WITH(a_fault_on_the_games_thread_or_in_a_tick_zeroes_the_force, share, unshare) {
    for (int where = 0; where < 2; where++) {
        check_ended_by(run(fault_with_force, where), SIGSEGV);
        check_limp();
    }
}

/* No other thread can write then; but the process ends. */
TEST_WITH(a_fault_in_the_exchange_itself_ends_it_after_the_wait, share, unshare) {
    check_ended_by(run(fault_with_force, 2), SIGSEGV);
}

static char noise;

static int overflow(volatile char *below, int64_t depth) {
    volatile char here[4096];
    here[0] = (char)(*below + 1);
    here[4095] = here[0];
    return depth == 0 ? 0 : overflow(here, depth - 1) + here[4095]; /* not a tail call */
}

static void overflow_the_stack(int number) {
    (void)number;
    (void)open_and_push(1);
    install();
    knurl_store_release(&m->crashed_at, now_ns());
    m->reached = (uint32_t)overflow(&noise, INT64_MAX);
}

/* A handler needs a stack, too. */
TEST_WITH(a_stack_that_overflows_zeroes_the_force, share, unshare) {
    check_ended_by(run(overflow_the_stack, 0), SIGSEGV);
    check_limp();
}

static void crash_without_blocking(int number) {
    (void)open_and_push(0);
    install();
    crash_by(number);
}

TEST_WITH(the_haptic_thread_zeroes_a_device_without_an_io_thread, share, unshare) {
    check_ended_by(run(crash_without_blocking, SIGSEGV), SIGSEGV);
    check_limp();
}

/* --- how long it takes --- */

static void crash_without_device(int number) {
    install();
    crash_by(number);
}

static void crash_while_hanging(int number) {
    (void)open_and_push(1);
    install();
    home_inject(&m->device, DOUBLE_HANG);
    sleep_ns(5000000);
    crash_by(number);
}

/* ns from the signal to the end by SIGTERM, at best of five. */
static int64_t time_to_end(void (*child)(int argument), int argument) {
    int64_t best = INT64_MAX;
    for (int k = 0; k < 5; k++) {
        check_ended_by(run(child, argument), SIGTERM);
        const int64_t took = now_ns() - m->crashed_at;
        best = took < best ? took : best;
    }
    return best;
}

TEST_WITH(without_a_device_nobody_waits, share, unshare) {
    assert_true(time_to_end(crash_without_device, SIGTERM) < 15000000);
}

TEST_WITH(a_device_that_hangs_is_waited_for_20_ms_and_no_longer, share, unshare) {
    const int64_t took = time_to_end(crash_while_hanging, SIGTERM);
    assert_true(took >= 20000000);
    assert_true(took < 60000000);
}

/* --- devices --- */

/* During the exchange of the first force: only zeros were sent before. */
static void crash_in_an_exchange(int number) {
    const double force[3] = {0.0, 1.0, 0.0};
    knurl_device *device = open_device(1);
    knurl_store_relaxed(&m->device.takes_ns, INT64_C(4000000));
    install();
    wait_for_count(&m->device.reads, 3);
    while (knurl_load_acquire(&m->device.limp_since) > 0) { /* again if the machine was slow and it became too old */
        knurl_port_release_halt(device);
        if (knurl_device_write(device, force)) {
            _exit(104);
        }
        for (int64_t until = now_ns() + 8000000; knurl_load_acquire(&m->device.limp_since) > 0 && now_ns() < until;) {}
    }
    crash_by(number);
}

TEST_WITH(an_exchange_under_way_is_waited_for, share, unshare) {
    for (int k = 0; k < 5; k++) {
        check_ended_by(run(crash_in_an_exchange, SIGTERM), SIGTERM);
        check_limp();
    }
}

/* Nothing pulls: opened and never written to; lost. */
static void crash_with_nothing_to_zero(int which) {
    knurl_device *device = NULL;
    if (which == 0) {
        (void)open_device(0);
    } else if (which == 1 && knurl_device_open("fake", &device)) {
        _exit(105);
    } else if (which > 1) {
        knurl_device_sample sample;
        device = open_and_push((uint32_t)which - 2);
        home_inject(&m->device, DOUBLE_UNPLUG);
        while (knurl_device_read(device, &sample) != KNURL_ERROR_DEVICE_LOST) {
            sleep_ns(200000);
        }
    }
    install();
    crash_by(SIGTERM);
}

TEST_WITH(a_device_that_has_no_force_or_is_gone_is_not_waited_for, share, unshare) {
    for (int which = 0; which < 4; which++) {
        assert_true(time_to_end(crash_with_nothing_to_zero, which) < 15000000);
    }
}

/* --- stops --- */

static int wait_for_full_force(void) {
    int is_full = 0;
    for (int64_t until = now_ns() + 2000000000; !is_full && now_ns() < until;) {
        is_full = knurl_load_double(&m->device.motor[1]) >= 1.0;
        sleep_ns(1000000);
    }
    return is_full;
}

static void stop_by(int number) {
    (void)setpgid(0, 0); /* an orphaned process group is not stopped */
    (void)open_and_push(1);
    install();
    for (int k = 0; k < 2; k++) {
        crash_by(number);
        m->reached++;
        (void)wait_for_full_force();
    }
    exit(0);
}

/* The first force that was sent after `count` writes, and the last one. */
static double first_force_after(uint64_t count) {
    for (uint64_t i = count; i < m->device.writes; i++) {
        if (m->device.log[i % HOME_LOG].force[1] > 0.0) {
            return m->device.log[i % HOME_LOG].force[1];
        }
    }
    return 0.0;
}

/* Ctrl-Z, and fg: twice. */
TEST_WITH(a_stop_zeroes_forces_and_they_come_back_by_the_ramp, share, unshare) {
    static const int numbers[] = {SIGTSTP, SIGTTIN, SIGTTOU};
    int ramps = 0;
    for (size_t i = 0; i < COUNT_OF(numbers); i++) {
        int status = 0;
        memset(m, 0, sizeof *m);
        const pid_t pid = fork();
        if (pid == 0) {
            be_a_child();
            stop_by(numbers[i]);
        }
        for (uint32_t k = 0; k < 2; k++) {
            assert_int_equal(waitpid(pid, &status, WUNTRACED), pid);
            assert_true(WIFSTOPPED(status) && WSTOPSIG(status) == numbers[i]);
            assert_int_equal(m->reached, k);
            check_limp();
            const uint64_t count = m->device.writes;
            assert_int_equal(kill(pid, SIGCONT), 0);
            assert_true(wait_for_full_force());
            ramps += first_force_after(count) < 0.9;
        }
        assert_int_equal(waitpid(pid, &status, 0), pid);
        assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
        check_limp();
    }
    assert_true(ramps >= 3); /* an I/O thread that gets no time misses one: 20 ms each, six of them */
}

/* --- exit() --- */

static void fork_and_exit(int number) {
    int status = 0;
    (void)number;
    (void)open_and_push(1);
    install();
    const pid_t pid = fork();
    if (pid == 0) {
        exit(3);
    }
    const int64_t begun = now_ns();
    (void)waitpid(pid, &status, 0);
    m->reached = still_pushes() && now_ns() - begun < 60000000;
    m->handled = (uint32_t)WEXITSTATUS(status);
    quick_exit(0);
}

/* A child has no thread that could write; quick_exit() is handled, too. */
TEST_WITH(the_exit_of_a_child_that_was_forked_changes_nothing, share, unshare) {
    assert_int_equal(run(fork_and_exit, 0), 0);
    assert_int_equal(m->reached, 1);
    assert_int_equal(m->handled, 3);
    check_limp();
}
