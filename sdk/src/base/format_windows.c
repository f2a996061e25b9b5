/* Windows: text with numbers. SPDX-License-Identifier: MIT */
#include "base/format.h"

#include <locale.h>
#include <stdio.h>
#include <string.h>

int knurl_format_arguments(char *to, size_t size, const char *format, va_list arguments) {
    char before[128] = "";
    const int was_shared = _configthreadlocale(_ENABLE_PER_THREAD_LOCALE);
    const char *name = setlocale(LC_NUMERIC, NULL);
    const int changes = name && strlen(name) < sizeof before && strcmp(name, "C") != 0;
    if (changes) {
        memcpy(before, name, strlen(name) + 1);
        (void)setlocale(LC_NUMERIC, "C");
    }
    const int length = vsnprintf(to, size, format, arguments);
    if (changes) {
        (void)setlocale(LC_NUMERIC, before);
    }
    (void)_configthreadlocale(was_shared);
    return length;
}
