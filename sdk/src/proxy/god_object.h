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
    int32_t squeezed; /* 1: a surface has moved over it, because another was in the way */
} knurl_god_object;

/* Moves it out of the way of what has moved over the place where it was a tick ago. */
void knurl_god_object_push(knurl_god_object *g, const knurl_obstacles *obstacles) KNURL_NONBLOCKING;

/* Moves it as near to the HIP as can be, and tells which faces keep it from there: none where it gets there. */
void knurl_god_object_follow(knurl_god_object *g, const knurl_obstacles *obstacles,
                             const double hip[3]) KNURL_NONBLOCKING;

/* It has come off a surface whose normal was `normal`: down onto what there is between a place above the HIP and the
 * HIP, if it faces about the same way. Returns 0 where there is none. */
int knurl_god_object_step_down(knurl_god_object *g, const knurl_obstacles *obstacles, const double above[3],
                               const double normal[3], const double hip[3]) KNURL_NONBLOCKING;

/* 1 where a way within the tick, from one place at rest to another, runs into nothing but `except`, or where all stand
 * still, into nothing that a small hop does not clear. normals: at the two places. */
int knurl_god_object_can_go(const knurl_obstacles *obstacles, const double from[3], const double from_normal[3],
                            const double to[3], const double to_normal[3], uint32_t except) KNURL_NONBLOCKING;

#endif
