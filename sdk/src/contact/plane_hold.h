/* Contact of a HIP that is held by a plane; inline, because a call would cost as much as the contact itself.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_PLANE_HOLD_H
#define KNURL_SRC_PLANE_HOLD_H

#include "base/base.h"
#include "contact/plane.h"

/* 1 if a rectangle that held a HIP still holds it. z: m, its height above the same side. */
static inline int knurl_plane_keeps(const knurl_plane *plane, const double hip[3], double z) {
    return z <= KNURL_ON_SURFACE && knurl_plane_spans(plane, hip);
}

/* Fast path of knurl_plane_contact(), with the same result: the HIP was inside, and still is below a rectangle, so that
 * its state stays as it is. Otherwise returns 0 and changes nothing. */
static inline int knurl_plane_hold(const knurl_plane *plane, const double hip[3], const knurl_contact_state *state,
                                   knurl_contact *contact) {
    const double side = state->side;
    const double z = hip[2] * side;
    if (KNURL_UNLIKELY(!state->inside || plane->outline || !knurl_plane_keeps(plane, hip, z))) {
        return 0;
    }
    knurl_plane_set_contact(hip, z, side, contact);
    contact->unsure = 0;
    return 1;
}

/* Tangent frame at a contact, in the plane's frame: unit, y = n x x. Allowed in a tick. */
static inline void knurl_plane_axes(const knurl_plane *plane, const knurl_contact *contact, double x[3], double y[3]) {
    const double side = contact->normal[2];
    x[0] = plane->x[0];
    x[1] = plane->x[1];
    y[0] = 0.0 - side * x[1]; /* avoids -0 */
    y[1] = side * x[0];
    x[2] = y[2] = 0.0;
}

/* Position on the grating (m; not rotated by the material's orientation). Allowed in a tick. */
static inline void knurl_plane_coordinates(const knurl_plane *plane, const knurl_contact *contact,
                                           double coordinates[2]) {
    const double *p = contact->proxy;
    for (int i = 0; i < 2; i++) {
        coordinates[i] = plane->map[i][0] * p[0] + plane->map[i][1] * p[1] + plane->map[i][2];
    }
    coordinates[1] *= contact->normal[2]; /* from behind, y is reversed */
}

/* Rates of change of those coordinates (m/s) at a velocity of the HIP (m/s). Returns 0 if the plane has no coordinates.
 * Allowed in a tick. */
static inline int knurl_plane_rates(const knurl_plane *plane, const knurl_contact *contact, const double velocity[3],
                                    double rates[2]) {
    for (int i = 0; i < 2; i++) {
        rates[i] = plane->map[i][0] * velocity[0] + plane->map[i][1] * velocity[1];
    }
    rates[1] *= contact->normal[2];
    return plane->has_coordinates;
}

#endif
