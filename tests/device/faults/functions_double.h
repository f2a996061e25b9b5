/* A caller's blocking functions as a double, see support/double.h. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_FUNCTIONS_DOUBLE_H
#define KNURL_TEST_FUNCTIONS_DOUBLE_H

#include "support/double.h"

extern const device_double functions_double;

/** Of functions_double's read, ns with DOUBLE_HANG: longer than its time limit. Call it after open. */
void functions_double_hang(int64_t ns);

/** A time in memory that children share, as the motors of both doubles are once one was opened. */
int64_t *functions_double_mark(void);

/** The same without an I/O thread, for faults of the haptic thread. */
extern const device_double plain_double;

#endif
