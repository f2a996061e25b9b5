/* Finds the contacts of a HIP in each tick. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_CONTACT_UPDATE_H
#define KNURL_SRC_CONTACT_UPDATE_H

#include "base/base.h"
#include "proxy/contacts.h"

/* Before the first tick. period, time: s. */
void knurl_contacts_init(knurl_contacts *contacts, double period, double time);

/* No contact; the next tick is a first one. */
void knurl_contacts_reset(knurl_contacts *contacts) KNURL_NONBLOCKING;

/* Full contact search, when the fast path does not apply. clear: 1 if only surfaces already in contact need testing. */
void knurl_contacts_find(knurl_contacts *contacts, const knurl_broad_phase *phase, const knurl_broad_index *index,
                         const double position[3], int clear, uint32_t *flags) KNURL_NONBLOCKING;

/* Finds the surfaces in contact with a HIP at a position (scene, m): contacts->now.list. Adds to *flags:
 * KNURL_TICK_CONTACTS_FULL, KNURL_TICK_SQUEEZED, KNURL_TICK_VISIT_LIMIT. */
static inline void knurl_contacts_update(knurl_contacts *c, const knurl_broad_phase *phase,
                                         const knurl_broad_index *index, const double position[3], uint32_t *flags) {
    const int clear = knurl_candidates_are_clear(&c->candidates, phase, position, c->proxy.depth);
    if (c->now.count > 0 || !clear || knurl_contacts_have_slipped(c)) {
        knurl_contacts_find(c, phase, index, position, clear, flags);
    }
}

/* Ends a valid tick: the next one continues from it. */
static inline void knurl_contacts_keep(knurl_contacts *contacts, const double position[3]) {
    vec3_copy(position, contacts->previous);
    contacts->has_previous = 1;
}

#endif
