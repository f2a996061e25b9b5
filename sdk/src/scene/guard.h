/* The protections of a HIP: what a tick calls to keep a hand, and a device's motors, from what a scene may ask for.
 * Pure computation, a few words of state. Units are the scene's, so that a tick need not convert.
 * SPDX-License-Identifier: MIT
 */
#ifndef KNURL_SRC_GUARD_H
#define KNURL_SRC_GUARD_H

#include "base/vec3.h"

#include <knurl/scene.h>

/* N s/m: the friction that the lightest hand adds to its device's, for nobody feels a device that he does not hold.
 * A finger tip alone has some N s/m, and more the harder it holds (Hajian and Howe 1997; Hasser and Cutkosky 2002). */
#define KNURL_LIGHTEST_HAND 2.0

/* What a device can do, as far as its HIP's protections care. SI, device frame. */
typedef struct knurl_hip_facts {
    double rate;
    double resolution;
    double max_force;
    double continuous_force;
    double heat_time;
    double viscous;
    double delay;
    double max_stiffness;
} knurl_hip_facts;

/* How warm motors are that are driven with a force: theta' = ((F/continuous)^2 - theta)/time. */
typedef struct knurl_heat {
    double theta;     /* 0 cold to 1: as warm as the continuous force makes them in the long run */
    double share;     /* of the way to where the force takes theta, a tick */
    double per_force; /* 1/continuous^2 */
    double continuous;
    double excess; /* (max_force/continuous)^2 - 1; 0: there is no limit but max_force */
    double max_force;
} knurl_heat;

void knurl_heat_init(knurl_heat *heat, const knurl_hip_facts *facts);

/* N: the longest force now. max_force while cool; as theta nears 1 it comes down smoothly to the continuous force. */
double knurl_heat_limit(const knurl_heat *heat) KNURL_NONBLOCKING;

/* What was played for a tick, N^2, or for so many of them, >= 0. */
void knurl_heat_add(knurl_heat *heat, double force2) KNURL_NONBLOCKING;
void knurl_heat_hold(knurl_heat *heat, double force2, double ticks) KNURL_NONBLOCKING;

/* The same heat whatever the continuous force: N^2, of the force that makes the motors as warm in the long run. */
double knurl_heat_get(const knurl_heat *heat) KNURL_NONBLOCKING;
void knurl_heat_set(knurl_heat *heat, double square) KNURL_NONBLOCKING;

/* What a wall and its texture may be on a device. */
typedef struct knurl_bounds {
    double scale;
    double friction; /* N s/m, of device and lightest hand */
    double lag;      /* s: half a period and the delay */
    double max_stiffness;
    double max_force;
    double continuous_force;
    double quantum; /* m, scene */
} knurl_bounds;

/* N/m, felt: the bounds of a wall of some damping (N s/m, scene): (b + B)/(T/2 + delay) and the maker's. */
double knurl_bounds_stability(const knurl_bounds *bounds, double damping) KNURL_NONBLOCKING;
double knurl_bounds_stiffness(const knurl_bounds *bounds, double damping) KNURL_NONBLOCKING;

/* m: the largest amplitude at a stiffness (N/m, scene): its swing within max_force, its rms within the continuous. */
double knurl_bounds_amplitude(const knurl_bounds *bounds, double stiffness, int32_t method) KNURL_NONBLOCKING;

/* From the lowest trough to the highest crest of a method, in amplitudes (paper, "Peaks"). */
double knurl_swing(int32_t method) KNURL_NONBLOCKING;

/* A wall at one tick, from what was asked for to what is felt. Scene units. */
typedef struct knurl_guard_wall {
    const knurl_material_desc *material;
    struct knurl_guard_contact *contact;
    double felt;      /* m: z; then as it is felt */
    double stiffness; /* N/m, as felt */
    double amplitude; /* m, as felt */
    double damping;   /* N s/m */
    double height;    /* m: H, by the grating: known after the forces */
    int32_t watched;  /* 1: the passivity controller was at work before the forces */
} knurl_guard_wall;

/* Of one contact. */
typedef struct knurl_guard_contact {
    double depth;  /* m: that the ramp has come to at the latest tick, 0 without contact */
    double height; /* m: H at the latest tick */
} knurl_guard_contact;

/* The passivity controller: the HIP's swings in walls that could run away, and what came of them. Scene units. */
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

/* Of one HIP. */
typedef struct knurl_guard {
    double force[3]; /* N, scene: as sent at the latest tick */
    double entry;    /* m that the felt depth may grow in a tick */
    double slew;     /* N that the force may grow or turn in a tick */
    double gain;     /* on the force of this tick, 0 to 1 */
    int32_t clamp;   /* 1: within bounds */
    knurl_passivity passivity;
    knurl_heat heat;
    knurl_bounds bounds;
} knurl_guard;

/* Sets the protections up; the motors stay as warm as they were. guard: zeroed, or set up before. facts: complete. */
void knurl_guard_init(knurl_guard *guard, const knurl_hip_desc *desc, const knurl_hip_facts *facts, double scale);

/* What the functions below leave to guard.c, because it is rare. */
void knurl_guard_follow(knurl_passivity *passivity) KNURL_NONBLOCKING;
void knurl_guard_limit_wall(const knurl_bounds *bounds, knurl_guard_wall *wall) KNURL_NONBLOCKING;
void knurl_guard_watch(knurl_passivity *passivity, knurl_guard_wall *wall, uint32_t *flags) KNURL_NONBLOCKING;

/* A contact begins. felt: m, the depth that was felt on the surface that it is handed over from; else 0. */
static inline void knurl_guard_begin_contact(knurl_guard_contact *contact, double felt) {
    contact->depth = contact->depth < felt ? felt : contact->depth;
}

/* There is no contact (any more). */
static inline void knurl_guard_end_contact(knurl_guard_contact *contact) {
    contact->depth = contact->height = 0.0;
}

/* A material's wall at z (m, scene): what the forces begin with. */
static inline void knurl_guard_wall_init(knurl_guard_wall *wall, const knurl_material_desc *material, double z,
                                         knurl_guard_contact *contact) {
    wall->material = material;
    wall->contact = contact;
    wall->felt = z;
    wall->stiffness = material->stiffness;
    wall->amplitude = material->amplitude;
    wall->damping = material->damping;
    wall->height = 0.0;
}

/* Stiffness and amplitude within bounds, where that was asked for. */
static inline void knurl_guard_clamp(const knurl_guard *guard, knurl_guard_wall *wall) {
    if (guard->clamp) {
        knurl_guard_limit_wall(&guard->bounds, wall);
    }
}

/* A tick begins, of whose force `attenuation` is not sent. */
static inline void knurl_guard_begin(knurl_guard *guard, double attenuation) {
    guard->gain = knurl_is_within(attenuation, 0.0, 1.0) ? 1.0 - attenuation : 0.0;
    if (guard->passivity.busy) {
        knurl_guard_follow(&guard->passivity);
    }
}

/* The depth that is felt grows as a ramp; while no force is sent, it begins anew. */
static inline void knurl_guard_enter(const knurl_guard *guard, knurl_guard_wall *wall, uint32_t *flags) {
    const double most = wall->contact->depth + guard->entry;
    if (guard->gain == 0.0) {
        wall->contact->depth = 0.0;
        return;
    }
    if (-wall->felt > most) {
        *flags |= KNURL_TICK_ENTRY;
        wall->felt = -most;
    }
    wall->contact->depth = wall->felt < 0.0 ? -wall->felt : 0.0;
}

/* Before the forces: each wall as it is to be felt. Bounded where that was asked for; its depth grows as a ramp; and it
 * is softer where it has shaken the hand by itself. */
static inline void knurl_guard_before(knurl_guard *guard, knurl_guard_wall *walls, uint32_t count, uint32_t *flags) {
    for (uint32_t i = 0; i < count; i++) {
        knurl_guard_wall *wall = &walls[i];
        knurl_guard_clamp(guard, wall);
        knurl_guard_enter(guard, wall, flags);
        if ((wall->stiffness > guard->passivity.safe) | guard->passivity.alarmed) {
            knurl_guard_watch(&guard->passivity, wall, flags);
        }
        wall->watched = guard->passivity.busy;
    }
}

/* After the forces: their sum as it is sent, in place: what the attenuation leaves of it, within slew_rate of the
 * latest but for the textures' own steps and what falls, within what the motors can do now. Returns its length, N; NaN
 * or infinite where the force was. */
double knurl_guard_after(knurl_guard *guard, const knurl_guard_wall *walls, uint32_t count, double force[3],
                         uint32_t *flags) KNURL_NONBLOCKING;

/* A force was sent without a tick, for as long as a tick. */
void knurl_guard_sent(knurl_guard *guard, const double force[3]) KNURL_NONBLOCKING;

/* After a tick that is not to be trusted: no force was sent. The motors are as warm as they are. */
void knurl_guard_reset(knurl_guard *guard) KNURL_NONBLOCKING;

#endif
