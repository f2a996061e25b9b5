/* Result codes, the thread's error message, versions, growable structs. SPDX-License-Identifier: MIT */
#include "base/error.h"

#include "base/finite.h"
#include "base/format.h"
#include "base/rule.h"
#if defined(__GLIBC__)
#include <pthread.h>
#endif

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#define KNURL_TEXT_(x) #x
#define KNURL_TEXT(x)  KNURL_TEXT_(x)

#define MESSAGE_SIZE 1024

/* The loader allocates this for every thread before it runs, so that its first use, perhaps in a tick, allocates
 * nothing. Other systems give no such guarantee; see knurl_loop_haptic_thread(). A process has some 1,600 bytes of such
 * storage for all libraries that it loads while it runs, and a library whose variables do not fit is not loaded. One
 * variable of this kind puts all thread-local variables of the library there, so the messages are on the heap. */
#if defined(__GLIBC__)
#define READY_AT_ONCE __attribute__((tls_model("initial-exec")))
#else
#define READY_AT_ONCE
#endif

static KNURL_THREAD_LOCAL const char *latest READY_AT_ONCE; /* the formatted message, a static sentence, or null */

#if defined(__GLIBC__)
static KNURL_THREAD_LOCAL char *formatted READY_AT_ONCE; /* MESSAGE_SIZE bytes, or null */
static pthread_once_t once = PTHREAD_ONCE_INIT;
static pthread_key_t end_of_thread;
static int has_end;

static void free_message(void *message) {
    free(message);
    formatted = NULL;
    latest = NULL;
}

static void make_end(void) {
    has_end = pthread_key_create(&end_of_thread, free_message) == 0;
}

/* At unload or exit: threads that end later must not call free_message(), and another library may get the same key. */
__attribute__((destructor)) static void give_back(void) {
    if (has_end) {
        has_end = 0;
        (void)pthread_key_delete(end_of_thread);
        free_message(formatted);
    }
}

/* This thread's buffer for a message; null if there is no memory. */
static char *room_for_message(void) {
    if (!formatted && pthread_once(&once, make_end) == 0 && has_end) {
        formatted = malloc(MESSAGE_SIZE);
        if (formatted && pthread_setspecific(end_of_thread, formatted) != 0) {
            free_message(formatted);
        }
    }
    return formatted;
}
#else
static char *room_for_message(void) {
    static KNURL_THREAD_LOCAL char formatted[MESSAGE_SIZE];
    return formatted;
}
#endif

const char *knurl_result_string(knurl_result result) {
    switch (result) {
#define KNURL_RESULT_CASE(name, value, text)                                                                           \
    case name:                                                                                                         \
        return text;
        KNURL_RESULTS(KNURL_RESULT_CASE)
#undef KNURL_RESULT_CASE
    default:
        return "a result code unknown to this version";
    }
}

const char *knurl_error_message(void) {
    return latest ? latest : "";
}

#if defined(__clang__) && __clang_major__ >= 20
#pragma clang diagnostic push
#pragma clang diagnostic ignored "-Wfunction-effects" /* thread-local variables may allocate: `latest` does not */
#endif
knurl_result knurl_fail_static(knurl_result code, const char *sentence) {
    latest = sentence;
    return code;
}
#if defined(__clang__) && __clang_major__ >= 20
#pragma clang diagnostic pop
#endif

/* --- lines for terminals and logs --- */

/* The code point at `at` and its length in bytes; 0 bytes if it is not valid UTF-8. */
static uint32_t code_point(const unsigned char *at, size_t *bytes) {
    static const uint32_t least[5] = {0, 0, 0x80, 0x800, 0x10000};
    const size_t length = at[0] < 0x80 ? 1 : at[0] >> 5 == 6 ? 2 : at[0] >> 4 == 14 ? 3 : at[0] >> 3 == 30 ? 4 : 0;
    uint32_t code = length == 1 ? at[0] : length ? at[0] & (0x7fu >> length) : 0;
    for (size_t i = 1; i < length; i++) {
        if (at[i] >> 6 != 2) {
            *bytes = 0;
            return 0;
        }
        code = code << 6 | (at[i] & 0x3fu);
    }
    const int valid = length && code >= least[length] && code <= 0x10ffff && (code < 0xd800 || code > 0xdfff);
    *bytes = valid ? length : 0;
    return code;
}

/* Characters that move a cursor, begin an escape, end a line, reverse the direction of text, or cannot be seen. The
 * joiners U+200C and U+200D are kept, because several scripts need them. */
static int is_harmful(uint32_t code) {
    static const uint32_t ranges[][2] = {
        {0x00, 0x1f},       /* C0 controls */
        {0x7f, 0x9f},       /* DEL, C1 controls */
        {0x61c, 0x61c},     /* Arabic letter mark */
        {0x180e, 0x180e},   /* Mongolian vowel separator */
        {0x200b, 0x200b},   /* zero width space */
        {0x200e, 0x200f},   /* left-to-right and right-to-left marks */
        {0x2028, 0x202e},   /* separators of lines and paragraphs, embeddings, overrides */
        {0x2060, 0x206f},   /* invisible operators, isolates, deprecated format characters */
        {0xfeff, 0xfeff},   /* byte order mark */
        {0xfff9, 0xfffb},   /* interlinear annotations */
        {0xe0000, 0xe007f}, /* tags */
    };
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++) {
        if (code >= ranges[i][0] && code <= ranges[i][1]) {
            return 1;
        }
    }
    return 0;
}

size_t knurl_text_line(char *to, size_t size, const char *from) {
    KNURL_RULE(NOT_HAPTIC, NULL);
    size_t length = 0;
    if (!to || !from) { /* not by handle.h, whose checks call knurl_fail() */
        (void)knurl_fail(KNURL_ERROR_ARGUMENT, "%s: expected a pointer, found null", to ? "from" : "to");
        return 0;
    }
    if (size == 0) {
        return 0;
    }
    const unsigned char *at = (const unsigned char *)from;
    while (*at) {
        size_t bytes;
        const uint32_t code = code_point(at, &bytes);
        const int kept = bytes > 0 && !is_harmful(code);
        const size_t taken = bytes ? bytes : 1;
        const size_t written = kept ? bytes : 1;
        if (length + written >= size) {
            break;
        }
        for (size_t i = 0; i < written; i++) {
            to[length++] = kept ? (char)at[i] : bytes && code < 0x80 ? ' ' : '?';
        }
        at += taken;
    }
    to[length] = '\0';
    return length;
}

knurl_result knurl_fail(knurl_result code, const char *format, ...) {
    KNURL_RULE(NOT_HAPTIC, NULL);
    char text[MESSAGE_SIZE]; /* a local buffer, so that the old message may be an argument */
    va_list arguments;
    va_start(arguments, format);
    (void)knurl_format_arguments(text, sizeof text, format ? format : "no reason was given", arguments);
    va_end(arguments);
    (void)knurl_text_line(text, sizeof text, text); /* names from files may contain anything */
    char *room = room_for_message();
    if (room) {
        memcpy(room, text, sizeof text);
    }
    latest = room ? room : knurl_result_string(code);
    return code;
}

const char *knurl_version_string(void) {
    return KNURL_TEXT(KNURL_VERSION_MAJOR) "." KNURL_TEXT(KNURL_VERSION_MINOR) "." KNURL_TEXT(KNURL_VERSION_PATCH);
}

uint32_t knurl_version_number(void) {
    return 10000u * KNURL_VERSION_MAJOR + 100u * KNURL_VERSION_MINOR + KNURL_VERSION_PATCH;
}

void knurl_desc_copy(const void *local, uint32_t local_size, void *caller, uint32_t size) {
    const uint32_t known = size < local_size ? size : local_size;
    memset(caller, 0, size);
    memcpy(caller, local, known);
    memcpy(caller, &size, size < sizeof size ? size : sizeof size);
}

/* Reads and checks a caller's struct_size. */
static knurl_result check_size(const char *type, const void *caller, uint32_t *size) {
    if (!caller) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "%s: expected a struct, found null", type);
    }
    memcpy(size, caller, sizeof *size);
    if (*size < 8 || *size > 65536) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "%s.struct_size: expected the value set by %s_init(), found %u", type,
                          type, (unsigned)*size);
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
            return knurl_fail(KNURL_ERROR_UNSUPPORTED, "%s: byte %u is set, but Knurl %s supports only %u bytes of it",
                              type, (unsigned)i, knurl_version_string(), (unsigned)local_size);
        }
    }
    memcpy(local, caller, size < local_size ? size : local_size);
    memcpy(local, &local_size, sizeof local_size);
    return KNURL_OK;
}
