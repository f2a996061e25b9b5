/* Casts a segment against a triangle mesh. Unlike in the search for crossings of mesh_query.c, tolerances are lengths:
 * every triangle extends beyond its edges by the same distance, and a segment may start behind a face by a rounding
 * error.
 * SPDX-License-Identifier: MIT */
#include "contact/mesh_cast.h"

#include "contact/closest_point.h"
#include "contact/mesh_search.h"

/* 1 if a point in the triangle's plane is at most `seam` beyond each edge and outside of the triangle's box: the edges
 * alone would extend a sliver far beyond its tips. inside: as for knurl_closest_on_edges(). */
static int is_near_triangle(const double corners[3][3], const double p[3], const double inside[2], double cross2,
                            double seam) {
    double bc[3], ac[3], ab[3];
    vec3_sub(corners[2], corners[1], bc);
    vec3_sub(corners[2], corners[0], ac);
    vec3_sub(corners[1], corners[0], ab);
    const double size = seam * sqrt(cross2);
    if (!(inside[0] >= -size * vec3_length(ac) && inside[1] >= -size * vec3_length(ab) &&
          cross2 - inside[0] - inside[1] >= -size * vec3_length(bc))) {
        return 0;
    }
    for (int axis = 0; axis < 3; axis++) {
        const double a = corners[0][axis], b = corners[1][axis], c = corners[2][axis];
        const double low = a < b ? a : b, high = a < b ? b : a;
        if (p[axis] < (low < c ? low : c) - seam || p[axis] > (high > c ? high : c) + seam) {
            return 0;
        }
    }
    return 1;
}

/* Bounding box of a cast from its start to a point on it. */
static void bound(const knurl_mesh *mesh, const knurl_cast *cast, const double to[3], double low[3], double high[3]) {
    knurl_bvh_bound(cast->from, to, mesh->facts.seam + KNURL_CAST_SLACK, low, high);
}

/* 1 if a segment hits a triangle before `hit`, which is then replaced. */
static int cast_at(const knurl_mesh *mesh, uint32_t triangle, const knurl_cast *cast, const double way[3],
                   knurl_cast_hit *hit) {
    double corners[3][3], ab[3], ac[3], cross[3], from[3], across[3], point[3];
    knurl_mesh_corners(mesh, triangle, corners);
    vec3_sub(corners[1], corners[0], ab);
    vec3_sub(corners[2], corners[0], ac);
    vec3_cross(ab, ac, cross);
    vec3_sub(cast->from, corners[0], from);
    const double before = vec3_dot(from, cross);
    const double rise = vec3_dot(way, cross);
    const int side = rise < 0.0 ? 1 : -1;
    const double cross2 = vec3_dot(cross, cross);
    const int misses = side * (before + rise) >= 0.0 || (side < 0 && !cast->double_sided) || rise == 0.0;
    if (misses || (side * before < 0.0 && before * before > KNURL_CAST_SLACK * KNURL_CAST_SLACK * cross2)) {
        return 0;
    }
    const double share = side * before > 0.0 ? -before / rise : 0.0;
    if (!(share < hit->share)) {
        return 0;
    }
    vec3_madd(cast->from, share, way, point);
    vec3_madd(from, share, way, from);
    vec3_cross(cross, from, across);
    const double inside[2] = {vec3_dot(across, ac), -vec3_dot(across, ab)};
    if (!(inside[0] >= 0.0 && inside[1] >= 0.0 && inside[0] + inside[1] <= cross2) &&
        !is_near_triangle((const double (*)[3])corners, point, inside, cross2, mesh->facts.seam)) {
        return 0;
    }
    const double size = sqrt(cross2);
    hit->share = share;
    hit->height = side * before / size;
    hit->triangle = triangle;
    hit->side = side;
    vec3_copy(point, hit->point);
    vec3_scale(side / size, cross, hit->normal);
    return 1;
}

int knurl_mesh_cast(const knurl_mesh *mesh, const knurl_cast *cast, knurl_cast_hit *hit) {
    knurl_mesh_search search;
    knurl_search_box box;
    double way[3], low[3], high[3];
    uint32_t triangle;
    vec3_sub(cast->to, cast->from, way);
    bound(mesh, cast, cast->to, low, high);
    knurl_search_box_set(low, high, &box);
    hit->share = 1.5;
    knurl_mesh_search_begin(&search, mesh, low, high, cast->visits, cast->part);
    while (knurl_mesh_search_next(&search, &box, &triangle) && knurl_visits_take(cast->visits, 1)) {
        if (cast_at(mesh, triangle, cast, way, hit)) { /* continue only before this hit */
            bound(mesh, cast, hit->point, low, high);
            knurl_search_box_set(low, high, &box);
        }
    }
    return hit->share < 1.5;
}

void knurl_mesh_rest(const knurl_mesh *mesh, const knurl_cast_hit *hit, const double point[3],
                     knurl_contact_state *state, knurl_contact *contact) {
    knurl_closest_point closest;
    knurl_closest_on_triangle(mesh, hit->triangle, point, &closest);
    vec3_copy(closest.point, contact->proxy);
    vec3_copy(closest.weights, contact->weights);
    contact->triangle = hit->triangle;
    state->inside = 1;
    state->side = hit->side;
    state->triangle = hit->triangle;
}
