/* Windows: what is done before an exception, abort() or the console ends the process. TerminateProcess() and
 * __fastfail() leave no time for anything. SPDX-License-Identifier: MIT */
#include "base/system.h"

#include <windows.h>

#include <signal.h>

static void (*let_go)(void);
static LPTOP_LEVEL_EXCEPTION_FILTER filter_before;
static void (*abort_before)(int number);

static LONG WINAPI on_exception(EXCEPTION_POINTERS *what) {
    let_go();
    return filter_before ? filter_before(what) : EXCEPTION_CONTINUE_SEARCH;
}

/* Ctrl-C, Ctrl-Break, the console's close button, logging off, shutting down; in a thread of the system's. */
static BOOL WINAPI on_console(DWORD event) {
    (void)event;
    let_go();
    return FALSE; /* on to the handler from before; the last one ends the process */
}

/* abort() raises no exception. */
static void on_abort(int number) {
    let_go();
    if (abort_before != SIG_DFL && abort_before != SIG_IGN) {
        abort_before(number);
    } /* else abort() goes on when this returns */
}

static int installed;

/* Whoever sets a filter after us is asked before us, and may not hand on. */
static BOOL CALLBACK install(INIT_ONCE *once, void *parameter, void **context) {
    (void)once;
    (void)parameter;
    (void)context;
    filter_before = SetUnhandledExceptionFilter(on_exception);
    abort_before = signal(SIGABRT, on_abort);
    installed = abort_before != SIG_ERR && SetConsoleCtrlHandler(on_console, TRUE);
    return TRUE; /* once, whatever came of it */
}

int knurl_system_on_crash(void (*function)(void)) {
    static INIT_ONCE once = INIT_ONCE_STATIC_INIT;
    let_go = function;
    (void)InitOnceExecuteOnce(&once, install, NULL, NULL);
    return installed;
}
