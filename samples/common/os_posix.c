/* POSIX. SPDX-License-Identifier: MIT */
#include "os.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <string.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

/* Gives a closed standard stream a descriptor that cannot be written to; otherwise the first opened file would get its
 * number, and messages would be written into it. */
static void occupy_standard_streams(void) {
    int handle = 0;
    while (handle >= 0 && handle <= STDERR_FILENO) {
        handle = open("/dev/null", O_RDONLY);
    }
    if (handle > STDERR_FILENO) {
        (void)close(handle);
    }
}

void os_begin(int *argc, char ***argv) {
    (void)argc;
    (void)argv;
    occupy_standard_streams();
}

static void (*on_interrupt)(int number);

void os_on_interrupt(void (*handler)(int number)) {
    struct sigaction action;
    memset(&action, 0, sizeof action);
    action.sa_handler = on_interrupt = handler;
    (void)sigaction(SIGINT, &action, NULL);
    (void)sigaction(SIGTERM, &action, NULL);
}

static void (*before_end)(void);

/* All signals from outside that end a process by default; not crashes, and not SIGPROF, which a profiler may handle. */
static struct {
    int number;
    struct sigaction earlier;
} endings[] = {
    {.number = SIGHUP},    {.number = SIGINT},  {.number = SIGQUIT},   {.number = SIGPIPE}, {.number = SIGALRM},
    {.number = SIGTERM},   {.number = SIGUSR1}, {.number = SIGUSR2},   {.number = SIGXCPU}, {.number = SIGXFSZ},
    {.number = SIGSYS},    {.number = SIGTRAP}, {.number = SIGVTALRM},
#ifdef SIGPOLL
    {.number = SIGPOLL},
#endif
#ifdef SIGPWR
    {.number = SIGPWR},
#endif
#ifdef SIGSTKFLT
    {.number = SIGSTKFLT},
#endif
};

/* After this handler returns, the earlier action follows: the library's, which zeroes forces, or the default. */
static void on_end(int number) {
    before_end();
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        if (endings[i].number == number) {
            (void)sigaction(number, &endings[i].earlier, NULL);
        }
    }
    (void)raise(number);
}

/* Ignored signals stay ignored, and those of os_on_interrupt() keep their handler. */
void os_before_end(void (*handler)(void)) {
    before_end = handler;
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        struct sigaction *earlier = &endings[i].earlier;
        struct sigaction action;
        if (sigaction(endings[i].number, NULL, &action) == 0 && action.sa_handler != SIG_IGN &&
            action.sa_handler != on_end && (!on_interrupt || action.sa_handler != on_interrupt)) {
            *earlier = action;
            memset(&action, 0, sizeof action);
            action.sa_handler = on_end;
            (void)sigaction(endings[i].number, &action, NULL);
        }
    }
}

int os_run_instead(const char *program, char **argv) {
    return execv(program, argv);
}

int os_wait_for_key(void) {
    struct pollfd in = {STDIN_FILENO, POLLIN, 0};
    unsigned char byte = 0;
    const int ready = poll(&in, 1, 5);
    const ssize_t got = ready > 0 ? read(STDIN_FILENO, &byte, 1) : 0;
    if (ready < 0 || got < 0) {
        return errno == EINTR ? 0 : -1;
    }
    return got > 0 ? byte : ready > 0 ? -1 : 0;
}

void os_forget_keys(void) {
    if (isatty(STDIN_FILENO)) {
        (void)tcflush(STDIN_FILENO, TCIFLUSH);
    }
}

static int identify(int failed, const struct stat *status, os_file *found) {
    if (!failed) {
        found->device = (uint64_t)status->st_dev;
        found->number = status->st_ino;
        found->is_regular = S_ISREG(status->st_mode);
    }
    return failed;
}

int os_identify(const char *path, os_file *found) {
    struct stat status;
    return identify(stat(path, &status), &status, found);
}

int os_identify_stream(FILE *stream, os_file *found) {
    struct stat status;
    return identify(fstat(fileno(stream), &status), &status, found);
}

FILE *os_open_input(const char *path, const char **why) {
    struct stat found;
    const int handle = open(path, O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC); /* does not wait for a writer */
    const int is_open = handle >= 0 && fstat(handle, &found) == 0;
    const int is_good = is_open && (S_ISREG(found.st_mode) || S_ISFIFO(found.st_mode));
    if (is_good && fcntl(handle, F_SETFL, 0) == 0) { /* reads wait for the writer */
        FILE *stream = fdopen(handle, "r");
        if (stream) {
            return stream;
        }
    }
    *why = !is_open || is_good      ? strerror(errno)
           : S_ISDIR(found.st_mode) ? "expected a file, found a directory"
                                    : "expected a file, found a device";
    if (handle >= 0) {
        (void)close(handle);
    }
    return NULL;
}

static FILE *stream_of(int handle) {
    FILE *stream = handle >= 0 ? fdopen(handle, "w") : NULL;
    if (!stream && handle >= 0) {
        (void)close(handle);
    }
    return stream;
}

FILE *os_create(const char *path) {
    return stream_of(open(path, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666));
}

FILE *os_open_output(const char *path) {
    return fopen(path, "w");
}

FILE *os_open_stdout(void) {
    (void)fflush(stdout);
    if ((fcntl(STDOUT_FILENO, F_GETFL) & O_ACCMODE) == O_RDONLY) { /* closed, see occupy_standard_streams() */
        errno = EBADF;
        return NULL;
    }
    return stream_of(dup(STDOUT_FILENO));
}

int os_remove(const char *path) {
    return unlink(path);
}

int os_replace(const char *path, const char *with) {
    return rename(with, path);
}

int os_sync(FILE *stream) {
    return fflush(stream) != 0 || fsync(fileno(stream)) != 0 ? -1 : 0;
}

int os_make_folder(const char *path) {
    return mkdir(path, 0777);
}

int os_random(uint64_t *number) {
    return getentropy(number, sizeof *number);
}

const char *os_base_name(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}
