/* Runs a program as a shell would: arguments in; exit code or signal, standard output and standard error out.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_PROCESS_H
#define KNURL_TEST_PROCESS_H

#include "support/close.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/** Seconds after which a program that does not end is killed; the test fails then. */
#ifndef PROCESS_PATIENCE /* longer under an emulator */
#define PROCESS_PATIENCE 20
#endif

#define PROCESS_ARGUMENTS 32

typedef struct process {
    pid_t pid;
    int pipes[2]; /* its standard output and error, read here */
    char *out;    /* all of it, with a 0 behind */
    char *err;
    size_t sizes[2]; /* of out and err */
    int exit_code;   /* -1: ended by a signal */
    int signal;      /* 0: ended by itself */
} process;

/** Starts arguments[0], with the others up to a null. stdout_path: a file for its standard output instead of `out`, or
 * null. */
static inline process process_start(const char *const *arguments, const char *stdout_path) {
    char *copies[PROCESS_ARGUMENTS + 1] = {NULL};
    int ends[2][2];
    process p;
    memset(&p, 0, sizeof p);
    for (size_t i = 0; i < PROCESS_ARGUMENTS && arguments[i]; i++) {
        copies[i] = strdup(arguments[i]);
    }
    assert_int_equal(pipe(ends[0]), 0);
    assert_int_equal(pipe(ends[1]), 0);
    p.pid = fork();
    assert_true(p.pid >= 0);
    if (p.pid == 0) {
        const int file = stdout_path ? open(stdout_path, O_WRONLY) : ends[0][1];
        const int nothing = open("/dev/null", O_RDONLY);
        if (file >= 0 && nothing >= 0 && dup2(nothing, STDIN_FILENO) >= 0 && dup2(file, STDOUT_FILENO) >= 0 &&
            dup2(ends[1][1], STDERR_FILENO) >= 0) {
            for (int i = 0; i < 2; i++) {
                (void)close(ends[i][0]);
                (void)close(ends[i][1]);
            }
            (void)execv(copies[0], copies);
        }
        _exit(126);
    }
    for (int i = 0; i < 2; i++) {
        (void)close(ends[i][1]);
        p.pipes[i] = ends[i][0];
    }
    for (size_t i = 0; i < PROCESS_ARGUMENTS; i++) {
        free(copies[i]);
    }
    return p;
}

/** Reads the pending output; closes a pipe at its end. */
static inline void process_drain(process *p, int which, char **text) {
    char chunk[65536];
    const ssize_t got = read(p->pipes[which], chunk, sizeof chunk);
    if (got <= 0) {
        (void)close(p->pipes[which]);
        p->pipes[which] = -1;
        return;
    }
    *text = realloc(*text, p->sizes[which] + (size_t)got + 1);
    assert_non_null(*text);
    memcpy(*text + p->sizes[which], chunk, (size_t)got);
    p->sizes[which] += (size_t)got;
    (*text)[p->sizes[which]] = '\0';
}

/** Waits for the end and collects the output. */
static inline void process_finish(process *p) {
    int status = 0;
    const time_t give_up = time(NULL) + PROCESS_PATIENCE;
    p->out = calloc(1, 1);
    p->err = calloc(1, 1);
    while (p->pipes[0] >= 0 || p->pipes[1] >= 0) {
        struct pollfd ends[2] = {{p->pipes[0], POLLIN, 0}, {p->pipes[1], POLLIN, 0}};
        if (time(NULL) > give_up) {
            (void)kill(p->pid, SIGKILL);
        }
        (void)poll(ends, 2, 200); /* a negative descriptor is passed over */
        if (ends[0].revents) {
            process_drain(p, 0, &p->out);
        }
        if (ends[1].revents) {
            process_drain(p, 1, &p->err);
        }
    }
    assert_int_equal(waitpid(p->pid, &status, 0), p->pid);
    p->signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    p->exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static inline void process_free(process *p) {
    free(p->out);
    free(p->err);
    p->out = NULL;
    p->err = NULL;
}

/** One that is freed at the end of its block. */
#define SCOPED_PROCESS __attribute__((cleanup(process_free))) process

#endif
