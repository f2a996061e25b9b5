/* The part of Unity's native plugin interface that Knurl uses, declared from its documentation: Unity's own headers
 * come with an editor and under its licence. If KNURL_UNITY_HEADERS names a folder with those headers,
 * tests/unity/native compares this file with them. Good for Unity 2020.1 and later. SPDX-License-Identifier: MIT */
#ifndef KNURL_UNITY_ABI_H
#define KNURL_UNITY_ABI_H

#include <stdint.h>

#if defined(_WIN32)
#define UNITY_CALL __stdcall
#else
#define UNITY_CALL
#endif

/** An unused entry in a table of functions. */
typedef void(UNITY_CALL *unity_unused)(void);

/** The argument of UnityPluginLoad(). The unused functions take their GUID as a struct by value, which Unity's
 * C++ and C pass differently. */
typedef struct unity_interfaces {
    unity_unused get_interface;
    unity_unused register_interface;
    void *(UNITY_CALL *get_interface_split)(unsigned long long high,
                                            unsigned long long low); /**< null: not available */
    unity_unused register_interface_split;
} unity_interfaces;

#define UNITY_LOG_HIGH 0x9E7507FA5B444D5DULL
#define UNITY_LOG_LOW  0x92FB979515EA83FCULL

enum { UNITY_LOG_WARNING = 2 };

/** The engine's log. */
typedef struct unity_log {
    void(UNITY_CALL *log)(int type, const char *message, const char *file, int line);
} unity_log;

#define UNITY_PROFILER_HIGH 0x2CE79ED8316A4833ULL
#define UNITY_PROFILER_LOW  0x87076B2013E1571FULL

enum { UNITY_PROFILER_SCRIPTS = 1 };     /**< a category */
enum { UNITY_MARKER_DEFAULT = 0 };       /**< flags */
enum { UNITY_BEGIN = 0, UNITY_END = 1 }; /**< events */

/** Opaque. */
typedef struct unity_marker unity_marker;

/** The engine's profiler; the rest of its table is not used. */
typedef struct unity_profiler {
    void(UNITY_CALL *emit_event)(const unity_marker *marker, uint16_t event, uint16_t data_count, const void *data);
    int(UNITY_CALL *is_enabled)(void);   /**< 1: the profiler records */
    int(UNITY_CALL *is_available)(void); /**< 0: the game was built without it */
    /** 0, or an error code. */
    int(UNITY_CALL *create_marker)(const unity_marker **marker, const char *name, uint16_t category, uint16_t flags,
                                   int data_count);
} unity_profiler;

#endif
