/* The forces of a wall, across and along it. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_FRICTION_H
#define KNURL_SRC_FRICTION_H

#include "base/base.h"
#include "guard/wall.h"
#include "proxy/contact_update.h"

/* Eq. 9 with the wall's damping, N; never a pull. share: of ridges and damping. outwards: m/s along the normal. */
static inline double knurl_normal_force(const knurl_wall *wall, double share, double outwards) {
    const double height = share * wall->height;
    if (wall->z >= height) {
        return 0.0;
    }
    const double size = wall->stiffness * (height - wall->z) - share * wall->damping * outwards;
    return KNURL_LIKELY(size > 0.0) ? size : 0.0;
}

/* Coulomb friction: the HIP drags an anchor along the surface by a spring of the wall's stiffness, and the anchor slips
 * if the spring would pull harder than friction holds. tangential: N, shape's frame. */
static inline void knurl_friction_force(const knurl_active_contact *c, const knurl_wall *wall, double tangential[3]) {
    const double friction = c->record->material.friction;
    const double depth = c->share > 0.0 ? -wall->z / c->share : 0.0; /* of all surfaces that hold the HIP */
    const double hold = depth > 0.0 ? friction * depth : 0.0;        /* m: longest spring that friction holds */
    double *anchor = c->candidate->anchor;
    double stretch[3] = {0.0, 0.0, 0.0};
    if (!c->begins && hold > 0.0) {
        vec3_sub(anchor, c->contact.proxy, stretch);
        vec3_make_tangent(c->contact.normal, stretch);
        const double length = vec3_length(stretch);
        if (length > hold) {
            vec3_scale(hold / length, stretch, stretch);
        }
    }
    vec3_madd(c->contact.proxy, 1.0, stretch, anchor);
    vec3_scale(wall->stiffness, stretch, tangential);
}

#endif
