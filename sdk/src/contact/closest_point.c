/* Closest point on the edges of a triangle. SPDX-License-Identifier: MIT */
#include "contact/closest_point.h"

/* Sets the weights of a point between corners i and j (along: 0 at i, 1 at j; clamped); returns its feature. */
static unsigned set_between(unsigned i, unsigned j, double along, double weights[3]) {
    weights[j] = along < 0.0 ? 0.0 : along < 1.0 ? along : 1.0;
    weights[i] = 1.0 - weights[j];
    return (weights[i] != 0.0 ? 1u << i : 0) | (weights[j] != 0.0 ? 1u << j : 0);
}

void knurl_closest_on_edges(const double p[3], const double inside[2], knurl_closest_point *closest) {
    const double *a = closest->corners[0];
    double ab[3], ac[3], ap[3], bc[3], bp[3];
    vec3_sub(closest->corners[1], a, ab);
    vec3_sub(closest->corners[2], a, ac);
    vec3_sub(p, a, ap);
    vec3_sub(closest->corners[2], closest->corners[1], bc);
    vec3_sub(p, closest->corners[1], bp);
    const double b_a = vec3_dot(ab, ap), c_a = vec3_dot(ac, ap);  /* p projected on the edges from a to b and c, */
    const double a_b = -vec3_dot(ab, bp), c_b = vec3_dot(bc, bp); /* from b to a and c, */
    const double ab2 = vec3_dot(ab, ab), ac2 = vec3_dot(ac, ac), bc2 = vec3_dot(bc, bc);
    const double a_c = ac2 - c_a, b_c = bc2 - c_b; /* and from c to a and b */
    double *w = closest->weights;
    w[0] = w[1] = w[2] = 0.0;
    if (b_a <= 0.0 && c_a <= 0.0) {
        closest->feature = set_between(0, 1, 0.0, w);
    } else if (a_b <= 0.0 && c_b <= 0.0) {
        closest->feature = set_between(1, 2, 0.0, w);
    } else if (a_c <= 0.0 && b_c <= 0.0) {
        closest->feature = set_between(2, 0, 0.0, w);
    } else if (inside[1] <= 0.0 && b_a >= 0.0 && a_b >= 0.0) {
        closest->feature = set_between(0, 1, b_a / ab2, w);
    } else if (inside[0] <= 0.0 && c_a >= 0.0 && a_c >= 0.0) {
        closest->feature = set_between(0, 2, c_a / ac2, w);
    } else {
        closest->feature = set_between(1, 2, c_b / bc2, w);
    }
    for (int axis = 0; axis < 3; axis++) {
        closest->point[axis] =
            w[0] * closest->corners[0][axis] + w[1] * closest->corners[1][axis] + w[2] * closest->corners[2][axis];
    }
    vec3_sub(p, closest->point, closest->offset);
    closest->distance2 = vec3_dot(closest->offset, closest->offset);
}
