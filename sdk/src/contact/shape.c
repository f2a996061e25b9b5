/* Creates a plane or a mesh from a description. SPDX-License-Identifier: MIT */
#include "contact/shape.h"

#include "base/base.h"
#include "base/vec3.h"
#include "contact/mesh_build.h"
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

static void set_plane(knurl_shape *shape, knurl_plane *plane) {
    shape->model = plane->outline ? "plane+outline" : "plane";
    shape->plane = plane;
    for (int axis = 0; axis < 2; axis++) {
        shape->low[axis] = -plane->half_extents[axis];
        shape->high[axis] = plane->half_extents[axis];
    }
    shape->has_coordinates = plane->has_coordinates;
    shape->double_sided = plane->double_sided;
    shape->seam = plane->facts.seam;
}

static void set_mesh(knurl_shape *shape, knurl_mesh *mesh, const double *axis) {
    shape->model = "mesh+bvh";
    shape->mesh = mesh;
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
    shape->seam = mesh->facts.seam;
    shape->bulge = mesh->facts.bulge;
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
    (void)__atomic_fetch_add(knurl_shape_other_users(shape), 1, __ATOMIC_RELAXED);
    return *shape;
}

void knurl_shape_destroy(knurl_heap *heap, const knurl_shape *shape) {
    if ((shape->plane || shape->mesh) && __atomic_fetch_sub(knurl_shape_other_users(shape), 1, __ATOMIC_ACQ_REL) == 0) {
        knurl_plane_destroy(heap, shape->plane);
        knurl_mesh_destroy(heap, shape->mesh);
    }
}

void knurl_shape_anchor(const knurl_shape *shape, const double rotation[9], knurl_contact *anchor) {
    if (shape->mesh) {
        knurl_mesh_anchor(shape->mesh, rotation, anchor);
        return;
    }
    memset(anchor, 0, sizeof *anchor);
    anchor->proxy[0] = shape->plane->inside[0];
    anchor->proxy[1] = shape->plane->inside[1];
    anchor->normal[2] = 1.0;
}
