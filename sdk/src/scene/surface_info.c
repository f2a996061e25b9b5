/* Reports on a surface, and finds an anchor for strokes. SPDX-License-Identifier: MIT */
#include "contact/mesh_facets.h"
#include "scene/scene.h"
#include "surface/surface_frame.h"

#include "base/base.h"
#include "base/rule.h"
#include "base/vec3.h"

#include <string.h>

void knurl_surface_info_init(knurl_surface_info *info, uint32_t size) {
    const knurl_surface_info defaults = {0};
    knurl_desc_write(&defaults, sizeof defaults, info, size);
}

/* m: distance from the anchor to the bounds along a direction. */
static double reach_along(const knurl_surface_info *info, const double direction[3]) {
    double reach = HUGE_VAL;
    for (int axis = 0; axis < 3; axis++) {
        const double edge = direction[axis] > 0.0 ? info->bounds_max[axis] : info->bounds_min[axis];
        if (fabs(direction[axis]) > 1e-6) {
            reach = fmin(reach, fmax(0.0, (edge - info->anchor[axis]) / direction[axis]));
        }
    }
    return reach;
}

static void describe_anchor(const knurl_surface_data *surface, const knurl_pose *pose, knurl_surface_info *info) {
    knurl_contact anchor;
    double x[3];
    double y[3];
    double coordinates[2];
    knurl_shape_anchor(&surface->shape, pose->rotation, &anchor);
    knurl_surface_frame(surface, surface->record, &anchor, x, y, coordinates);
    knurl_pose_to_parent(pose, anchor.proxy, info->anchor);
    mat3_mul(pose->rotation, x, info->anchor_x);
    mat3_mul(pose->rotation, anchor.normal, info->anchor_normal);
    mat3_mul(pose->rotation, y, y);
    for (int i = 0; i < 4; i++) {
        double direction[3];
        vec3_scale(i % 2 == 0 ? 1.0 : -1.0, i < 2 ? info->anchor_x : y, direction);
        info->anchor_reach[i] = reach_along(info, direction);
    }
}

static void describe_facets(const knurl_mesh_facets *facets, knurl_surface_info *info) {
    info->edges = facets->edges;
    info->hard_edges = facets->hard_edges;
    memcpy(info->facet_angle, facets->facet_angle, sizeof info->facet_angle);
    memcpy(info->felt_angle, facets->felt_angle, sizeof info->felt_angle);
}

static void describe_model(const knurl_surface_data *surface, knurl_surface_info *info) {
    const knurl_shape_facts *facts = knurl_shape_get_facts(&surface->shape);
    const knurl_plane *plane = surface->shape.plane;
    const knurl_mesh *mesh = surface->shape.mesh;
    info->shape = surface->given;
    info->model = surface->shape.model;
    info->why = surface->shape.why;
    info->triangle_count = knurl_shape_triangles(&surface->shape);
    info->dropped_triangles = facts->dropped;
    info->reversed_twins = facts->reversed_twins;
    info->turned_triangles = facts->turned;
    info->model_error = facts->error;
    info->seam = facts->seam;
    info->touching_pairs = facts->touching;
    info->curved_triangles = facts->curved;
    info->bad_normals = facts->bad_normals;
    info->bulge = facts->bulge;
    info->coordinates = surface->shape.coordinates;
    info->uneven = facts->uneven;
    info->projection_seams = facts->projection_seams;
    info->smooth = surface->shape.smooth;
    uint32_t users = 1 + knurl_load_relaxed(knurl_shape_other_users(&surface->shape));
    if (mesh) {
        describe_facets(&mesh->facets, info);
        users -= mesh->facet_counts;
    }
    if (plane || (mesh->uvs && !mesh->has_axis)) {
        memcpy(info->uv_scale, plane ? plane->uv_scale : mesh->uv_scale, sizeof info->uv_scale);
    }
    info->double_sided = (uint32_t)surface->double_sided;
    info->bytes = knurl_heap_size(surface) + knurl_heap_size(surface->record) + knurl_heap_size(surface->name) +
                  (plane ? knurl_plane_bytes(plane) : knurl_mesh_bytes(mesh)) / users;
    memcpy(info->stretch, facts->stretch[0], sizeof facts->stretch[0]);
    memcpy(info->stretch_y, facts->stretch[1], sizeof facts->stretch[1]);
}

/* Describes a surface as it stands now; the bounds of a moving one contain its whole motion. */
static void describe(const knurl_scene *scene, const knurl_surface_data *surface, knurl_surface_info *info) {
    knurl_pose pose;
    memset(info, 0, sizeof *info);
    knurl_scene_copy_name(surface, info->name);
    vec3_copy(surface->axis, info->axis);
    const double now = knurl_scene_time(scene);
    knurl_motion_at(&surface->record->motion, now, &pose);
    knurl_surface_bounds(surface, &surface->record->motion, now, info->bounds_min, info->bounds_max);
    describe_model(surface, info);
    describe_anchor(surface, &pose, info);
}

/* Unlocks the scene, whose edits need not wait, and counts the edges of a mesh for the first time. */
static void unlock_and_count(const knurl_scene *scene, const knurl_shape *of, knurl_surface_info *info) {
    const knurl_shape shape = knurl_shape_share(of); /* the mesh may outlive its surface */
    knurl_mesh *mesh = shape.mesh;
    knurl_mesh_facets facets;
    mesh->facet_counts++;
    knurl_scene_unlock(scene);
    knurl_mesh_count_facets(mesh, &facets);
    describe_facets(&facets, info);
    knurl_scene_lock(scene);
    mesh->facets = facets;
    mesh->are_facets_counted = 1;
    mesh->facet_counts--;
    const int is_last = knurl_load_relaxed(knurl_shape_other_users(&shape)) == 0;
    if (!is_last) { /* while no other thread can count the users */
        knurl_shape_destroy(scene->surfaces.heap, &shape);
    }
    knurl_scene_unlock(scene);
    if (is_last) { /* frees the mesh, for which edits need not wait */
        knurl_shape_destroy(scene->surfaces.heap, &shape);
    }
}

static int needs_count(const knurl_shape *shape) {
    return shape->mesh && !shape->mesh->are_facets_counted;
}

knurl_result knurl_scene_get_surface_info(const knurl_scene *scene, knurl_surface_id surface,
                                          knurl_surface_info *info) {
    KNURL_RULE(NOT_HAPTIC, scene);
    if (KNURL_IS_NULL(info)) {
        return KNURL_ERROR_ARGUMENT;
    }
    knurl_surface_info made;
    knurl_surface_data *data;
    const knurl_result result = knurl_scene_lock_surface(scene, surface, &data);
    if (result) {
        return result;
    }
    describe(scene, data, &made);
    if (needs_count(&data->shape)) {
        unlock_and_count(scene, &data->shape, &made);
    } else {
        knurl_scene_unlock(scene);
    }
    return knurl_desc_return("knurl_surface_info", &made, sizeof made, info);
}

knurl_result knurl_scene_get_material(const knurl_scene *scene, knurl_surface_id surface,
                                      knurl_material_desc *material) {
    KNURL_RULE(NOT_HAPTIC, scene);
    if (KNURL_IS_NULL(material)) {
        return KNURL_ERROR_ARGUMENT;
    }
    knurl_surface_data *data;
    const knurl_result result = knurl_scene_lock_surface(scene, surface, &data);
    if (result) {
        return result;
    }
    const knurl_material_desc found = data->record->material;
    knurl_scene_unlock(scene);
    return knurl_desc_return("knurl_material_desc", &found, sizeof found, material);
}
