/* Functions for all drivers: properties, listings, URIs. SPDX-License-Identifier: MIT */
#include "device/driver.h"

#include "base/base.h"
#include "base/format.h"
#include "base/number.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define FIELD(field, range, kind)                                                                                      \
    {                                                                                                                  \
        #field, offsetof(knurl_device_info, field), {                                                                  \
            range, kind                                                                                                \
        }                                                                                                              \
    }

static const knurl_field fields[] = {
    FIELD(workspace_min[0], KNURL_RANGE_CORNER, 0),
    FIELD(workspace_min[1], KNURL_RANGE_CORNER, 0),
    FIELD(workspace_min[2], KNURL_RANGE_CORNER, 0),
    FIELD(workspace_max[0], KNURL_RANGE_CORNER, 0),
    FIELD(workspace_max[1], KNURL_RANGE_CORNER, 0),
    FIELD(workspace_max[2], KNURL_RANGE_CORNER, 0),
    FIELD(resolution, KNURL_RANGE_QUANTUM, KNURL_OR_ZERO),
    FIELD(max_force, KNURL_RANGE_FORCE, 0),
    FIELD(delay, KNURL_RANGE_DELAY, 0),
    FIELD(continuous_force, KNURL_RANGE_FORCE, KNURL_OR_INFINITY),
    FIELD(heat_time, KNURL_RANGE_HEAT_TIME, 0),
    FIELD(mass, KNURL_RANGE_MASS, KNURL_OR_ZERO),
    FIELD(viscous, KNURL_RANGE_VISCOUS, 0),
    FIELD(coulomb, KNURL_RANGE_COULOMB, 0),
    FIELD(max_stiffness, KNURL_RANGE_STIFFNESS, KNURL_OR_INFINITY),
    FIELD(native_rate, KNURL_RANGE_NATIVE_RATE, KNURL_OR_ZERO),
    FIELD(max_torque, KNURL_RANGE_TORQUE, KNURL_OR_ZERO),
    FIELD(max_grip, KNURL_RANGE_FORCE, KNURL_OR_ZERO),
};

void knurl_device_info_init(knurl_device_info *info, uint32_t size) {
    const knurl_device_info defaults = {0};
    knurl_desc_write(&defaults, sizeof defaults, info, size);
}

void knurl_device_info_sphere(knurl_device_info *info, double radius) {
    for (int axis = 0; axis < 3; axis++) {
        info->workspace_max[axis] = 0.577350269189626 * radius; /* sqrt(1 / 3) */
        info->workspace_min[axis] = -info->workspace_max[axis];
    }
}

knurl_result knurl_device_ask(const knurl_device *device, knurl_device_info *info) {
    char type[64];
    knurl_device_info made;
    knurl_device_info_init(&made, sizeof made);
    made.continuous_force = made.max_stiffness = INFINITY;
    made.heat_time = 60.0;
    device->driver->get_info(device, &made);
    made.name[sizeof made.name - 1] = '\0';
    (void)snprintf(type, sizeof type, "device '%.24s': knurl_device_info", device->driver->uri);
    const knurl_result result = knurl_fields_check(type, fields, sizeof fields / sizeof *fields, &made);
    for (int i = 0; i < 3 && !result; i++) {
        if (made.workspace_min[i] > made.workspace_max[i]) {
            return knurl_fail(KNURL_ERROR_ARGUMENT,
                              "%s: expected workspace_min[%d] up to workspace_max[%d], found %g and %g m", type, i, i,
                              made.workspace_min[i], made.workspace_max[i]);
        }
    }
    if (!result) {
        *info = made;
    }
    return result;
}

knurl_result knurl_device_get_info(const knurl_device *device, knurl_device_info *info) {
    if (KNURL_BAD_HANDLE(device, DEVICE) || KNURL_IS_NULL(info)) {
        return KNURL_ERROR_ARGUMENT;
    }
    knurl_device_info made;
    knurl_result result = knurl_device_ask(device, &made);
    result = result ? result : knurl_desc_return("knurl_device_info", &made, sizeof made, info);
    if (!result) {
        knurl_desc_end_text(info, offsetof(knurl_device_info, name),
                            offsetof(knurl_device_info, name) + sizeof info->name);
    }
    return result;
}

void knurl_listings_add(knurl_listings *listings, const char *uri, const char *name, const char *reason, ...) {
    if (listings->count++ < listings->capacity) {
        knurl_device_listing *listing = &listings->to[listings->count - 1];
        va_list arguments;
        memset(listing, 0, sizeof *listing);
        (void)snprintf(listing->uri, sizeof listing->uri, "%s", uri);
        (void)snprintf(listing->name, sizeof listing->name, "%s", name);
        va_start(arguments, reason);
        (void)knurl_format_arguments(listing->reason, sizeof listing->reason, reason, arguments);
        va_end(arguments);
        (void)knurl_text_line(listing->name, sizeof listing->name, listing->name); /* from the device, or a path */
        (void)knurl_text_line(listing->reason, sizeof listing->reason, listing->reason);
    }
}

static knurl_result take(const char *driver, const char *what, const char *from, size_t length, char *to) {
    if (length >= KNURL_URI_ROOM) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "device '%s': %s: expected fewer than %d characters, found %lu", driver,
                          what, KNURL_URI_ROOM, (unsigned long)length);
    }
    memcpy(to, from, length);
    to[length] = '\0';
    return KNURL_OK;
}

static knurl_result refuse(const char *driver, const char *pair, size_t length, const knurl_uri_key *keys,
                           size_t key_count) {
    char known[256] = "";
    for (size_t i = 0; i < key_count; i++) {
        const size_t used = strlen(known);
        (void)snprintf(known + used, sizeof known - used, "%s%s=", i > 0 ? " or " : "", keys[i].key);
    }
    return knurl_fail(KNURL_ERROR_ARGUMENT, "device '%s': expected %s, found '%.*s'", driver,
                      key_count > 0 ? known : "a name and no keys", (int)(length < 200 ? length : 200), pair);
}

knurl_result knurl_uri_parse(const char *driver, const char *options, char *name, const knurl_uri_key *keys,
                             size_t key_count) {
    const char *at = options + strcspn(options, "?");
    knurl_result result = take(driver, "name", options, (size_t)(at - options), name);
    for (size_t i = 0; i < key_count; i++) {
        keys[i].value[0] = '\0';
    }
    while (!result && *at && at[1]) { /* at '?' or '&' */
        const char *pair = at + 1;
        const size_t length = strcspn(pair, "&");
        const size_t key_length = strcspn(pair, "=&");
        size_t i = 0;
        while (i < key_count && (strlen(keys[i].key) != key_length || strncmp(keys[i].key, pair, key_length) != 0)) {
            i++;
        }
        if (i == key_count || pair[key_length] != '=') {
            return refuse(driver, pair, length, keys, key_count);
        }
        result = take(driver, keys[i].key, pair + key_length + 1, length - key_length - 1, keys[i].value);
        at = pair + length;
    }
    return result;
}

knurl_result knurl_uri_flag(const char *driver, const char *key, const char *value, uint32_t *flag) {
    if (value[0] && strcmp(value, "0") != 0 && strcmp(value, "1") != 0) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "device '%s': %s: expected 0 or 1, found '%.100s'", driver, key, value);
    }
    *flag = value[0] == '1';
    return KNURL_OK;
}
