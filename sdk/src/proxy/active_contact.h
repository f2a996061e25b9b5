/* One surface that a HIP is in contact with. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_ACTIVE_CONTACT_H
#define KNURL_SRC_ACTIVE_CONTACT_H

#include "proxy/felt_parts.h"
#include "proxy/obstacles.h"

/* Of this tick; its pointers are invalid after it, unless it is steady. */
typedef struct knurl_active_contact {
    const knurl_surface_data *surface;
    const knurl_record *record;
    knurl_candidate *candidate; /* state kept from tick to tick, with the contact's proxy and normal */
    const knurl_pose *pose;     /* of the shape's frame, now */
    knurl_contact contact;      /* shape's frame */
    double share;               /* of its ridges and damping; 1 if it is alone */
    double friction_share;      /* of its friction; 1 if it is alone */
    uint64_t steady;   /* `edits` of `record`, if this was the only contact in the last tick and stands still; else 0 */
    double seam;       /* m: the shape's, while it slides */
    int32_t slides;    /* 1: steady, and its rectangle or cached facet held the HIP: see knurl_contacts_slide() */
    int32_t begins;    /* 1: not in contact at the last tick */
    int32_t is_unfelt; /* 1: in contact with a smooth mesh's triangles, but not with its surface */
    const double *normal; /* as felt, scene: the candidate's, or that of `felt` */
    struct {              /* on a smooth mesh, whose triangles hold the proxy */
        knurl_felt_parts parts;
        double normal[3];  /* scene */
        knurl_facet facet; /* the plane that touches the surface there */
    } felt;
} knurl_active_contact;

#endif
