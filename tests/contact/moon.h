/* A real surface for the tests of contact, for programs that link moon.cpp. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_MOON_H
#define KNURL_TEST_MOON_H

#include "contact/bodies.h"

#include <stdio.h>

/** The first mesh of a glTF file, one primitive: its positions and indices, on the heap; 0 if there is none. */
int moon_load(const char *path, float **positions, uint32_t *vertex_count, uint32_t **indices, uint32_t *index_count);

/** The moon's surface around the origin, up turned to z, its longest side scaled to 0.3 m; without the corpus an empty
 * shape and a message. */
static inline shape body_moon(void) {
    shape s = {0};
    if (!moon_load(KNURL_TEST_CORPUS "/moon/moon_petavius_crater.gltf", &s.positions, &s.vertex_count, &s.indices,
                   &s.index_count)) {
        printf("SKIPPED the moon: no corpus at " KNURL_TEST_CORPUS "\n");
        return s;
    }
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
    double high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (size_t i = 0; i < 3 * (size_t)s.vertex_count; i++) {
        low[i % 3] = fmin(low[i % 3], (double)s.positions[i]);
        high[i % 3] = fmax(high[i % 3], (double)s.positions[i]);
    }
    const double scale = 0.3 / fmax(high[0] - low[0], fmax(high[1] - low[1], high[2] - low[2]));
    for (uint32_t v = 0; v < s.vertex_count; v++) {
        double p[3];
        shape_get(&s, v, p);
        for (int axis = 0; axis < 3; axis++) {
            p[axis] = scale * (p[axis] - 0.5 * (low[axis] + high[axis]));
        }
        shape_set(&s, v, p[0], -p[2], p[1]);
    }
    uint32_t kept = 0;
    for (uint32_t i = 0; i + 2 < s.index_count; i += 3) { /* the oracle divides by edges and areas */
        double corners[3][3];
        double normal[3];
        shape_corners(&s, i / 3, corners);
        if (normal3((const double (*)[3])corners, normal) > 1e-5 * pow(distance3(corners[0], corners[1]), 2.0) &&
            distance3(corners[0], corners[1]) > 0.0) {
            memmove(&s.indices[kept], &s.indices[i], 3 * sizeof *s.indices);
            kept += 3;
        }
    }
    s.index_count = kept;
    return s;
}

#endif
