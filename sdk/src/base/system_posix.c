/* POSIX: time, threads, locked memory, libraries. SPDX-License-Identifier: MIT */
#include "base/system.h"

#include "base/base.h"

#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#if defined(__APPLE__)
#include <mach/mach.h>
#include <mach/mach_time.h>
#endif
#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#if defined(__linux__)
#include <sys/auxv.h>
#endif
#include <sys/file.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

#define LOCKED_STACK ((size_t)64 * 1024)

struct knurl_thread {
    pthread_t handle;
    void (*entry)(void *argument);
    void *argument;
    uintptr_t process; /* the process that started it */
};

/* These continue while the machine sleeps, so that a force from before is too old to be played. */
#if defined(CLOCK_BOOTTIME)
#define CLOCK CLOCK_BOOTTIME
#elif defined(__APPLE__)
#define CLOCK CLOCK_MONOTONIC_RAW /* its CLOCK_MONOTONIC has a resolution of 1 us */
#else
#define CLOCK CLOCK_MONOTONIC
#endif

int64_t knurl_system_now_ns(void) {
    struct timespec now;
    (void)clock_gettime(CLOCK, &now);
    return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

#if defined(__APPLE__)

/* Ticks of mach_absolute_time(), which stops while the machine sleeps: only differences are taken from it. */
static uint64_t mach_ticks(int64_t nanoseconds) {
    mach_timebase_info_data_t base;
    (void)mach_timebase_info(&base); /* cached by the system's library */
    return (uint64_t)nanoseconds * base.denom / base.numer;
}

void knurl_system_sleep_until_ns(int64_t deadline_ns) {
    int64_t left;
    while ((left = deadline_ns - knurl_system_now_ns()) > 0) { /* the wait may be interrupted */
        (void)mach_wait_until(mach_absolute_time() + mach_ticks(left));
    }
}

/* A time-constraint thread, as for audio, which needs no privilege: up to 0.2 ms of work in each millisecond, done
 * within 0.5 ms. */
int knurl_system_make_realtime(void) {
    thread_time_constraint_policy_data_t policy = {(uint32_t)mach_ticks(1000000), (uint32_t)mach_ticks(200000),
                                                   (uint32_t)mach_ticks(500000), 1};
    return thread_policy_set(pthread_mach_thread_np(pthread_self()), THREAD_TIME_CONSTRAINT_POLICY,
                             (thread_policy_t)&policy, THREAD_TIME_CONSTRAINT_POLICY_COUNT) == KERN_SUCCESS;
}

#else

void knurl_system_sleep_until_ns(int64_t deadline_ns) {
    struct timespec deadline;
    deadline.tv_sec = (time_t)(deadline_ns / 1000000000);
    deadline.tv_nsec = (long)(deadline_ns % 1000000000);
    while (clock_nanosleep(CLOCK, TIMER_ABSTIME, &deadline, NULL) == EINTR) {}
}

/* Above the kernel's threaded interrupt handlers (50) and beside audio servers; well below the watchdogs (99). */
#define REALTIME_PRIORITY 70

int knurl_system_make_realtime(void) {
    struct sched_param parameters;
    int policy = SCHED_OTHER;
    memset(&parameters, 0, sizeof parameters);
    if (pthread_getschedparam(pthread_self(), &policy, &parameters) == 0 &&
        (policy == SCHED_FIFO || policy == SCHED_RR)) {
        return 1; /* another library's thread: keep its priority */
    }
    parameters.sched_priority = REALTIME_PRIORITY;
    return pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters) == 0;
}

#endif

/* The caller provides the storage, so that all of a scene's memory comes from its allocator. */
typedef char mutex_fits[sizeof(pthread_mutex_t) <= sizeof(knurl_mutex) ? 1 : -1];

static pthread_mutex_t *native(knurl_mutex *mutex) {
    return (pthread_mutex_t *)(void *)mutex->storage;
}

void knurl_system_mutex_init(knurl_mutex *mutex) {
    (void)pthread_mutex_init(native(mutex), NULL); /* cannot fail with default attributes here */
}

void knurl_system_mutex_destroy(knurl_mutex *mutex) {
    (void)pthread_mutex_destroy(native(mutex));
}

void knurl_system_mutex_lock(knurl_mutex *mutex) {
    (void)pthread_mutex_lock(native(mutex));
}

void knurl_system_mutex_unlock(knurl_mutex *mutex) {
    (void)pthread_mutex_unlock(native(mutex));
}

static void *run_thread(void *argument) {
    knurl_thread *thread = argument;
    thread->entry(thread->argument);
    return NULL;
}

/* Blocks signals in the new thread: a handler must not run on a haptic or I/O thread, because zeroing forces at exit
 * waits for those threads. Faults raised by the thread itself are not blocked. */
static int create(knurl_thread *thread, const pthread_attr_t *attributes) {
    static const int own[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGSYS, SIGABRT};
    sigset_t others;
    sigset_t before;
    (void)sigfillset(&others);
    for (size_t i = 0; i < sizeof own / sizeof *own; i++) {
        (void)sigdelset(&others, own[i]);
    }
    (void)pthread_sigmask(SIG_SETMASK, &others, &before); /* the thread inherits the mask */
    const int failed = pthread_create(&thread->handle, attributes, run_thread, thread);
    (void)pthread_sigmask(SIG_SETMASK, &before, NULL);
    return failed;
}

knurl_thread *knurl_system_start_thread(void (*entry)(void *argument), void *argument, size_t stack_bytes) {
    knurl_thread *thread = calloc(1, sizeof *thread);
    pthread_attr_t attributes;
    if (!thread || pthread_attr_init(&attributes) != 0) {
        free(thread);
        return NULL;
    }
    thread->entry = entry;
    thread->argument = argument;
    thread->process = knurl_system_process_id();
    const int failed = pthread_attr_setstacksize(&attributes, stack_bytes) || create(thread, &attributes);
    (void)pthread_attr_destroy(&attributes);
    if (failed) {
        free(thread);
        return NULL;
    }
    return thread;
}

void knurl_system_join_thread(knurl_thread *thread) {
    if (thread->process == knurl_system_process_id()) {
        (void)pthread_join(thread->handle, NULL);
    }
    free(thread);
}

const char *knurl_system_environment(const char *name) {
#if defined(__linux__)
    const int has_more_rights = getauxval(AT_SECURE) != 0;
#else
    const int has_more_rights = getuid() != geteuid() || getgid() != getegid();
#endif
    return has_more_rights ? NULL : getenv(name);
}

uintptr_t knurl_system_process_id(void) {
    return (uintptr_t)getpid();
}

uintptr_t knurl_system_thread_id(void) {
    static KNURL_THREAD_LOCAL char mine; /* its address is unique to this thread */
    return (uintptr_t)&mine;
}

int knurl_system_lock_memory(void *memory, size_t size) {
    return mlock(memory, size) == 0;
}

void knurl_system_unlock_memory(void *memory, size_t size) {
    (void)munlock(memory, size);
}

void knurl_system_unlock_stack(uintptr_t start) {
    /* NOLINTNEXTLINE(performance-no-int-to-ptr): the frame is gone, but its pages remain */
    (void)munlock((void *)start, LOCKED_STACK);
}

int knurl_system_lock_stack(uintptr_t *start) {
    char pages[LOCKED_STACK];
    volatile char *touched = pages;
    for (size_t i = 0; i < sizeof pages; i += 4096) {
        touched[i] = 0;
    }
    *start = (uintptr_t)pages;
    return mlock(pages, sizeof pages) == 0;
}

/* Locks a descriptor of its own: drivers that open the node for data do not share theirs. The kernel releases the lock
 * with the last descriptor, even after SIGKILL. */
intptr_t knurl_system_take_node(const char *path) {
    const int node = open(path, O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (node < 0) {
        return -1;
    }
    if (flock(node, LOCK_EX | LOCK_NB) == 0) {
        return (intptr_t)node + 1;
    }
    const int why = errno;
    (void)close(node);
    return why == EWOULDBLOCK ? 0 : -1;
}

void knurl_system_give_back_node(intptr_t node) {
    if (node > 0) {
        (void)close((int)(node - 1));
    }
}

knurl_library *knurl_system_load_library(const char *path, char *why, size_t why_size) {
    if (path[0] != '/' && strchr(path, '/')) { /* relative to the current folder */
        (void)snprintf(why, why_size, "expected an absolute path or a bare name");
        return NULL;
    }
    void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!library) {
        const char *told = dlerror();
        (void)snprintf(why, why_size, "%s", told ? told : "no reason given");
    }
    return library;
}

void knurl_system_unload_library(knurl_library *library) {
    (void)dlclose(library);
}

int knurl_system_find_function(knurl_library *library, const char *name, void *function) {
    void *found = dlsym((void *)library, name);
    if (found) {
        memcpy(function, &found, sizeof found); /* POSIX: both kinds of pointers are alike; C99 has no cast */
    }
    return found != NULL;
}
