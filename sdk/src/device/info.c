/* Device properties, checked each time they are read. SPDX-License-Identifier: MIT */
#include "device/driver.h"

#include "base/base.h"
#include "base/range.h"

#include <math.h>
#include <stdio.h>

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
