/* POSIX: what is done before a signal ends the process. SPDX-License-Identifier: MIT */
#include "base/system.h"

#include <pthread.h>
#include <signal.h>
#include <string.h>

static const int signals[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTERM, SIGHUP, SIGINT};

#define SIGNAL_COUNT (sizeof signals / sizeof *signals)

static struct sigaction before[SIGNAL_COUNT];
static void (*let_go)(void);

/* Defaults are told by their address, whatever the flags: Linux keeps both kinds of handlers in one place. */
static int is_plain(const struct sigaction *action, void (*handler)(int)) {
    return action->sa_handler == handler;
}

/* Hands the signal on: to the handler from before, or to the default, which comes when this handler returns. */
static void hand_on(size_t which, int number, siginfo_t *info, void *context) {
    const struct sigaction *old = &before[which];
    if (is_plain(old, SIG_DFL) || is_plain(old, SIG_IGN)) {
        (void)sigaction(number, old, NULL);
        (void)raise(number); /* held back until the handler has returned */
    } else if (old->sa_flags & SA_SIGINFO) {
        old->sa_sigaction(number, info, context);
    } else {
        old->sa_handler(number);
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

/* A stack that overflowed is no place for a handler. For the calling thread, unless it has such a stack. */
static void give_a_stack(void) {
    static char room[64 * 1024]; /* the handlers from before run there too */
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
    give_a_stack();
    installed = 1;
    for (size_t i = 0; i < SIGNAL_COUNT; i++) {
        installed &= sigaction(signals[i], NULL, &before[i]) == 0;
        const int ignored = is_plain(&before[i], SIG_IGN);
        /* as the one from before: whether calls are restarted, what is held back, whether it is for one time */
        action.sa_flags = SA_SIGINFO | SA_ONSTACK | (before[i].sa_flags & (SA_RESTART | (int)SA_RESETHAND));
        action.sa_mask = before[i].sa_mask;
        installed &= ignored || sigaction(signals[i], &action, NULL) == 0; /* what does not end it is left alone */
    }
}

int knurl_system_on_crash(void (*function)(void)) {
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    let_go = function;
    (void)pthread_once(&once, install);
    return installed;
}
