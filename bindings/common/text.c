/* Formatting of sentences into a caller's buffer. SPDX-License-Identifier: MIT */
#include "parts.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Removes an incomplete character at the end of a text that was cut. */
static void trim(char *text) {
    size_t length = strlen(text);
    size_t begin = length;
    while (begin > 0 && length - begin < 3 && ((unsigned char)text[begin - 1] & 0xC0) == 0x80) {
        begin--;
    }
    if (begin > 0 && ((unsigned char)text[begin - 1] & 0xC0) == 0xC0) {
        const unsigned char lead = (unsigned char)text[begin - 1];
        const size_t wanted = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
        length = length - begin + 1 < wanted ? begin - 1 : length;
    }
    text[length] = '\0';
}

void knurl_session_clear_text(char *text, uint32_t size) {
    if (text && size > 0) {
        text[0] = '\0';
    }
}

void knurl_session_add_line(char *text, uint32_t size, const char *format, ...) {
    const size_t length = text && size > 0 ? strlen(text) : 0;
    if (!text || length + 2 > size) {
        return;
    }
    va_list arguments;
    va_start(arguments, format);
    if (length > 0) {
        text[length] = '\n';
        text[length + 1] = '\0';
    }
    const size_t begin = length > 0 ? length + 1 : 0;
    const int all = vsnprintf(text + begin, size - begin, format, arguments);
    va_end(arguments);
    if (all < 0 || (size_t)all >= size - begin) {
        trim(text);
    }
}

void knurl_session_fault_text(int32_t code, double value, char *text, uint32_t size) {
    const char *sentence = knurl_fault_string(code);
    const char *unit = knurl_fault_unit(code);
    const char *cause = knurl_fault_cause(code, value);
    knurl_session_clear_text(text, size);
    if (*cause) {
        knurl_session_add_line(text, size, "%s: %s", sentence, cause);
    } else if (*unit) {
        knurl_session_add_line(text, size, "%s (%g %s)", sentence, value, unit);
    } else {
        knurl_session_add_line(text, size, "%s", sentence);
    }
}
