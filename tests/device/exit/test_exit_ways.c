/* Every kind of end and stop of a program, on every device: the motors' last force, and its time. The child is this
 * program again; kinds of devices are tried in parallel. Prints a table, and writes it to exits.md.
 * SPDX-License-Identifier: MIT */
#define _GNU_SOURCE 1

#include "wire.h"

#include "support/close.h"

#include "base/atomic.h"
#include "base/system.h"

#include <fcntl.h>
#include <knurl/loop.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#define GUARD_MS 100.0 /* limit for a guard to zero the force */
#define EXIT_MS  25.0  /* the longest wait at a detected end, with a margin */

/* --- the ways --- */

enum { RETURN = -1, EXIT = -2, QUICK_EXIT = -3, UNDERSCORE_EXIT = -4, CRASH = -5 }; /* others: signals */

static const struct way {
    const char *name;
    int how;
    int is_seen;   /* by the process itself */
    int is_a_stop; /* it may go on */
} ways[] = {
    {"exit()", EXIT, 1, 0},     {"return from main", RETURN, 1, 0}, {"quick_exit()", QUICK_EXIT, 1, 0},
    {"crash", CRASH, 1, 0},     {"SIGSEGV", SIGSEGV, 1, 0},         {"SIGBUS", SIGBUS, 1, 0},
    {"SIGFPE", SIGFPE, 1, 0},   {"SIGILL", SIGILL, 1, 0},           {"abort()", SIGABRT, 1, 0},
    {"SIGTERM", SIGTERM, 1, 0}, {"SIGHUP", SIGHUP, 1, 0},           {"SIGINT", SIGINT, 1, 0},
    {"SIGQUIT", SIGQUIT, 1, 0}, {"SIGPIPE", SIGPIPE, 1, 0},         {"SIGALRM", SIGALRM, 1, 0},
    {"SIGUSR1", SIGUSR1, 1, 0}, {"SIGUSR2", SIGUSR2, 1, 0},         {"SIGXCPU", SIGXCPU, 1, 0},
    {"SIGXFSZ", SIGXFSZ, 1, 0}, {"SIGTRAP", SIGTRAP, 1, 0},         {"SIGSYS", SIGSYS, 1, 0},
    {"SIGPROF", SIGPROF, 1, 0}, {"SIGVTALRM", SIGVTALRM, 1, 0},     {"SIGPOLL", SIGPOLL, 1, 0},
    {"SIGPWR", SIGPWR, 1, 0},   {"SIGSTKFLT", SIGSTKFLT, 1, 0},     {"SIGTSTP", SIGTSTP, 1, 1},
    {"SIGTTIN", SIGTTIN, 1, 1}, {"SIGTTOU", SIGTTOU, 1, 1},         {"_exit()", UNDERSCORE_EXIT, 0, 0},
    {"SIGKILL", SIGKILL, 0, 0}, {"SIGSTOP", SIGSTOP, 0, 1},
};

/* --- the child --- */

static void nap(void) {
    knurl_system_sleep_until_ns(knurl_system_now_ns() + 1000000);
}

/* Its return value is main's. */
static int end_by(int how) {
    switch (how) {
    case RETURN:
        return 0;
    case EXIT:
        exit(0);
    case QUICK_EXIT:
        quick_exit(0);
    case UNDERSCORE_EXIT:
        _exit(0);
    case CRASH:
        *(volatile char *)mmap(NULL, 4096, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) = 1;
        break;
    case SIGABRT:
        abort();
    default:
        (void)kill(getpid(), how);
    }
    for (;;) { /* it continues after a stop */
        nap();
    }
}

static int number_of(const char *argument) {
    return (int)strtol(argument, NULL, 10);
}

static int be_a_child(char **arguments) {
    const wire_kind *kind = &wire_kinds[number_of(arguments[0])];
    const uint32_t guarded = (uint32_t)number_of(arguments[2]);
    wire_shared *shared = mmap(NULL, sizeof *shared, PROT_READ | PROT_WRITE, MAP_SHARED, number_of(arguments[4]), 0);
    const struct rlimit none = {0, 0};
    static double force[3] = {0.0, 1.0, 0.0};
    knurl_loop *loop = NULL;
    (void)setrlimit(RLIMIT_CORE, &none);
    (void)setpgid(0, 0); /* an orphaned process group is not stopped */
    for (size_t i = 0; i < COUNT_OF(ways); i++) {
        if (ways[i].how > 0) {
            (void)signal(ways[i].how, SIG_DFL); /* a sanitizer's */
        }
    }
    const knurl_loop_desc desc = push_desc(kind->open(number_of(arguments[3]), shared, guarded), force);
    if (!desc.device || knurl_device_zero_on_exit(0) || knurl_loop_create(&desc, &loop) || knurl_loop_start(loop)) {
        (void)fprintf(stderr, "child: %s\n", knurl_error_message());
        _exit(100);
    }
    for (int well = 0; well < 20; well++) { /* motors have got a force for a while */
        well = knurl_load_acquire(&shared->told.limp_since) == 0 ? well : 0;
        nap();
    }
    knurl_store_release(&shared->ended_at, knurl_system_now_ns());
    return end_by(number_of(arguments[1]));
}

/* --- the test --- */

typedef struct outcome {
    double zero_ms;     /* from the end to force 0; -1: the last force stays */
    int is_by_that;     /* the process ended or stopped as it would have without Knurl */
    int goes_on;        /* stops: after SIGCONT the force was there again */
    int handle_is_free; /* no process holds the device any more */
} outcome;

static int wait_until(const int *flag, int milliseconds) {
    for (int i = 0; i < milliseconds && !knurl_load_acquire(flag); i++) {
        nap();
    }
    return knurl_load_acquire(flag);
}

static pid_t start_child(size_t kind, int how, int guarded, int wire, int memory) {
    char words[5][16];
    char *arguments[] = {(char[]){"test_exit_ways"}, words[0], words[1], words[2], words[3], words[4], NULL};
    const int numbers[] = {(int)kind, how, guarded, wire, memory};
    for (int i = 0; i < 5; i++) {
        (void)snprintf(words[i], sizeof words[i], "%d", numbers[i]);
    }
    const pid_t pid = fork();
    if (pid == 0) { /* others, which another kind's thread starts just now, must not have the two */
        sigset_t none;
        (void)sigemptyset(&none); /* the thread that starts it has all blocked */
        (void)sigprocmask(SIG_SETMASK, &none, NULL);
        (void)fcntl(wire, F_SETFD, 0);
        (void)fcntl(memory, F_SETFD, 0);
        (void)execv("/proc/self/exe", arguments);
        _exit(101);
    }
    return pid;
}

/* ms from the end to force 0, waiting for it for 200 ms. */
static double time_to_zero(const wire_shared *shared) {
    for (int i = 0; i < 200 && knurl_load_acquire(&shared->told.limp_since) == 0; i++) {
        nap();
    }
    const int64_t since = knurl_load_acquire(&shared->told.limp_since);
    return since > 0 ? fmax(0.0, 1e-6 * (double)(since - shared->ended_at)) : -1.0;
}

static int is_as_without(int status, const struct way *way) {
    const int number = way->how > 0 ? way->how : way->how == CRASH ? SIGSEGV : 0;
    return way->is_a_stop ? WIFSTOPPED(status) && WSTOPSIG(status) == number
           : number       ? WIFSIGNALED(status) && WTERMSIG(status) == number
                          : WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/* Forces return, without interruption for 100 ms. */
static int is_pushing_again(pid_t child, const wire_shared *shared) {
    int run = 0;
    (void)kill(child, SIGCONT);
    for (int i = 0; i < 3000 && run < 100; i++) {
        run = knurl_load_acquire(&shared->told.limp_since) == 0 ? run + 1 : 0;
        nap();
    }
    return run >= 100;
}

/* A failure of the system's is an outcome that is not good. */
static outcome try_way(size_t kind, const struct way *way, int guarded) {
    outcome o;
    int ends[2] = {-1, -1};
    int status = 0;
    wire_device device;
    memset(&o, 0, sizeof o);
    const int memory = memfd_create("exit_ways", MFD_CLOEXEC);
    if (memory < 0 || ftruncate(memory, sizeof(wire_shared)) != 0 ||
        socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) {
        return o;
    }
    wire_shared *shared = mmap(NULL, sizeof *shared, PROT_READ | PROT_WRITE, MAP_SHARED, memory, 0);
    if (shared == MAP_FAILED) {
        return o;
    }
    shared->told.limp_since = 1;
    const pid_t child = start_child(kind, way->how, guarded, ends[1], memory);
    (void)close(ends[1]);
    (void)close(memory);
    wire_start(&device, &wire_kinds[kind], ends[0], shared);
    o.is_by_that = waitpid(child, &status, WUNTRACED) == child && is_as_without(status, way);
    o.zero_ms = time_to_zero(shared);
    if (way->is_a_stop) {
        o.goes_on = is_pushing_again(child, shared);
        (void)kill(child, SIGKILL);
        (void)waitpid(child, &status, 0);
    }
    o.handle_is_free = wait_until(&device.is_closed, 2000);
    (void)shutdown(ends[0], SHUT_RDWR);
    wire_join(&device);
    (void)close(ends[0]);
    (void)munmap(shared, sizeof *shared);
    return o;
}

static int is_good(const outcome *o, const struct way *way, int guarded) {
    const int zero = way->is_seen ? o->zero_ms >= 0.0 && o->zero_ms <= EXIT_MS
                     : guarded
                         ? o->zero_ms >= 0.0 && o->zero_ms <= GUARD_MS
                         : o->zero_ms < 0.0; /* an undetected end needs a guard: otherwise this test is of no use */
    return zero && o->is_by_that && o->handle_is_free && (!way->is_a_stop || o->goes_on);
}

/* One of each kind is enough for a guard. */
static int is_tried(const struct way *way, int guarded) {
    return !guarded || !way->is_seen || way->how <= 0 || way->how == SIGTERM || way->how == SIGTSTP;
}

/* --- the table --- */

typedef struct column {
    size_t kind;
    int guarded;
    outcome outcomes[COUNT_OF(ways)];
    knurl_thread *thread;
} column;

static column columns[8];

/* A failure because of load does not happen three times. */
static void try_column(void *argument) {
    column *c = argument;
    for (size_t i = 0; i < COUNT_OF(ways); i++) {
        int good = !is_tried(&ways[i], c->guarded);
        for (int tries = 0; tries < 3 && !good; tries++) {
            c->outcomes[i] = try_way(c->kind, &ways[i], c->guarded);
            good = is_good(&c->outcomes[i], &ways[i], c->guarded);
        }
    }
}

static void try_all(int guarded) {
    assert_true(wire_kind_count <= COUNT_OF(columns));
    memset(columns, 0, sizeof columns);
    for (size_t kind = 0; kind < wire_kind_count; kind++) {
        columns[kind].kind = kind;
        columns[kind].guarded = guarded;
        if (!guarded || !wire_kinds[kind].cannot) {
            columns[kind].thread = knurl_system_start_thread(try_column, &columns[kind], (size_t)256 * 1024);
            assert_non_null(columns[kind].thread);
        }
    }
    for (size_t kind = 0; kind < wire_kind_count; kind++) {
        if (columns[kind].thread) {
            knurl_system_join_thread(columns[kind].thread);
        }
    }
}

static FILE *table;

static void tell(const char *text) {
    (void)fputs(text, stdout);
    if (table) {
        (void)fputs(text, table);
    }
}

static int check_cell(const column *c, size_t way_index) {
    const struct way *way = &ways[way_index];
    const outcome *o = &c->outcomes[way_index];
    const int good = is_good(o, way, c->guarded);
    char text[128];
    if (o->zero_ms >= 0.0) {
        (void)snprintf(text, sizeof text, " %s%.1f ms%s |", c->guarded && !way->is_seen ? "the guard's, " : "",
                       o->zero_ms, good ? "" : " BAD");
    } else {
        (void)snprintf(text, sizeof text, " stays%s |", good ? "" : " BAD");
    }
    tell(text);
    if (!good) {
        print_error("%s, %s, guard %d: zero %.1f ms, by that %d, goes on %d, free %d\n", wire_kinds[c->kind].name,
                    way->name, c->guarded, o->zero_ms, o->is_by_that, o->goes_on, o->handle_is_free);
    }
    return good;
}

static void head(const char *title) {
    tell(title);
    for (size_t kind = 0; kind < wire_kind_count; kind++) {
        tell(" ");
        tell(wire_kinds[kind].name);
        tell(" |");
    }
    tell("\n|---|---|---|---|---|---|\n");
}

/* 1: all is good. */
static int check_all(int guarded) {
    int good = 1;
    for (size_t i = 0; i < COUNT_OF(ways); i++) {
        if (!is_tried(&ways[i], guarded)) {
            continue;
        }
        tell("| ");
        tell(ways[i].name);
        tell(" |");
        for (size_t kind = 0; kind < wire_kind_count; kind++) {
            if (columns[kind].thread) {
                good &= check_cell(&columns[kind], i);
            } else {
                tell(" cannot: ");
                tell(wire_kinds[kind].cannot);
                tell(" |");
            }
        }
        tell("\n");
    }
    return good;
}

TEST(an_end_that_the_process_sees_leaves_no_force_and_others_need_a_guard) {
    try_all(0);
    head("\n| without a guard |");
    assert_true(check_all(0));
}

TEST(with_a_guard_no_end_leaves_a_force_for_100_ms) {
    try_all(1);
    head("\n| with ?guard=1 |");
    assert_true(check_all(1));
}

TEST(a_touch_cannot_be_guarded_and_says_why) {
    knurl_device *device = NULL;
    CHECK_REFUSED(knurl_device_open("touch:?guard=1", &device), KNURL_ERROR_UNSUPPORTED, device);
    check_message("library");
    CHECK_REFUSED(knurl_device_open("falcon:?guard=yes", &device), KNURL_ERROR_ARGUMENT, device);
    check_message("guard: expected 0 or 1, found 'yes'");
}

int main(int argc, char **argv) {
    if (argc == 6) {
        return be_a_child(argv + 1);
    }
    table = fopen(KNURL_TEST_TMP "/exits.md", "w");
    const int failed = suite_run("exit_ways");
    if (table) {
        (void)fclose(table);
    }
    return failed;
}
