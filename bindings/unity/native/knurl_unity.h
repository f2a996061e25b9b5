/* Knurl in Unity: the plugin's exports besides Knurl's and the session's functions.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_UNITY_H
#define KNURL_UNITY_H

#include "session.h"

#ifdef __cplusplus
extern "C" {
#endif

/** One struct that the C# side mirrors, or one of its fields, as this library's compiler lays it out. */
typedef struct knurl_unity_layout_row {
    const char *type;  /**< the struct's name; static */
    const char *field; /**< the field's name in C#, or "": the struct itself; static */
    uint32_t offset;   /**< bytes from the struct's beginning */
    uint32_t size;     /**< bytes */
} knurl_unity_layout_row;

/** 16 hexadecimal digits that stand for everything that the C# side mirrors (NativeMethods.g.cs has the same ones): a
 * library with other ones belongs to another package. [any thread] */
KNURL_API const char *knurl_unity_interface(void);

/** Row `index` of the layout: 1, or 0, with `row` untouched, beyond the end. [any thread] */
KNURL_API uint32_t knurl_unity_layout(uint32_t index, knurl_unity_layout_row *row);

/** knurl_session_update(), shown as "Knurl.Update" in Unity's profiler, if present. [game thread] */
KNURL_API void knurl_unity_update(knurl_session *session);

#ifdef __cplusplus
}
#endif
#endif
