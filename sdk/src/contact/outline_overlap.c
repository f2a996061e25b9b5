/* Tests whether an outline goes around its sheet exactly once. SPDX-License-Identifier: MIT */
#include "contact/outline_overlap.h"

#include <math.h>

/* Distance (m) of a point to the left of an edge. */
static double left_of(const knurl_edge *edge, const double p[2]) {
    const double x = edge->to[0] - edge->from[0];
    const double y = edge->to[1] - edge->from[1];
    return (x * (p[1] - edge->from[1]) - y * (p[0] - edge->from[0])) / sqrt(x * x + y * y);
}

/* 1 if the ends of `other` lie on different sides of `edge`, both by more than the limit. */
static int separates(const knurl_edge *edge, const knurl_edge *other, double limit) {
    const double from = left_of(edge, other->from);
    const double to = left_of(edge, other->to);
    return fmin(fabs(from), fabs(to)) > limit && (from > 0.0) != (to > 0.0);
}

/* Winding number of the outline just left of the middle of an edge. The ray runs along x, or along y if the edge runs
 * more along x. */
static int winding_beside(const knurl_plane *plane, const knurl_edge *edge) {
    const double *a = edge->from;
    const double *b = edge->to;
    const int u = fabs(b[1] - a[1]) >= fabs(b[0] - a[0]) ? 0 : 1; /* axis of the ray */
    const int v = 1 - u;
    const double middle[2] = {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
    const int sign = u == 0 ? 1 : -1;                /* along y, left and right are exchanged */
    int winding = (b[v] > a[v]) == (u == 0) ? 1 : 0; /* of the edge itself, if the ray crosses it */
    for (uint32_t i = 0; i < plane->edge_count; i++) {
        const knurl_edge *e = &plane->outline[i];
        const int from_below = e->from[v] <= middle[v];
        const int to_below = e->to[v] <= middle[v];
        if (e != edge && from_below != to_below &&
            middle[u] < e->from[u] + (middle[v] - e->from[v]) * (e->to[u] - e->from[u]) / (e->to[v] - e->from[v])) {
            winding += from_below ? sign : -sign;
        }
    }
    return winding;
}

/* The number of triangles over a point is the winding number of the outline there. If no two edges cross, that number
 * is constant along an edge, and every region has an edge: one test beside each edge covers them all. (The sum of the
 * triangles' areas does not help: it equals the outline's signed area however they overlap.) */
int knurl_outline_is_simple(const knurl_plane *plane, double limit) {
    for (uint32_t i = 0; i < plane->edge_count; i++) {
        if (winding_beside(plane, &plane->outline[i]) != 1) {
            return 0;
        }
        for (uint32_t k = 0; k < i; k++) {
            if (separates(&plane->outline[i], &plane->outline[k], limit) &&
                separates(&plane->outline[k], &plane->outline[i], limit)) {
                return 0;
            }
        }
    }
    return 1;
}
