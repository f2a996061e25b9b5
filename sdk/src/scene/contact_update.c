/* Contacts begin, are held, end and are handed over. Read knurl_contacts_update(), at the end, first.
 * SPDX-License-Identifier: MIT */
#include "scene/contact_update.h"

#include "base/atomic.h"

#include <string.h>

/* s that a HIP may be behind another before it takes over its time: it has not ticked for a while. */
#define MAX_LAG 0.05

/* m above a surface: where a HIP is taken to come from that slides off it and onto the next one. What lies higher than
 * this is a step that stops nobody who is already below it. */
#define HANDOVER_HEIGHT 1e-5

/* s that it may be between two surfaces: cracks of some nanometres are all that floats leave, but a tick may fall into
 * one. */
#define HANDOVER_SECONDS 0.005

/* What is being found in one tick. */
typedef struct update {
    knurl_contacts *contacts;
    const knurl_broad_index *index;
    const double *position;
    uint32_t *flags;
} update;

static void end_contact(knurl_candidate *candidate) {
    candidate->in_contact = 0;
    memset(&candidate->contact, 0, sizeof candidate->contact);
}

/* The surface's motion now, and the HIP in its frame, before and now. Returns 1 where it was in contact and has jumped,
 * or another shape has come in its place: that contact is over. */
static int place_hip(update *u, knurl_candidate *candidate, knurl_active_contact *a, knurl_contact_query *query) {
    knurl_contacts *c = u->contacts;
    const knurl_motion *motion = &a->record->motion;
    if (motion->start_time - c->clock.time > MAX_LAG) {
        knurl_store_double(&c->clock.time, motion->start_time);
        c->clock.previous_time = motion->start_time - c->clock.period;
    }
    a->pose = &motion->end;
    if (!knurl_motion_is_over(motion, c->clock.time)) {
        knurl_motion_at(motion, c->clock.time, &a->moved);
        a->pose = &a->moved;
    }
    /* what holds a HIP and jumps may hold it still; what jumps past one was never in contact with it */
    const int jumped = candidate->has_previous && candidate->jumps != motion->jumps;
    const int ends = jumped && candidate->in_contact;
    if (ends) {
        end_contact(candidate);
    }
    knurl_pose_to_own(a->pose, u->position, query->hip);
    query->has_previous = c->has_previous && !ends;
    if (candidate->has_previous && !jumped) {
        vec3_copy(candidate->previous, query->previous);
    } else if (knurl_motion_is_over(motion, c->clock.previous_time)) {
        knurl_pose_to_own(&motion->end, c->previous, query->previous);
    } else {
        knurl_pose before;
        knurl_motion_at(motion, c->clock.previous_time, &before);
        knurl_pose_to_own(&before, c->previous, query->previous);
    }
    query->reach = a->record->reach;
    query->double_sided = a->surface->double_sided;
    query->facet = &candidate->facet;
    candidate->jumps = motion->jumps;
    candidate->has_previous = 1;
    vec3_copy(query->hip, candidate->previous);
    return ends;
}

/* Where a HIP comes from that has slid off a surface, as long as it is behind where the surface was. */
static void offer(knurl_hand_over *over, const double position[3]) {
    double offset[3];
    vec3_sub(position, over->proxy, offset);
    const double along = vec3_dot(offset, over->normal);
    if (along < 0.0) {
        over->depth = HANDOVER_HEIGHT - along;
        vec3_madd(position, over->depth, over->normal, over->from);
        over->given = 1;
    }
}

/* The HIP has slid off this surface: the next one may take it over. */
static void slide_off(knurl_contacts *c, const knurl_candidate *candidate, const double position[3]) {
    knurl_hand_over *over = &c->hand_over;
    vec3_copy(candidate->proxy, over->proxy);
    vec3_copy(candidate->normal, over->normal);
    over->felt = candidate->guard.depth;
    offer(over, position);
    over->time = over->given ? c->clock.time : -1.0;
}

/* Returns 0 where there is no room for one more: it is looked at again in the next tick. */
static int begin_contact(update *u, knurl_candidate *candidate) {
    const knurl_hand_over *over = &u->contacts->hand_over;
    if (u->contacts->active_count == KNURL_CONTACTS_MAX) {
        *u->flags |= KNURL_TICK_CONTACTS_FULL;
        memset(&candidate->contact, 0, sizeof candidate->contact);
        return 0;
    }
    memset(&candidate->grating, 0, sizeof candidate->grating);
    candidate->facet.side = 0;
    knurl_wall_begin(&candidate->guard, over->given ? over->felt : 0.0);
    return 1;
}

/* The candidate's surface, or null where it was taken out; another may be in its place since. */
static const knurl_surface_data *find_surface(const update *u, knurl_candidate *candidate) {
    const knurl_surface_data *surface = candidate->place < u->index->capacity
                                            ? __atomic_load_n(&u->index->items[candidate->place], __ATOMIC_SEQ_CST)
                                            : NULL;
    if (!surface || (candidate->in_contact && candidate->generation != surface->generation)) {
        end_contact(candidate);
        candidate->has_previous = 0;
        knurl_wall_end(&candidate->guard);
    }
    if (surface && candidate->generation != surface->generation) {
        candidate->generation = surface->generation;
        candidate->has_previous = 0;
    }
    return surface;
}

/* One candidate: is the HIP in contact with it? */
static void update_candidate(update *u, knurl_candidate *candidate) {
    knurl_active_contact spare; /* there may be no room */
    knurl_contacts *c = u->contacts;
    knurl_active_contact *a = c->active_count < KNURL_CONTACTS_MAX ? &c->active[c->active_count] : &spare;
    const knurl_hand_over *over = &c->hand_over;
    knurl_contact_query query;
    a->surface = find_surface(u, candidate);
    if (!a->surface) {
        return;
    }
    a->record = __atomic_load_n(&a->surface->record, __ATOMIC_SEQ_CST);
    const int has_jumped = place_hip(u, candidate, a, &query);
    int held = knurl_shape_contact(&a->surface->shape, &query, &candidate->contact, &a->contact);
    if (!held && has_jumped && query.double_sided) { /* from the side that it was on */
        double from[3];
        vec3_madd(candidate->proxy, KNURL_CAPTURE_DEPTH, candidate->normal, from);
        knurl_pose_to_own(a->pose, from, query.previous);
        query.has_previous = 1;
        held = knurl_shape_contact(&a->surface->shape, &query, &candidate->contact, &a->contact);
    }
    if (!held && candidate->in_contact) {
        slide_off(c, candidate, u->position);
    } else if (!held && over->given && query.has_previous) {
        knurl_pose_to_own(a->pose, over->from, query.previous);
        held = knurl_shape_contact(&a->surface->shape, &query, &candidate->contact, &a->contact);
    }
    if (!held) {
        knurl_wall_end(&candidate->guard);
        candidate->in_contact = 0;
        return;
    }
    a->begins = !candidate->in_contact;
    if (a->begins && !begin_contact(u, candidate)) {
        return;
    }
    knurl_pose_to_parent(a->pose, a->contact.proxy, candidate->proxy);
    knurl_pose_turn_to_parent(a->pose, a->contact.normal, candidate->normal);
    candidate->in_contact = 1;
    a->candidate = candidate;
    c->active_count++;
}

/* How the HIP goes in this tick. */
static knurl_hip_path path_of(const update *u) {
    const knurl_contacts *c = u->contacts;
    const knurl_hip_path path = {c->has_previous ? c->previous : u->position,
                                 u->position,
                                 c->depth,
                                 c->clock.time,
                                 !c->has_previous,
                                 c->everything};
    return path;
}

/* Candidates that are not in contact (held: those that were, as bits) may come into it. */
static void begin_others(update *u, const knurl_hip_path *path, uint64_t held) {
    const double margin = path->is_first ? KNURL_CAPTURE_DEPTH : 1e-9;
    knurl_candidates *list = &u->contacts->candidates;
    int ended = 0;
    for (uint32_t i = 0; i < list->count; i++) {
        knurl_candidate *candidate = &list->list[i];
        if (held >> i & 1) {
            ended |= !candidate->in_contact;
        } else if (knurl_candidate_is_met(candidate, path, margin + u->contacts->hand_over.depth)) {
            update_candidate(u, candidate);
        } else {
            candidate->has_previous = 0;
        }
    }
    knurl_candidates_measure(list, u->position, ended || path->everything);
}

/* What the next tick goes by. */
static void finish(update *u) {
    knurl_contacts *c = u->contacts;
    if (c->active_count > 0) {
        c->depth = 0.0;
        c->hand_over.time = -1.0;
    } else {
        c->depth = c->hand_over.given ? c->hand_over.depth : 0.0;
    }
    for (uint32_t i = 0; i < c->active_count; i++) {
        const double depth = -c->active[i].contact.z;
        c->depth = depth > c->depth ? depth : c->depth;
    }
    if (c->candidates.overflow) {
        *u->flags |= KNURL_TICK_CONTACTS_FULL;
    }
}

void knurl_contacts_init(knurl_contacts *c, double period, double time) {
    memset(c, 0, sizeof *c);
    c->clock.period = period;
    c->clock.time = time;
    knurl_contacts_reset(c);
}

void knurl_contacts_reset(knurl_contacts *c) {
    knurl_candidates_reset(&c->candidates);
    c->has_previous = 0;
    c->depth = 0.0;
    c->hand_over.time = -1.0;
    c->hand_over.felt = 0.0;
}

void knurl_contacts_update(knurl_contacts *c, const knurl_broad_phase *phase, const knurl_broad_index *index,
                           const double position[3], uint32_t *flags) {
    update u = {c, index, position, flags};
    knurl_hip_path path;
    uint64_t held = 0;
    const int clear = c->has_previous && knurl_candidates_are_clear(&c->candidates, phase, position, c->depth);
    int ended = 0;
    if (!clear) {
        path = path_of(&u);
        knurl_candidates_update(&c->candidates, phase, index, &path);
    }
    c->active_count = 0;
    c->hand_over.given = 0;
    c->hand_over.depth = 0.0;
    if (c->clock.time - c->hand_over.time < HANDOVER_SECONDS && c->has_previous) {
        offer(&c->hand_over, position);
    }
    for (uint32_t i = 0; i < c->candidates.count; i++) { /* what is in contact stays so until its contact ends, */
        knurl_candidate *candidate = &c->candidates.list[i];
        if (candidate->in_contact) {
            held |= (uint64_t)1 << i;
            update_candidate(&u, candidate);
            ended |= !candidate->in_contact;
        }
    }
    if (!clear || ended || c->hand_over.given) { /* then whatever else is near may begin */
        path = path_of(&u);
        begin_others(&u, &path, held);
    }
    finish(&u);
}
