/* One line on stderr. SPDX-License-Identifier: MIT */
#include "experiment.h"

#include <stdarg.h>

int exp_error(int code, const char *format, ...) {
    va_list arguments;
    fputs("knurl_experiment: ", stderr);
    va_start(arguments, format);
    (void)vfprintf(stderr, format, arguments);
    va_end(arguments);
    fputc('\n', stderr);
    return code;
}
