/* POSIX: hooks that run before the process ends or stops. SPDX-License-Identifier: MIT */
#include "base/system.h"

#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

/* Treatment of a signal that has a handler already. */
enum {
    ENDS,    /* left to that handler: if it calls exit() or main() returns, atexit() still zeroes forces */
    FAULT,   /* as CRASH; as ENDS if the process's runtime recovers from it */
    CRASH,   /* zero first, then that handler */
    SUSPENDS /* by default stops the process, which may continue later; with a handler, as ENDS */
};

/* Every signal that by default ends or stops a process, except SIGKILL and SIGSTOP, which cannot be caught, and
 * real-time signals, because runtimes search for unused ones and handle all that they use. */
static const struct {
    int number, kind;
} signals[] = {
    {SIGSEGV, FAULT},  {SIGBUS, FAULT},     {SIGFPE, FAULT},     {SIGILL, FAULT},     {SIGABRT, CRASH}, {SIGTERM, ENDS},
    {SIGHUP, ENDS},    {SIGINT, ENDS},      {SIGQUIT, ENDS},     {SIGPIPE, ENDS},     {SIGALRM, ENDS},  {SIGUSR1, ENDS},
    {SIGUSR2, ENDS},   {SIGXCPU, ENDS},     {SIGXFSZ, ENDS},     {SIGTRAP, ENDS},     {SIGSYS, ENDS},   {SIGPROF, ENDS},
    {SIGVTALRM, ENDS}, {SIGTSTP, SUSPENDS}, {SIGTTIN, SUSPENDS}, {SIGTTOU, SUSPENDS},
#ifdef SIGPOLL
    {SIGPOLL, ENDS}, /* also named SIGIO */
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
static pid_t owner; /* a forked child has no threads that could send zero force */

/* Compares sa_handler whatever the flags say: on Linux it shares its place with sa_sigaction. */
static int is_plain(const struct sigaction *action, void (*handler)(int)) {
    return action->sa_handler == handler;
}

static void end(void) {
    if (getpid() == owner) {
        actions->end();
    }
}

/* Calls the earlier handler, or raises the signal again for its default action after this handler returns. */
static void hand_on(size_t which, int number, siginfo_t *info, void *context) {
    const struct sigaction *old = &before[which];
    if (is_plain(old, SIG_DFL)) {
        (void)sigaction(number, old, NULL);
        (void)raise(number); /* blocked until the handler returns */
    } else if (old->sa_flags & SA_SIGINFO) {
        old->sa_sigaction(number, info, context);
    } else {
        old->sa_handler(number);
    }
}

/* Stops the process by the default action until SIGCONT, then reinstalls this handler. */
static void suspend(size_t which, int number) {
    struct sigaction mine;
    sigset_t one;
    sigset_t mask;
    (void)sigaction(number, &before[which], &mine);
    (void)sigemptyset(&one);
    (void)sigaddset(&one, number);
    (void)raise(number); /* blocked until the next line */
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

#define STACK_BYTES ((size_t)64 * 1024) /* earlier handlers run there too */

static void *stack;

/* Gives the calling thread a signal stack unless it has one, because a handler cannot run on a stack that overflowed.
 * It is mapped, not static: the library may be unloaded before the thread ends. */
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

/* Only if called on the thread that got it. */
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
    /* restart system calls as before: a signal without a handler interrupts no call */
    action.sa_flags = SA_SIGINFO | SA_ONSTACK;
    action.sa_flags |=
        is_plain(&before[which], SIG_DFL) ? SA_RESTART : before[which].sa_flags & (SA_RESTART | (int)SA_RESETHAND);
    action.sa_mask = before[which].sa_mask;
    is_taken[which] = sigaction(number, &action, NULL) == 0;
    return (int)is_taken[which];
}

/* The library is being unloaded: restore handlers that point into it. Handlers installed after ours stay. */
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
