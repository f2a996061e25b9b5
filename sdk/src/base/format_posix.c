/* POSIX: text with numbers. SPDX-License-Identifier: MIT */
#include "base/format.h"

#include <locale.h>
#include <stdio.h>
#ifdef __APPLE__
#include <xlocale.h>
#endif

int knurl_format_arguments(char *to, size_t size, const char *format, va_list arguments) {
    const locale_t points = newlocale(LC_ALL_MASK, "C", (locale_t)0); /* needs no memory in glibc and musl */
    const locale_t before = points ? uselocale(points) : (locale_t)0; /* this thread's alone */
    const int length = vsnprintf(to, size, format, arguments);
    if (points) {
        (void)uselocale(before);
        freelocale(points);
    }
    return length;
}
