/* Finds the contacts of a HIP in each tick. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_CONTACT_UPDATE_H
#define KNURL_SRC_CONTACT_UPDATE_H

#include "base/base.h"
#include "proxy/contacts.h"

/* Before the first tick. period, time: s. */
void knurl_contacts_init(knurl_contacts *contacts, double period, double time);

/* No contact; the next tick is a first one. */
void knurl_contacts_reset(knurl_contacts *contacts) KNURL_NONBLOCKING;

/* 1 if `a`, the only contact of the last tick, is steady, and its surface was not edited since. */
static inline int knurl_contact_is_steady(const knurl_active_contact *a, const knurl_broad_index *index) {
    const knurl_candidate *candidate = a->candidate;
    if (!a->steady || candidate->place >= index->capacity) {
        return 0;
    }
    const knurl_surface_data *surface = __atomic_load_n(&index->items[candidate->place], __ATOMIC_SEQ_CST);
    return surface && surface->generation == candidate->generation &&
           __atomic_load_n(&surface->record, __ATOMIC_SEQ_CST)->edits == a->steady;
}

/* Fast path of knurl_contacts_find(), with the same result: a rectangle that is steady still holds the HIP, and nothing
 * else is near. Only the HIP's place in it is new. Otherwise returns 0 and changes nothing. */
static inline int knurl_contacts_slide(knurl_contacts *c, const knurl_broad_index *index, const double position[3]) {
    knurl_active_contact *a = &c->now.list[0];
    knurl_candidate *candidate = a->candidate;
    double hip[3], proxy[3];
    if (c->now.count != 1 || !a->rectangle || !knurl_contact_is_steady(a, index)) {
        return 0;
    }
    knurl_pose_to_own(a->pose, position, hip);
    const double z = hip[2] * a->contact.normal[2];
    const double at[3] = {hip[0], hip[1], 0.0};
    knurl_pose_to_parent(a->pose, at, proxy);
    if (!knurl_plane_keeps(a->rectangle, hip, z) || !knurl_candidates_are_clear_of(&c->candidates, proxy)) {
        return 0;
    }
    a->contact.proxy[0] = hip[0];
    a->contact.proxy[1] = hip[1];
    a->contact.z = z;
    vec3_copy(proxy, candidate->proxy);
    vec3_copy(hip, candidate->previous);
    candidate->placed = c->clock.tick;
    c->proxy.depth = fabs(z);
    return 1;
}

/* Full contact search, when the fast path does not apply. clear: 1 if only surfaces already in contact need testing. */
void knurl_contacts_find(knurl_contacts *contacts, const knurl_broad_phase *phase, const knurl_broad_index *index,
                         const double position[3], int clear, uint32_t *flags) KNURL_NONBLOCKING;

/* Finds the surfaces in contact with a HIP at a position (scene, m): contacts->now.list. Adds to *flags:
 * KNURL_TICK_CONTACTS_FULL, KNURL_TICK_SQUEEZED, KNURL_TICK_VISIT_LIMIT. */
static inline void knurl_contacts_update(knurl_contacts *c, const knurl_broad_phase *phase,
                                         const knurl_broad_index *index, const double position[3], uint32_t *flags) {
    const int clear = knurl_candidates_are_clear(&c->candidates, phase, position, c->proxy.depth);
    if (KNURL_LIKELY(clear) && knurl_contacts_slide(c, index, position)) {
        return;
    }
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
