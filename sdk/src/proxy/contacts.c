/* Begin and end of a contact. SPDX-License-Identifier: MIT */
#include "proxy/contacts.h"

#include <string.h>

void knurl_contacts_take_time(knurl_contacts *c, double time) {
    knurl_store_double(&c->clock.time, time);
    c->clock.previous_time = time - c->clock.period;
}

int knurl_contacts_add(knurl_contacts *c, knurl_candidate *candidate, const knurl_surface_data *surface,
                       const knurl_record *record, const knurl_pose *pose, const knurl_touched *touched) {
    if (c->now.count == KNURL_CONTACTS_MAX) {
        knurl_candidate_end_contact(candidate);
        return 0;
    }
    knurl_active_contact *a = &c->now.list[c->now.count++];
    a->surface = surface;
    a->record = record;
    a->pose = pose;
    a->candidate = candidate;
    a->contact = touched->contact;
    a->steady = 0;
    a->slides = 0;
    a->begins = !candidate->in_contact;
    if (a->begins) {
        memset(&candidate->grating, 0, sizeof candidate->grating);
        candidate->facet.side = 0;
        knurl_wall_begin(&candidate->wall, c->proxy.ramped_depth);
    }
    candidate->contact = touched->state;
    candidate->in_contact = 1;
    knurl_pose_to_parent(a->pose, a->contact.proxy, candidate->proxy);
    knurl_pose_vector_to_parent(a->pose, a->contact.normal, candidate->normal);
    a->normal = candidate->normal;
    a->is_unfelt = 0;
    a->share = a->friction_share = 1.0;
    a->felt.parts.count = 0;
    if (touched->parts.count > 0) {
        a->felt.parts = touched->parts;
    }
    return 1;
}

void knurl_contacts_share(const knurl_contacts *c, knurl_active_contact *a) {
    const double whole = c->proxy.whole, depth = c->proxy.depth, z = a->contact.z;
    if (a->candidate->contact.inside && whole > 0.0) {
        a->share = z < 0.0 ? -z / whole : 0.0; /* at most slightly above 1, see share_depth() */
        a->friction_share = a->share * vec3_dot(a->normal, c->proxy.normal);
        if (!(a->surface->shape.bulge > 0.0)) { /* a smooth mesh finds its own */
            knurl_pose_vector_to_own(a->pose, c->proxy.normal, a->contact.normal);
        }
    } else if (!a->candidate->contact.inside && c->proxy.holders > 0 && depth > 0.0) {
        a->share = z > 0.0 ? z / sqrt(z * z + depth * depth) : 0.0;
    }
}
