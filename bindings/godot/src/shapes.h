/* Shapes that surfaces share: a mesh at one scale is read, and its tree built, once for each device.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_SHAPES_H
#define KNURL_GODOT_SHAPES_H

#include "world.h"

/* Everything that a surface's shape depends on. */
typedef struct shape_key {
    GDObjectInstanceID mesh; /* 0: not to be shared */
    float rest[9], axis[3];  /* rounded, because decompositions of equal scales differ in their last bits */
    int32_t smooth;
    uint16_t box_coordinates, slot; /* the device's */
} shape_key;

shape_key shapes_key(const surface *s, const double rest[9], int slot);

/* The shape for a key, which has a user in the device's scene; or null. */
shape *shapes_find(const shape_key *key);

/* The id of a surface that has that shape. */
knurl_surface_id shapes_user(const shape *shared);

/* The surface has taken a shape: `shared`, or one that it has read if that is null. */
void shapes_join(surface *s, const shape_key *key, shape *shared);

/* The surface's mesh has changed, or may have: its shapes are not found again. */
void shapes_expire(const surface *s);

/* The surface has left the device's scene, or takes another shape there. */
void shapes_leave(surface *s, int slot);

#endif
