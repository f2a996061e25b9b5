/* SPDX-License-Identifier: MIT */
#define _GNU_SOURCE 1 /* MAP_ANONYMOUS */

#pragma GCC visibility push(default) /* of malloc() and its like: for all libraries of the process */
#include "memory/failing.h"

#include <errno.h>
#include <fcntl.h>
#include <malloc.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#define PATIENCE     20  /* s for one run */
#define RUNS_MOST    600 /* of a call, in each mode, in the short form */
#define STATE_ROOM   4096
#define MESSAGE_ROOM 160

/* --- memory --- */

/* glibc's own, by the names that a program's malloc() does not replace. */
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *memory, size_t size);
void *__libc_memalign(size_t alignment, size_t size);
void __libc_free(void *memory);

static int armed;       /* atomic: requests are counted, and refused */
static long requests;   /* atomic: since it was armed */
static long first;      /* the request that is refused */
static int all_from_it; /* and all that come later */
static long blocks;     /* atomic: alive */

static int is_refused(void) {
    if (!__atomic_load_n(&armed, __ATOMIC_SEQ_CST)) {
        return 0;
    }
    const long number = __atomic_add_fetch(&requests, 1, __ATOMIC_SEQ_CST);
    const int refused = first > 0 && (all_from_it ? number >= first : number == first);
    if (refused) {
        errno = ENOMEM;
    }
    return refused;
}

static void *noted(void *memory) {
    if (memory) {
        (void)__atomic_add_fetch(&blocks, 1, __ATOMIC_SEQ_CST);
    }
    return memory;
}

void *malloc(size_t size) {
    return is_refused() ? NULL : noted(__libc_malloc(size));
}

void *calloc(size_t count, size_t size) {
    return is_refused() ? NULL : noted(__libc_calloc(count, size));
}

void free(void *memory) {
    if (memory) {
        (void)__atomic_sub_fetch(&blocks, 1, __ATOMIC_SEQ_CST);
    }
    __libc_free(memory);
}

void *realloc(void *memory, size_t size) {
    if (!memory) {
        return malloc(size);
    }
    if (size == 0) {
        free(memory);
        return NULL;
    }
    return is_refused() ? NULL : __libc_realloc(memory, size);
}

void *memalign(size_t alignment, size_t size) {
    return is_refused() ? NULL : noted(__libc_memalign(alignment, size));
}

void *aligned_alloc(size_t alignment, size_t size) {
    return memalign(alignment, size);
}

int posix_memalign(void **memory, size_t alignment, size_t size) {
    void *made = memalign(alignment, size);
    if (!made) {
        return ENOMEM;
    }
    *memory = made;
    return 0;
}

/* --- one run, in the child --- */

/* Shared with the parent. */
static struct report {
    long at;     /* the allocation that fails in the present run; 0: no allocation */
    int all;     /* and all later ones */
    long needed; /* requests of a run that is refused nothing */
    long runs, errors, successes;
    long theirs;                         /* leaks and ends by libraries */
    long crashes, leaks, changes, other; /* other: no message, or the call failed with memory, too */
    char what[MESSAGE_ROOM];             /* of the first that was wrong */
} *report;

static void tell(long *which, const char *what, const char *detail) {
    if (!report->what[0]) {
        (void)snprintf(report->what, sizeof report->what, "%s at request %ld%s: %s", what, report->at,
                       report->all ? " and later" : "", detail);
    }
    (*which)++;
}

void failing_need(knurl_result result) {
    if (result != KNURL_OK) {
        tell(&report->other, "preparing failed", knurl_error_message());
        _exit(3);
    }
}

int failing_files_of_library;

int failing_open_files(void) {
    int count = 0;
    for (int i = 0; i < 256; i++) {
        count += fcntl(i, F_GETFD) >= 0;
    }
    return count;
}

static knurl_result call_refusing(const failing_call *c, long at, int all) {
    first = at;
    all_from_it = all;
    __atomic_store_n(&requests, 0, __ATOMIC_SEQ_CST);
    __atomic_store_n(&armed, 1, __ATOMIC_SEQ_CST);
    const knurl_result result = c->call();
    __atomic_store_n(&armed, 0, __ATOMIC_SEQ_CST);
    return result;
}

/* Returns how many requests the call made. */
static long run_once(const failing_call *c, long at, int all) {
    char states[2][STATE_ROOM] = {"", ""};
    if (c->prepare) {
        c->prepare();
    }
    if (c->state) {
        c->state(states[0], STATE_ROOM);
    }
    const knurl_result result = call_refusing(c, at, all);
    const long made = requests;
    if (result < 0) {
        report->errors++;
        if (!knurl_error_message()[0]) {
            tell(&report->other, "no message", knurl_result_string(result));
        }
        if (c->state) {
            c->state(states[1], STATE_ROOM);
        }
        if (strcmp(states[0], states[1]) != 0) {
            tell(&report->changes, "the state has changed", states[1]);
        }
        if (!c->is_wrong && call_refusing(c, 0, 0) < 0) {
            tell(&report->other, "failed again with memory", knurl_error_message());
        }
    } else {
        report->successes++;
    }
    if (c->finish) {
        c->finish();
    }
    return made;
}

/* Some memory is allocated once per process by the first call; a leak grows with each run. */
static long run_and_weigh(const failing_call *c, long at, int all) {
    long made = 0;
    long grown = 0;
    int files = 0;
    for (int tries = 0; tries < 3; tries++) {
        const long before = __atomic_load_n(&blocks, __ATOMIC_SEQ_CST);
        files = failing_open_files();
        made = run_once(c, at, all);
        grown = __atomic_load_n(&blocks, __ATOMIC_SEQ_CST) - before;
        files = failing_open_files() - files;
        if (grown <= 0 && files <= 0) {
            return made;
        }
    }
    char detail[48];
    (void)snprintf(detail, sizeof detail, "%ld blocks, %d files", grown, files);
    if (c->lists_usb || (grown <= 0 && files <= 2 * failing_files_of_library)) { /* a failed call is made twice */
        report->theirs++;
    } else {
        tell(&report->leaks, "leaks", detail);
    }
    return made;
}

/* The parent counts crashes, not cmocka; no core files, and no messages of the C++ runtime. */
static void be_quiet(void) {
    static const int crashes[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGSYS};
    const struct rlimit none = {0, 0};
    for (size_t i = 0; i < sizeof crashes / sizeof *crashes; i++) {
        (void)signal(crashes[i], SIG_DFL);
    }
    (void)setrlimit(RLIMIT_CORE, &none);
    if (!freopen("/dev/null", "w", stderr)) {
        _exit(3);
    }
}

int failing_is_long(void) {
    return getenv("KNURL_LONG") != NULL;
}

static void run_child(const failing_call *c) {
    be_quiet();
    report->needed = report->at > 0 ? report->needed : run_and_weigh(c, 0, 0);
    const long step = failing_is_long() || report->needed < RUNS_MOST ? 1 : report->needed / RUNS_MOST + 1;
    for (; report->all < 2; report->all++, report->at = 0) {
        long made = 0;
        do {
            report->at += report->at == 0 ? 1 : step;
            (void)alarm(PATIENCE);
            made = run_and_weigh(c, report->at, report->all);
            report->runs++;
        } while (made >= report->at);
    }
    _exit(0);
}

/* --- all runs, in the parent --- */

/* A thread's first use of a library's thread-local variable allocates it; without memory glibc ends the process with
 * this code, as in libudev of Debian 11, through hidapi. */
#define ENDED_BY_GLIBC 127

/* A crash ends a child; the next child continues after it. */
static void run_call(const failing_call *c) {
    int status = 0;
    int ended_by_glibc = 0;
    memset(report, 0, sizeof *report);
    do {
        (void)fflush(NULL);
        const pid_t child = fork();
        assert_true(child >= 0);
        if (child == 0) {
            run_child(c);
        }
        assert_int_equal(waitpid(child, &status, 0), child);
        if (WIFSIGNALED(status)) {
            report->runs++;
            tell(&report->crashes, "crash", strsignal(WTERMSIG(status)));
        }
        ended_by_glibc = c->lists_usb && WIFEXITED(status) && WEXITSTATUS(status) == ENDED_BY_GLIBC;
        report->runs += ended_by_glibc;
        report->theirs += ended_by_glibc;
    } while ((WIFSIGNALED(status) || ended_by_glibc) && report->at > 0);
    if (WIFEXITED(status) && report->all < 2) {
        tell(&report->other, "the process ended", "by exit()");
    }
}

static void add(struct report *sum) {
    sum->needed += report->needed;
    sum->runs += report->runs;
    sum->errors += report->errors;
    sum->theirs += report->theirs;
    sum->crashes += report->crashes;
    sum->leaks += report->leaks;
    sum->changes += report->changes;
    sum->other += report->other;
}

static void print(const char *name, const struct report *r) {
    print_message("%-44s %5ld requests, %5ld runs, %5ld errors; %ld crashes, %ld leaks, %ld in libraries, %ld changed, "
                  "%ld other%s%s\n",
                  name, r->needed, r->runs, r->errors, r->crashes, r->leaks, r->theirs, r->changes, r->other,
                  r->what[0] ? ": " : "", r->what);
}

void failing_run(const failing_call *calls, size_t count) {
    struct report sum;
    char name[32];
    memset(&sum, 0, sizeof sum);
    report = mmap(NULL, sizeof *report, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    assert_true(report != MAP_FAILED);
    for (size_t i = 0; i < count; i++) {
        run_call(&calls[i]);
        print(calls[i].name, report);
        add(&sum);
    }
    (void)snprintf(name, sizeof name, "%zu calls", count);
    print(name, &sum);
    (void)munmap(report, sizeof *report);
    assert_true(sum.needed > 0);
    assert_int_equal(sum.crashes + sum.leaks + sum.changes + sum.other, 0);
}

/* Bytes of address space. Without stdio, which allocates memory. */
static size_t space_in_use(void) {
    char text[4096];
    const int file = open("/proc/self/statm", O_RDONLY);
    const ssize_t size = read(file, text, sizeof text - 1);
    (void)close(file);
    text[size > 0 ? size : 0] = '\0';
    return strtoul(text, NULL, 10) * (size_t)sysconf(_SC_PAGESIZE);
}

int failing_survives(knurl_result (*call)(void), size_t bytes) {
    int status = 0;
    (void)fflush(NULL);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        be_quiet();
        const struct rlimit limit = {space_in_use() + bytes, space_in_use() + bytes};
        _exit(setrlimit(RLIMIT_AS, &limit) == 0 && call() <= 0 ? 0 : 3);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}
