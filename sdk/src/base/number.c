/* Parses numbers, and checks them against ranges. SPDX-License-Identifier: MIT */
#include "base/number.h"

#include "base/format.h"
#include "base/vec3.h"

#include <stdint.h>
#include <string.h>

static int digit(char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : 16;
}

int knurl_number_hex(const char *text, size_t length, double *value) {
    int sum = 0;
    if (length < 1 || length > 4) {
        return 0;
    }
    for (size_t i = 0; i < length; i++) {
        if (digit(text[i]) >= 16) {
            return 0;
        }
        sum = 16 * sum + digit(text[i]);
    }
    *value = sum;
    return 1;
}

typedef struct decimal {
    int64_t mantissa;
    int significant; /* digits in it */
    int digits;      /* read, including leading zeros */
    int scale;       /* power of ten */
} decimal;

static size_t take_digits(const char *text, size_t at, size_t length, int scale, decimal *d) {
    for (; at < length && digit(text[at]) < 10 && d->digits < 64; at++) {
        d->mantissa = d->significant < 16 ? 10 * d->mantissa + digit(text[at]) : d->mantissa;
        d->significant += d->mantissa > 0;
        d->digits++;
        d->scale += scale;
    }
    return at;
}

static size_t take_exponent(const char *text, size_t at, size_t length, int *exponent) {
    decimal d = {0, 0, 0, 0};
    const int minus = at < length && text[at] == '-';
    at += at < length && (text[at] == '-' || text[at] == '+');
    at = take_digits(text, at, length, 0, &d);
    *exponent = d.mantissa > 1000 ? 1000 : (int)d.mantissa;
    *exponent = minus ? -*exponent : *exponent;
    return d.digits > 0 ? at : length + 1;
}

int knurl_number(const char *text, size_t length, double *value) {
    /* a mantissa below 2^53 and a power of ten up to 22 are exact, so that the result is rounded only once */
    static const double powers[23] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                      1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    if (length > 2 && text[0] == '0' && (text[1] == 'x' || text[1] == 'X')) {
        return knurl_number_hex(text + 2, length - 2, value);
    }
    decimal d = {0, 0, 0, 0};
    int exponent = 0;
    const int minus = length > 0 && text[0] == '-';
    size_t at = take_digits(text, (size_t)minus, length, 0, &d);
    if (at < length && text[at] == '.') {
        at = take_digits(text, at + 1, length, -1, &d);
    }
    if (at < length && (text[at] == 'e' || text[at] == 'E')) {
        at = take_exponent(text, at + 1, length, &exponent);
    }
    const int scale = d.scale + exponent;
    if (at != length || d.digits == 0 || d.significant > 15 || (d.mantissa != 0 && (scale < -22 || scale > 22))) {
        return 0;
    }
    const double size = d.mantissa == 0 ? 0.0
                        : scale < 0     ? (double)d.mantissa / powers[-scale]
                                        : (double)d.mantissa * powers[scale];
    *value = minus ? -size : size;
    return 1;
}

int knurl_range_holds(const knurl_range *range, double value) {
    return ((range->kind & KNURL_OR_ZERO) && value == 0.0) ||
           ((range->kind & KNURL_OR_DEFAULT) && value == KNURL_DEFAULT) ||
           ((range->kind & KNURL_OR_INFINITY) && value == HUGE_VAL) ||
           (value >= range->least && value <= range->most && (!(range->kind & KNURL_WHOLE) || value == floor(value)));
}

const char *knurl_range_text(const knurl_range *range, char *text) {
    (void)knurl_format(text, KNURL_RANGE_ROOM, "%s%s%s%s%.10g to %.10g%s%s",
                       range->kind & KNURL_OR_DEFAULT ? "KNURL_DEFAULT (-1) or " : "",
                       range->kind & KNURL_OR_INFINITY ? "INFINITY or " : "",
                       range->kind & KNURL_OR_ZERO ? "0 or " : "",
                       range->kind & KNURL_WHOLE ? "a whole number from " : "", range->least, range->most,
                       range->unit[0] ? " " : "", range->unit);
    return text;
}

knurl_result knurl_check_coordinates(const char *name, const char *unit, const double at[3]) {
    if (!vec3_within(at, KNURL_COORDINATE_MAX)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "%s: expected numbers from %g to %g%s%s, found [%g, %g, %g]", name,
                          -KNURL_COORDINATE_MAX, KNURL_COORDINATE_MAX, unit[0] ? " " : "", unit, at[0], at[1], at[2]);
    }
    return KNURL_OK;
}

knurl_result knurl_fields_check(const char *type, const knurl_field *fields, size_t count, const void *values) {
    for (size_t i = 0; i < count; i++) {
        double value;
        char expected[KNURL_RANGE_ROOM];
        memcpy(&value, (const char *)values + fields[i].offset, sizeof value);
        if (!knurl_range_holds(&fields[i].range, value)) {
            return knurl_fail(KNURL_ERROR_ARGUMENT, "%s.%s: expected %s, found %g", type, fields[i].name,
                              knurl_range_text(&fields[i].range, expected), value);
        }
    }
    return KNURL_OK;
}
