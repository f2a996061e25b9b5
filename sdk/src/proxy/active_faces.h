/* The faces that hold a proxy back, up to three at once, and the allowed point nearest to the HIP: the god-object's
 * constraints (Zilles and Salisbury 1995). Pure.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_ACTIVE_FACES_H
#define KNURL_SRC_ACTIVE_FACES_H

#include "base/vec3.h"
#include "contact/contact.h"

#include <knurl/base.h>

/* Where more planes meet in a point, three hold it. */
#define KNURL_ACTIVE_FACES_MAX 3

/* A face as a constraint, scene axes: normal * x >= offset. */
typedef struct knurl_active_face {
    double normal[3];   /* unit */
    double offset;      /* m */
    double rest;        /* m: of it, how far above the face a proxy rests */
    double press;       /* m: how much of the way from the HIP to the proxy is this face's (a Lagrange multiplier) */
    knurl_cast_hit hit; /* shape's frame */
    uint32_t obstacle;  /* whose face it is */
} knurl_active_face;

typedef struct knurl_active_faces {
    knurl_active_face list[KNURL_ACTIVE_FACES_MAX];
    uint32_t count;
} knurl_active_faces;

/* The point nearest to a target of all that the faces allow; sets how much each presses. 0 where there is none. */
int knurl_active_faces_project(knurl_active_faces *faces, const double target[3], double nearest[3]) KNURL_NONBLOCKING;

/* One more: in place of one that it is parallel to, or of the one that presses least. */
void knurl_active_faces_add(knurl_active_faces *faces, const knurl_active_face *face) KNURL_NONBLOCKING;

#endif
