/* Contact where several surfaces are near a HIP, or one that touches itself: the proxy is held by every face that it
 * has not crossed from the front, of whatever surface.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_JOINT_CONTACT_H
#define KNURL_SRC_JOINT_CONTACT_H

#include "proxy/contacts.h"

/* m: surfaces within this of a path count as near it, and a proxy goes no farther in the tick. */
static inline double knurl_hip_path_margin(const knurl_hip_path *path) {
    return 1e-5 + 2.0 * sqrt(vec3_distance2(path->from, path->to));
}

/* Finds the contacts with what a path comes near. Adds to *flags: KNURL_TICK_CONTACTS_FULL, KNURL_TICK_SQUEEZED. */
void knurl_joint_contact(knurl_contacts *contacts, const knurl_broad_index *index, const knurl_hip_path *path,
                         uint32_t *flags) KNURL_NONBLOCKING;

#endif
