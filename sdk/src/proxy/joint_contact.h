/* Contact with several surfaces near a HIP, or with one that touches itself: every face that the proxy has not crossed
 * from its front holds it, whichever surface the face belongs to. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_JOINT_CONTACT_H
#define KNURL_SRC_JOINT_CONTACT_H

#include "proxy/contacts.h"

/* m: surfaces within this distance of a path are near it; a proxy moves no farther in the tick. */
static inline double knurl_hip_path_margin(const knurl_hip_path *path) {
    return 1e-5 + 2.0 * sqrt(vec3_distance2(path->from, path->to));
}

/* Finds the contacts of a path. Adds to *flags: KNURL_TICK_CONTACTS_FULL, KNURL_TICK_SQUEEZED. */
void knurl_joint_contact(knurl_contacts *contacts, const knurl_broad_index *index, const knurl_hip_path *path,
                         uint32_t *flags) KNURL_NONBLOCKING;

#endif
