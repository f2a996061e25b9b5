/* The table of spatial methods. A new method is a number in <knurl/grating.h>, a height function and a row in
 * methods.c. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_METHODS_H
#define KNURL_SRC_METHODS_H

#include "grating/method.h"

/* By number, KNURL_METHOD_S1 and on; the first row is unused. */
extern const knurl_method knurl_methods[];

#endif
