/* POSIX: what is done before a signal ends the process. SPDX-License-Identifier: MIT */
#include "base/system.h"

#include <pthread.h>
#include <signal.h>
#include <string.h>

static const int signals[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTERM, SIGHUP, SIGINT};

#define SIGNAL_COUNT (sizeof signals / sizeof *signals)

static struct sigaction before[SIGNAL_COUNT];
static void (*let_go)(void);

/* Hands the signal on: to the handler from before, or to the default, which comes when this handler returns. */
static void hand_on(size_t which, int number, siginfo_t *info, void *context) {
    const struct sigaction *old = &before[which];
    if (old->sa_flags & SA_SIGINFO) {
        old->sa_sigaction(number, info, context);
    } else if (old->sa_handler != SIG_DFL && old->sa_handler != SIG_IGN) {
        old->sa_handler(number);
    } else {
        (void)sigaction(number, old, NULL);
        (void)raise(number); /* held back until the handler has returned */
    }
}

static void on_signal(int number, siginfo_t *info, void *context) {
    let_go();
    for (size_t i = 0; i < SIGNAL_COUNT; i++) {
        if (signals[i] == number) {
            hand_on(i, number, info, context);
        }
    }
}

/* A stack that overflowed is no place for a handler. Of the calling thread; whoever gave it one has provided already.
 */
static void give_a_stack(void) {
    static char room[64 * 1024]; /* more than a handler from before has been used to */
    stack_t found;
    stack_t mine;
    memset(&mine, 0, sizeof mine);
    mine.ss_sp = room;
    mine.ss_size = sizeof room;
    if (sigaltstack(NULL, &found) == 0 && found.ss_flags & SS_DISABLE) {
        (void)sigaltstack(&mine, NULL);
    }
}

static int installed;

static void install(void) {
    struct sigaction action;
    memset(&action, 0, sizeof action);
    action.sa_sigaction = on_signal;
    action.sa_flags = SA_SIGINFO | SA_ONSTACK;
    give_a_stack();
    (void)sigemptyset(&action.sa_mask);
    installed = 1;
    for (size_t i = 0; i < SIGNAL_COUNT; i++) {
        installed &= sigaction(signals[i], NULL, &before[i]) == 0;
        const int ignored = !(before[i].sa_flags & SA_SIGINFO) && before[i].sa_handler == SIG_IGN;
        installed &= ignored || sigaction(signals[i], &action, NULL) == 0; /* what does not end it is left alone */
    }
}

int knurl_system_on_crash(void (*function)(void)) {
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    let_go = function;
    (void)pthread_once(&once, install);
    return installed;
}
