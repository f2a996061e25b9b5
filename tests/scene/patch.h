/* Meshes put together triangle by triangle. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_PATCH_H
#define KNURL_TEST_PATCH_H

#include "support/scenes.h"

/** A growing list of triangles with separate vertices: vertices at the same position are welded.
 */
typedef struct patch {
    shape s;
    uint32_t used;
} patch;

static inline patch patch_new(uint32_t triangles) {
    patch p = {shape_new(3 * triangles, 3 * triangles, 0), 0};
    return p;
}

static inline void add_triangle(patch *p, const double a[3], const double b[3], const double c[3]) {
    const double *corners[3] = {a, b, c};
    assert_true(p->used + 3 <= p->s.index_count);
    for (int k = 0; k < 3; k++) {
        shape_set(&p->s, p->used, corners[k][0], corners[k][1], corners[k][2]);
        p->s.indices[p->used] = p->used;
        p->used++;
    }
}

/** A mesh whose grating runs along y. */
static inline surface_parts surface_shape(const shape *s) {
    surface_parts parts = surface_mesh(s);
    parts.desc.axis[1] = 1.0;
    return parts;
}

#endif
