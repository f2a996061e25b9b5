/* Text with numbers, on every system. SPDX-License-Identifier: MIT */
#include "base/format.h"

int knurl_format(char *to, size_t size, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    const int length = knurl_format_arguments(to, size, format, arguments);
    va_end(arguments);
    return length;
}
