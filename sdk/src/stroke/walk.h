/* Paths over a surface, for a simulated hand to follow. Game thread; nothing in a tick.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_WALK_H
#define KNURL_SRC_WALK_H

#include "surface/surface_frame.h"

/* Follows a surface step by step, pressed in by one step's length; contact is found as in a tick. In the shape's frame.
 * Copy it to return to a place. */
typedef struct knurl_walker {
    const knurl_surface_data *surface;
    double step; /* m */
    knurl_contact_state state;
    double hip[3];
    double place[3];  /* on the surface */
    double normal[3]; /* outward, unit */
    double x[3];      /* the grating's, unit, tangent */
    double y[3];      /* normal x x */
    knurl_contact contact;
} knurl_walker;

/* Starts at a point of the surface (m) with a known outward normal. Returns 0 if the surface does not hold it. */
int knurl_walker_begin(knurl_walker *walker, const knurl_surface_data *surface, double step, const double place[3],
                       const double normal[3]);

/* One step along `direction` (unit, tangent). Returns 0, without moving, if the surface ends or bends by more than 60
 * degrees. */
int knurl_walker_go(knurl_walker *walker, const double direction[3]);

/* Growth of the surface's first coordinate per metre along `direction`; 1 if it has no coordinates. */
double knurl_walker_stretch(const knurl_walker *walker, const double direction[3]);

#endif
