/* Windows: hooks that run before an exception, abort(), a console event or exit() ends the process. TerminateProcess()
 * and __fastfail() cannot be hooked. If a program that uses the DLL calls exit(), all other threads have ended by then,
 * so none can send zero force.
 * SPDX-License-Identifier: MIT */
#include "base/system.h"

#include <windows.h>

#include <signal.h>
#include <stdlib.h>

static const knurl_exit_actions *actions;
static LPTOP_LEVEL_EXCEPTION_FILTER filter_before;
static void (*abort_before)(int number);

static void end(void) {
    actions->end();
}

/* Called only for unhandled exceptions, not for those that a runtime recovers from. */
static LONG WINAPI on_exception(EXCEPTION_POINTERS *what) {
    end();
    return filter_before ? filter_before(what) : EXCEPTION_CONTINUE_SEARCH;
}

/* Ctrl-C, Ctrl-Break, the console's close button, logging off, shutting down; called in a thread of the system's. */
static BOOL WINAPI on_console(DWORD event) {
    (void)event;
    end();
    return FALSE; /* call the earlier handler; the last one ends the process */
}

/* abort() raises no exception. */
static void on_abort(int number) {
    end();
    if (abort_before != SIG_DFL && abort_before != SIG_IGN) {
        abort_before(number);
    } /* else abort() continues when this returns */
}

static int installed;

/* A filter set later is called first, and may not call this one. */
static BOOL CALLBACK install(INIT_ONCE *once, void *parameter, void **context) {
    (void)once;
    (void)parameter;
    (void)context;
    filter_before = SetUnhandledExceptionFilter(on_exception);
    abort_before = signal(SIGABRT, on_abort);
    installed = abort_before != SIG_ERR && SetConsoleCtrlHandler(on_console, TRUE) && atexit(end) == 0;
    return TRUE; /* do not retry after a failure */
}

/* The library is being unloaded: remove hooks that point into it. Hooks installed after ours stay. */
__attribute__((destructor)) static void give_back(void) {
    if (installed) {
        const LPTOP_LEVEL_EXCEPTION_FILTER filter = SetUnhandledExceptionFilter(filter_before);
        if (filter != on_exception) {
            (void)SetUnhandledExceptionFilter(filter);
        }
        (void)SetConsoleCtrlHandler(on_console, FALSE);
        (void)signal(SIGABRT, abort_before);
    }
}

int knurl_system_on_exit(const knurl_exit_actions *what, int faults_recover) {
    static INIT_ONCE once = INIT_ONCE_STATIC_INIT;
    (void)faults_recover;
    actions = what;
    (void)InitOnceExecuteOnce(&once, install, NULL, NULL);
    return installed;
}
