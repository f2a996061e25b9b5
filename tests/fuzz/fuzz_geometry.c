/* Geometry files of raw HID devices. SPDX-License-Identifier: MIT */
#include "fuzz.h"

#include "device/rawhid/geometry.h"
#include "device/rawhid/kinematics.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    knurl_rawhid_geometry geometry;
    knurl_rawhid_arm arm;
    char *exact = malloc(size ? size : 1); /* so that a byte too far is seen */
    EXPECT(exact != NULL);
    memcpy(exact, data, size);
    if (knurl_rawhid_geometry_parse("fuzz", exact, size, &geometry) == KNURL_OK) {
        const double centre[3] = {0.0, 0.0, 0.0};
        const double force[3] = {1.0, -2.0, 3.0};
        double angles[3];
        int16_t currents[3];
        knurl_rawhid_arm_init(&arm, &geometry);
        EXPECT(knurl_rawhid_inverse(&arm, centre, angles)); /* which the check promised */
        knurl_rawhid_currents(&arm, angles, force, currents);
        for (int i = 0; i < 3; i++) {
            EXPECT(abs(currents[i]) <= (int)(1000.0 * geometry.max_current) + 1);
        }
    }
    free(exact);
    return 0;
}
