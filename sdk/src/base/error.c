/* Result codes, the thread's error message, versions, growable structs. SPDX-License-Identifier: MIT */
#include "base/base.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define KNURL_TEXT_(x) #x
#define KNURL_TEXT(x)  KNURL_TEXT_(x)

static KNURL_THREAD_LOCAL char error_message[1024];

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
    return error_message;
}

knurl_result knurl_fail(knurl_result code, const char *format, ...) {
    char text[sizeof error_message]; /* built apart, so that the old message may be one of the arguments */
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    for (char *c = text; *c; c++) { /* one line, whatever a file's names hold */
        if ((unsigned char)*c < 0x20 || *c == 0x7f) {
            *c = ' ';
        }
    }
    memcpy(error_message, text, sizeof text);
    return code;
}

const char *knurl_version_string(void) {
    return KNURL_TEXT(KNURL_VERSION_MAJOR) "." KNURL_TEXT(KNURL_VERSION_MINOR) "." KNURL_TEXT(KNURL_VERSION_PATCH);
}

void knurl_desc_write(const void *local, uint32_t local_size, void *caller, uint32_t size) {
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
        knurl_desc_write(local, local_size, caller, size);
    }
    return result;
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
