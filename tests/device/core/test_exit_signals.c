/* What knurl_device_zero_on_exit() does at signals, and to the host's handlers. Children end; what their device's
 * motors do stands in memory that they share with the test. SPDX-License-Identifier: MIT */
#define _DEFAULT_SOURCE 1 /* MAP_ANONYMOUS */
#define _ISOC11_SOURCE  1 /* quick_exit() */

#include "home.h"

#include <knurl/loop.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

typedef struct shared {
    home device;
    int64_t crashed_at;    /* ns */
    uint32_t handled;      /* times that the handler from before ran */
    int64_t handled_limp;  /* limp_since, as that one saw it */
    uint32_t was_siginfo;  /* it got what it had asked for */
    uint32_t reached;      /* what a child that lived on reached */
    uint32_t crash_inside; /* 1: the callback crashes; 2: the exchange does */
} shared;

static shared *m;

/* Every test has a fresh one. */
static int share(void **state) {
    (void)state;
    m = mmap(NULL, sizeof *m, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    return m == MAP_FAILED;
}

static int unshare(void **state) {
    (void)state;
    return munmap(m, sizeof *m);
}

/* --- what children do --- */

static const int ends[] = {SIGSEGV, SIGBUS,    SIGFPE,  SIGILL,  SIGABRT,   SIGTERM, SIGHUP,  SIGINT,
                           SIGQUIT, SIGPIPE,   SIGUSR1, SIGUSR2, SIGXCPU,   SIGXFSZ, SIGTRAP, SIGSYS,
                           SIGPROF, SIGVTALRM, SIGPOLL, SIGPWR,  SIGSTKFLT, SIGALRM};

/* No handlers of sanitizers, no core files, no noise; and no child lives for ever. */
static void be_a_child(void) {
    const struct rlimit none = {0, 0};
    (void)setrlimit(RLIMIT_CORE, &none);
    for (size_t i = 0; i < COUNT_OF(ends); i++) {
        (void)signal(ends[i], SIG_DFL);
    }
    (void)alarm(20);
}

static void crash_by(int number) {
    knurl_store_release(&m->crashed_at, now_ns());
    if (number == SIGABRT) {
        abort();
    }
    (void)raise(number);
}

/* Memory that may not be written: a fault that the kernel tells, not one that is sent. */
static void crash_truly(void) {
    volatile char *page = mmap(NULL, 4096, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    knurl_store_release(&m->crashed_at, now_ns());
    *page = 1;
}

static void push(uint64_t tick, const knurl_device_sample *sample, double force[3], void *user) {
    (void)sample;
    (void)user;
    force[1] = 1.0;
    if (m->crash_inside == 1 && tick > 100) {
        crash_truly();
    }
}

static knurl_result write_or_crash(void *user, const double force[3]) {
    const knurl_result result = home_write(user, force);
    if (m->crash_inside == 2 && force[1] > 0.0) {
        crash_truly();
    }
    return result;
}

static knurl_device *open_device(uint32_t blocking) {
    knurl_device *device = NULL;
    knurl_device_functions f = home_functions(&m->device, blocking);
    f.write = write_or_crash;
    m->device.limp_since = now_ns();
    m->device.hangs_for = INT64_C(20000000000);
    if (knurl_device_open_functions(&f, &device)) {
        _exit(100);
    }
    return device;
}

/* A running loop whose force has reached the motors. */
static knurl_device *open_and_push(uint32_t blocking) {
    knurl_loop_desc desc;
    knurl_loop *loop = NULL;
    knurl_device *device = open_device(blocking);
    knurl_loop_desc_init(&desc, sizeof desc);
    desc.device = device;
    desc.force_callback = push;
    desc.watchdog_s = 0.0;
    if (knurl_loop_create(&desc, &loop) || knurl_loop_start(loop)) {
        _exit(101);
    }
    while (m->crash_inside == 0 && knurl_load_acquire(&m->device.limp_since) > 0) {
        sleep_ns(200000);
    }
    return device;
}

static void install(void) {
    if (knurl_device_zero_on_exit(0)) {
        _exit(102);
    }
}

/* Runs a child; how it ended, as waitpid() says. */
static int run(void (*child)(int argument), int argument) {
    int status = 0;
    const pid_t pid = fork();
    assert_true(pid >= 0);
    if (pid == 0) {
        be_a_child();
        child(argument);
        _exit(0);
    }
    assert_int_equal(waitpid(pid, &status, 0), pid);
    return status;
}

static void check_ended_by(int status, int number) {
    if (!WIFSIGNALED(status) || WTERMSIG(status) != number) {
        fail_msg("expected an end by signal %d, found status %#x", number, (unsigned)status);
    }
}

static void check_limp(void) {
    CHECK_SAME(m->device.motor[1], 0.0L);
    assert_true(m->device.limp_since > 0);  /* since before the crash where the machine made the force too old */
    assert_true(m->device.strongest > 0.0); /* there had been a force */
}

/* --- signals --- */

/* What forces do in a process that lives on: 1: they go out as before. */
static uint32_t still_pushes(void) {
    sleep_ns(30000000);
    return knurl_load_acquire(&m->device.limp_since) == 0;
}

static void crash_with_force(int number) {
    (void)open_and_push(1);
    install();
    crash_by(number);
}

TEST_WITH(whatever_signal_ends_the_process_forces_are_zeroed_before, share, unshare) {
    for (size_t i = 0; i < COUNT_OF(ends); i++) {
        memset(m, 0, sizeof *m);
        check_ended_by(run(crash_with_force, ends[i]), ends[i]);
        check_limp();
    }
}

static void crash_without_help(int number) {
    (void)open_and_push(1);
    crash_by(number);
}

/* At times an I/O thread that got no time has just held a force for too old. */
TEST_WITH(without_having_asked_for_it_the_force_stays, share, unshare) {
    for (int k = 0; k < 5 && m->device.motor[1] < 1.0; k++) {
        memset(m, 0, sizeof *m);
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
        memset(m, 0, sizeof *m);
        check_ended_by(run(fault_with_force, where), SIGSEGV);
        check_limp();
    }
}

/* Nobody else can write then; but it ends. */
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

/* ns from the signal to the end, at best of five. */
static int64_t time_to_end(void (*child)(int argument), int number) {
    int64_t best = INT64_MAX;
    for (int k = 0; k < 5; k++) {
        memset(m, 0, sizeof *m);
        check_ended_by(run(child, number), number);
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

/* The first force of all, and while the device still answers to it: what was sent before was none. */
static void crash_in_an_exchange(int number) {
    const double force[3] = {0.0, 1.0, 0.0};
    knurl_device *device = open_device(1);
    knurl_store_relaxed(&m->device.takes_ns, INT64_C(4000000));
    install();
    wait_for_count(&m->device.reads, 3);
    while (knurl_load_acquire(&m->device.limp_since) > 0) { /* again where the machine made it too old */
        knurl_device_release_halt(device);
        if (knurl_device_write(device, force)) {
            _exit(104);
        }
        for (int64_t until = now_ns() + 8000000; knurl_load_acquire(&m->device.limp_since) > 0 && now_ns() < until;) {}
    }
    crash_by(number);
}

TEST_WITH(an_exchange_under_way_is_waited_for, share, unshare) {
    for (int k = 0; k < 5; k++) {
        memset(m, 0, sizeof *m);
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
        int64_t best = INT64_MAX;
        for (int k = 0; k < 5; k++) {
            memset(m, 0, sizeof *m);
            check_ended_by(run(crash_with_nothing_to_zero, which), SIGTERM);
            const int64_t took = now_ns() - m->crashed_at;
            best = took < best ? took : best;
        }
        assert_true(best < 15000000);
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
    (void)setpgid(0, 0); /* a group that no shell looks after is not stopped */
    (void)open_and_push(1);
    install();
    for (int k = 0; k < 2; k++) {
        crash_by(number);
        m->reached++;
        (void)wait_for_full_force();
    }
    exit(0);
}

/* The first force that went out after `count` writes, and the last of all. */
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

/* Its child has no thread that could write; quick_exit() is seen, too. */
TEST_WITH(the_exit_of_a_child_that_was_forked_changes_nothing, share, unshare) {
    assert_int_equal(run(fork_and_exit, 0), 0);
    assert_int_equal(m->reached, 1);
    assert_int_equal(m->handled, 3);
    check_limp();
}

/* --- handlers from before --- */

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
        memset(m, 0, sizeof *m);
        const int status = run(crash_with_handler, is_siginfo);
        assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 7);
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

/* SIGHUP that has a game read its settings anew is no end; but the exit() that follows is one. */
TEST_WITH(a_signal_that_the_host_handles_is_left_to_it_and_exit_zeroes, share, unshare) {
    static const int numbers[] = {SIGTERM, SIGHUP, SIGINT, SIGUSR1, SIGALRM, SIGPROF, SIGTSTP};
    for (size_t i = 0; i < COUNT_OF(numbers); i++) {
        memset(m, 0, sizeof *m);
        const int status = run(be_signalled, numbers[i]);
        assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 7);
        assert_int_equal(m->handled, 1);
        assert_int_equal(m->handled_limp, 0);
        assert_int_equal(m->reached, 1);
        check_limp();
    }
}

/* As C# at a null reference: the handler mends what was wrong, and the program goes on. */
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
        memset(m, 0, sizeof *m);
        check_ended_by(run(recover_from_a_fault, flag), SIGABRT);
        assert_int_equal(m->handled, 1);
        assert_int_equal(m->reached, flag);
        check_limp();
    }
}

TEST(a_flag_that_is_none_is_refused) {
    assert_int_equal(knurl_device_zero_on_exit(2), KNURL_ERROR_ARGUMENT);
    check_message("expected 0 or 1, found 2");
}

/* A default that was installed with the flag of another kind of handler. */
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

/* Else a game's reads and waits fail that never failed before. */
TEST_WITH(calls_that_a_handler_from_before_did_not_interrupt_are_not_interrupted, share, unshare) {
    for (int restarts = 0; restarts < 2; restarts++) {
        memset(m, 0, sizeof *m);
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
    m->reached = m->device.limp_since == 0; /* it still pulls */
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
    const int status = run(install_twice, SIGSEGV);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 8);
    assert_int_equal(m->handled, 1);
    check_limp();
}
