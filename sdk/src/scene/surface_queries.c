/* Queries for games: ids, ray casts, all contacts of a HIP.
 * SPDX-License-Identifier: MIT */
#include "scene/scene.h"

#include "base/base.h"
#include "base/number.h"
#include "base/rule.h"

#include <string.h>

uint32_t knurl_scene_has_surface(const knurl_scene *scene, knurl_surface_id surface) {
    KNURL_RULE(NOT_HAPTIC, scene);
    if (KNURL_BAD_HANDLE(scene, SCENE)) {
        return 0;
    }
    knurl_scene_lock(scene);
    const uint32_t is_there = knurl_surfaces_find(&scene->surfaces, surface) != NULL;
    knurl_scene_unlock(scene);
    return is_there;
}

void knurl_surface_point_init(knurl_surface_point *point, uint32_t size) {
    const knurl_surface_point defaults = {0};
    knurl_desc_write(&defaults, sizeof defaults, point, size);
}

/* 1 if the box of a segment comes within `margin` (m) of another box. */
static int passes_box(const double from[3], const double to[3], double margin, const double low[3],
                      const double high[3]) {
    double least[3], most[3];
    knurl_bvh_bound(from, to, margin, least, most);
    for (int axis = 0; axis < 3; axis++) {
        if (least[axis] > high[axis] || most[axis] < low[axis]) {
            return 0;
        }
    }
    return 1;
}

/* Casts at one surface. *share: of the segment, at the first hit so far, which is `hit`. */
static void cast_at(const knurl_scene *scene, const knurl_surface_data *surface, const double from[3],
                    const double to[3], double *share, knurl_surface_point *hit) {
    const double now = knurl_scene_time(scene);
    const knurl_motion *motion = &surface->record->motion;
    knurl_cast cast = {.double_sided = surface->double_sided};
    knurl_cast_hit found;
    knurl_pose pose;
    double low[3], high[3], normal[3];
    knurl_surface_bounds(surface, motion, now, low, high);
    if (!passes_box(from, to, surface->shape.seam + KNURL_CAST_SLACK, low, high)) {
        return;
    }
    knurl_motion_at(motion, now, &pose);
    knurl_pose_to_own(&pose, from, cast.from);
    knurl_pose_to_own(&pose, to, cast.to);
    if (!knurl_shape_cast(&surface->shape, &cast, &found) || found.share >= *share) {
        return;
    }
    *share = found.share;
    hit->surface = surface->id;
    knurl_pose_to_parent(&pose, found.point, hit->position);
    vec3_scale(found.side, found.normal, normal); /* normal of the front */
    knurl_pose_vector_to_parent(&pose, normal, hit->normal);
}

knurl_result knurl_scene_cast_ray(const knurl_scene *scene, const double from[3], const double to[3],
                                  knurl_surface_point *point) {
    KNURL_RULE(NOT_HAPTIC, scene);
    if (KNURL_BAD_HANDLE(scene, SCENE) || KNURL_IS_NULL(from) || KNURL_IS_NULL(to) || KNURL_IS_NULL(point)) {
        return KNURL_ERROR_ARGUMENT;
    }
    knurl_result result = knurl_check_coordinates("from", "m", from);
    result = result ? result : knurl_check_coordinates("to", "m", to);
    if (result) {
        return result;
    }
    knurl_surface_point hit = {0};
    double share = 2.0;
    knurl_scene_lock(scene);
    for (uint32_t i = 0; i < scene->surfaces.count; i++) {
        cast_at(scene, knurl_surfaces_at(&scene->surfaces, i), from, to, &share, &hit);
    }
    knurl_scene_unlock(scene);
    if (hit.surface) {
        double way[3];
        vec3_sub(hit.position, from, way);
        hit.distance = vec3_length(way);
    }
    return knurl_desc_return("knurl_surface_point", &hit, sizeof hit, point);
}

/* Ids are made from place and generation, because surfaces may have been removed and freed since the tick. */
uint32_t knurl_scene_get_contacts(const knurl_scene *scene, uint32_t hip, knurl_hip_contact *contacts,
                                  uint32_t capacity) {
    KNURL_RULE_OF_HIP(HAPTIC, scene, hip);
    if (!KNURL_IS_HANDLE(scene, SCENE) || hip >= scene->hip_count) {
        return 0;
    }
    const knurl_contacts *c = &scene->hips[hip].contacts;
    uint32_t count = 0;
    for (uint32_t i = 0; i < c->now.count; i++) {
        const knurl_active_contact *active = &c->now.list[i];
        const knurl_candidate *candidate = active->candidate;
        if (active->is_unfelt || count++ >= capacity || !contacts) {
            continue;
        }
        knurl_hip_contact *contact = &contacts[count - 1];
        memset(contact, 0, sizeof *contact);
        contact->surface = knurl_surfaces_make_id(&scene->surfaces, candidate->place, candidate->generation);
        vec3_copy(candidate->proxy, contact->proxy);
        vec3_copy(active->normal, contact->normal);
        contact->depth = -active->contact.z;
    }
    return count;
}
