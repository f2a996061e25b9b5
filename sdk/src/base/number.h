/* Locale-independent parsing of numbers. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_NUMBER_H
#define KNURL_SRC_NUMBER_H

#include "base/finite.h"

#include <stddef.h>

/* Parses all of `text` as a decimal number ("-0.5", "2e-3") of up to 15 significant digits, correctly rounded, or as a
 * hexadecimal number of up to four digits ("0x16c0"). If it is neither, returns 0 and leaves *value unchanged. */
int knurl_number(const char *text, size_t length, double *value);

/* Parses all of `text` as one to four hexadecimal digits. */
int knurl_number_hex(const char *text, size_t length, double *value);

#endif
