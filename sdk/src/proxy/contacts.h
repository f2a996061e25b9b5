/* The contacts of one HIP: their state from tick to tick, their begin and end. contact_update.c finds them.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_CONTACTS_H
#define KNURL_SRC_CONTACTS_H

#include "base/atomic.h"
#include "base/base.h"
#include "proxy/active_contact.h"

#include <knurl/hip.h>

/* s that a HIP may be between two surfaces: it may spend a tick in a crack that is wider than seams bridge. */
#define KNURL_SLIP_SECONDS 0.005

/* s that a HIP that has not ticked for a while may be behind another before it takes over that one's time. */
#define KNURL_MAX_LAG 0.05

/* A HIP that was pressed into a surface and has come off its rim. */
typedef struct knurl_slip {
    double time;         /* s: of the slip; negative: no slip, or the HIP is held again */
    double proxy[3];     /* last proxy on the surface, scene */
    double normal[3];    /* unit */
    double ramped_depth; /* m: depth there, as limited by the entry ramp */
} knurl_slip;

/* The result of querying one shape. */
typedef struct knurl_touched {
    int32_t held;
    knurl_contact_state state;
    knurl_contact contact;
    knurl_felt_parts parts; /* of a smooth mesh */
} knurl_touched;

/* The contacts of this tick; their pointers are invalid after it. */
typedef struct knurl_contacts_now {
    knurl_active_contact list[KNURL_CONTACTS_MAX];
    uint32_t count;
} knurl_contacts_now;

/* The proxy at the last tick. Scene axes. */
typedef struct knurl_proxy {
    double at[3];        /* outside of every surface; the HIP if nothing holds it. Not kept up while a contact slides */
    double normal[3];    /* unit */
    double depth;        /* m; 0 if no surface held the HIP */
    double ramped_depth; /* m: as limited by the entry ramp; a contact that begins continues from it */
    double whole;        /* m: depth that its holders share; 0: each has its own */
    uint32_t holders;    /* surfaces that held the HIP */
} knurl_proxy;

typedef struct knurl_visit_budget {
    knurl_visits visits;  /* of this tick */
    uint32_t max;         /* per tick: KNURL_VISITS_MAX, fewer or more in tests */
    uint32_t short_ticks; /* consecutive ticks, up to the last, that used up their visits; at most 5 */
} knurl_visit_budget;

/* The query of this tick that joint contact need not repeat. */
typedef struct knurl_query_cache {
    const knurl_candidate *of; /* candidate queried alone, or null */
    knurl_touched result;
} knurl_query_cache;

/* Of one HIP, from tick to tick. */
typedef struct knurl_contacts {
    knurl_hip_clock clock;
    double previous[3]; /* HIP position at the last tick, scene */
    int32_t has_previous;
    int32_t test_all; /* 1: test every surface in every tick (KNURL_FULL_SEARCH) */
    knurl_proxy proxy;
    knurl_slip slip;
    knurl_contacts_now now;
    knurl_query_cache cache;
    knurl_visit_budget budget;
    knurl_candidates candidates;
} knurl_contacts;

/* Slow path of knurl_contacts_catch_up(). */
void knurl_contacts_take_time(knurl_contacts *contacts, double time) KNURL_NONBLOCKING;

/* 1 for KNURL_SLIP_SECONDS after the HIP has come off a rim. */
static inline int knurl_contacts_have_slipped(const knurl_contacts *c) {
    return KNURL_UNLIKELY(c->clock.time - c->slip.time < KNURL_SLIP_SECONDS) && c->slip.time >= 0.0;
}

/* Adds a contact. pose: of the shape's frame, now. Returns 0 if there is no room; the next tick tests it again. */
int knurl_contacts_add(knurl_contacts *contacts, knurl_candidate *candidate, const knurl_surface_data *surface,
                       const knurl_record *record, const knurl_pose *pose,
                       const knurl_touched *touched) KNURL_NONBLOCKING;

/* Finds the shares of one of several contacts, before felt.h changes it. Ridges, damping and friction of surfaces that
 * hold the HIP together add up to those of one mesh: they count by the surface's share of the depth. A crest ahead of
 * the proxy counts less, the deeper the HIP is in others: it ends with 0, as the share begins. */
void knurl_contacts_share(const knurl_contacts *contacts, knurl_active_contact *contact) KNURL_NONBLOCKING;

/* Lets a HIP that has not ticked for a while take over the time of a moving surface. */
static inline void knurl_contacts_catch_up(knurl_contacts *contacts, const knurl_motion *motion) {
    if (motion->start_time - contacts->clock.time > KNURL_MAX_LAG) {
        knurl_contacts_take_time(contacts, motion->start_time);
    }
}

#endif
