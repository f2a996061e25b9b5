/* Knurl: results, errors, versions and memory, shared by every room.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_BASE_H
#define KNURL_BASE_H

#include <stddef.h>
#include <stdint.h>

#define KNURL_VERSION_MAJOR 0
#define KNURL_VERSION_MINOR 1
#define KNURL_VERSION_PATCH 0

#if defined(_WIN32) && !defined(KNURL_STATIC)
#if defined(KNURL_BUILDING)
#define KNURL_API __declspec(dllexport)
#else
#define KNURL_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define KNURL_API __attribute__((visibility("default")))
#else
#define KNURL_API
#endif

#if defined(__MINGW32__) && !defined(__clang__) /* its own `printf` means Microsoft's old one */
#define KNURL_PRINTF(format_index, first) __attribute__((format(gnu_printf, format_index, first)))
#elif defined(__GNUC__)
#define KNURL_PRINTF(format_index, first) __attribute__((format(printf, format_index, first)))
#else
#define KNURL_PRINTF(format_index, first)
#endif

/** Marks what may run in a tick: no heap, lock, wait or message. Clang 20 and later hold its code, and all that it
 * calls, to that (-Wfunction-effects); to other compilers it is a comment. */
#if defined(__has_attribute)
#if __has_attribute(nonblocking)
#define KNURL_NONBLOCKING __attribute__((nonblocking))
#endif
#endif
#ifndef KNURL_NONBLOCKING
#define KNURL_NONBLOCKING
#endif

#ifdef __cplusplus
extern "C" {
#endif

/** Every result code with its sentence: the one table that codes and knurl_result_string() come from. */
#define KNURL_RESULTS(X)                                                                                               \
    X(KNURL_OK, 0, "ok")                                                                                               \
    X(KNURL_ERROR_ARGUMENT, -1, "an argument is out of its range")                                                     \
    X(KNURL_ERROR_STATE, -2, "the call does not fit the object's state")                                               \
    X(KNURL_ERROR_MEMORY, -3, "memory could not be had")                                                               \
    X(KNURL_ERROR_STALE_ID, -4, "the id names nothing that exists")                                                    \
    X(KNURL_ERROR_FULL, -5, "a declared capacity is used up")                                                          \
    X(KNURL_ERROR_UNSUPPORTED, -6, "this version cannot do what was asked")                                            \
    X(KNURL_ERROR_IO, -7, "a file could not be read or written")                                                       \
    X(KNURL_ERROR_FORMAT, -8, "a file does not hold what its format demands")                                          \
    X(KNURL_ERROR_UNKNOWN, -9, "a name is not known")                                                                  \
    X(KNURL_ERROR_DEVICE_LOST, -10, "the device no longer answers")                                                    \
    X(KNURL_ERROR_SYSTEM, -11, "the operating system refused")                                                         \
    X(KNURL_ERROR_DEVICE_NOT_READY, -12, "the device gives no position that can be trusted")                           \
    X(KNURL_ERROR_CANCELLED, -13, "the caller stopped it")

enum {
#define KNURL_RESULT_ENUMERATOR(name, value, text) name = (value),
    KNURL_RESULTS(KNURL_RESULT_ENUMERATOR)
#undef KNURL_RESULT_ENUMERATOR
};

/** 0 (KNURL_OK) or a negative KNURL_ERROR_ code. Outputs are untouched unless a call returns KNURL_OK.
 *
 * Pointers, of all functions: null, where a function's comment does not allow it, and a handle (a scene, a device, a
 * loop, a session) that is of another kind or was destroyed are KNURL_ERROR_ARGUMENT with a sentence that names the
 * parameter. Functions that return something else do nothing and return 0 or null, with the same sentence but for those
 * that may run in a tick. A destroyed handle is recognised as long as nothing else has got its memory: that finds
 * mistakes in most cases, and no more is promised. */
typedef int32_t knurl_result;

/** The sentence for a result code; never null, static, also for codes this version does not know. [any thread] */
KNURL_API const char *knurl_result_string(knurl_result result);

/** What went wrong in the latest failing call *on this thread*, in a sentence that names the thing, what was expected
 * and what was found. Where that was a call of the haptic path (knurl_scene_tick(), knurl_device_read() and _write(),
 * knurl_fake_get_truth()) it is one of a few fixed sentences, which cost a tick nothing. Valid until the next failing
 * call on this thread; "" before the first. [any thread] */
KNURL_API const char *knurl_error_message(void);

/** Copies text that somebody else wrote (names, paths, a file's words) as one line that a terminal or a log can be
 * given: control characters and line ends become spaces; C1 controls, what turns the direction of reading, and bytes
 * that are no UTF-8 become '?'. Every message of this library has gone through it. to: `size` bytes, the caller's; what
 * does not fit is cut off between characters; may be `from`. Returns the length without the final 0. [any thread, never
 * from a tick] */
KNURL_API size_t knurl_text_line(char *to, size_t size, const char *from);

/** Sets this thread's error message (printf style, at most 1023 bytes; as knurl_text_line() leaves it; null for
 * none) and returns `code`. For code that extends Knurl, such as loaders and drivers. [any thread, never from a tick]
 */
KNURL_API knurl_result knurl_fail(knurl_result code, const char *format, ...) KNURL_PRINTF(2, 3);

/** The version of the library that is running, "major.minor.patch"; static. [any thread] */
KNURL_API const char *knurl_version_string(void);

/** A caller's memory functions. All scene memory comes from here; nothing is asked of them in a tick. */
typedef struct knurl_allocator {
    /** `size` bytes (> 0) aligned to `alignment` (a power of two), or null. [game thread] */
    void *(*allocate)(size_t size, size_t alignment, void *user);
    /** Gives back what `allocate` returned, with the same `size`. [game thread] */
    void (*release)(void *memory, size_t size, void *user);
    void *user; /**< passed to both */
} knurl_allocator;

#ifdef __cplusplus
}
#endif
#endif
