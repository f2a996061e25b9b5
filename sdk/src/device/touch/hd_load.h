/* The HD library, loaded at run time. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_HD_LOAD_H
#define KNURL_SRC_HD_LOAD_H

#include "device/touch/hd.h"

#include <knurl/base.h>

/* The library for one more user. `path`: where it is, or "": the environment variable KNURL_HD_LIBRARY, else the usual
 * names. A second user gets what the first one loaded. `device`: whom messages name. Errors: KNURL_ERROR_UNSUPPORTED
 * (all that was tried, and what the system says to each), KNURL_ERROR_ARGUMENT (another one is loaded). [one thread at
 * a time] */
knurl_result hd_acquire(const char *path, const char *device, const hd_api **hd);

/* One user less; the last one unloads it. */
void hd_release(void);

#endif
