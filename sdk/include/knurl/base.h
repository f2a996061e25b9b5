/* Knurl: results, errors, versions and memory, used by all other headers.
 *
 * Each function's comment says in brackets who may call it:
 * - [any thread]: any, also during other calls.
 * - [any thread but the haptic]: the same, but it may wait for other threads, which a tick must not.
 * - [game thread]: any thread but the haptic, one at a time: no other call marked so, with the same scene, device or
 *   loop, runs meanwhile. It need not be the same thread each time.
 * - [haptic thread]: the one that ticks: one thread at a time for each HIP, and for each device without a loop.
 * A debug build (KNURL_CHECK_THREADS) ends the program, with a sentence, at a call that breaks its mark.
 *
 * Constants are ints. Fields that hold one of them are int32_t, those that hold bits uint32_t.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_BASE_H
#define KNURL_BASE_H

#include <stddef.h>
#include <stdint.h>

#define KNURL_VERSION_MAJOR 0
#define KNURL_VERSION_MINOR 3
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

#if defined(__MINGW32__) && !defined(__clang__) /* plain `printf` would mean Microsoft's format */
#define KNURL_PRINTF(format_index, first) __attribute__((format(gnu_printf, format_index, first)))
#elif defined(__GNUC__)
#define KNURL_PRINTF(format_index, first) __attribute__((format(printf, format_index, first)))
#else
#define KNURL_PRINTF(format_index, first)
#endif

/** Marks a replaced function: compilers warn at each call, with `text` (a string that names the replacement). Goes
 * before KNURL_API. */
#if defined(__GNUC__)
#define KNURL_DEPRECATED(text) __attribute__((deprecated(text)))
#elif defined(_MSC_VER)
#define KNURL_DEPRECATED(text) __declspec(deprecated(text))
#else
#define KNURL_DEPRECATED(text)
#endif

/** Marks functions that may be called in a tick: no heap, lock, wait or message. Clang 20 and later check it for all
 * callees of such a function (-Wfunction-effects); other compilers ignore it. */
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

/** All result codes with their sentences. */
#define KNURL_RESULTS(X)                                                                                               \
    X(KNURL_OK, 0, "ok")                                                                                               \
    X(KNURL_ERROR_ARGUMENT, -1, "an argument is out of its range")                                                     \
    X(KNURL_ERROR_STATE, -2, "the call is not allowed in the object's state")                                          \
    X(KNURL_ERROR_MEMORY, -3, "out of memory")                                                                         \
    X(KNURL_ERROR_STALE_ID, -4, "no object has this id")                                                               \
    X(KNURL_ERROR_FULL, -5, "a declared capacity is used up")                                                          \
    X(KNURL_ERROR_UNSUPPORTED, -6, "not supported by this version")                                                    \
    X(KNURL_ERROR_IO, -7, "a file could not be read or written")                                                       \
    X(KNURL_ERROR_FORMAT, -8, "a file does not follow its format")                                                     \
    X(KNURL_ERROR_UNKNOWN, -9, "unknown name")                                                                         \
    X(KNURL_ERROR_DEVICE_LOST, -10, "the device no longer answers")                                                    \
    X(KNURL_ERROR_SYSTEM, -11, "the operating system refused")                                                         \
    X(KNURL_ERROR_DEVICE_NOT_READY, -12, "the device has no valid position")                                           \
    X(KNURL_ERROR_CANCELLED, -13, "cancelled by the caller")

enum {
#define KNURL_RESULT_ENUMERATOR(name, value, text) name = (value),
    KNURL_RESULTS(KNURL_RESULT_ENUMERATOR)
#undef KNURL_RESULT_ENUMERATOR
};

/** 0 (KNURL_OK) or a negative KNURL_ERROR_ code. Outputs are changed only if a call returns KNURL_OK.
 *
 * Null, unless a function's comment allows it, and an invalid handle (of another kind, or destroyed) give
 * KNURL_ERROR_ARGUMENT and a message that names the parameter. Functions that do not return a knurl_result do nothing
 * and return 0 or null; they set the same message unless they may run in a tick. A destroyed handle is recognised until
 * its memory is used again: this finds most mistakes, but is not guaranteed. */
typedef int32_t knurl_result;

/** The sentence for a result code. Static, never null, also for codes unknown to this version. [any thread] */
KNURL_API const char *knurl_result_string(knurl_result result);

/** The message of the last failing call *on this thread*: the cause, the expected and the found value. (If a language
 * moves its tasks between the system's threads, as Go does, read it before the task can be moved.) Numbers have decimal
 * points, whatever the host's locale. The calls of the haptic path (knurl_scene_tick(), knurl_device_read() and
 * _write(), knurl_fake_get_truth()) set one of a few fixed sentences, which takes no time. Valid until the next failing
 * call on this thread; "" before the first. [any thread] */
KNURL_API const char *knurl_error_message(void);

/** Copies untrusted text (names, paths, a file's contents) as one line that is safe to print: control characters and
 * line ends become spaces; C1 controls, characters that change the direction of text or cannot be seen (Unicode tags,
 * zero width spaces, byte order marks), and invalid UTF-8 become '?'.
 * All messages of this library are cleaned by it. to: `size` bytes, the caller's; longer text is cut between
 * characters; may be the same as `from`. Returns the length without the final 0. [any thread, never from a tick] */
KNURL_API size_t knurl_text_line(char *to, size_t size, const char *from);

/** Sets this thread's error message (printf style, at most 1023 bytes, cleaned as by knurl_text_line(); null: "no
 * reason was given") and returns `code`. For code that extends Knurl, such as loaders and drivers. [any thread, never
 * from a tick] */
KNURL_API knurl_result knurl_fail(knurl_result code, const char *format, ...) KNURL_PRINTF(2, 3);

/** The version of the loaded library, "major.minor.patch"; static. [any thread] */
KNURL_API const char *knurl_version_string(void);

/** The same as a number: 10000 major + 100 minor + patch, for example 300 for 0.3.0. [any thread] */
KNURL_API uint32_t knurl_version_number(void);

/** m: the largest coordinate in a scene: of meshes and planes, positions, workspaces and queried points; for a HIP the
 * limit of |x| + |y| + |z|. There doubles still resolve 0.0001 mm, and no computation in a tick overflows. The float32
 * coordinates of a mesh resolve millimetres up to 10 km only: see KNURL_FAR. */
#define KNURL_COORDINATE_MAX 1000000000.0

/** The default of a number whose field allows it (knurl_hip_desc). */
#define KNURL_DEFAULT (-1.0)

/** A caller's memory functions, used for all memory of a scene; loops, devices and the glTF loader's own work use
 * malloc. Both are called on the threads that create, edit or destroy the scene, one at a time. Never in a tick. */
typedef struct knurl_allocator {
    /** `size` bytes (> 0) aligned to `alignment` (a power of two), or null. */
    void *(*allocate)(size_t size, size_t alignment, void *user);
    /** Frees what `allocate` returned; `size` is the same. */
    void (*release)(void *memory, size_t size, void *user);
    void *user; /**< passed to both */
} knurl_allocator;

#ifdef __cplusplus
}
#endif
#endif
