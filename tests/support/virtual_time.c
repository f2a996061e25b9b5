/* Simulated time, for programs whose threads wait for one another: linked in place of the system's
 * clock, sleep and threads (knurl_virtual_time in CMakeLists.txt; tests and library call the same functions). One
 * thread runs at a time, until it sleeps, joins another or ends; then the thread with the earliest wake-up time
 * continues, of several the one that has slept longest, and time advances to its wake-up time. So nothing really waits
 * or depends on the machine, and every run is the same. A thread that never sleeps stops time: wait with
 * knurl_system_sleep_until_ns(), not by polling the clock alone. SPDX-License-Identifier: MIT */
#include "base/base.h"
#include "base/system.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

#define MOST_TASKS 32
#define NEVER      INT64_MAX

typedef struct task {
    void (*entry)(void *argument);
    void *argument;
    knurl_thread *thread; /* null: the program's first */
    int64_t wakes_at;     /* ns; NEVER: another thread must wake it */
    uint64_t order;       /* of those that wake at the same time */
    struct task *awaits;  /* the end of this one; null: of no thread */
    int is_used;
    int has_ended;
    pthread_cond_t turn;
} task;

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER; /* guards all of these; `now` is read by the running thread */
static task tasks[MOST_TASKS];                            /* the first: the program's first thread */
static task *running;
static uint64_t orders;
static int64_t now = INT64_C(1000000000000);
static KNURL_THREAD_LOCAL task *mine;

int64_t __wrap_knurl_system_now_ns(void);
void __wrap_knurl_system_sleep_until_ns(int64_t deadline_ns);
knurl_thread *__wrap_knurl_system_start_thread(void (*entry)(void *argument), void *argument, size_t stack_bytes);
void __wrap_knurl_system_join_thread(knurl_thread *thread);
knurl_thread *__real_knurl_system_start_thread(void (*entry)(void *argument), void *argument, size_t stack_bytes);
void __real_knurl_system_join_thread(knurl_thread *thread);

/* ThreadSanitizer must not take the turns for an order that the library's own code has seen to: it would find nothing.
 * These are its run time's. */
#ifdef KNURL_TSAN
void AnnotateIgnoreSyncBegin(const char *file, int line);
void AnnotateIgnoreSyncEnd(const char *file, int line);
void AnnotateIgnoreWritesBegin(const char *file, int line);
void AnnotateIgnoreWritesEnd(const char *file, int line);
#define TSAN(what) Annotate##what(__FILE__, __LINE__)
#else
#define TSAN(what) ((void)0)
#endif

static void lock(void) {
    TSAN(IgnoreSyncBegin);
    TSAN(IgnoreWritesBegin);
    (void)pthread_mutex_lock(&mutex);
}

static void unlock(void) {
    (void)pthread_mutex_unlock(&mutex);
    TSAN(IgnoreWritesEnd);
    TSAN(IgnoreSyncEnd);
}

static void give_up(const char *why) {
    (void)fprintf(stderr, "virtual time: %s\n", why);
    abort();
}

static task *take_task(void) {
    for (int i = running ? 1 : 0; i < MOST_TASKS; i++) {
        if (!tasks[i].is_used) {
            tasks[i] = (task){.is_used = 1, .wakes_at = now, .order = ++orders};
            (void)pthread_cond_init(&tasks[i].turn, NULL);
            return &tasks[i];
        }
    }
    give_up("too many threads");
    return NULL;
}

/* The caller's own; with the mutex held. */
static task *self(void) {
    if (!mine) {
        if (running) {
            give_up("asked for by a thread that knurl_system_start_thread() has not started");
        }
        mine = running = take_task();
    }
    return mine;
}

static void run_next(void) {
    task *next = NULL;
    for (int i = 0; i < MOST_TASKS; i++) {
        task *t = &tasks[i];
        if (t->is_used && !t->has_ended && t->wakes_at != NEVER &&
            (!next || t->wakes_at < next->wakes_at || (t->wakes_at == next->wakes_at && t->order < next->order))) {
            next = t;
        }
    }
    if (!next) {
        give_up("every thread waits for another one's end");
        return;
    }
    now = next->wakes_at > now ? next->wakes_at : now;
    running = next;
    (void)pthread_cond_signal(&next->turn);
}

static void await_turn(task *t) {
    while (running != t) {
        (void)pthread_cond_wait(&t->turn, &mutex);
    }
}

static void wait_until(task *t, int64_t wakes_at) {
    t->wakes_at = wakes_at;
    t->order = ++orders;
    run_next();
    await_turn(t);
}

static void run_task(void *argument) {
    task *t = argument;
    lock();
    mine = t;
    await_turn(t);
    unlock();
    t->entry(t->argument);
    lock();
    t->has_ended = 1;
    for (int i = 0; i < MOST_TASKS; i++) {
        if (tasks[i].is_used && tasks[i].awaits == t) {
            tasks[i].awaits = NULL;
            tasks[i].wakes_at = now;
            tasks[i].order = ++orders;
        }
    }
    run_next();
    unlock();
}

int64_t __wrap_knurl_system_now_ns(void) {
    return now;
}

void __wrap_knurl_system_sleep_until_ns(int64_t deadline_ns) {
    lock();
    wait_until(self(), deadline_ns > now ? deadline_ns : now);
    unlock();
}

knurl_thread *__wrap_knurl_system_start_thread(void (*entry)(void *argument), void *argument, size_t stack_bytes) {
    lock();
    (void)self();
    task *t = take_task();
    t->entry = entry;
    t->argument = argument;
    unlock();
    t->thread = __real_knurl_system_start_thread(run_task, t, stack_bytes);
    t->is_used = t->thread != NULL; /* other threads can read it only in their turn */
    return t->thread;
}

void __wrap_knurl_system_join_thread(knurl_thread *thread) {
    lock();
    task *awaited = NULL;
    for (int i = 0; i < MOST_TASKS && !awaited; i++) {
        awaited = tasks[i].is_used && tasks[i].thread == thread ? &tasks[i] : NULL;
    }
    if (!awaited) {
        give_up("join of a thread that was not started, or was joined before");
        return;
    }
    if (!awaited->has_ended) {
        self()->awaits = awaited;
        wait_until(self(), NEVER);
    }
    unlock();
    __real_knurl_system_join_thread(thread);
    awaited->is_used = 0; /* its condition stays: no thread waits for it, and the next one initialises it again */
}
