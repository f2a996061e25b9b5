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
    double viscous; /* negative: not known */
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

/* What was played for a tick, N^2. */
void knurl_heat_add(knurl_heat *heat, double force2) KNURL_NONBLOCKING;

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

/* Of one contact. */
typedef struct knurl_guard_contact {
    double felt;   /* m: depth that was felt at the latest tick, 0 without contact */
    double height; /* m: H at the latest tick */
    double z;      /* m: of the latest tick; of use while in contact */
} knurl_guard_contact;

/* Of one HIP. */
typedef struct knurl_guard {
    double force[3]; /* N, scene: as sent at the latest tick */
    double entry;    /* m that the felt depth may grow in a tick */
    double slew;     /* N that the force may grow or turn in a tick */
    double step;     /* N: of that tick's textures */
    double left;     /* m: depth felt where the HIP slid off a surface, for the one that it is handed to */
    int32_t clamp;   /* 1: within bounds */
    knurl_bounds bounds;
    knurl_heat heat;
} knurl_guard;

/* Sets the protections up, cold. facts: complete. */
void knurl_guard_init(knurl_guard *guard, const knurl_hip_desc *desc, const knurl_hip_facts *facts, double scale);

/* The z that is felt: as it is outside; inside no deeper than the ramp has come. */
double knurl_guard_enter(const knurl_guard *guard, knurl_guard_contact *contact, double z,
                         uint32_t *flags) KNURL_NONBLOCKING;

/* There is no contact (any more). */
void knurl_guard_leave(knurl_guard_contact *contact) KNURL_NONBLOCKING;

/* The texture is at a height (m) on a wall of some stiffness (N/m): its own step is let through. */
void knurl_guard_step(knurl_guard *guard, knurl_guard_contact *contact, double stiffness,
                      double height) KNURL_NONBLOCKING;

/* Stiffness and amplitude as felt. */
void knurl_guard_clamp(const knurl_guard *guard, const knurl_material_desc *material, double *stiffness,
                       double *amplitude) KNURL_NONBLOCKING;

/* The force that is sent, in place: within slew_rate of the latest but for the textures' steps and what falls, within
 * what the motors can do now. Returns its length, N; NaN or infinite where the force was. */
double knurl_guard_force(knurl_guard *guard, double force[3], uint32_t *flags) KNURL_NONBLOCKING;

/* After a tick that is not to be trusted: no force was sent. The motors are as warm as they are. */
void knurl_guard_let_go(knurl_guard *guard) KNURL_NONBLOCKING;

#endif
