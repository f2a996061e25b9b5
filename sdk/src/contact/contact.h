/* Contact of one HIP with one surface, in the surface's own frame: a frictionless proxy (god-object).
 * Everything here may run in a tick. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_CONTACT_H
#define KNURL_SRC_CONTACT_H

#include "contact/mesh.h"

/* A HIP that is seen for the first time counts as pressed in when it is at most this deep (m) behind a front face.
 * Later it must have come through the face. 10 mm: deeper than any hand presses before the force limit holds it. */
#define KNURL_CAPTURE_DEPTH 0.010

/* Closer to the proxy than this (m), the direction to it is noise: the triangle's normal is used. */
#define KNURL_NORMAL_DISTANCE 1e-6

/* So near (m), a HIP is on the surface, and contact keeps the side that it came from: positions that are multiples of
 * an encoder's count stop on surfaces exactly, give or take what rounding adds. */
#define KNURL_ON_SURFACE 1e-9

/* What contact remembers from tick to tick. Zero: not in contact. */
typedef struct knurl_contact_state {
    int32_t inside;    /* 1: the HIP has come through the surface, or stands on it */
    int32_t side;      /* +1: from the front; -1: from behind (double-sided); 0: not in contact */
    uint32_t triangle; /* where the proxy was */
} knurl_contact_state;

/* What is asked at a tick. */
typedef struct knurl_contact_query {
    double hip[3];
    double previous[3];   /* where the HIP was a tick ago, in the same frame */
    double reach;         /* m in front of the surface that count as contact: the highest crest */
    int32_t has_previous; /* 0: a first tick; KNURL_CAPTURE_DEPTH applies */
    int32_t double_sided;
} knurl_contact_query;

typedef struct knurl_contact {
    double proxy[3];
    double normal[3];  /* unit, towards the side that the HIP came from */
    double z;          /* m along the normal, negative inside */
    double weights[3]; /* mesh: barycentric coordinates of the proxy */
    uint32_t triangle; /* mesh: which; plane: 0 */
} knurl_contact;

/* 1 and a contact while the HIP is inside, on the surface (KNURL_ON_SURFACE) or within reach, else 0 and a zeroed
 * state. */
int knurl_mesh_contact(const knurl_mesh *mesh, const knurl_contact_query *query, knurl_contact_state *state,
                       knurl_contact *contact) KNURL_NONBLOCKING;

/* The surface's tangent frame at a contact (unit, tangent to the contact's normal, y = n x x), by the axis, else by
 * tangents or uvs, and where on the grating it is (m; 0 without an axis and uvs). Allowed in a tick. */
void knurl_mesh_frame(const knurl_mesh *mesh, const knurl_contact *contact, double x[3], double y[3],
                      double coordinates[2]) KNURL_NONBLOCKING;

/* How fast those coordinates change (m/s) where the HIP moves at `velocity` (m/s), and by how much at most in a metre
 * along the surface. 0 and untouched without an axis where the uvs have no area. Allowed in a tick. */
int knurl_mesh_rates(const knurl_mesh *mesh, const knurl_contact *contact, const double velocity[3], double rates[2],
                     double *steepest) KNURL_NONBLOCKING;

/* The nearest point of the mesh within `radius` of p; 0 where there is none. Fills in proxy, weights and triangle. */
int knurl_mesh_closest(const knurl_mesh *mesh, const double p[3], double radius,
                       knurl_contact *nearest) KNURL_NONBLOCKING;

/* A place for a stroke to begin: the first front face on, then beside, then under the mesh, as the scene sees it by
 * `rotation` (row-major, from the mesh's axes to the scene's). A zeroed contact but for proxy, normal, weights and
 * triangle. */
void knurl_mesh_anchor(const knurl_mesh *mesh, const double rotation[9], knurl_contact *anchor);

/* Where the segment from a to b first goes through a triangle: from the front, or from either side. Returns the side
 * (+1, -1) or 0 for none. */
int knurl_mesh_cross(const knurl_mesh *mesh, const double a[3], const double b[3], int double_sided,
                     uint32_t *triangle) KNURL_NONBLOCKING;

#endif
