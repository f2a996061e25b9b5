/* The closest point of all surfaces, searched through the hierarchy that ticks use. SPDX-License-Identifier: MIT */
#include "scene/scene.h"

#include "base/base.h"
#include "base/number.h"
#include "base/rule.h"
#include "contact/bvh_search.h"
#include "contact/mesh_query.h"
#include "contact/mesh_walk.h"

typedef struct search {
    const knurl_scene *scene;
    const double *position;
    double time;               /* s */
    knurl_surface_point found; /* so far; its distance, at first the radius, limits the search */
} search;

/* The closest point of a shape and its outward normal, shape's frame. *triangle: receives the mesh's. Returns 0 if
 * there is no point within the radius. */
static int closest_of_shape(const knurl_shape *shape, const double p[3], double radius, double closest[3],
                            double normal[3], uint32_t *triangle) {
    knurl_contact found;
    knurl_triangle t;
    if (shape->plane) {
        static const double front[3] = {0.0, 0.0, 1.0};
        *triangle = 0;
        vec3_copy(front, normal);
        knurl_plane_closest(shape->plane, p, closest);
        return 1;
    }
    if (!knurl_mesh_closest(shape->mesh, p, radius, NULL, NULL, &found)) {
        return 0;
    }
    *triangle = found.triangle;
    knurl_mesh_triangle(shape->mesh, found.triangle, &t);
    vec3_copy(found.proxy, closest);
    vec3_copy(t.normal, normal);
    return 1;
}

static void look_at(search *s, const knurl_surface_data *surface) {
    knurl_surface_point *best = &s->found;
    knurl_pose pose;
    double own[3], closest[3], normal[3], off[3];
    uint32_t triangle;
    knurl_motion_at(&surface->record->motion, s->time, &pose);
    knurl_pose_to_own(&pose, s->position, own);
    if (!closest_of_shape(&surface->shape, own, best->distance, closest, normal, &triangle)) {
        return;
    }
    knurl_pose_to_parent(&pose, closest, closest);
    vec3_sub(s->position, closest, off);
    const double distance = vec3_length(off);
    if (distance < best->distance || (distance == best->distance && (!best->surface || surface->id < best->surface))) {
        best->surface = surface->id;
        best->hint = triangle;
        best->distance = distance;
        vec3_copy(closest, best->position);
        knurl_pose_vector_to_parent(&pose, normal, best->normal);
    }
}

/* Shortens the search to the distance of the surface of an earlier answer, if it is still there: down from that
 * answer's triangle, which may be of another shape by now. A little more than that, so that the answer is the same. */
static void begin_at(search *s, knurl_surface_id id, uint32_t triangle) {
    const knurl_surface_data *surface = knurl_surfaces_find(&s->scene->surfaces, id);
    const knurl_mesh *mesh = surface ? surface->shape.mesh : NULL; /* null for a plane, too */
    if (mesh && triangle < mesh->triangle_count) {
        knurl_closest_point closest;
        knurl_pose pose;
        double own[3];
        knurl_motion_at(&surface->record->motion, s->time, &pose);
        knurl_pose_to_own(&pose, s->position, own);
        knurl_closest_on_triangle(mesh, triangle, own, &closest);
        (void)knurl_mesh_walk(mesh, own, 1, NULL, &closest);
        const double room =
            sqrt(closest.distance2) * (1.0 + 1e-9) + 1e-12 * (1.0 + vec3_length(s->position) + vec3_length(own));
        s->found.distance = fmin(s->found.distance, room);
    }
}

/* m^2: from a point to a box; a lower bound. */
static float distance2_to(const knurl_search_point *point, const float box[6]) {
    const knurl_float4 low = {box[0], box[1], box[2], 0.0f}, high = {box[3], box[4], box[5], 0.0f};
    return knurl_search_distance2(point, low, high);
}

static int is_within(const search *s, float distance2) {
    return (double)distance2 <= s->found.distance * s->found.distance * (1.0 + 1e-9);
}

/* The surfaces at rest: the nearest boxes first. */
static void look_at_still(search *s, const knurl_broad_index *index, const knurl_search_point *point) {
    uint32_t stack[KNURL_BVH_DEPTH_MAX] = {0};
    uint32_t top = index->node_count > 0;
    while (top > 0) {
        const uint32_t at = stack[--top];
        const knurl_bvh_node *node = &index->nodes[at];
        if (!is_within(s, knurl_search_node_distance2(point, node))) {
            continue;
        }
        for (uint32_t i = node->first; i < node->first + node->count; i++) {
            const uint32_t place = index->order[i];
            if (index->items[place] && !index->rank[place]) {
                look_at(s, index->items[place]);
            }
        }
        if (node->count == 0) {
            const uint32_t left = at + 1, right = node->first;
            const int left_first = knurl_search_node_distance2(point, &index->nodes[left]) <=
                                   knurl_search_node_distance2(point, &index->nodes[right]);
            stack[top++] = left_first ? right : left;
            stack[top++] = left_first ? left : right;
        }
    }
}

/* Under the scene's lock. */
static void look_around(search *s) {
    const knurl_broad_index *index = s->scene->broad_phase.index;
    knurl_search_point point;
    knurl_search_point_set(s->position, &point);
    for (uint32_t i = 0; !index && i < s->scene->surfaces.count; i++) {
        look_at(s, knurl_surfaces_at(&s->scene->surfaces, i));
    }
    if (index) {
        look_at_still(s, index, &point);
    }
    for (uint32_t i = 0; index && i < index->dynamic_count; i++) {
        const uint32_t place = index->dynamic[i];
        if (index->items[place] && is_within(s, distance2_to(&point, index->boxes[place]))) {
            look_at(s, index->items[place]);
        }
    }
}

static knurl_result check_query(const double position[3], double radius) {
    const knurl_result result = knurl_check_coordinates("position", "m", position);
    return !result && !(radius > 0.0)
               ? knurl_fail(KNURL_ERROR_ARGUMENT, "radius: expected more than 0 m, found %g", radius)
               : result;
}

/* Begins at `hint`; *point: receives the answer. */
static knurl_result find_closest(const knurl_scene *scene, const double position[3], double radius,
                                 knurl_surface_point *hint, knurl_surface_point *point) {
    knurl_surface_point given;
    knurl_surface_point_init(&given, sizeof given);
    const knurl_result result = knurl_desc_read("knurl_surface_point", hint, &given, sizeof given);
    if (result) {
        return result;
    }
    search s = {scene, position, 0.0, {.distance = radius}};
    knurl_scene_lock(scene);
    s.time = knurl_scene_time(scene);
    begin_at(&s, given.surface, given.hint);
    look_around(&s);
    knurl_scene_unlock(scene);
    s.found.distance = s.found.surface ? s.found.distance : 0.0;
    return knurl_desc_return("knurl_surface_point", &s.found, sizeof s.found, point);
}

knurl_result knurl_scene_find_closest(const knurl_scene *scene, const double position[3], double radius,
                                      knurl_surface_point *point) {
    KNURL_RULE(NOT_HAPTIC, scene);
    if (KNURL_BAD_HANDLE(scene, SCENE) || KNURL_IS_NULL(position) || KNURL_IS_NULL(point)) {
        return KNURL_ERROR_ARGUMENT;
    }
    const knurl_result result = check_query(position, radius);
    return result ? result : find_closest(scene, position, radius, point, point);
}

knurl_result knurl_scene_find_closest_batch(const knurl_scene *scene, const double *positions, uint64_t count,
                                            double radius, knurl_surface_point *points) {
    KNURL_RULE(NOT_HAPTIC, scene);
    if (KNURL_BAD_HANDLE(scene, SCENE) || KNURL_IS_NULL(positions) || KNURL_IS_NULL(points)) {
        return KNURL_ERROR_ARGUMENT;
    }
    knurl_result result = KNURL_OK;
    char *at = (char *)points;
    for (uint64_t i = 0; i < count && !result; i++) {
        knurl_surface_point given;
        result = check_query(positions + 3 * i, radius);
        result = result ? result : knurl_desc_read("knurl_surface_point", at, &given, sizeof given);
        at += ((const knurl_surface_point *)(const void *)at)->struct_size;
    }
    at = (char *)points;
    for (uint64_t i = 0; i < count && !result; i++) {
        knurl_surface_point *last = (knurl_surface_point *)(void *)at;
        at += i > 0 ? last->struct_size : 0;
        result = find_closest(scene, positions + 3 * i, radius, last, (knurl_surface_point *)(void *)at);
    }
    return result;
}
