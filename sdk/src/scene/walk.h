/* Paths over a surface, for a simulated hand to follow. Game thread; nothing in a tick.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_WALK_H
#define KNURL_SRC_WALK_H

#include "scene/surface_frame.h"

/* A finger that is led over a surface step by step, pressed in as deep as a step is long: its contact is found as a
 * tick finds it. In the shape's frame. Copy it to come back to where it was. */
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

/* Sets the finger down on a point of the surface (m) whose outward normal is known. 0: there is no surface to hold it.
 */
int knurl_walker_begin(knurl_walker *walker, const knurl_surface_data *surface, double step, const double place[3],
                       const double normal[3]);

/* One step along `direction` (unit, tangent). 0, and the walker stays where it was: the surface ends there, or turns by
 * more than 60 degrees. */
int knurl_walker_go(knurl_walker *walker, const double direction[3]);

/* How fast the surface's first coordinate grows along `direction`, against metres; 1 where it has none. */
double knurl_walker_stretch(const knurl_walker *walker, const double direction[3]);

#endif
