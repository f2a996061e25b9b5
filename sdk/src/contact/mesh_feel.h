/* The contact with a smooth mesh as it is felt. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_MESH_FEEL_H
#define KNURL_SRC_MESH_FEEL_H

#include "contact/facet.h"

/* Changes a contact with a mesh's triangles to one with the smooth surface. It moves from the contact's point to the
 * one whose normal goes through the HIP, over at most a few triangles and no hard edge. side: the contact's, +1 or -1.
 * Sets the contact's facet to `facet`, the plane that touches the patch there. Does nothing on a flat triangle. */
void knurl_mesh_feel(const knurl_mesh *mesh, int32_t side, knurl_contact *contact,
                     knurl_facet *facet) KNURL_NONBLOCKING;

/* 1 if two triangles belong to one smooth surface: they are the same, or share a corner and its normal. */
int knurl_mesh_continues(const knurl_mesh *mesh, uint32_t triangle, uint32_t other) KNURL_NONBLOCKING;

#endif
