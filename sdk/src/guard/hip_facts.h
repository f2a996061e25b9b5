/* The properties of a device that its HIP needs. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_HIP_FACTS_H
#define KNURL_SRC_HIP_FACTS_H

#include "base/finite.h"

/* SI, device frame. */
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

#endif
