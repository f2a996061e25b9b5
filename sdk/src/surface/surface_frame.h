/* Surface coordinates at a contact: directions of x and y, and the position on the grating.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_SURFACE_FRAME_H
#define KNURL_SRC_SURFACE_FRAME_H

#include "surface/surface.h"

/* A surface's tangent frame at a contact, in the shape's frame. x, y: unit, tangent to the contact's normal.
 * coordinates: for knurl_surface_coordinates(). */
static inline void knurl_surface_frame(const knurl_surface_data *surface, const knurl_record *record,
                                       const knurl_contact *contact, double x[3], double y[3], double coordinates[2]) {
    knurl_shape_frame(&surface->shape, contact, x, y, coordinates);
    if (record->is_oriented) {
        const double c = record->cos_sin[0];
        const double s = record->cos_sin[1];
        for (int i = 0; i < 3; i++) {
            const double along = x[i];
            x[i] = c * along + s * y[i];
            y[i] = c * y[i] - s * along;
        }
    }
}

/* The contact's position on the grating, m, as method S1 uses it. After knurl_surface_frame(), with its coordinates.
 * begins, carry: as for knurl_mesh_carry(). */
static inline void knurl_surface_coordinates(const knurl_surface_data *surface, const knurl_record *record,
                                             const knurl_contact *contact, int begins, knurl_projection_carry *carry,
                                             double coordinates[2]) {
    if (surface->shape.plane) {
        knurl_plane_coordinates(surface->shape.plane, contact, coordinates);
    } else if (surface->shape.is_projected) {
        double carried[2] = {coordinates[0], coordinates[1]}; /* a copy, see force_law.h */
        knurl_mesh_carry(surface->shape.mesh, contact, begins, carry, carried);
        coordinates[0] = carried[0];
        coordinates[1] = carried[1];
    }
    if (record->is_oriented) { /* rotates the frame, so the coordinates rotate back */
        const double c = record->cos_sin[0];
        const double s = record->cos_sin[1];
        const double place[2] = {coordinates[0], coordinates[1]};
        coordinates[0] = c * place[0] + s * place[1];
        coordinates[1] = c * place[1] - s * place[0];
    }
}

/* Rates of those coordinates (m/s) while the HIP moves over the surface at `velocity` (m/s, shape's frame). Returns 0,
 * with the outputs untouched, if there are no coordinates. */
static inline int knurl_surface_rates(const knurl_surface_data *surface, const knurl_record *record,
                                      const knurl_contact *contact, const double velocity[3], double rates[2]) {
    double straight[2];
    if (!knurl_shape_rates(&surface->shape, contact, velocity, straight)) {
        return 0;
    }
    rates[0] = straight[0];
    rates[1] = straight[1];
    if (record->is_oriented) {
        rates[0] = record->cos_sin[0] * straight[0] + record->cos_sin[1] * straight[1];
        rates[1] = record->cos_sin[0] * straight[1] - record->cos_sin[1] * straight[0];
    }
    return 1;
}

#endif
