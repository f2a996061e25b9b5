/* Calls a deprecated function: it compiles, with a warning. SPDX-License-Identifier: MIT */
#include <knurl/base.h>

KNURL_DEPRECATED("call knurl_new() instead") KNURL_API void knurl_old(void);
void call(void);

void call(void) {
    knurl_old();
}
