/* Keys and presets of a fake URI. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_FAKE_URI_H
#define KNURL_SRC_FAKE_URI_H

#include "base/number.h"

#include <knurl/fake.h>

/* Minimum, maximum and unit of quantities that real devices do not have. */
#define KNURL_FAKE_HAND_MASS      0.0, 10.0, "kg"
#define KNURL_FAKE_HAND_STIFFNESS 0.0, 10000.0, "N/m"
#define KNURL_FAKE_HAND_DAMPING   0.0, 100.0, "N s/m"
#define KNURL_FAKE_SIZE           0.001, 10.0, "m"
#define KNURL_FAKE_TREMOR         0.0, 0.01, "m"
#define KNURL_FAKE_FLAG           0.0, 1.0, ""
#define KNURL_FAKE_SEED           0.0, 4294967295.0, ""
#define KNURL_FAKE_TIME           0.0, 1e9, "s"

/* Every key of a fake URI except `preset`: name, default, range, further values (KNURL_OR_, KNURL_WHOLE), meaning. One
 * table for parsing and for the help. The defaults are the preset "touch" and an assumed hand: a light grip on a
 * stylus, soft enough to feel through and stiff enough to keep a 1 mm press; its mass is part of the device's. */
#define KNURL_FAKE_KEYS(X)                                                                                             \
    X(mass, 0.045, KNURL_RANGE_MASS, 0, "the device's moving mass")                                                    \
    X(viscous, 0.5, KNURL_RANGE_VISCOUS, 0, "the device's viscous friction")                                           \
    X(coulomb, 0.26, KNURL_RANGE_COULOMB, 0, "the device's dry friction")                                              \
    X(hand_mass, 0, KNURL_FAKE_HAND_MASS, 0, "mass of the hand that moves with the device")                            \
    X(hand_stiffness, 700, KNURL_FAKE_HAND_STIFFNESS, 0, "spring of the hand")                                         \
    X(hand_damping, 5, KNURL_FAKE_HAND_DAMPING, 0, "damper of the hand")                                               \
    X(resolution, 0.000055, KNURL_RANGE_QUANTUM, KNURL_OR_ZERO, "position quantum, 0 for none")                        \
    X(max_force, 3.3, KNURL_RANGE_FORCE, 0, "peak force of the motors")                                                \
    X(continuous_force, 0.88, KNURL_RANGE_FORCE, KNURL_OR_ZERO, "force they can hold, 0 for max_force")                \
    X(heat_time, 60, KNURL_RANGE_HEAT_TIME, 0, "thermal time constant of the motors")                                  \
    X(max_stiffness, 1020, KNURL_RANGE_STIFFNESS, KNURL_OR_ZERO,                                                       \
      "the stiffest wall that is promised, 0 for no promise")                                                          \
    X(delay, 1, KNURL_RANGE_DELAY, KNURL_WHOLE, "from a force written to a force felt, a whole number")                \
    X(width, 0.160, KNURL_FAKE_SIZE, 0, "workspace along x")                                                           \
    X(height, 0.120, KNURL_FAKE_SIZE, 0, "workspace along y")                                                          \
    X(depth, 0.070, KNURL_FAKE_SIZE, 0, "workspace along z")                                                           \
    X(exact, 0, KNURL_FAKE_FLAG, KNURL_WHOLE, "1: exact motion, 0: four steps a tick if they are stable")              \
    X(tremor, 0.00002, KNURL_FAKE_TREMOR, 0, "rms of the hand's 10 Hz tremor")                                         \
    X(seed, 1, KNURL_FAKE_SEED, KNURL_WHOLE, "of the tremor's noise, a whole number")                                  \
    X(lose_at, 0, KNURL_FAKE_TIME, 0, "when the cable is pulled, until it is looked for; 0 for never")                 \
    X(press_at, 0, KNURL_FAKE_TIME, 0, "when its button is pressed for 0.1 s; 0 for never")

/* Every preset: name, description, and the keys that differ from the defaults.
 *
 * touch: 0.055 mm and 3.3 N from the paper; 160 x 120 x 70 mm, 45 g, 0.26 N, 0.88 N continuous and 1.26, 2.31, 1.02
 * N/mm (x, y, z; the smallest counts) from the Phantom Omni's data sheet, as it is quoted. Its viscous friction is not
 * published: a passive 400 N/m wall at 1 kHz with a tick of delay needs 0.5 N s/m. Its heat_time is assumed: windings
 * of small DC motors take about 10 s, their housings some minutes; with 60 s it plays 3.3 N for 4 s and 2 N for 11 s
 * before the force is reduced.
 *
 * falcon: 8.9 N (2 lbf) at the peak, over 400 dpi (0.06 mm) and 4 inches cubed from Novint's brochure, as it is quoted;
 * 3000 N/m from CHAI3D. Mass, frictions, continuous force (a third of the peak), heat_time and delay (one transfer in
 * each direction at 1 kHz) are assumed.
 *
 * woodenhaptics, omega: as in the drivers of these devices (rawhid/geometry.h and dhd/dhd.c, with sources); the
 * workspace is the cube inside the driver's sphere.
 *
 * inverse3: as in its driver (inverse3/inverse3.c): its maker's data sheet, as it is quoted; the rest is assumed there.
 *
 * ideal: the starting point of theory: a mass without friction, delay or quantisation, and a hand without tremor. */
#define KNURL_FAKE_PRESETS(X)                                                                                          \
    X(touch, "a simulated Touch", "")                                                                                  \
    X(falcon, "a simulated Falcon",                                                                                    \
      "mass=0.2&viscous=1.5&coulomb=0.5&resolution=0.00006&max_force=8.9&continuous_force=3&max_stiffness=3000&"       \
      "delay=2&width=0.1016&height=0.1016&depth=0.1016&exact=1")                                                       \
    X(woodenhaptics, "a simulated WoodenHaptics",                                                                      \
      "mass=0.2&viscous=0.5&coulomb=0.3&resolution=0.0001&max_force=3&continuous_force=1.7&max_stiffness=1000&"        \
      "delay=2&width=0.1155&height=0.1155&depth=0.1155&exact=1")                                                       \
    X(omega, "a simulated omega.3",                                                                                    \
      "mass=0.25&viscous=0.5&coulomb=0.3&resolution=0.00001&max_force=12&continuous_force=4&max_stiffness=5000&"       \
      "delay=1&width=0.0866&height=0.0866&depth=0.0866&exact=1")                                                       \
    X(inverse3, "a simulated Inverse3",                                                                                \
      "mass=0.2&viscous=0.5&coulomb=0.3&resolution=0.00001&max_force=4&continuous_force=3.3&max_stiffness=1000&"       \
      "delay=2&width=0.1155&height=0.1155&depth=0.1155&exact=1")                                                       \
    X(ideal, "an ideal device",                                                                                        \
      "viscous=0&coulomb=0&resolution=0&max_force=1000&continuous_force=0&max_stiffness=0&delay=0&width=1&height=1&"   \
      "depth=1&exact=1&tremor=0")

typedef struct knurl_fake_settings {
#define KNURL_FAKE_FIELD(name, standard, range, kind, meaning) double name;
    KNURL_FAKE_KEYS(KNURL_FAKE_FIELD)
#undef KNURL_FAKE_FIELD
    int32_t resolution_named; /* 1: the URI sets it, so that it also applies to traces */
    int32_t preset;           /* in the order of KNURL_FAKE_PRESETS */
} knurl_fake_settings;

/* Description of a preset, for display; static. */
const char *knurl_fake_preset_name(int32_t preset);

/* Parses "?key=value&key=value", or "". Errors: KNURL_ERROR_ARGUMENT (which key, expected, found). */
knurl_result knurl_fake_parse(const char *options, knurl_fake_settings *settings);

#endif
