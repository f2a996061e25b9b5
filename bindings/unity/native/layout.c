/* Data that the C# side checks before any other call: a hash of the interface, and the offset of every field as
 * compiled. SPDX-License-Identifier: MIT */
#include "knurl_unity.h"

#include "layout.g.h"

#include <knurl/knurl.h>

const char *knurl_unity_interface(void) {
    return KNURL_UNITY_INTERFACE;
}

#define STRUCT(type, bytes) {#type, "", 0, (uint32_t)sizeof(type)},
#define FIELD(type, field, name, at, bytes)                                                                            \
    {#type, name, (uint32_t)offsetof(type, field), (uint32_t)sizeof(((const type *)0)->field)},

/* NOLINTNEXTLINE(bugprone-sizeof-expression): sizes of pointers are intended */
static const knurl_unity_layout_row rows[] = {KNURL_UNITY_LAYOUT(STRUCT, FIELD)};

uint32_t knurl_unity_layout(uint32_t index, knurl_unity_layout_row *row) {
    if (index >= sizeof rows / sizeof rows[0]) {
        return 0;
    }
    *row = rows[index];
    return 1;
}
