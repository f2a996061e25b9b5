/* The table of spatial methods. A new method is a number in <knurl/grating.h>, a height function and a row in
 * methods.c. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_METHODS_H
#define KNURL_SRC_METHODS_H

#include "grating/method.h"

/* Numbers below it are the library's own; the caller's own methods follow. */
#define KNURL_BUILT_IN_METHODS (KNURL_METHOD_BANDLIMITED + 1)
#define KNURL_OWN_METHODS      16

/* By number, KNURL_METHOD_S1 and on; the first row is unused. A row never changes once it is counted. */
extern knurl_method knurl_methods[KNURL_BUILT_IN_METHODS + KNURL_OWN_METHODS];
extern int32_t knurl_method_count; /* atomic */

#endif
