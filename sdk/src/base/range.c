/* Checks numbers against ranges. SPDX-License-Identifier: MIT */
#include "base/range.h"

#include "base/format.h"
#include "base/vec3.h"

#include <string.h>

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
