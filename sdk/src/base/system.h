/* Operating system functions: time, threads, locked memory, process ends, libraries. One implementation per system.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_SYSTEM_H
#define KNURL_SRC_SYSTEM_H

#include "base/finite.h"

#include <stddef.h>
#include <stdint.h>

typedef struct knurl_thread knurl_thread;

/* A monotonic clock that continues while the machine sleeps, ns. Not a system call if the kernel has a vDSO. */
int64_t knurl_system_now_ns(void);

/* Returns at once if the deadline has passed. */
void knurl_system_sleep_until_ns(int64_t deadline_ns);

/* Starts a thread with `stack_bytes` of stack; null if the system refuses. */
knurl_thread *knurl_system_start_thread(void (*entry)(void *argument), void *argument, size_t stack_bytes);

/* Waits for the thread's end and frees it. In a forked child, which has no such thread, it only frees. */
void knurl_system_join_thread(knurl_thread *thread);

/* A number that differs for each living thread; never 0. */
uintptr_t knurl_system_thread_id(void);

/* Differs in a forked child, which has its parent's memory but not its threads. */
uintptr_t knurl_system_process_id(void);

/* For editing threads; never in a tick. */
typedef struct knurl_mutex {
    uint64_t storage[8];
} knurl_mutex;

void knurl_system_mutex_init(knurl_mutex *mutex);
void knurl_system_mutex_destroy(knurl_mutex *mutex);
void knurl_system_mutex_lock(knurl_mutex *mutex);
void knurl_system_mutex_unlock(knurl_mutex *mutex);

/* Functions to call before the process ends or stops. They may use the clock, sleeps and atomics only. */
typedef struct knurl_exit_actions {
    void (*end)(void);    /* before the process ends; may be called more than once */
    void (*stop)(void);   /* before the terminal stops the process (Ctrl-Z) */
    void (*resume)(void); /* when it continues */
} knurl_exit_actions;

/* Registers `actions` (kept) for exit() and for every signal that ends or stops the process, unless the host handles or
 * ignores it. Earlier handlers of crashes are called after `end`; with faults_recover, existing handlers of SIGSEGV,
 * SIGBUS, SIGFPE and SIGILL are kept instead. Returns 0 if the system refuses. Only the first call has an effect. */
int knurl_system_on_exit(const knurl_exit_actions *actions, int faults_recover);

/* Reserves a device's node, against this process and others, until it is released or the process ends, even by SIGKILL.
 * Returns a positive number for knurl_system_give_back_node(); 0 if it is reserved already; negative if the system
 * cannot reserve it. */
intptr_t knurl_system_take_node(const char *path);
void knurl_system_give_back_node(intptr_t node);

/* An environment variable with a file's path; null if the program has more rights than its user (setuid). */
const char *knurl_system_environment(const char *name);

/* Loads a library. path: absolute, or a bare name, searched in the system's library folders (on Windows also beside the
 * program), never in the current folder or along PATH. Returns null and the system's reason in `why` if it fails. */
typedef struct knurl_library knurl_library;
knurl_library *knurl_system_load_library(const char *path, char *why, size_t why_size);
void knurl_system_unload_library(knurl_library *library);

/* Copies a function's address to *function, a pointer to a function pointer; 0 if there is no such function. */
int knurl_system_find_function(knurl_library *library, const char *name, void *function);

/* Moves the calling thread to the real-time scheduler; 0 if that is not permitted. On POSIX systems a thread that is
 * there already keeps its priority. */
int knurl_system_make_realtime(void);

/* Locks pages into RAM; 0 if that is not permitted. */
int knurl_system_lock_memory(void *memory, size_t size);

/* Unlocks them. */
void knurl_system_unlock_memory(void *memory, size_t size);

/* Touches and locks the next 64 KiB of the calling thread's stack; 0 if that is not permitted. *start: their address,
 * for knurl_system_unlock_stack() before the thread ends (its stack may be reused by another thread). */
int knurl_system_lock_stack(uintptr_t *start);
void knurl_system_unlock_stack(uintptr_t start);

#endif
