/* A HIP over one shape, moved by hand: a scene's calls of contact/, without the scene.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_PROBE_H
#define KNURL_TEST_PROBE_H

#include "support/geometry.h"

#include "contact/mesh_build.h"
#include "contact/mesh_contact.h"
#include "contact/plane.h"

/** The plane is used if there is no mesh. */
typedef struct probe {
    knurl_heap heap;
    knurl_mesh *mesh;
    knurl_plane plane;
    knurl_contact_query query;
    knurl_contact_state state;
    knurl_contact contact;
} probe;

static inline probe probe_plane(double half_x, double half_y) {
    probe p;
    memset(&p, 0, sizeof p);
    knurl_plane_from_rectangle((const double[2]){half_x, half_y}, NULL, &p.plane);
    return p;
}

/** Takes the shape over: it is freed. */
static inline probe probe_shape(shape *s) {
    probe p;
    memset(&p, 0, sizeof p);
    knurl_heap_init(&p.heap, NULL);
    const knurl_mesh_desc desc = shape_desc(s);
    assert_int_equal(knurl_mesh_create(&p.heap, &desc, &p.mesh), KNURL_OK);
    shape_free(s);
    return p;
}

/** Of a shape that nothing else needs. */
static inline probe probe_of(shape s) {
    return probe_shape(&s);
}

static inline void probe_free(probe *p) {
    knurl_mesh_destroy(&p->heap, p->mesh);
    assert_int_equal(p->heap.bytes, 0);
}

/** A probe that is freed at the end of its scope. */
#define SCOPED_PROBE __attribute__((cleanup(probe_free))) probe

/** Resets the contact: the next position is a first one. */
static inline void probe_forget(probe *p) {
    p->query.has_previous = 0;
    memset(&p->state, 0, sizeof p->state);
}

/** One tick: 1 if there is contact. */
static inline int probe_at(probe *p, const double hip[3]) {
    memcpy(p->query.hip, hip, sizeof p->query.hip);
    const int held = p->mesh ? knurl_mesh_contact(p->mesh, &p->query, &p->state, &p->contact)
                             : knurl_plane_contact(&p->plane, &p->query, &p->state, &p->contact);
    memcpy(p->query.previous, hip, sizeof p->query.previous);
    p->query.has_previous = 1;
    if (!held) {
        const knurl_contact_state none = {0, 0, 0};
        assert_memory_equal(&p->state, &none, sizeof none);
        return 0;
    }
    assert_true(p->contact.z <= fmax(p->query.reach, 1e-9));
    CHECK_CLOSE(length3(p->contact.normal), 1.0, 1e-9);
    return 1;
}

static inline int probe_to(probe *p, double x, double y, double z) {
    const double hip[3] = {x, y, z};
    return probe_at(p, hip);
}

/** 1 if the HIP is held inside (not merely in reach). */
static inline int probe_inside(probe *p, const double hip[3]) {
    return probe_at(p, hip) && p->contact.z < 0.0;
}

/** The contact holds the HIP at `depth` below a proxy, along a normal. */
#define CHECK_HELD(p, px, py, pz, nx, ny, nz, depth)                                                                   \
    do {                                                                                                               \
        CHECK_CLOSE((p)->contact.proxy[0], px, 1e-9);                                                                  \
        CHECK_CLOSE((p)->contact.proxy[1], py, 1e-9);                                                                  \
        CHECK_CLOSE((p)->contact.proxy[2], pz, 1e-9);                                                                  \
        CHECK_CLOSE((p)->contact.normal[0], nx, 1e-9);                                                                 \
        CHECK_CLOSE((p)->contact.normal[1], ny, 1e-9);                                                                 \
        CHECK_CLOSE((p)->contact.normal[2], nz, 1e-9);                                                                 \
        CHECK_CLOSE(-(p)->contact.z, depth, 1e-9);                                                                     \
    } while (0)

#endif
