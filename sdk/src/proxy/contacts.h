/* The contacts of one HIP: their state from tick to tick, their begin and end. contact_update.c finds them.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_CONTACTS_H
#define KNURL_SRC_CONTACTS_H

#include "base/atomic.h"
#include "base/base.h"
#include "proxy/obstacles.h"

/* m: how much higher a surface may go on, with nothing between the two parts, and still take a HIP over. */
#define KNURL_STEP_HEIGHT 1e-3

/* s that a HIP may be between two surfaces: beyond what a seam bridges, a tick may fall into a crack. */
#define KNURL_SLIP_SECONDS 0.005

/* s that a HIP may be behind another before it takes over its time: it has not ticked for a while. */
#define KNURL_MAX_LAG 0.05

/* One surface that the HIP is in contact with in this tick. */
typedef struct knurl_active_contact {
    const knurl_surface_data *surface;
    const knurl_record *record;
    knurl_candidate *candidate; /* what is kept of it from tick to tick, with the contact's proxy and normal */
    const knurl_pose *pose;     /* of the shape's frame, now */
    knurl_contact contact;      /* shape's frame */
    int32_t begins;             /* 1: it was not in contact at the last tick */
} knurl_active_contact;

/* A HIP that was pressed into a surface and has come off its rim. */
typedef struct knurl_slip {
    double time;     /* s: when; below 0: it has not, or is held again */
    double proxy[3]; /* where it was held last, scene */
    double normal[3];
    double ramped_depth; /* m: the depth there, as limited by the entry ramp */
} knurl_slip;

/* What a shape says to a HIP in one tick. */
typedef struct knurl_touched {
    int32_t held;
    knurl_contact_state state;
    knurl_contact contact;
} knurl_touched;

/* Of one HIP, from tick to tick. */
typedef struct knurl_contacts {
    knurl_hip_clock clock;
    double previous[3];             /* HIP position at the last tick, scene */
    double depth;                   /* at the latest tick: m, how deep it was pressed in; 0: it was not */
    double proxy[3];                /* and where its proxy was, scene: outside of every surface, */
    double normal[3];               /* and which way it was held */
    const knurl_candidate *held_by; /* not null: proxy and normal are not set yet, but follow from this one's, */
    double held_off;                /* m: off whose surface the proxy is; see knurl_contacts_find() */
    uint32_t pressed;               /* surfaces that held it; 0: none, and the proxy is the HIP */
    double ramped_depth; /* m: the depth as limited by the entry ramp: a contact that begins goes on from there */
    int32_t has_previous;
    knurl_slip slip;
    int32_t everything;                              /* 1: every tick looks at every surface (KNURL_FULL_SEARCH) */
    knurl_active_contact active[KNURL_CONTACTS_MAX]; /* in this tick; what they point to is gone after it */
    uint32_t active_count;
    knurl_touched asked;             /* in this tick: what the shape of */
    uint32_t cut_short;              /* so many latest ticks used all of their visits; at most 5 */
    const knurl_candidate *asked_of; /* this one said when it was asked alone; null: none was */
    uint32_t max_visits;             /* a tick's */
    knurl_visits visits;             /* this tick's */
    knurl_candidates candidates;
} knurl_contacts;

/* What is rare: called by knurl_contacts_surface() and knurl_contacts_catch_up(). */
void knurl_contacts_note_change(knurl_candidate *candidate, const knurl_surface_data *surface) KNURL_NONBLOCKING;
void knurl_contacts_take_time(knurl_contacts *contacts, double time) KNURL_NONBLOCKING;

/* The candidate's surface, or null where it was taken out; another may be in its place since, and then the contact has
 * ended. */
static inline const knurl_surface_data *knurl_contacts_surface(const knurl_broad_index *index,
                                                               knurl_candidate *candidate) {
    const knurl_surface_data *surface =
        candidate->place < index->capacity ? __atomic_load_n(&index->items[candidate->place], __ATOMIC_SEQ_CST) : NULL;
    if (KNURL_UNLIKELY(!surface || candidate->generation != surface->generation)) {
        knurl_contacts_note_change(candidate, surface);
    }
    return surface;
}

/* 1 for a while after the HIP has come off a rim. */
static inline int knurl_contacts_have_slipped(const knurl_contacts *c) {
    return KNURL_UNLIKELY(c->clock.time - c->slip.time < KNURL_SLIP_SECONDS) && c->slip.time >= 0.0;
}

/* No contact any more. */
void knurl_contacts_end(knurl_candidate *candidate) KNURL_NONBLOCKING;

/* One more contact of this tick; pose: of the shape's frame, now. 0 where there is no room: it is looked at again in
 * the next tick. */
int knurl_contacts_add(knurl_contacts *contacts, knurl_candidate *candidate, const knurl_surface_data *surface,
                       const knurl_record *record, const knurl_pose *pose,
                       const knurl_touched *touched) KNURL_NONBLOCKING;

/* A HIP that has not ticked for a while takes over the time of a surface that moves. */
static inline void knurl_contacts_catch_up(knurl_contacts *contacts, const knurl_motion *motion) {
    if (motion->start_time - contacts->clock.time > KNURL_MAX_LAG) {
        knurl_contacts_take_time(contacts, motion->start_time);
    }
}

#endif
