/* What the samples ask of the operating system beyond C: os_posix.c or os_windows.c. Arguments and paths are UTF-8.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SAMPLES_OS_H
#define KNURL_SAMPLES_OS_H

#include <stdint.h>
#include <stdio.h>

/* What main() calls first. On Windows: arguments in UTF-8, a console that shows UTF-8, and standard streams that do not
 * change line ends. */
void os_begin(int *argc, char ***argv);

/* Ctrl-C and a request to end (SIGTERM) call `handler` instead of ending the process. On Windows in another thread, and
 * for Ctrl-C and Ctrl-Break only, always with SIGINT. */
void os_on_interrupt(void (*handler)(int number));

/* Whatever ends the process from outside, but kills that nobody sees, calls `handler` before: Ctrl-C and a request to
 * end unless they interrupt, a closed terminal, a reader that has gone, limits of time and size. It does what a signal
 * handler may do. After knurl_device_zero_on_exit(), whose handlers are called next. */
void os_before_end(void (*handler)(void));

/* Runs another program with this one's arguments and standard streams. Returns its exit code, if at all: on POSIX it
 * takes this process's place. -1: errno says why it cannot be run. */
int os_run_instead(const char *program, char **argv);

/* Waits up to 5 ms for a key, or a byte of what standard input is: that, 0 for none, -1 at the end. A terminal gives
 * keys after Enter, Windows' at once. */
int os_wait_for_key(void);
void os_forget_keys(void); /* that were typed before, where standard input is a terminal */

/* --- files: 0, or -1 with errno --- */

/* Which file it is, whatever it is called. All 0: not to be told apart, as a pipe on Windows. */
typedef struct os_file {
    uint64_t device, number;
    int is_regular;
} os_file;

int os_identify(const char *path, os_file *found);
int os_identify_stream(FILE *stream, os_file *found);

/* Opens for reading what exists: a regular file, or a pipe; a FIFO that nobody writes to is an empty one. Null: *why
 * says what it is instead: devices have no end, and folders no lines. */
FILE *os_open_input(const char *path, const char **why);

/* Opens for writing; null with errno. Create: a file that is not there yet (else EEXIST), which may be removed while it
 * is open. */
FILE *os_create(const char *path);
FILE *os_open_output(const char *path);
FILE *os_open_stdout(void); /* a stream of its own, at the same offset */

int os_remove(const char *path);                    /* may be called by os_before_end()'s handler */
int os_replace(const char *path, const char *with); /* renames `with`; the file that was there is gone */
int os_sync(FILE *stream);                          /* what was written survives a power cut */
int os_make_folder(const char *path);
int os_random(uint64_t *number); /* that nobody can guess */

/* Where a path's last part begins. */
const char *os_base_name(const char *path);

#endif
