/* The passivity controller: sees walls that shake the hand by themselves, and softens them. SPDX-License-Identifier:
 * MIT */
#ifndef KNURL_SRC_PASSIVITY_H
#define KNURL_SRC_PASSIVITY_H

#include "scene/hip_facts.h"
#include "scene/wall.h"

/* A HIP's swings in walls that could run away, and what came of them. Scene units. */
typedef struct knurl_passivity {
    double safe;       /* N/m: a wall of no more cannot run away, and is not watched; infinite: left out */
    double unit;       /* m, scene: a device's metre */
    double longest;    /* ticks of a swing in and out again that no hand makes */
    double depth;      /* m: of the deepest wall in this tick, as felt; 0 outside */
    double extreme;    /* m: where the depth last turned */
    double farthest;   /* m: from there on, the way that it is heading */
    double largest;    /* m: of the row's swings, forgetting */
    double squares;    /* m^2: of the row's swings */
    double moved;      /* m: by how much H changed since the depth last turned, */
    int32_t crossings; /* and how often it crossed 0, */
    int32_t crossed;   /* and from the turn before that to it */
    int32_t row;       /* swings, each as large as those before it */
    int32_t ticks;     /* since the depth last turned, */
    int32_t before;    /* and from the turn before that to it */
    int32_t outwards;  /* 1: heading out */
    int32_t busy;      /* 1: there is a depth to follow, or an alarm */
    int32_t alarmed;
    double soft;      /* 0 to 1: as soft as is passive */
    double softening; /* of the way there, a tick */
    double off;       /* ticks since the HIP was last in a wall */
    double off_most;  /* after so many walls are hard again */
} knurl_passivity;

/* watches: 0: left out. scale: scene metres a device metre. */
void knurl_passivity_init(knurl_passivity *passivity, int watches, const knurl_hip_facts *facts, double scale);

/* From one tick to the next; only while it is busy. */
void knurl_passivity_follow(knurl_passivity *passivity) KNURL_NONBLOCKING;

/* Watches a wall that could run away, and has it felt softer once it has. */
void knurl_passivity_watch(knurl_passivity *passivity, knurl_wall *wall, uint32_t *flags) KNURL_NONBLOCKING;

#endif
