/* Finds the contacts of a HIP in each tick. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_CONTACT_UPDATE_H
#define KNURL_SRC_CONTACT_UPDATE_H

#include "scene/contacts.h"

/* Before the first tick. period, time: s. */
void knurl_contacts_init(knurl_contacts *contacts, double period, double time);

/* No contact; the next tick is a first one. */
void knurl_contacts_reset(knurl_contacts *contacts) KNURL_NONBLOCKING;

/* From the HIP's position (scene, m) to the surfaces that it is in contact with: contacts->active. Adds to *flags:
 * KNURL_TICK_CONTACTS_FULL. */
void knurl_contacts_update(knurl_contacts *contacts, const knurl_broad_phase *phase, const knurl_broad_index *index,
                           const double position[3], uint32_t *flags) KNURL_NONBLOCKING;

/* The tick is over, and was one to go on from. */
static inline void knurl_contacts_keep(knurl_contacts *contacts, const double position[3]) {
    vec3_copy(position, contacts->previous);
    contacts->has_previous = 1;
}

#endif
