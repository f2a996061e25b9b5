/* Checks of handles. Each object starts with its kind's number, cleared when it is destroyed. This detects null,
 * another kind, and a destroyed object until its memory is reused. Header only, because bindings/common links with
 * public functions only.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_HANDLE_H
#define KNURL_SRC_HANDLE_H

#include <knurl/base.h>

/* Kinds: numbers unlikely to be in memory by chance. */
#define KNURL_HANDLE_SCENE   0x5343a61du
#define KNURL_HANDLE_DEVICE  0x4456b72eu
#define KNURL_HANDLE_LOOP    0x4c50c83fu
#define KNURL_HANDLE_SESSION 0x5353d94bu
#define KNURL_HANDLE_AUDIO   0x4155ea5cu

/* Clears an object's number before its memory is freed; volatile, so that the compiler keeps the store. */
static inline void knurl_handle_clear(uint32_t *number) {
    *(volatile uint32_t *)number = 0;
}

/* Reads the number at a caller's handle; 0 if null or misaligned. The object may have been freed: sanitizers must not
 * report this read. */
#if defined(__GNUC__)
__attribute__((no_sanitize("address"), no_sanitize("thread")))
#endif
static inline uint32_t knurl_handle_number(const void *handle) {
    return handle && (uintptr_t)handle % sizeof(uint32_t) == 0 ? *(const volatile uint32_t *)handle : 0;
}

static inline const char *knurl_handle_kind(uint32_t number) {
    return number == KNURL_HANDLE_SCENE     ? "a scene"
           : number == KNURL_HANDLE_DEVICE  ? "a device"
           : number == KNURL_HANDLE_LOOP    ? "a loop"
           : number == KNURL_HANDLE_SESSION ? "a session"
           : number == KNURL_HANDLE_AUDIO   ? "an audio"
                                            : "an invalid or destroyed handle";
}

static inline int knurl_is_bad_handle(const void *handle, uint32_t kind, const char *name) {
    const uint32_t number = knurl_handle_number(handle);
    if (number == kind) {
        return 0;
    }
    (void)knurl_fail(KNURL_ERROR_ARGUMENT, "%s: expected %s, found %s", name, knurl_handle_kind(kind),
                     handle ? knurl_handle_kind(number) : "null");
    return 1;
}

static inline int knurl_is_null(const void *pointer, const char *name) {
    if (!pointer) {
        (void)knurl_fail(KNURL_ERROR_ARGUMENT, "%s: expected a pointer, found null", name);
    }
    return !pointer;
}

/* For public functions: 1, with the thread's error message set, if `handle` is not a live object of the kind (SCENE,
 * DEVICE, LOOP, SESSION, AUDIO), or `pointer` is null. Not in a tick: see KNURL_IS_HANDLE. */
#define KNURL_BAD_HANDLE(handle, kind) knurl_is_bad_handle((handle), KNURL_HANDLE_##kind, #handle)
#define KNURL_IS_NULL(pointer)         knurl_is_null((pointer), #pointer)

/* For the haptic path, without a message: 1 if it is a live object of the kind. */
#define KNURL_IS_HANDLE(handle, kind) (knurl_handle_number(handle) == KNURL_HANDLE_##kind)

#endif
