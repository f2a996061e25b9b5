/* Searches a mesh's hierarchy for the nearest point and for crossings. Iterative, bounded by the caller's visits.
 * SPDX-License-Identifier: MIT */
#include "contact/mesh_query.h"

#include "base/base.h"
#include "contact/closest_point.h"
#include "contact/leaf_bound.h"
#include "contact/mesh_search.h"

#include <string.h>

/* Keeps a triangle's closest point if it is nearer than `best2`; returns the smaller squared distance. */
static double closest_in_triangle(const knurl_mesh *mesh, uint32_t triangle, const double p[3], double best2,
                                  knurl_visits *visits, knurl_contact *nearest) {
    knurl_closest_point closest;
    if (!knurl_visits_take(visits, KNURL_VISITS_CLOSEST)) {
        return best2;
    }
    knurl_closest_on_triangle(mesh, triangle, p, &closest);
    if (closest.distance2 >= best2) {
        return best2;
    }
    vec3_copy(closest.point, nearest->proxy);
    vec3_copy(closest.weights, nearest->weights);
    nearest->triangle = triangle;
    return closest.distance2;
}

/* Prefetches the data that a search reads at a node: in a mesh larger than the caches it would wait for memory. */
KNURL_PREFETCHING void fetch_next(const knurl_mesh *mesh, const knurl_bvh_node *node) {
    if (node->count > 0) {
        __builtin_prefetch(&mesh->triangles[3 * (size_t)node->first]);
        __builtin_prefetch(&mesh->triangles[3 * ((size_t)node->first + node->count) - 1]);
    } else {
        __builtin_prefetch(node + 1);
        __builtin_prefetch(&mesh->nodes[node->first]);
    }
}

/* Prefetches the corners of a leaf's triangles. */
KNURL_PREFETCHING void fetch_corners(const knurl_mesh *mesh, const knurl_bvh_node *leaf) {
    const uint32_t *vertices = &mesh->triangles[3 * (size_t)leaf->first];
    for (uint32_t i = 0; i < 3 * leaf->count; i++) {
        __builtin_prefetch(&mesh->positions[3 * (size_t)vertices[i]]);
    }
}

/* Upper bound of a double as a float. */
static inline float round_up(double value) {
    return value < 1e38 ? (float)value * (1.0f + KNURL_FLOAT_ROUNDING) + KNURL_FLOAT_TINY : HUGE_VALF;
}

/* Keeps the closest point of a leaf if it is nearer than `best2`; returns the smaller squared distance. */
static double closest_in_leaf(const knurl_mesh *mesh, const knurl_bvh_node *leaf, const double p[3],
                              const knurl_leaf_point *lanes, double best2, knurl_visits *visits,
                              knurl_contact *nearest) {
    const uint32_t last = leaf->first + leaf->count - 1;
    fetch_corners(mesh, leaf);
    for (uint32_t first = leaf->first; first <= last; first += 4) {
        const knurl_float4 bound2 = knurl_leaf_bound2(mesh, first, last, lanes);
        for (uint32_t i = 0; i < 4 && first + i <= last; i++) {
            if (!((double)bound2[i] >= best2)) {
                best2 = closest_in_triangle(mesh, first + i, p, best2, visits, nearest);
            }
        }
    }
    return best2;
}

int knurl_mesh_closest(const knurl_mesh *mesh, const double p[3], double radius, knurl_part *part, knurl_visits *visits,
                       knurl_contact *nearest) {
    struct {
        float distance2;
        uint32_t index;
    } stack[KNURL_BVH_DEPTH_MAX];
    uint32_t top = 0;
    const double limit2 = radius * radius * (1.0 + 1e-12) + 1e-300; /* a point at `radius` counts, also at 0 */
    double best2 = limit2;
    float limit = round_up(best2);
    double low[3], high[3];
    knurl_search_point point;
    knurl_leaf_point lanes;
    knurl_bvh_bound(p, p, sqrt(limit2), low, high);
    knurl_search_point_set(p, &point);
    knurl_leaf_point_set(p, &lanes);
    stack[top].index = knurl_mesh_find_part(mesh, low, high, visits, part)->node;
    stack[top].distance2 = knurl_search_node_distance2(&point, &mesh->nodes[stack[top].index]);
    top++;
    while (top > 0) {
        uint32_t index = stack[--top].index;
        float distance2 = stack[top].distance2;
        while (distance2 < limit) {
            const knurl_bvh_node *node = &mesh->nodes[index];
            if (!knurl_visits_take(visits, 2 + node->count)) { /* the boxes of a node's children count too */
                return best2 < limit2;
            }
            if (node->count > 0) {
                best2 = closest_in_leaf(mesh, node, p, &lanes, best2, visits, nearest);
                limit = round_up(best2);
                break;
            }
            const uint32_t children[2] = {index + 1, node->first};
            const float distances2[2] = {knurl_search_node_distance2(&point, &mesh->nodes[children[0]]),
                                         knurl_search_node_distance2(&point, &mesh->nodes[children[1]])};
            const int right_first = distances2[1] < distances2[0]; /* the nearer child is visited first */
            fetch_next(mesh, &mesh->nodes[children[0]]);
            fetch_next(mesh, &mesh->nodes[children[1]]);
            stack[top].index = right_first ? children[0] : children[1];
            stack[top].distance2 = right_first ? distances2[0] : distances2[1];
            top += stack[top].distance2 < limit;
            index = right_first ? children[1] : children[0];
            distance2 = right_first ? distances2[1] : distances2[0];
        }
    }
    return best2 < limit2;
}

/* 1 if a segment is on one side of a triangle's plane, by more than rounding and the slack of hit_triangle(). */
static int is_on_one_side(const double edge1[3], const double edge2[3], const double from[3],
                          const double direction[3]) {
    double normal[3];
    vec3_cross(edge1, edge2, normal);
    const double start = vec3_dot(from, normal);
    const double rise = vec3_dot(direction, normal);
    double size = 0.0;
    for (int i = 0; i < 3; i++) {
        size += (fabs(from[i]) + fabs(direction[i])) * fabs(normal[i]);
    }
    const double margin = 1e-6 * fabs(rise) + 1e-12 * size;
    return (start > margin && start + rise > margin) || (start < -margin && start + rise < -margin);
}

/* Parameter s at which a + s (b - a) hits a triangle (Moeller and Trumbore 1997), or 2 if it does not before `best`.
 * Edges are widened by 1e-7 of the triangle, so that nothing slips between two neighbours. */
static double hit_triangle(const double corners[3][3], const double a[3], const double direction[3], double best,
                           int double_sided, int *side) {
    double edge1[3], edge2[3], p[3], q[3], from[3];
    const double slack = 1e-7;
    vec3_sub(corners[1], corners[0], edge1);
    vec3_sub(corners[2], corners[0], edge2);
    vec3_sub(a, corners[0], from);
    if (is_on_one_side(edge1, edge2, from, direction)) {
        return 2.0;
    }
    vec3_cross(direction, edge2, p);
    const double det = vec3_dot(edge1, p); /* above 0 if the segment enters from the front */
    if (det == 0.0 || (det < 0.0 && !double_sided)) {
        return 2.0;
    }
    const double inverse = 1.0 / det;
    vec3_cross(from, edge1, q);
    const double u = vec3_dot(from, p) * inverse;
    const double v = vec3_dot(direction, q) * inverse;
    const double s = vec3_dot(edge2, q) * inverse;
    if (!(u >= -slack && v >= -slack && u + v <= 1.0 + slack && s >= -slack && s <= 1.0 + slack && s < best)) {
        return 2.0;
    }
    *side = det > 0.0 ? 1 : -1;
    return s;
}

int knurl_mesh_cross(const knurl_mesh *mesh, const double a[3], const double b[3], int double_sided, knurl_part *part,
                     knurl_visits *visits, uint32_t *triangle) {
    knurl_mesh_search search;
    knurl_search_box box;
    double direction[3], low[3], high[3];
    double best = 1.5;
    int side = 0;
    uint32_t at;
    vec3_sub(b, a, direction);
    knurl_bvh_bound(a, b, 1e-7 * vec3_length(direction) + 1e-9, low, high);
    knurl_search_box_set(low, high, &box);
    knurl_mesh_search_begin(&search, mesh, low, high, visits, part);
    while (knurl_mesh_search_next(&search, &box, &at) && knurl_visits_take(visits, 1)) {
        double corners[3][3];
        knurl_mesh_corners(mesh, at, corners);
        const double s = hit_triangle((const double (*)[3])corners, a, direction, best, double_sided, &side);
        if (s < best) {
            best = s;
            *triangle = at;
        }
    }
    return best < 1.5 ? side : 0;
}

/* Triangles that knurl_mesh_exceeds_visits() samples: a place with many overlapping triangles gets many of them. */
#define SAMPLES 64

/* m: motion of a fast hand in a tick. */
#define SAMPLE_STEP 1e-3

/* 1 if contact at p exceeds its share of visits: half of a tick's in front, a quarter for one of several casts. */
static int exceeds_visits_at(const knurl_mesh *mesh, const double p[3], const double normal[3], double reach,
                             uint32_t max_visits) {
    knurl_visits nearest = {max_visits / 2, 0};
    knurl_visits crossing = {max_visits / 4, 0};
    knurl_contact found;
    uint32_t triangle;
    double front[3], behind[3];
    vec3_madd(p, reach, normal, front);
    (void)knurl_mesh_closest(mesh, front, reach, NULL, &nearest, &found);
    vec3_madd(p, 0.5 * SAMPLE_STEP, normal, front);
    vec3_madd(p, -0.5 * SAMPLE_STEP, normal, behind);
    (void)knurl_mesh_cross(mesh, front, behind, 0, NULL, &crossing, &triangle);
    return nearest.exhausted || crossing.exhausted;
}

int knurl_mesh_exceeds_visits(const knurl_mesh *mesh, double reach, uint32_t max_visits) {
    static const double nowhere[3] = {0.0, 0.0, 0.0};
    const uint32_t samples = mesh->triangle_count < SAMPLES ? mesh->triangle_count : SAMPLES;
    double middle[3];
    for (int i = 0; i < 3; i++) {
        middle[i] = 0.5 * ((double)mesh->nodes[0].min[i] + (double)mesh->nodes[0].max[i]);
    }
    int exceeds = exceeds_visits_at(mesh, middle, nowhere, reach, max_visits);
    for (uint32_t i = 0; i < samples && !exceeds; i++) {
        knurl_triangle t;
        knurl_mesh_triangle(mesh, (uint32_t)((uint64_t)i * mesh->triangle_count / samples), &t);
        for (int k = 0; k < 3; k++) {
            middle[k] = (t.corners[0][k] + t.corners[1][k] + t.corners[2][k]) / 3.0;
        }
        exceeds = exceeds_visits_at(mesh, middle, t.normal, reach, max_visits);
    }
    return exceeds;
}

/* The first front face on, then beside, then under the middle of the bounds; else the point nearest to the middle. */
static void find_front_face(const knurl_mesh *mesh, const double rotation[9], knurl_contact *anchor) {
    static const double from[6][3] = {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 0, 0}, {0, 0, -1}, {0, -1, 0}};
    double centre[3];
    double size = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        centre[axis] = 0.5 * ((double)mesh->nodes[0].min[axis] + (double)mesh->nodes[0].max[axis]);
        size += (double)mesh->nodes[0].max[axis] - (double)mesh->nodes[0].min[axis];
    }
    for (int i = 0; i < 6; i++) {
        double direction[3];
        double outside[3];
        double opposite[3];
        knurl_triangle t;
        mat3_mul_transposed(rotation, from[i], direction);
        vec3_madd(centre, size, direction, outside);
        vec3_madd(centre, -size, direction, opposite);
        if (knurl_mesh_cross(mesh, outside, opposite, 0, NULL, NULL, &anchor->triangle)) {
            knurl_mesh_triangle(mesh, anchor->triangle, &t);
            double offset[3];
            vec3_sub(t.corners[0], outside, offset);
            const double s = vec3_dot(offset, t.normal) / vec3_dot(direction, t.normal);
            vec3_madd(outside, s, direction, anchor->proxy);
            return;
        }
    }
    (void)knurl_mesh_closest(mesh, centre, 2.0 * size, NULL, NULL, anchor);
}

void knurl_mesh_anchor(const knurl_mesh *mesh, const double rotation[9], knurl_contact *anchor) {
    knurl_triangle t;
    memset(anchor, 0, sizeof *anchor);
    find_front_face(mesh, rotation, anchor);
    /* query the nearest point, for its weights and its face's normal */
    (void)knurl_mesh_closest(mesh, anchor->proxy, 1e-6 + 1e-5 * vec3_length(anchor->proxy), NULL, NULL, anchor);
    knurl_mesh_triangle(mesh, anchor->triangle, &t);
    vec3_copy(t.normal, anchor->normal);
}
