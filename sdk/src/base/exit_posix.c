/* POSIX: hooks that run before the process ends or stops. SPDX-License-Identifier: MIT */
#include "base/system.h"

#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

/* What becomes of a signal that has a handler already. */
enum {
    ENDS,    /* it is left to that handler: exit() and a return from main are seen all the same */
    FAULT,   /* as CRASH, unless the process has a runtime that recovers from it */
    CRASH,   /* zero first, then that handler */
    SUSPENDS /* as ENDS; without a handler it stops the process, which may go on later */
};

/* Every signal that by default ends or stops a process, but: SIGKILL and SIGSTOP, which nobody sees; real-time signals,
 * of which runtimes look for free ones and have handlers for all that they use. */
static const struct {
    int number, kind;
} signals[] = {
    {SIGSEGV, FAULT},  {SIGBUS, FAULT},     {SIGFPE, FAULT},     {SIGILL, FAULT},     {SIGABRT, CRASH}, {SIGTERM, ENDS},
    {SIGHUP, ENDS},    {SIGINT, ENDS},      {SIGQUIT, ENDS},     {SIGPIPE, ENDS},     {SIGALRM, ENDS},  {SIGUSR1, ENDS},
    {SIGUSR2, ENDS},   {SIGXCPU, ENDS},     {SIGXFSZ, ENDS},     {SIGTRAP, ENDS},     {SIGSYS, ENDS},   {SIGPROF, ENDS},
    {SIGVTALRM, ENDS}, {SIGTSTP, SUSPENDS}, {SIGTTIN, SUSPENDS}, {SIGTTOU, SUSPENDS},
#ifdef SIGPOLL
    {SIGPOLL, ENDS}, /* and SIGIO, its other name */
#endif
#ifdef SIGPWR
    {SIGPWR, ENDS},
#endif
#ifdef SIGSTKFLT
    {SIGSTKFLT, ENDS},
#endif
};

#define SIGNAL_COUNT (sizeof signals / sizeof *signals)

static struct sigaction before[SIGNAL_COUNT];
static uint32_t is_taken[SIGNAL_COUNT]; /* 1: the handler is ours */
static const knurl_exit_actions *actions;
static pid_t owner; /* a child that was forked has no threads that could send anything */

/* Defaults are told by their address, whatever the flags: Linux keeps both kinds of handlers in one place. */
static int is_plain(const struct sigaction *action, void (*handler)(int)) {
    return action->sa_handler == handler;
}

static void end(void) {
    if (getpid() == owner) {
        actions->end();
    }
}

/* To the handler from before, or to the default, which comes when this handler returns. */
static void hand_on(size_t which, int number, siginfo_t *info, void *context) {
    const struct sigaction *old = &before[which];
    if (is_plain(old, SIG_DFL)) {
        (void)sigaction(number, old, NULL);
        (void)raise(number); /* held back until the handler has returned */
    } else if (old->sa_flags & SA_SIGINFO) {
        old->sa_sigaction(number, info, context);
    } else {
        old->sa_handler(number);
    }
}

/* Stops here, as by default, until SIGCONT comes; then this handler is there again for the next stop. */
static void suspend(size_t which, int number) {
    struct sigaction mine;
    sigset_t one;
    sigset_t mask;
    (void)sigaction(number, &before[which], &mine);
    (void)sigemptyset(&one);
    (void)sigaddset(&one, number);
    (void)raise(number); /* held back until it is let through */
    (void)pthread_sigmask(SIG_UNBLOCK, &one, &mask);
    (void)pthread_sigmask(SIG_SETMASK, &mask, NULL);
    (void)sigaction(number, &mine, NULL);
}

static void on_signal(int number, siginfo_t *info, void *context) {
    size_t which = 0;
    while (signals[which].number != number) {
        which++;
    }
    if (signals[which].kind == SUSPENDS && getpid() == owner) {
        actions->stop();
        suspend(which, number);
        actions->resume();
    } else {
        end();
        hand_on(which, number, info, context);
    }
}

#define STACK_BYTES ((size_t)64 * 1024) /* the handlers from before run there too */

static void *stack;

/* A stack that overflowed is no place for a handler. For the calling thread, unless it has such a stack. It is no part
 * of the library, which may be unloaded while that thread lives on. */
static void give_a_stack(void) {
    stack_t found;
    stack_t mine;
    memset(&mine, 0, sizeof mine);
    if (sigaltstack(NULL, &found) != 0 || !(found.ss_flags & SS_DISABLE)) {
        return;
    }
    mine.ss_sp = mmap(NULL, STACK_BYTES, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    mine.ss_size = STACK_BYTES;
    if (mine.ss_sp != MAP_FAILED && sigaltstack(&mine, NULL) == 0) {
        stack = mine.ss_sp;
    }
}

/* Where that thread is the calling one. */
static void take_the_stack_back(void) {
    stack_t found;
    if (stack && sigaltstack(NULL, &found) == 0 && found.ss_sp == stack && !(found.ss_flags & SS_ONSTACK)) {
        found.ss_flags = SS_DISABLE;
        if (sigaltstack(&found, NULL) == 0) {
            (void)munmap(stack, STACK_BYTES);
        }
    }
}

static int is_left_alone(size_t which, int faults_recover) {
    const int kind = signals[which].kind;
    const int handled = !is_plain(&before[which], SIG_DFL);
    return is_plain(&before[which], SIG_IGN) || (handled && kind != CRASH && (kind != FAULT || faults_recover));
}

static int take(size_t which, int faults_recover) {
    const int number = signals[which].number;
    struct sigaction action;
    if (sigaction(number, NULL, &before[which]) != 0) {
        return 0;
    }
    if (is_left_alone(which, faults_recover)) {
        return 1;
    }
    memset(&action, 0, sizeof action);
    action.sa_sigaction = on_signal;
    /* calls are restarted as before: nothing was interrupted by a signal without a handler */
    action.sa_flags = SA_SIGINFO | SA_ONSTACK;
    action.sa_flags |=
        is_plain(&before[which], SIG_DFL) ? SA_RESTART : before[which].sa_flags & (SA_RESTART | (int)SA_RESETHAND);
    action.sa_mask = before[which].sa_mask;
    is_taken[which] = sigaction(number, &action, NULL) == 0;
    return (int)is_taken[which];
}

/* The library is unloaded: nothing may point into it. Handlers that were installed after ours stay. */
__attribute__((destructor)) static void give_back(void) {
    for (size_t i = 0; i < SIGNAL_COUNT; i++) {
        struct sigaction now;
        if (is_taken[i] && sigaction(signals[i].number, NULL, &now) == 0 && now.sa_sigaction == on_signal) {
            (void)sigaction(signals[i].number, &before[i], NULL);
        }
    }
    take_the_stack_back();
}

static int installed;
static int recovers;

static void install(void) {
    owner = getpid();
    give_a_stack();
    installed = atexit(end) == 0;
#ifdef __GLIBC__
    installed &= at_quick_exit(end) == 0;
#endif
    for (size_t i = 0; i < SIGNAL_COUNT; i++) {
        installed &= take(i, recovers);
    }
}

int knurl_system_on_exit(const knurl_exit_actions *what, int faults_recover) {
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    actions = what;
    recovers = faults_recover;
    (void)pthread_once(&once, install);
    return installed;
}
