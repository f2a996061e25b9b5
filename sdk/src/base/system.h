/* The operating system's part: time, threads, locked memory, process ends, libraries. One implementation per system.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_SYSTEM_H
#define KNURL_SRC_SYSTEM_H

#include "base/finite.h"

#include <stddef.h>
#include <stdint.h>

typedef struct knurl_thread knurl_thread;

/* A monotonic clock that goes on while the machine sleeps, ns. No system call where the kernel offers a vDSO. */
int64_t knurl_system_now_ns(void);

/* Returns at once when the deadline has passed. */
void knurl_system_sleep_until_ns(int64_t deadline_ns);

/* A new thread with `stack_bytes` of stack; null when the system refuses. */
knurl_thread *knurl_system_start_thread(void (*entry)(void *argument), void *argument, size_t stack_bytes);

/* Waits for its end and gives it back. In a child that was forked there is none to wait for. */
void knurl_system_join_thread(knurl_thread *thread);

/* A number that differs for each living thread; never 0. */
uintptr_t knurl_system_thread_id(void);

/* Differs in a child that was forked, which has its parent's memory and none of its threads. */
uintptr_t knurl_system_process_id(void);

/* For threads that edit; never for a tick. */
typedef struct knurl_mutex {
    uint64_t storage[8];
} knurl_mutex;

void knurl_system_mutex_init(knurl_mutex *mutex);
void knurl_system_mutex_destroy(knurl_mutex *mutex);
void knurl_system_mutex_lock(knurl_mutex *mutex);
void knurl_system_mutex_unlock(knurl_mutex *mutex);

/* Functions to call before the process ends or stops. They may use the clock, sleeps and atomics only. */
typedef struct knurl_exit_actions {
    void (*end)(void);    /* before an end, once or more often */
    void (*stop)(void);   /* before the process is stopped as a job of its terminal */
    void (*resume)(void); /* when it goes on after that */
} knurl_exit_actions;

/* Registers `actions` (kept) for exit() and for every signal that ends or stops the process, unless the host handles or
 * ignores it. Earlier handlers of crashes are called after `end`; with faults_recover, those of SIGSEGV, SIGBUS, SIGFPE
 * and SIGILL are left alone too. Returns 0 where the system refuses. Later calls change nothing. */
int knurl_system_on_exit(const knurl_exit_actions *actions, int faults_recover);

/* Locks a device's node against other openings, here or in another process, until it is given back or the process ends
 * in whatever way. Returns a positive number to give it back by; 0: another has it; negative: the system cannot tell.
 */
intptr_t knurl_system_take_node(const char *path);
void knurl_system_give_back_node(intptr_t node);

/* A variable that names a library or another file; null in a program that has more rights than who started it, and to
 * whom it belongs (setuid, capabilities). */
const char *knurl_system_environment(const char *name);

/* Loads a library. path: absolute, or a bare name that is searched where the system keeps libraries (on Windows also
 * beside the program), never in the current folder or along PATH. Returns null and the system's reason in `why`. */
typedef struct knurl_library knurl_library;
knurl_library *knurl_system_load_library(const char *path, char *why, size_t why_size);
void knurl_system_unload_library(knurl_library *library);

/* Copies a function's address to *function, a pointer to a function pointer; 0 where there is none of that name. */
int knurl_system_find_function(knurl_library *library, const char *name, void *function);

/* Moves the calling thread to the real-time scheduler, unless it is there already (on POSIX systems it then keeps its
 * priority); 0 where that is not permitted. */
int knurl_system_make_realtime(void);

/* Keeps pages in RAM; 0 where that is not permitted. */
int knurl_system_lock_memory(void *memory, size_t size);

/* Lets pages go that were locked. */
void knurl_system_unlock_memory(void *memory, size_t size);

/* Touches and locks the next 64 KiB of the calling thread's stack; 0 where that is not permitted. *start: where they
 * begin, for knurl_system_unlock_stack() before the thread ends (its stack may live on as another thread's). */
int knurl_system_lock_stack(uintptr_t *start);
void knurl_system_unlock_stack(uintptr_t start);

#endif
