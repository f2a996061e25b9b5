/* Children that end with a force on their device's motors; the state of the motors is in memory that they share with
 * the test. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_EXIT_CHILD_H
#define KNURL_TEST_EXIT_CHILD_H

#ifndef _DEFAULT_SOURCE
#define _DEFAULT_SOURCE 1 /* MAP_ANONYMOUS */
#endif

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
    uint32_t handled;      /* calls of the earlier handler */
    int64_t handled_limp;  /* limp_since in that handler */
    uint32_t was_siginfo;  /* its SA_SIGINFO was honoured */
    uint32_t reached;      /* progress of a child that survived */
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

/* Writes to read-only memory: a fault raised by the kernel, not a sent signal. */
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

/* Runs a child, with the shared memory as new. Returns its status from waitpid(). */
static int run(void (*child)(int argument), int argument) {
    int status = 0;
    memset(m, 0, sizeof *m);
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
    assert_true(m->device.limp_since > 0);  /* before the crash if the machine was slow and the force became too old */
    assert_true(m->device.strongest > 0.0); /* there had been a force */
}

/* Forces in a process that survives: 1: they are sent as before. */
static uint32_t still_pushes(void) {
    sleep_ns(30000000);
    return knurl_load_acquire(&m->device.limp_since) == 0;
}

#endif
