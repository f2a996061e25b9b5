/* One tick's search for contact with several surfaces: the obstacles, and each one's own contact.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_JOINT_SEARCH_H
#define KNURL_SRC_JOINT_SEARCH_H

#include "proxy/contacts.h"

/* m: rounding of a path's ends, with seams. */
#define KNURL_JOINT_ROUNDING 1e-6

/* The working data of one tick's search; on the stack of knurl_joint_contact(). */
typedef struct knurl_joint_search {
    knurl_contacts *contacts;
    const knurl_broad_index *index;
    const knurl_hip_path *path;
    const double *hip; /* scene: the path's end */
    knurl_obstacles near;
    knurl_touched touched[KNURL_CANDIDATES_MAX];
    int jumped;       /* 1: a surface in contact has jumped */
    uint32_t queried; /* number of obstacles, from the first, whose query results are in `touched` */
    uint64_t late;    /* bit i: obstacle i's search ran out of visits, so the HIP may have crossed it */
    int unknown;      /* 1: the visits ran out before the contacts were found */
    double margin;    /* m: obstacles this far around the path were collected; a proxy may move no farther */
    double proxy[3];  /* results, with `touched` */
    double normal[3]; /* unit */
    uint32_t pressed;
    double whole; /* m: depth that the pressed shapes share; 0: each has its own */
} knurl_joint_search;

/* Collects the obstacles within `margin` (m) of a path, and those in contact. */
void knurl_joint_collect(knurl_joint_search *search, const knurl_hip_path *path, double margin) KNURL_NONBLOCKING;

/* Collects the obstacles that a god-object may meet: it only comes nearer to the HIP. */
void knurl_joint_collect_all(knurl_joint_search *search) KNURL_NONBLOCKING;

/* Queries one shape's contact with this tick's HIP, without the others. In a first tick, or after the surface in
 * contact has jumped, the HIP may be inside. */
void knurl_joint_query_contact(knurl_joint_search *search, const knurl_obstacle *obstacle,
                               knurl_touched *touched) KNURL_NONBLOCKING;

/* Repeats the query if a surface in contact has jumped: a double-sided one keeps the HIP on its side. */
void knurl_joint_query_jumped(const knurl_joint_search *search, const knurl_obstacle *obstacle,
                              knurl_touched *touched) KNURL_NONBLOCKING;

/* Queries contact with the crests of a surface whose outside the proxy is on. A surface that lies in a pressed face is
 * skipped: that face's crests are felt. */
void knurl_joint_query_crests(knurl_joint_search *search, const knurl_obstacle *obstacle,
                              knurl_touched *touched) KNURL_NONBLOCKING;

/* Takes the proxy and the normal from the contact of obstacle i. */
void knurl_joint_set_proxy(knurl_joint_search *search, uint32_t i) KNURL_NONBLOCKING;

/* No surface holds the HIP: the proxy is the HIP. */
static inline void knurl_joint_set_free(knurl_joint_search *m) {
    vec3_copy(m->hip, m->proxy);
    m->pressed = 0;
}

/* 1 if the HIP is pressed into the shape; 0 if it is free or only touches crests. */
static inline int knurl_joint_is_inside(const knurl_touched *touched) {
    return touched->held && touched->state.inside;
}

/* 1 if the surface that holds the HIP is the only one near, and its own contact has been found. */
static inline int knurl_joint_goes_on_alone(const knurl_joint_search *m) {
    return m->contacts->proxy.holders == 1 && m->near.count == 1 && m->queried == 1 &&
           knurl_joint_is_inside(&m->touched[0]);
}

#endif
