/* The faces that hold a proxy back, up to three at once, and the allowed point nearest to the HIP: the god-object's
 * constraints (Zilles and Salisbury 1995). Pure. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_ACTIVE_FACES_H
#define KNURL_SRC_ACTIVE_FACES_H

#include "base/vec3.h"
#include "contact/contact.h"

#include <knurl/base.h>

/* Three planes fix a point, even if more of them meet there. */
#define KNURL_ACTIVE_FACES_MAX 3

/* A face as a constraint, scene axes: normal * x >= offset. */
typedef struct knurl_active_face {
    double normal[3];   /* unit */
    double offset;      /* m */
    double rest;        /* m: part of `offset`: the height above the face at which a proxy rests */
    double press;       /* m: this face's share of the displacement from the HIP to the proxy (a Lagrange multiplier) */
    knurl_cast_hit hit; /* shape's frame */
    uint32_t obstacle;  /* index of the obstacle that the face belongs to */
} knurl_active_face;

typedef struct knurl_active_faces {
    knurl_active_face list[KNURL_ACTIVE_FACES_MAX];
    uint32_t count;
} knurl_active_faces;

/* Finds the point nearest to a target that all faces allow, and sets `press` of each face. Returns 0 if there is no
 * such point. */
int knurl_active_faces_project(knurl_active_faces *faces, const double target[3], double nearest[3]) KNURL_NONBLOCKING;

/* Adds a face. It replaces a parallel one or, if the list is full, the one that presses least. */
void knurl_active_faces_add(knurl_active_faces *faces, const knurl_active_face *face) KNURL_NONBLOCKING;

#endif
