/* Contact with a triangle mesh. Everything here is allowed in a tick. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_MESH_CONTACT_H
#define KNURL_SRC_MESH_CONTACT_H

#include "contact/contact.h"
#include "contact/mesh.h"

/* Returns 1 and a contact while the HIP is inside, on the surface (KNURL_ON_SURFACE) or within reach, else 0 and a
 * zeroed state. */
int knurl_mesh_contact(const knurl_mesh *mesh, const knurl_contact_query *query, knurl_contact_state *state,
                       knurl_contact *contact) KNURL_NONBLOCKING;

#endif
