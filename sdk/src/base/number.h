/* Parses numbers, in every locale alike. Ranges of all numbers that describe a device or a HIP, from callers, drivers,
 * files and URIs, and their checks. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_NUMBER_H
#define KNURL_SRC_NUMBER_H

#include "base/finite.h"

#include <knurl/base.h>

#include <stddef.h>

/* Parses all of `text` as a decimal number ("-0.5", "2e-3") of up to 15 significant digits, correctly rounded, or as a
 * hexadecimal number of up to four digits ("0x16c0"). If it is neither, returns 0 and leaves *value unchanged. */
int knurl_number(const char *text, size_t length, double *value);

/* Parses all of `text` as one to four hexadecimal digits. */
int knurl_number_hex(const char *text, size_t length, double *value);

/* Least, greatest, unit. Wide enough for any hand-held device; narrow enough that every square, quotient and
 * exponential in a tick is finite. The public headers repeat these numbers. */
#define KNURL_RANGE_FORCE     0.01, 1000.0, "N"
#define KNURL_RANGE_HIP_FORCE 0.01, 1e6, "N" /* the device's own limit applies too */
#define KNURL_RANGE_HEAT_TIME 0.001, 1e6, "s"
#define KNURL_RANGE_TORQUE    0.0001, 100.0, "N m"
#define KNURL_RANGE_MASS      0.001, 10.0, "kg"
#define KNURL_RANGE_VISCOUS   0.0, 1000.0, "N s/m"
#define KNURL_RANGE_COULOMB   0.0, 10.0, "N"
#define KNURL_RANGE_STIFFNESS 1.0, 1e9, "N/m"
#define KNURL_RANGE_QUANTUM   1e-9, 0.01, "m"
#define KNURL_RANGE_DELAY     0.0, 16.0, "ticks"
#define KNURL_RANGE_CORNER -KNURL_COORDINATE_MAX, KNURL_COORDINATE_MAX, "m" /* a mouse's workspace is a whole scene */
#define KNURL_RANGE_NATIVE_RATE 1.0, 1e5, "Hz"
#define KNURL_RANGE_RATE        KNURL_UPDATE_RATE_MIN, KNURL_UPDATE_RATE_MAX, "Hz"
#define KNURL_RANGE_SLEW        0.01, 1e9, "N/s"

/* Values allowed beyond least to most, and restrictions. */
enum {
    KNURL_OR_ZERO = 1,     /* unknown or absent, see the field's comment */
    KNURL_OR_DEFAULT = 2,  /* KNURL_DEFAULT */
    KNURL_OR_INFINITY = 4, /* no limit */
    KNURL_WHOLE = 8        /* a whole number */
};

typedef struct knurl_range {
    double least, most;
    const char *unit;
    unsigned kind; /* KNURL_OR_ and KNURL_WHOLE bits */
} knurl_range;

/* A double field of a struct. */
typedef struct knurl_field {
    const char *name;
    size_t offset;
    knurl_range range;
} knurl_field;

int knurl_range_holds(const knurl_range *range, double value);

#define KNURL_RANGE_ROOM 128

/* "0 or 0.01 to 1000 N", to follow "expected". text: KNURL_RANGE_ROOM bytes. Returns it. */
const char *knurl_range_text(const knurl_range *range, char *text);

/* Checks a scene's point or vector against KNURL_COORDINATE_MAX. Errors: KNURL_ERROR_ARGUMENT (name, range, found). */
knurl_result knurl_check_coordinates(const char *name, const char *unit, const double at[3]);

/* Checks fields of a struct in their order. Errors: KNURL_ERROR_ARGUMENT: "type.field: expected range, found value". */
knurl_result knurl_fields_check(const char *type, const knurl_field *fields, size_t count, const void *values);

#endif
