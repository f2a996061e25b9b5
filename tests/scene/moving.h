/* A HIP at rest, and a plane that moves under it. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_MOVING_H
#define KNURL_TEST_MOVING_H

#include "support/poses.h"

#define K   400.0 /* N/m, the default */
#define TOL 1e-9L

static const pose HOME = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}};

static pose at_height(double x, double y, double z) {
    pose p = HOME;
    p.position[0] = x;
    p.position[1] = y;
    p.position[2] = z;
    return p;
}

static surface_parts wide_plane(void) {
    surface_parts parts = surface_plane();
    parts.plane.half_extents[0] = parts.plane.half_extents[1] = 0.5;
    return parts;
}

/* A tick of HIP 0 at rest at a position. */
static knurl_tick_output stand_at(knurl_scene *scene, double x, double y, double z) {
    return tick_moving(scene, (const double[3]){x, y, z}, (const double[3]){0.0, 0.0, 0.0});
}

/* Raises a surface, not turned, to z at (0, 0). */
static inline void raise_to(knurl_scene *scene, knurl_surface_id id, double z, double seconds) {
    const pose there = at_height(0.0, 0.0, z);
    move_to(scene, id, &there, seconds);
}

/* HIP 0 stands 1 mm deep in it. */
static knurl_scene *stood_on(surface_parts *parts, knurl_surface_id *id) {
    knurl_scene *scene = scene_of(parts);
    *id = knurl_scene_get_surface(scene, 0);
    (void)stand_at(scene, 0.0, 0.0, -0.001);
    return scene;
}

static inline knurl_scene *stood_on_plane(knurl_surface_id *id) {
    surface_parts parts = wide_plane();
    return stood_on(&parts, id);
}

#endif
