/* Parses numbers, independent of the locale. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_NUMBER_H
#define KNURL_SRC_NUMBER_H

#include "base/finite.h"

#include <stddef.h>

/* All of `text` as a decimal number ("-0.5", "2e-3") of up to 15 significant digits, correctly rounded, or as a
 * hexadecimal one of up to four ("0x16c0"). 0, and *value untouched, where it is neither. */
int knurl_number(const char *text, size_t length, double *value);

/* All of `text` as one to four hexadecimal digits. */
int knurl_number_hex(const char *text, size_t length, double *value);

#endif
