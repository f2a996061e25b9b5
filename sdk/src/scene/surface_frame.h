/* Surface coordinates: which way x and y run at a contact, and where on the grating it is. SPDX-License-Identifier: MIT
 */
#ifndef KNURL_SRC_SURFACE_FRAME_H
#define KNURL_SRC_SURFACE_FRAME_H

#include "scene/surface.h"

/* A surface's tangent frame at a contact, in the shape's frame. x, y: unit, tangent to the contact's normal.
 * coordinates: m, what S1 looks up. */
void knurl_surface_frame(const knurl_surface_data *surface, const knurl_record *record, const knurl_contact *contact,
                         double x[3], double y[3], double coordinates[2]) KNURL_NONBLOCKING;

/* How fast those coordinates change (m/s) where the HIP moves over the surface at `velocity` (m/s, shape's frame), and
 * by how much at most in a metre along the surface. 0, and untouched, where there are no coordinates. */
int knurl_surface_rates(const knurl_surface_data *surface, const knurl_record *record, const knurl_contact *contact,
                        const double velocity[3], double rates[2], double *steepest) KNURL_NONBLOCKING;

#endif
