/* Starts the guard process from memory and sends it messages. SPDX-License-Identifier: MIT */
#include "base/guard_process.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#define EXECUTABLE 0x10u /* MFD_EXEC, missing in older headers */

#define PATIENCE_MS 1000 /* timeout for its start and its end */

/* The guard's executable (made by embed.cmake). */
extern const unsigned char knurl_guard_image[];
extern const size_t knurl_guard_image_size;

struct knurl_guard_process {
    int socket;
};

static void close_one(int fd) {
    if (fd >= 0) {
        (void)close(fd);
    }
}

/* Moves a descriptor above 2, because the guard's descriptors become 0 and 1. */
static int lift(int fd) {
    const int high = fd >= 0 ? fcntl(fd, F_DUPFD_CLOEXEC, 3) : -1;
    close_one(fd);
    return high;
}

static int open_image(void) {
    int file = memfd_create("knurl-guard", MFD_CLOEXEC | EXECUTABLE);
    if (file < 0 && errno == EINVAL) { /* a kernel before 6.3 */
        file = memfd_create("knurl-guard", MFD_CLOEXEC);
    }
    file = lift(file);
    size_t done = 0;
    while (file >= 0 && done < knurl_guard_image_size) {
        const ssize_t put = write(file, knurl_guard_image + done, knurl_guard_image_size - done);
        if (put <= 0) {
            close_one(file);
            return -1;
        }
        done += (size_t)put;
    }
    return file;
}

/* Returns 0 or an errno code. The child does not get the host's handlers, environment or open files. */
static int spawn(int image, int socket, int device, pid_t *child) {
    char path[64];
    char name[] = "knurl-guard";
    char *const arguments[] = {name, NULL};
    char *const environment[] = {NULL};
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    sigset_t all;
    (void)snprintf(path, sizeof path, "/proc/self/fd/%d", image);
    (void)sigfillset(&all);
    if (posix_spawn_file_actions_init(&files) != 0 || posix_spawnattr_init(&attributes) != 0) {
        return ENOMEM;
    }
    int code = posix_spawn_file_actions_adddup2(&files, socket, 0);
    code = code ? code : posix_spawn_file_actions_adddup2(&files, device, 1);
    code = code ? code : posix_spawnattr_setsigmask(&attributes, &all);
    code = code ? code : posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
    code = code ? code : posix_spawn(child, path, &files, &attributes, arguments, environment);
    (void)posix_spawn_file_actions_destroy(&files);
    (void)posix_spawnattr_destroy(&attributes);
    return code;
}

/* Waits for the guard's first message; 0 on timeout. */
static int is_there(int socket) {
    char word;
    struct pollfd guard = {socket, POLLIN, 0};
    return poll(&guard, 1, PATIENCE_MS) == 1 && recv(socket, &word, 1, MSG_DONTWAIT) == 1;
}

/* Returns 0 or an errno code. ends: the socket's ends, the host's and the guard's. */
static int start(const int ends[2], int device, const knurl_guard_order *order) {
    pid_t child = 0;
    const int image = open_image();
    int code = image >= 0 ? spawn(image, ends[1], device, &child) : errno;
    close_one(image);
    if (code) {
        return code;
    }
    while (waitpid(child, NULL, 0) < 0 && errno == EINTR) {} /* this child only forks the guard */
    return send(ends[0], order, sizeof *order, MSG_NOSIGNAL) == (ssize_t)sizeof *order ? 0 : errno;
}

knurl_guard_process *knurl_guard_process_start(int device, const knurl_guard_order *order, char *why, size_t why_size) {
    knurl_guard_process *made = calloc(1, sizeof *made);
    int ends[2] = {-1, -1};
    const int high = lift(device);
    int code = made ? 0 : ENOMEM;
    if (!code && (high < 0 || socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0)) {
        code = errno;
    }
    ends[1] = lift(ends[1]);
    code = code ? code : ends[0] >= 0 && ends[1] >= 0 ? start(ends, high, order) : EMFILE;
    close_one(ends[1]);
    close_one(high);
    if (!code && !is_there(ends[0])) {
        code = ETIMEDOUT;
    }
    if (code) {
        (void)snprintf(why, why_size, "the guard process cannot be started: %s", strerror(code));
        close_one(ends[0]);
        free(made);
        return NULL;
    }
    made->socket = ends[0];
    return made;
}

int knurl_guard_process_tell(knurl_guard_process *guard) {
    static const uint8_t word = KNURL_GUARD_ALIVE;
    return send(guard->socket, &word, 1, MSG_DONTWAIT | MSG_NOSIGNAL) == 1 || errno == EAGAIN || errno == EINTR;
}

void knurl_guard_process_stop(knurl_guard_process *guard) {
    static const uint8_t word = KNURL_GUARD_LEAVE;
    if (guard) {
        struct pollfd gone = {guard->socket, POLLIN, 0};
        if (send(guard->socket, &word, 1, MSG_NOSIGNAL) == 1) {
            (void)poll(&gone, 1, PATIENCE_MS);
        }
        close_one(guard->socket);
        free(guard);
    }
}
