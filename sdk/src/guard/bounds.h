/* Limits of stiffness and amplitude on a device. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_BOUNDS_H
#define KNURL_SRC_BOUNDS_H

#include "guard/hip_facts.h"

#include <knurl/base.h>

#include <stdint.h>

/* N s/m: damping that the lightest hand adds to that of its device; a device that is felt is held, at least loosely. A
 * finger tip alone has some N s/m, and more the harder it holds (Hajian and Howe 1997; Hasser and Cutkosky 2002). */
#define KNURL_LIGHTEST_HAND 2.0

/* Limits of walls and textures on a device. */
typedef struct knurl_bounds {
    double scale;
    double friction; /* N s/m, of device and lightest hand */
    double lag;      /* s: half a period and the delay */
    double max_stiffness;
    double max_force;
    double continuous_force;
    double quantum; /* m, scene */
} knurl_bounds;

/* scale: scene metres a device metre. */
void knurl_bounds_init(knurl_bounds *bounds, const knurl_hip_facts *facts, double scale) KNURL_NONBLOCKING;

/* N/m, at the device. damping: N s/m, scene. Stability limit (b + B)/(T/2 + delay); its minimum with max_stiffness. */
double knurl_bounds_stability(const knurl_bounds *bounds, double damping) KNURL_NONBLOCKING;
double knurl_bounds_stiffness(const knurl_bounds *bounds, double damping) KNURL_NONBLOCKING;

/* m: largest amplitude at a stiffness (N/m, scene): its swing within max_force, its rms within continuous_force. */
double knurl_bounds_amplitude(const knurl_bounds *bounds, double stiffness, int32_t method) KNURL_NONBLOCKING;

#endif
