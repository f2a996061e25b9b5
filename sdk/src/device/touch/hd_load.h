/* The HD library, loaded at run time. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_HD_LOAD_H
#define KNURL_SRC_HD_LOAD_H

#include "device/touch/hd.h"

#include <knurl/base.h>

/* Loads the library, or counts one more user if it is loaded. `path`: the library, or "" for the environment variable
 * KNURL_HD_LIBRARY, then the usual names. `device`: for messages. Errors: KNURL_ERROR_UNSUPPORTED (every attempt, with
 * the system's reason), KNURL_ERROR_ARGUMENT (another library is loaded). [one thread at a time] */
knurl_result knurl_hd_acquire(const char *path, const char *device, const hd_api **hd);

/* Counts one user less, and unloads the library after the last one. */
void knurl_hd_release(void);

#endif
