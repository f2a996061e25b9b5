/* What a HIP is in contact with, from tick to tick: contacts begin, are held, end, and are handed over from one surface
 * to the next. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_CONTACT_UPDATE_H
#define KNURL_SRC_CONTACT_UPDATE_H

#include "base/atomic.h"
#include "scene/candidates.h"

/* A HIP that was pressed into a surface and has slid off it: where it is taken to come from onto the next one. */
typedef struct knurl_hand_over {
    double time;     /* s: when it slid off; below 0: it did not, or another surface holds it */
    double proxy[3]; /* where it was held last, scene */
    double normal[3];
    double felt;    /* m: depth that was felt there */
    double from[3]; /* in this tick, scene, m: where its proxy would be, had the surface gone on, */
    double depth;   /* and m from there to the HIP */
    int32_t given;  /* 1: these two hold */
} knurl_hand_over;

/* A HIP's time. It may be behind other HIPs' that have ticked more often. */
typedef struct knurl_hip_clock {
    double time; /* atomic: s, scene time after the latest tick */
    double previous_time;
    double period; /* s */
} knurl_hip_clock;

/* One period on. */
static inline void knurl_hip_clock_advance(knurl_hip_clock *clock) {
    const double time = clock->time + clock->period;
    clock->previous_time = clock->time;
    knurl_store_double(&clock->time, time);
}

/* One surface that the HIP is in contact with in this tick. */
typedef struct knurl_active_contact {
    const knurl_surface_data *surface;
    const knurl_record *record;
    knurl_candidate *candidate; /* what is kept of it from tick to tick, with the contact's proxy and normal */
    const knurl_pose *pose;     /* of the shape's frame, now */
    knurl_pose moved;           /* what `pose` points to while the surface moves */
    knurl_contact contact;      /* shape's frame */
    int32_t begins;             /* 1: it was not in contact at the last tick */
} knurl_active_contact;

/* Of one HIP, from tick to tick. */
typedef struct knurl_contacts {
    knurl_hip_clock clock;
    double previous[3]; /* HIP position at the last tick, scene */
    double depth;       /* of the deepest contact at the latest tick, m; 0 without */
    int32_t has_previous;
    int32_t everything; /* 1: every tick looks at every surface (KNURL_FULL_SEARCH) */
    knurl_hand_over hand_over;
    knurl_active_contact active[KNURL_CONTACTS_MAX]; /* in this tick; what they point to is gone after it */
    uint32_t active_count;
    knurl_candidates candidates;
} knurl_contacts;

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
