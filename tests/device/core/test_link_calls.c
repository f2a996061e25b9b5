/* The haptic thread's calls to a device with an I/O thread allocate no memory, take no lock, never wait, and make no
 * system call. Linked with --wrap for the functions that would (CMakeLists.txt), and run under seccomp, which kills on
 * a system call. SPDX-License-Identifier: MIT */
#define _DEFAULT_SOURCE 1 /* syscall() */

#include "home.h"

#include "device/link.h"

#include <linux/filter.h>
#include <linux/seccomp.h>
#include <pthread.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SANITIZED 1
#else
#define SANITIZED 0
#endif

/* Calls of wrapped functions by this thread; readings of the clock are counted separately, because each force has a
 * time stamp. */
static __thread uint64_t calls;
static __thread uint64_t looks;

#define WRAP(type, name, parameters, arguments)                                                                        \
    type __real_##name parameters;                                                                                     \
    type __wrap_##name parameters;                                                                                     \
    type __wrap_##name parameters {                                                                                    \
        calls++;                                                                                                       \
        return __real_##name arguments;                                                                                \
    }

WRAP(void *, malloc, (size_t size), (size))
WRAP(void *, calloc, (size_t count, size_t size), (count, size))
WRAP(int, pthread_mutex_lock, (pthread_mutex_t * mutex), (mutex))
WRAP(int, pthread_cond_signal, (pthread_cond_t * condition), (condition))
WRAP(int, clock_nanosleep, (clockid_t clock, int how, const struct timespec *wanted, struct timespec *left),
     (clock, how, wanted, left))
WRAP(int, vsnprintf, (char *text, size_t size, const char *format, va_list arguments), (text, size, format, arguments))

int __real_clock_gettime(clockid_t clock, struct timespec *now);
int __wrap_clock_gettime(clockid_t clock, struct timespec *now);
int __wrap_clock_gettime(clockid_t clock, struct timespec *now) {
    looks++;
    return __real_clock_gettime(clock, now);
}

static home h;

/* Every second read finds a position; now and then there is an event. */
static void read_and_write(knurl_device *device, int count) {
    for (int k = 0; k < count; k++) {
        const double force[3] = {0.1 * (k % 7), k % 11 ? 0.0 : (double)NAN, 20.0};
        knurl_device_sample sample;
        (void)knurl_device_read(device, &sample);
        (void)knurl_device_write(device, force);
    }
}

TEST(reading_and_writing_ask_for_nothing_but_the_time) {
    static const int faults[] = {DOUBLE_WELL, DOUBLE_MUTE, DOUBLE_NAN, DOUBLE_JUMP, DOUBLE_HANG, DOUBLE_UNPLUG};
    for (size_t i = 0; i < COUNT_OF(faults); i++) {
        SCOPED_DEVICE *device = home_open(&h, 1);
        for (int round = 0; round < 40; round++) {
            if (round == 10) {
                home_inject(&h, faults[i]);
            }
            const uint64_t calls_before = calls;
            const uint64_t looks_before = looks;
            read_and_write(device, 100);
            assert_true(calls == calls_before);
            assert_true(looks - looks_before <= 120); /* one a force, and one an event */
            sleep_ns(500000);
        }
        assert_true(calls >= 40); /* the sleeps, so the wrapping works */
        home_inject(&h, DOUBLE_WELL);
    }
}

/* A link without its thread, for a child that may not make system calls. */
static knurl_link io;
static knurl_device linked;

static const knurl_driver io_driver = {.uri = "io"};

static void strictly(int ask_for_something) {
    for (int k = 0; k < 5000; k++) {
        if (k % 3 == 0 && k < 3000) { /* later it is silent */
            io.samples[io.positions.back].position[0] = k % 500 ? 0.0 : (double)NAN;
            knurl_mailbox_post(&io.positions);
            io.cycles++;
        }
        read_and_write(&linked, 1);
    }
    if (ask_for_something) {
        (void)syscall(SYS_getppid);
    }
}

/* The kernel kills on any system call but exit. (Its strict mode would also disable the CPU's time stamp counter.) */
static int be_strict(void) {
    struct sock_filter rules[] = {
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, nr)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_exit, 0, 1),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL),
    };
    const struct sock_fprog program = {(unsigned short)COUNT_OF(rules), rules};
    return prctl(PR_SET_NO_NEW_PRIVS, 1UL, 0UL, 0UL, 0UL) == 0 &&
           prctl(PR_SET_SECCOMP, (unsigned long)SECCOMP_MODE_FILTER, &program) == 0;
}

TEST(the_kernel_is_asked_for_nothing) {
    if (SANITIZED) {
        print_message("skipped: sanitizers make system calls of their own\n");
        skip();
    }
    (void)now_ns(); /* the vDSO is found by now */
    for (int ask = 0; ask < 2; ask++) {
        int status = -1;
        memset(&io, 0, sizeof io);
        memset(&linked, 0, sizeof linked);
        knurl_device_init(&linked, &io_driver);
        linked.max_force = HOME_FORCE;
        linked.max_speed = 10.0;
        linked.link = &io;
        linked.period = 0.001;
        io.device = &linked;
        io.native_rate = 1000.0;
        knurl_mailbox_init(&io.positions);
        knurl_mailbox_init(&io.orders);
        knurl_link_start(&io, 1000.0);
        const pid_t child = fork();
        assert_true(child >= 0);
        if (child == 0) {
            if (!be_strict()) {
                (void)syscall(SYS_exit, 77);
            }
            strictly(ask);
            (void)syscall(SYS_exit, io.is_silent ? 0 : 1);
        }
        assert_true(waitpid(child, &status, 0) == child);
        if (WIFEXITED(status) && WEXITSTATUS(status) == 77) {
            print_message("skipped: this kernel refuses seccomp\n");
            skip();
        }
        assert_true(ask ? WIFSIGNALED(status) : WIFEXITED(status) && WEXITSTATUS(status) == 0);
    }
}
