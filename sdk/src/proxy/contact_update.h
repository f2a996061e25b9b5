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

/* Contact of a HIP (shape's frame) with the rectangle or the facet that held it in the last tick, and has not moved
 * since. Returns 0, with `contact` undefined, if that no longer holds it. */
static inline int knurl_contact_goes_on(const knurl_active_contact *a, const double hip[3], knurl_contact *contact) {
    const knurl_plane *plane = a->surface->shape.plane;
    double inside[2];
    if (!plane) {
        return knurl_facet_contact(&a->candidate->facet, hip, inside, contact) && contact->z <= 0.0;
    }
    contact->proxy[0] = hip[0];
    contact->proxy[1] = hip[1];
    contact->z = hip[2] * contact->normal[2];
    return knurl_plane_keeps(plane, hip, contact->z);
}

/* Fast path of knurl_contacts_find(), with the same result: the face that alone held the HIP in the last tick still
 * does, stands still and was not edited, and nothing else is near. Only the HIP's place on it is new. Otherwise returns
 * 0 and changes nothing that a search reads. */
static inline int knurl_contacts_slide(knurl_contacts *c, const knurl_broad_index *index, const double position[3]) {
    knurl_active_contact *a = &c->now.list[0];
    knurl_candidate *candidate = a->candidate;
    double hip[3], proxy[3];
    if (c->now.count != 1 || !a->slides || !knurl_contact_is_steady(a, index)) {
        return 0;
    }
    knurl_pose_to_own(a->pose, position, hip);
    if (!knurl_contact_goes_on(a, hip, &a->contact)) {
        return 0;
    }
    knurl_pose_to_parent(a->pose, a->contact.proxy, proxy);
    if (!knurl_candidates_are_clear_of(&c->candidates, proxy)) {
        return 0;
    }
    vec3_copy(proxy, candidate->proxy);
    vec3_copy(hip, candidate->previous);
    candidate->placed = c->clock.tick;
    c->proxy.depth = fabs(a->contact.z);
    if (KNURL_UNLIKELY(a->surface->shape.bulge > 0.0)) { /* knurl_felt_find() has changed these */
        a->contact.facet = &candidate->facet;
        a->normal = candidate->normal;
        a->begins = a->is_unfelt = 0;
    }
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
