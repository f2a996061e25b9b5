/* Text with numbers: as printf(), but with a decimal point in every locale of the host. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_BASE_FORMAT_H
#define KNURL_SRC_BASE_FORMAT_H

#include "base/finite.h"

#include <knurl/base.h>
#include <stdarg.h>

/* As snprintf() and vsnprintf(). */
int knurl_format(char *to, size_t size, const char *format, ...) KNURL_PRINTF(3, 4);
int knurl_format_arguments(char *to, size_t size, const char *format, va_list arguments) KNURL_PRINTF(3, 0);

#endif
