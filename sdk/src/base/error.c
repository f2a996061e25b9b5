/* Result codes, the thread's error message, versions, growable structs. SPDX-License-Identifier: MIT */
#include "base/base.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define KNURL_TEXT_(x) #x
#define KNURL_TEXT(x)  KNURL_TEXT_(x)

/* The loader sets this aside for every thread before it runs: no memory is asked for at its first use, which may be in
 * a tick. It has room for a word, not for a message. Other systems have no such promise; see
 * knurl_loop_haptic_thread().
 */
#if defined(__GLIBC__)
#define READY_AT_ONCE __attribute__((tls_model("initial-exec")))
#else
#define READY_AT_ONCE
#endif

static KNURL_THREAD_LOCAL char formatted[1024];
static KNURL_THREAD_LOCAL const char *latest READY_AT_ONCE; /* `formatted`, a static sentence, or null: none yet */

const char *knurl_result_string(knurl_result result) {
    switch (result) {
#define KNURL_RESULT_CASE(name, value, text)                                                                           \
    case name:                                                                                                         \
        return text;
        KNURL_RESULTS(KNURL_RESULT_CASE)
#undef KNURL_RESULT_CASE
    default:
        return "a result code that this version does not know";
    }
}

const char *knurl_error_message(void) {
    return latest ? latest : "";
}

#if defined(__clang__) && __clang_major__ >= 20
#pragma clang diagnostic push
#pragma clang diagnostic ignored "-Wfunction-effects" /* what is thread-local may take memory: not `latest` */
#endif
knurl_result knurl_fail_static(knurl_result code, const char *sentence) {
    latest = sentence;
    return code;
}
#if defined(__clang__) && __clang_major__ >= 20
#pragma clang diagnostic pop
#endif

knurl_result knurl_fail(knurl_result code, const char *format, ...) {
    char text[sizeof formatted]; /* built apart, so that the old message may be one of the arguments */
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(text, sizeof text, format ? format : "no reason was given", arguments);
    va_end(arguments);
    for (char *c = text; *c; c++) { /* one line, whatever a file's names hold */
        if ((unsigned char)*c < 0x20 || *c == 0x7f) {
            *c = ' ';
        }
    }
    memcpy(formatted, text, sizeof text);
    latest = formatted;
    return code;
}

const char *knurl_version_string(void) {
    return KNURL_TEXT(KNURL_VERSION_MAJOR) "." KNURL_TEXT(KNURL_VERSION_MINOR) "." KNURL_TEXT(KNURL_VERSION_PATCH);
}

void knurl_desc_copy(const void *local, uint32_t local_size, void *caller, uint32_t size) {
    const uint32_t known = size < local_size ? size : local_size;
    memset(caller, 0, size);
    memcpy(caller, local, known);
    memcpy(caller, &size, size < sizeof size ? size : sizeof size);
}

/* Reads and checks the size that a caller's struct says it has. */
static knurl_result check_size(const char *type, const void *caller, uint32_t *size) {
    if (!caller) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "%s: expected a struct, found null", type);
    }
    memcpy(size, caller, sizeof *size);
    if (*size < 8 || *size > 65536) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "%s.struct_size: expected what %s_init() sets, found %u", type, type,
                          (unsigned)*size);
    }
    return KNURL_OK;
}

knurl_result knurl_desc_return(const char *type, const void *local, uint32_t local_size, void *caller) {
    uint32_t size = 0;
    const knurl_result result = check_size(type, caller, &size);
    if (!result) {
        knurl_desc_copy(local, local_size, caller, size);
    }
    return result;
}

void knurl_desc_end_text(void *caller, size_t begin, size_t end) {
    uint32_t size;
    memcpy(&size, caller, sizeof size);
    if (size > begin && size < end) {
        ((char *)caller)[size - 1] = '\0';
    }
}

knurl_result knurl_desc_read(const char *type, const void *caller, void *local, uint32_t local_size) {
    uint32_t size = 0;
    const knurl_result result = check_size(type, caller, &size);
    if (result) {
        return result;
    }
    for (uint32_t i = local_size; i < size; i++) {
        if (((const unsigned char *)caller)[i] != 0) {
            return knurl_fail(KNURL_ERROR_UNSUPPORTED, "%s: byte %u is set, but Knurl %s knows only %u bytes of it",
                              type, (unsigned)i, knurl_version_string(), (unsigned)local_size);
        }
    }
    memcpy(local, caller, size < local_size ? size : local_size);
    memcpy(local, &local_size, sizeof local_size);
    return KNURL_OK;
}
