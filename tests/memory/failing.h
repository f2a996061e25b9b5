/* Memory that runs out, everywhere: a call is repeated with its first request refused, then its second, and so on; and
 * with all requests refused from the first on, from the second on, and so on. Each must give an error or succeed, leave
 * things as they were if it failed, succeed when it is tried again, leak nothing, and not end the process.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_FAILING_H
#define KNURL_TEST_FAILING_H

#include "support/close.h"
#include "support/suite.h"

#include <knurl/knurl.h>

#include <stdio.h>

/** A call, its setup and checks. Allocations fail only in `call`. All of it runs in a child process. */
typedef struct failing_call {
    const char *name;
    void (*prepare)(void);                  /* or null */
    knurl_result (*call)(void);             /* functions without a result: KNURL_OK */
    void (*finish)(void);                   /* gives everything back; or null */
    void (*state)(char *text, size_t size); /* describes the state that a failed call must not change; or null */
    int is_wrong;                           /* 1: it fails with memory, too */
    int lists_usb; /* 1: it enumerates USB devices with libraries that leak blocks then, such as libusb, or in which
                    * glibc ends the process; both are counted as the libraries'
                    */
} failing_call;

/** Files that a library is known to leave open after each call, with memory or without; 0 unless set before
 * failing_run(). They are counted as the library's. */
extern int failing_files_of_library;

/** The number of open files of this process. */
int failing_open_files(void);

/** Makes all the calls and fails the test if one does not hold; prints a line for each. */
void failing_run(const failing_call *calls, size_t count);

/** 1 in the long form (`./run soak`): every request, however many. */
int failing_is_long(void);

/** For `prepare`: ends the child process unless `result` is KNURL_OK, and the test fails. */
void failing_need(knurl_result result);

/** Runs `call` in a child process with `bytes` of address space beyond the used one; 1 if it ran to its end.
 */
int failing_survives(knurl_result (*call)(void), size_t bytes);

#endif
