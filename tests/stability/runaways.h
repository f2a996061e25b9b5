/* Runaways without protections within the devices' limits: stiffness up to the maker's, amplitude up to the force. From
 * the study's maps; each is well beyond the bound (b + fc/v + hand)/(T/2 + td). SPDX-License-Identifier: MIT
 */
#ifndef KNURL_TEST_RUNAWAYS_H
#define KNURL_TEST_RUNAWAYS_H

#include "lab.h"

typedef struct runaway {
    const char *device, *grip;
    int32_t method;
    double stiffness, amplitude, speed; /* N/m, m, m/s; no amplitude: a flat wall */
} runaway;

static const runaway runaways[] = {
    {"preset=falcon", "loose", KNURL_METHOD_DEFAULT, 3000.0, 0.0, 0.2},
    {"preset=falcon", "loose", KNURL_METHOD_DEFAULT, 3000.0, 0.0, 0.25},
    {"preset=falcon", "light", KNURL_METHOD_DEFAULT, 3000.0, 0.0, 0.25},
    {"preset=falcon", "light", KNURL_METHOD_DEFAULT, 2850.0, 0.0, 0.3},
    {"preset=falcon", "loose", KNURL_METHOD_DEFAULT, 1757.0, 0.0, 0.25},
    {"preset=falcon", "loose", KNURL_METHOD_DEFAULT, 1500.0, 0.0, 0.3},
    {"preset=falcon", "loose", KNURL_METHOD_S1, 3000.0, 0.0002, 0.25},
    {"preset=falcon", "loose", KNURL_METHOD_S1, 3000.0, 0.0002, 0.126}, /* at a quarter of the texture's frequency */
    {"preset=falcon", "loose", KNURL_METHOD_S2, 3000.0, 0.0002, 0.25},
    {"preset=falcon", "loose", KNURL_METHOD_BANDLIMITED, 3000.0, 0.0002, 0.25},
    {"preset=touch&coulomb=0", "loose", KNURL_METHOD_DEFAULT, 1020.0, 0.0, 0.0},
    {"preset=touch&coulomb=0", "loose", KNURL_METHOD_S1, 1020.0, 0.0002, 0.1},
    {"preset=touch&coulomb=0", "loose", KNURL_METHOD_S2, 1020.0, 0.0002, 0.1},
    {"preset=touch&coulomb=0", "loose", KNURL_METHOD_BANDLIMITED, 1020.0, 0.0002, 0.1},
};

static inline lab_case runaway_case(const runaway *r, uint32_t without) {
    lab_case c;
    lab_case_init(&c);
    c.device = r->device;
    c.grip = lab_grip_named(r->grip);
    c.method = r->method;
    c.stiffness = r->stiffness;
    c.amplitude = r->amplitude;
    c.speed = r->speed;
    c.settle = 2.25; /* S2 has ended its first event */
    c.without = without;
    return c;
}

#endif
