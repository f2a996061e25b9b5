/* Functions of the operating system beyond standard C: os_posix.c or os_windows.c. Arguments and paths are UTF-8.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SAMPLES_OS_H
#define KNURL_SAMPLES_OS_H

#include <stdint.h>
#include <stdio.h>

/* Call it first in main(). On Windows: converts the arguments to UTF-8, sets the console to UTF-8 and standard streams
 * to binary. */
void os_begin(int *argc, char ***argv);

/* Ctrl-C and a request to end (SIGTERM) call `handler` instead of ending the process. On Windows in another thread, and
 * for Ctrl-C and Ctrl-Break only, always with SIGINT. */
void os_on_interrupt(void (*handler)(int number));

/* Calls `handler` before a signal ends the process, except SIGKILL: Ctrl-C and SIGTERM unless os_on_interrupt() handles
 * them, a closed terminal or pipe, limits of time and size. It must be async-signal-safe. Call this after
 * knurl_device_zero_on_exit(), whose handlers run next. */
void os_before_end(void (*handler)(void));

/* Runs another program with this one's arguments and standard streams. Returns its exit code; on POSIX it replaces this
 * process. -1: errno says why it cannot be run. */
int os_run_instead(const char *program, char **argv);

/* Waits up to 5 ms for a key, or a byte from standard input. Returns it, 0 on timeout, -1 at the end. A terminal sends
 * keys after Enter, a Windows console immediately. */
int os_wait_for_key(void);
void os_forget_keys(void); /* drops earlier keys if standard input is a terminal */

/* --- files: 0, or -1 with errno --- */

/* Identity of a file, independent of its path. All 0: unknown, such as a pipe on Windows. */
typedef struct os_file {
    uint64_t device, number;
    int is_regular;
} os_file;

int os_identify(const char *path, os_file *found);
int os_identify_stream(FILE *stream, os_file *found);

/* Opens a regular file or a pipe for reading; a FIFO without a writer is empty. Null: *why says what it is instead,
 * such as a device or a folder, which cannot be read as a file of lines. */
FILE *os_open_input(const char *path, const char **why);

/* Opens for writing; null with errno. os_create(): a new file (otherwise EEXIST), which may be removed while it is
 * open. */
FILE *os_create(const char *path);
FILE *os_open_output(const char *path);
FILE *os_open_stdout(void); /* a stream of its own, at the same offset */

int os_remove(const char *path);                    /* may be called by os_before_end()'s handler */
int os_replace(const char *path, const char *with); /* renames `with` to `path`, replacing it */
int os_sync(FILE *stream);                          /* flushes to disk: the data survive a power cut */
int os_make_folder(const char *path);
int os_random(uint64_t *number); /* unpredictable */

/* The last component of a path. */
const char *os_base_name(const char *path);

#endif
