/* Creates a plane or a mesh from a description; function tables of both. SPDX-License-Identifier: MIT */
#include "contact/shape.h"

#include "base/base.h"
#include "base/vec3.h"
#include "contact/mesh_build.h"
#include "contact/mesh_cast.h"
#include "contact/mesh_contact.h"
#include "contact/mesh_normals.h"
#include "contact/mesh_query.h"
#include "contact/plane_from_mesh.h"
#include "contact/uv_scale.h"

#include <string.h>

void knurl_plane_desc_init(knurl_plane_desc *desc, uint32_t size) {
    const knurl_plane_desc defaults = {.half_extents = {0.05, 0.05}};
    knurl_desc_write(&defaults, sizeof defaults, desc, size);
}

void knurl_mesh_desc_init(knurl_mesh_desc *desc, uint32_t size) {
    const knurl_mesh_desc defaults = {0};
    knurl_desc_write(&defaults, sizeof defaults, desc, size);
}

/* --- function table of the plane --- */

static int plane_contact(const void *plane, const knurl_contact_query *query, knurl_contact_state *state,
                         knurl_contact *contact) KNURL_NONBLOCKING {
    return knurl_plane_contact(plane, query, state, contact);
}

static int plane_cast(const void *plane, const knurl_cast *cast, knurl_cast_hit *hit) KNURL_NONBLOCKING {
    return knurl_plane_cast(plane, cast, hit);
}

static void plane_rest(const void *plane, const knurl_cast_hit *hit, const double point[3], knurl_contact_state *state,
                       knurl_contact *contact) KNURL_NONBLOCKING {
    (void)plane;
    knurl_plane_rest(hit, point, state, contact);
}

static void plane_anchor(const void *geometry, const double rotation[9], knurl_contact *anchor) {
    const knurl_plane *plane = geometry;
    (void)rotation;
    memset(anchor, 0, sizeof *anchor);
    anchor->proxy[0] = plane->inside[0];
    anchor->proxy[1] = plane->inside[1];
    anchor->normal[2] = 1.0;
}

static void plane_facts(const void *geometry, knurl_shape_facts *facts) {
    const knurl_plane *plane = geometry;
    const knurl_shape_facts made = {.model = plane->outline ? "plane+outline" : "plane",
                                    .bytes = knurl_plane_bytes(plane),
                                    .triangle_count = plane->triangle_count,
                                    .dropped = plane->dropped,
                                    .reversed_twins = plane->reversed_twins,
                                    .seam = plane->seam,
                                    .error = plane->flatness};
    *facts = made;
    memcpy(facts->uv_scale, plane->uv_scale, sizeof facts->uv_scale);
    memcpy(facts->stretch, plane->stretch, sizeof facts->stretch);
}

static int plane_exceeds_visits(const void *geometry, double reach, uint32_t max_visits) {
    (void)geometry;
    (void)reach;
    (void)max_visits;
    return 0;
}

static uint32_t *plane_other_users(void *geometry) {
    knurl_plane *plane = geometry;
    return &plane->other_users;
}

static void plane_destroy(knurl_heap *heap, void *plane) {
    knurl_plane_destroy(heap, plane);
}

static const knurl_shape_functions plane_functions = {plane_contact,     plane_cast,   plane_rest,
                                                      plane_anchor,      plane_facts,  plane_exceeds_visits,
                                                      plane_other_users, plane_destroy};

/* --- function table of the mesh --- */

static int mesh_contact(const void *mesh, const knurl_contact_query *query, knurl_contact_state *state,
                        knurl_contact *contact) KNURL_NONBLOCKING {
    return knurl_mesh_contact(mesh, query, state, contact);
}

static int mesh_cast(const void *mesh, const knurl_cast *cast, knurl_cast_hit *hit) KNURL_NONBLOCKING {
    return knurl_mesh_cast(mesh, cast, hit);
}

static void mesh_rest(const void *mesh, const knurl_cast_hit *hit, const double point[3], knurl_contact_state *state,
                      knurl_contact *contact) KNURL_NONBLOCKING {
    knurl_mesh_rest(mesh, hit, point, state, contact);
}

static void mesh_anchor(const void *mesh, const double rotation[9], knurl_contact *anchor) {
    knurl_mesh_anchor(mesh, rotation, anchor);
}

static void mesh_facts(const void *geometry, knurl_shape_facts *facts) {
    const knurl_mesh *mesh = geometry;
    knurl_shape_facts made = {.model = "mesh+bvh",
                              .bytes = knurl_mesh_bytes(mesh),
                              .triangle_count = mesh->triangle_count,
                              .dropped = mesh->dropped,
                              .reversed_twins = mesh->reversed_twins,
                              .turned = mesh->turned,
                              .mixed = mesh->mixed,
                              .seam = mesh->seam,
                              .touching = mesh->touching,
                              .curved = mesh->curved,
                              .bad_normals = mesh->bad_normals,
                              .bulge = mesh->bulge,
                              .has_computed_normals = mesh->has_computed_normals,
                              .collapsed = mesh->collapsed,
                              .uneven = mesh->uneven,
                              .projection_seams = mesh->projection_seams,
                              .error = 0.0}; /* meshes are stored as given, in floats */
    for (int i = 0; i < 2 && mesh->uvs && !mesh->has_axis; i++) {
        made.uv_scale[i] = mesh->uv_scale[i];
    }
    memcpy(made.stretch, mesh->stretch, sizeof made.stretch);
    *facts = made;
}

static int mesh_exceeds_visits(const void *mesh, double reach, uint32_t max_visits) {
    return knurl_mesh_exceeds_visits(mesh, reach, max_visits);
}

static uint32_t *mesh_other_users(void *geometry) {
    knurl_mesh *mesh = geometry;
    return &mesh->other_users;
}

static void mesh_destroy(knurl_heap *heap, void *mesh) {
    knurl_mesh_destroy(heap, mesh);
}

static const knurl_shape_functions mesh_functions = {mesh_contact, mesh_cast,           mesh_rest,        mesh_anchor,
                                                     mesh_facts,   mesh_exceeds_visits, mesh_other_users, mesh_destroy};

/* --- creation --- */

static void set_plane(knurl_shape *shape, knurl_plane *plane) {
    shape->functions = &plane_functions;
    shape->geometry = plane;
    shape->plane = plane;
    for (int axis = 0; axis < 2; axis++) {
        shape->low[axis] = -plane->half_extents[axis];
        shape->high[axis] = plane->half_extents[axis];
    }
    shape->has_coordinates = plane->has_coordinates;
    shape->double_sided = plane->double_sided;
    shape->seam = plane->seam;
}

static void set_mesh(knurl_shape *shape, knurl_mesh *mesh, const double *axis) {
    shape->functions = &mesh_functions;
    shape->geometry = mesh;
    for (int i = 0; i < 3; i++) {
        shape->low[i] = (double)mesh->nodes[0].min[i];
        shape->high[i] = (double)mesh->nodes[0].max[i];
    }
    if (axis) {
        knurl_mesh_set_axis(mesh, axis);
    }
    shape->has_coordinates = mesh->uvs || mesh->is_projected || axis;
    shape->is_projected = mesh->is_projected;
    shape->double_sided = mesh->double_sided;
    shape->seam = mesh->seam;
    shape->bulge = mesh->bulge;
}

static knurl_result check_extent(const char *key, double value) {
    if (!(value >= KNURL_EXTENT_MIN && value <= KNURL_COORDINATE_MAX)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "%s: expected %g to %g m, found %g", key, KNURL_EXTENT_MIN,
                          KNURL_COORDINATE_MAX, value);
    }
    return KNURL_OK;
}

static knurl_result from_plane(knurl_heap *heap, const knurl_shape_desc *d, knurl_shape *shape) {
    knurl_plane_desc desc;
    knurl_plane_desc_init(&desc, sizeof desc);
    knurl_result result = knurl_desc_read("knurl_plane_desc", d->plane, &desc, sizeof desc);
    result = result ? result : check_extent("plane.half_extents[0]", desc.half_extents[0]);
    result = result ? result : check_extent("plane.half_extents[1]", desc.half_extents[1]);
    if (result) {
        return result;
    }
    knurl_plane *plane = knurl_heap_alloc(heap, 1, sizeof *plane);
    if (!plane) {
        return KNURL_ERROR_MEMORY;
    }
    knurl_plane_from_rectangle(desc.half_extents, d->axis, plane);
    shape->why = "given as a plane";
    shape->coordinates = d->axis ? "axis" : "plane";
    set_plane(shape, plane);
    return KNURL_OK;
}

/* Decides where the coordinates come from; leaves out unused attributes. */
static const char *choose_coordinates(const knurl_shape_desc *d, knurl_mesh_desc *desc, int32_t *has_flat_uvs) {
    if (d->axis) {
        return "axis";
    }
    if (d->is_box) {
        desc->uvs = desc->tangents = NULL;
    }
    const int is_usable = desc->uvs && knurl_uvs_are_usable(desc);
    *has_flat_uvs = desc->uvs && !is_usable && !desc->tangents;
    desc->uvs = is_usable ? desc->uvs : NULL;
    return desc->uvs ? "uvs" : desc->tangents ? "tangents" : *has_flat_uvs ? "box, for its uvs have no area" : "box";
}

static knurl_result from_mesh(knurl_heap *heap, const knurl_shape_desc *d, knurl_shape *shape, double position[3],
                              double rotation[9]) {
    knurl_mesh_desc desc;
    knurl_plane *plane = NULL;
    knurl_mesh *mesh = NULL;
    knurl_mesh_desc_init(&desc, sizeof desc);
    knurl_result result = knurl_desc_read("knurl_mesh_desc", d->mesh, &desc, sizeof desc);
    result = result ? result : knurl_mesh_check(&desc);
    if (result) {
        return result;
    }
    shape->coordinates = choose_coordinates(d, &desc, &shape->has_flat_uvs);
    desc.normals = d->smooth == KNURL_SMOOTH_OFF ? NULL : desc.normals;
    const int is_projected = !d->axis && !desc.uvs && !desc.tangents;
    shape->why = "the full model was requested";
    const int curves = knurl_mesh_curves(&desc);
    if (curves) {
        shape->why = "its normals describe a curved surface";
    } else if (!d->full_model) {
        result = knurl_plane_from_mesh(heap, &desc, d->axis, &plane, position, rotation, &shape->why);
    }
    if (!result && !plane) {
        result = knurl_mesh_create(heap, &desc, &mesh);
    }
    if (!result && mesh && d->smooth == KNURL_SMOOTH_ON && !desc.normals) {
        result = knurl_mesh_compute_normals(heap, mesh);
        shape->why = mesh->normals ? "its triangles describe a curved surface, with edges where they are over 43 "
                                     "degrees apart; it has no normals"
                                   : shape->why;
    }
    if (!result && mesh && is_projected) {
        result = knurl_mesh_set_projection(heap, mesh);
    }
    if (plane) {
        set_plane(shape, plane);
    } else if (mesh) {
        set_mesh(shape, mesh, d->axis);
    }
    return result;
}

knurl_result knurl_shape_create(knurl_heap *heap, const knurl_shape_desc *desc, knurl_shape *shape, double position[3],
                                double rotation[9]) {
    memset(shape, 0, sizeof *shape);
    for (int i = 0; i < 9; i++) {
        rotation[i] = i % 4 == 0 ? 1.0 : 0.0;
    }
    position[0] = position[1] = position[2] = 0.0;
    shape->smooth = desc->smooth;
    if (!desc->plane == !desc->mesh) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "shape: expected exactly one of plane and mesh, found %s",
                          desc->plane ? "both" : "none");
    }
    return desc->mesh ? from_mesh(heap, desc, shape, position, rotation) : from_plane(heap, desc, shape);
}

knurl_shape knurl_shape_share(const knurl_shape *shape) {
    (void)__atomic_fetch_add(shape->functions->other_users(shape->geometry), 1, __ATOMIC_RELAXED);
    return *shape;
}

void knurl_shape_destroy(knurl_heap *heap, const knurl_shape *shape) {
    if (shape->functions &&
        __atomic_fetch_sub(shape->functions->other_users(shape->geometry), 1, __ATOMIC_ACQ_REL) == 0) {
        shape->functions->destroy(heap, shape->geometry);
    }
}
