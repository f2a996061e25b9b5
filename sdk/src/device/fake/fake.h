/* The fake device: a plant in a hand, or a trace that is played. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_FAKE_H
#define KNURL_SRC_FAKE_H

#include "device/driver.h"
#include "device/fake/hand.h"
#include "device/fake/plant.h"

/* Every key of a fake URI: name, default, least, greatest, unit, meaning. One table for parsing and for the help.
 * Touch: 0.055 mm and 3.3 N as in the paper; 160 x 120 x 70 mm, 45 g, 0.26 N as on its data sheet. Its viscous damping
 * is not published: 0.5 N s/m is what a passive 400 N/m wall at 1 kHz with a tick of delay needs. The hand is a light
 * grip on a stylus: soft enough to be felt through, stiff enough to keep a 1 mm press. */
#define KNURL_FAKE_KEYS(X)                                                                                             \
    X(mass, 0.045, 0.001, 10.0, "kg", "moving mass")                                                                   \
    X(viscous, 0.5, 0.0, 1000.0, "N s/m", "the device's viscous friction")                                             \
    X(coulomb, 0.26, 0.0, 10.0, "N", "the device's dry friction")                                                      \
    X(hand_stiffness, 700, 0.0, 10000.0, "N/m", "spring of the hand")                                                  \
    X(hand_damping, 5, 0.0, 100.0, "N s/m", "damper of the hand")                                                      \
    X(resolution, 0.000055, 0.0, 0.01, "m", "position quantum, 0 for none")                                            \
    X(max_force, 3.3, 0.001, 1000.0, "N", "what the motors can do")                                                    \
    X(delay, 1, 0.0, 16.0, "ticks", "from a force written to a force felt, a whole number")                            \
    X(width, 0.160, 0.001, 10.0, "m", "workspace along x")                                                             \
    X(height, 0.120, 0.001, 10.0, "m", "workspace along y")                                                            \
    X(depth, 0.070, 0.001, 10.0, "m", "workspace along z")                                                             \
    X(tremor, 0.00002, 0.0, 0.01, "m", "rms of the hand's 10 Hz tremor")                                               \
    X(seed, 1, 0.0, 4294967295.0, "", "of the tremor's noise, a whole number")                                         \
    X(lose_at, 0, 0.0, 1e9, "s", "when the cable is pulled, 0 for never")

typedef struct knurl_fake_settings {
#define KNURL_FAKE_FIELD(name, standard, least, greatest, unit, meaning) double name;
    KNURL_FAKE_KEYS(KNURL_FAKE_FIELD)
#undef KNURL_FAKE_FIELD
    int32_t resolution_named; /* 1: the URI named it, so it holds for traces too */
    uint32_t reserved;
} knurl_fake_settings;

/* Reads "?key=value&key=value", or "". Errors: KNURL_ERROR_ARGUMENT (which key, expected, found). */
knurl_result knurl_fake_parse(const char *options, knurl_fake_settings *settings);

#endif
