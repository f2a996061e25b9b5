/* The contact with a smooth mesh as it is felt. The mesh's triangles hold the proxy, so that nothing depends on how
 * smooth the mesh is but the force. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_FELT_H
#define KNURL_SRC_FELT_H

#include "proxy/contacts.h"

/* Adds the push of a smooth mesh's face to those of its surface, or as another part. is_most: 1: of all faces, it
 * pushes most. */
void knurl_felt_add_part(const knurl_mesh *mesh, uint32_t triangle, const double push[3], int is_most,
                         knurl_felt_parts *parts) KNURL_NONBLOCKING;

/* Changes a contact with a smooth mesh's triangles to the one with its surface, for the force. Returns 0 if the HIP is
 * not that deep yet. */
int knurl_felt_find(knurl_active_contact *contact) KNURL_NONBLOCKING;

#endif
