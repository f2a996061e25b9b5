/* The result of knurl_plane_from_mesh(), for its tests. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_FLAT_OUTCOME_H
#define KNURL_TEST_FLAT_OUTCOME_H

#include "support/flat.h"

/* The result for a mesh; `why` is also set if it did not become a plane. */
typedef struct outcome {
    knurl_heap heap;
    knurl_plane *plane;
    double position[3];
    double rotation[9];
    const char *why;
} outcome;

static inline outcome decide_with(const knurl_mesh_desc *desc, const double *axis) {
    outcome o;
    memset(&o, 0, sizeof o);
    knurl_heap_init(&o.heap, NULL);
    assert_int_equal(knurl_mesh_check(desc), KNURL_OK);
    assert_int_equal(knurl_plane_from_mesh(&o.heap, desc, axis, &o.plane, o.position, o.rotation, &o.why), KNURL_OK);
    assert_non_null(o.why);
    assert_true(o.heap.bytes == (o.plane ? knurl_plane_bytes(o.plane) : 0)); /* no scratch is left */
    return o;
}

static inline outcome decide(const shape *s) {
    const knurl_mesh_desc desc = shape_desc(s);
    return decide_with(&desc, NULL);
}

static inline void forget(outcome *o) {
    knurl_plane_destroy(&o->heap, o->plane);
    assert_int_equal(o->heap.bytes, 0);
}

/* Frees the shape. */
#define CHECK_STAYS(s, reason) check_stays(s, NULL, reason, __LINE__)

static inline void check_stays(shape *s, const double *axis, const char *reason, int line) {
    const knurl_mesh_desc desc = shape_desc(s);
    outcome o = decide_with(&desc, axis);
    if (o.plane || strcmp(o.why, reason) != 0) {
        print_error("line %d: expected \"%s\", found \"%s\"\n", line, reason, o.why);
        fail();
    }
    forget(&o);
    shape_free(s);
}

/* The outline encloses `area` m2 with `edges` straight edges of `length` m in all. Frees the shape. */
#define CHECK_OUTLINE(s, edges, area, length) check_outline(s, edges, area, length, __LINE__)

static inline void check_outline(shape *s, uint32_t edges, double area, double length, int line) {
    outcome o = decide(s);
    double found_length = 0.0;
    if (!o.plane || o.plane->edge_count != edges || (edges == 0) != !o.plane->outline) {
        print_error("line %d: expected %u edges, found %u: %s\n", line, (unsigned)edges,
                    (unsigned)(o.plane ? o.plane->edge_count : 0), o.why);
        fail();
        return;
    }
    CHECK_CLOSE(flat_area(o.plane, &found_length), area, 1e-7 * length);
    CHECK_CLOSE(found_length, length, 1e-7 + 1e-6 * length);
    assert_true(knurl_plane_covers(o.plane, o.plane->inside));
    assert_true(flat_to_outline(o.plane, o.plane->inside) > 1e-4 * length);
    for (uint64_t seed = 1, i = 0; o.plane->outline && i < 200; i++) {
        double p[3] = {random_between(&seed, -0.1, 0.1), random_between(&seed, -0.1, 0.1), 0.02}, closest[3];
        const double distance = knurl_plane_covers(o.plane, p) ? 0.0 : flat_to_outline(o.plane, p);
        knurl_plane_closest(o.plane, p, closest);
        CHECK_CLOSE(hypot(p[0] - closest[0], p[1] - closest[1]), distance, 1e-12);
        CHECK_CLOSE(flat_to_outline(o.plane, closest) * (distance > 0.0), 0.0, 1e-12);
    }
    forget(&o);
    shape_free(s);
}

#endif
