/* knurl_device_zero_on_exit() and the host's signal handlers. SPDX-License-Identifier: MIT */
#include "exit_child.h"

static void on_plain(int number) {
    (void)number;
    m->handled++;
    m->handled_limp = m->device.limp_since;
}

static void on_siginfo(int number, siginfo_t *info, void *context) {
    m->was_siginfo = info && info->si_signo == number && context;
    on_plain(number);
}

static void handle(int number, int flags, void (*plain)(int)) {
    struct sigaction action;
    memset(&action, 0, sizeof action);
    action.sa_flags = flags;
    if (plain) {
        action.sa_handler = plain;
    } else {
        action.sa_sigaction = on_siginfo;
    }
    if (sigaction(number, &action, NULL)) {
        _exit(103);
    }
}

static void check_exited(int status, int code) {
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == code);
}

static void crash_with_handler(int is_siginfo) {
    handle(SIGSEGV, is_siginfo ? SA_SIGINFO : 0, is_siginfo ? NULL : on_plain);
    (void)open_and_push(1);
    install();
    crash_by(SIGSEGV);
    m->reached = 1;
    _exit(7);
}

TEST_WITH(a_handler_of_crashes_is_called_with_zero_force_and_decides, share, unshare) {
    for (int is_siginfo = 0; is_siginfo < 2; is_siginfo++) {
        check_exited(run(crash_with_handler, is_siginfo), 7);
        assert_int_equal(m->handled, 1);
        assert_int_equal(m->reached, 1);
        assert_int_equal(m->was_siginfo, is_siginfo);
        assert_true(m->handled_limp > 0);
        check_limp();
    }
}

static void be_signalled(int number) {
    handle(number, 0, on_plain);
    (void)open_and_push(1);
    install();
    crash_by(number);
    m->reached = still_pushes();
    exit(7);
}

/* SIGHUP makes a game reload its settings and is no end; the exit() that follows is one. */
TEST_WITH(a_signal_that_the_host_handles_is_left_to_it_and_exit_zeroes, share, unshare) {
    static const int numbers[] = {SIGTERM, SIGHUP, SIGINT, SIGUSR1, SIGALRM, SIGPROF, SIGTSTP};
    for (size_t i = 0; i < COUNT_OF(numbers); i++) {
        check_exited(run(be_signalled, numbers[i]), 7);
        assert_int_equal(m->handled, 1);
        assert_int_equal(m->handled_limp, 0);
        assert_int_equal(m->reached, 1);
        check_limp();
    }
}

/* As in C# at a null reference: the handler repairs the cause, and the program continues. */
static void recover_from_a_fault(int flag) {
    handle(SIGSEGV, 0, on_plain);
    (void)open_and_push(1);
    if (knurl_device_zero_on_exit((uint32_t)flag)) {
        _exit(102);
    }
    crash_by(SIGSEGV);
    m->reached = still_pushes();
    crash_by(SIGABRT);
}

TEST_WITH(a_runtime_that_recovers_from_faults_keeps_its_handler_and_its_forces, share, unshare) {
    for (int flag = 0; flag < 2; flag++) {
        check_ended_by(run(recover_from_a_fault, flag), SIGABRT);
        assert_int_equal(m->handled, 1);
        assert_int_equal(m->reached, flag);
        check_limp();
    }
}

TEST(an_unknown_flag_is_refused) {
    assert_int_equal(knurl_device_zero_on_exit(2), KNURL_ERROR_ARGUMENT);
    check_message("expected 0 or 1, found 2");
}

/* SIG_DFL installed with SA_SIGINFO. */
static void crash_by_default(int number) {
    struct sigaction action;
    memset(&action, 0, sizeof action);
    action.sa_handler = SIG_DFL;
    action.sa_flags = SA_SIGINFO;
    (void)sigaction(number, &action, NULL);
    (void)open_and_push(1);
    install();
    crash_by(number);
}

TEST_WITH(a_default_is_a_default_whatever_its_flags, share, unshare) {
    check_ended_by(run(crash_by_default, SIGTERM), SIGTERM);
    check_limp();
}

static void read_through_a_signal(int flags) {
    int ends_of_pipe[2];
    char byte = 0;
    handle(SIGBUS, flags, on_plain);
    install();
    if (pipe(ends_of_pipe)) {
        _exit(106);
    }
    const pid_t parent = getpid();
    if (fork() == 0) {
        sleep_ns(30000000);
        (void)kill(parent, SIGBUS);
        sleep_ns(60000000);
        _exit(write(ends_of_pipe[1], "x", 1) != 1);
    }
    m->reached = read(ends_of_pipe[0], &byte, 1) == 1;
}

/* Otherwise a game's reads and waits would start to fail. */
TEST_WITH(calls_that_a_handler_from_before_did_not_interrupt_are_not_interrupted, share, unshare) {
    for (int restarts = 0; restarts < 2; restarts++) {
        assert_int_equal(run(read_through_a_signal, restarts ? SA_RESTART : 0), 0);
        assert_int_equal(m->handled, 1);
        assert_int_equal(m->reached, restarts);
    }
}

static void end_at_the_second_signal(int number) {
    handle(number, (int)SA_RESETHAND, on_plain);
    (void)open_and_push(1);
    install();
    crash_by(number);
    m->reached = 1;
    crash_by(number);
}

TEST_WITH(a_handler_for_one_time_is_called_one_time, share, unshare) {
    check_ended_by(run(end_at_the_second_signal, SIGSEGV), SIGSEGV);
    assert_int_equal(m->handled, 1);
    assert_int_equal(m->reached, 1);
    CHECK_SAME(m->device.motor[1], 0.0L);
}

static void ignore_some(int number) {
    (void)signal(SIGHUP, SIG_IGN);
    (void)signal(SIGINT, SIG_IGN);
    (void)open_and_push(1);
    install();
    crash_by(SIGHUP);
    crash_by(SIGINT);
    sleep_ns(20000000);
    m->reached = m->device.limp_since == 0; /* the force is still there */
    crash_by(number);
}

TEST_WITH(what_was_ignored_stays_ignored, share, unshare) {
    check_ended_by(run(ignore_some, SIGTERM), SIGTERM);
    assert_int_equal(m->reached, 1);
    check_limp();
}

static void install_twice(int number) {
    handle(number, 0, on_plain);
    install();
    (void)open_and_push(1);
    install();
    install();
    crash_by(number);
    _exit(8);
}

TEST_WITH(installing_it_twice_is_fine, share, unshare) {
    check_exited(run(install_twice, SIGSEGV), 8);
    assert_int_equal(m->handled, 1);
    check_limp();
}
