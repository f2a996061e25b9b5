/* The god-object (Zilles and Salisbury 1995): a point that stays outside all surfaces near a HIP, as near to the HIP as
 * the faces in between allow. It only moves along segments that hit nothing, so it never enters a surface. It stays
 * above a face by the shape's seam, so that neither rounding nor a slightly higher neighbour puts it behind the face.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_GOD_OBJECT_H
#define KNURL_SRC_GOD_OBJECT_H

#include "proxy/active_faces.h"
#include "proxy/contacts.h"

typedef struct knurl_god_object {
    double at[3]; /* scene */
    knurl_active_faces faces;
    int32_t squeezed; /* 1: a surface has moved over it, because another blocked its path */
} knurl_god_object;

/* Pushes the object out of surfaces that moved through it in this tick. */
void knurl_god_object_push(knurl_god_object *g, const knurl_obstacles *obstacles) KNURL_NONBLOCKING;

/* Moves the object as near to the HIP as possible. `faces` are those that hold it back; empty if it arrives. */
void knurl_god_object_follow(knurl_god_object *g, const knurl_obstacles *obstacles,
                             const double hip[3]) KNURL_NONBLOCKING;

/* After leaving a surface: casts from `above` to the HIP and lands on the first face within 60 degrees of `normal`.
 * Returns 0 if there is no such face. */
int knurl_god_object_step_down(knurl_god_object *g, const knurl_obstacles *obstacles, const double above[3],
                               const double normal[3], const double hip[3]) KNURL_NONBLOCKING;

/* 1 if the segment between two resting places hits only `except` within the tick or, if no surface moves, nothing that
 * a small hop does not clear. normals: at the two places. */
int knurl_god_object_can_go(const knurl_obstacles *obstacles, const double from[3], const double from_normal[3],
                            const double to[3], const double to_normal[3], uint32_t except) KNURL_NONBLOCKING;

#endif
