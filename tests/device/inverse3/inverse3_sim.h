/* The Haply Inverse Service 3.5 with one or two simulated Inverse3s, written from its public documentation
 * (docs.haply.co/inverseSDK) and from messages in its maker's own client (the crate haply 1.3, unit_tests.rs): its
 * messages to a client that connects, and its answers. Undocumented behaviour is the worst for a driver: the last force
 * is held when commands stop, and a session begins with filters that others have set. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_INVERSE3_SIM_H
#define KNURL_TEST_INVERSE3_SIM_H

#include "device/fake/hand.h"
#include "device/fake/plant.h"

#define INVERSE3_SIM_ROOM 8192 /* bytes of its longest message */

typedef struct inverse3_sim {
    knurl_plant plant;
    knurl_hand hand;
    int strokes; /* 1: its hand strokes along x, 1 mm below y = 0 of the workspace's middle; 0: it holds still there */
    double target[3];
    double begun_at, moved_to, limp_since; /* s; limp_since < 0: its motors get something */
    double force[3];                       /* N, in the service's axes: its motors' force */
    double told[3];                        /* N: the last commanded force */
    double greatest_rise;                  /* N: of the force that its motors play, in one command */
    int told_while_off;                    /* forces commanded while its motors were off */
    double jump;                           /* m, added to x */
    int is_centered;                       /* 1: positions count from the workspace's middle */
    int is_gone;                           /* 1: the device's cable is out */
    int is_unhomed;                        /* 1: it has lost its calibration */
    int is_endless;                        /* 1: its position is sent as a number that is not finite */
    int is_old;                            /* 1: a service before 3.5 */
    int is_unpowered;                      /* 1: its power supply is out */
    int is_not_ready;                      /* 1: it is not ready, for a reason of its own */
    int is_left_out;                       /* so many of its next states leave the device out */
    int grip;                              /* INVERSE3_SIM_: which handle there is */
    double discharged;                     /* of a wireless grip's battery, 0 to 1 */
    int gravity;                           /* its compensation: 1 on, -1 off, 0 never set */
    const char *type;                      /* of the device; null: inverse3 */
    double damping;                        /* N s/m: added by the session's filter */
    int has_second;                        /* 1: there is another device, 0A11, listed before this one */
    double force_of_second[3];
} inverse3_sim;

enum { INVERSE3_SIM_WIRELESS, INVERSE3_SIM_WIRED, INVERSE3_SIM_CUSTOM, INVERSE3_SIM_NO_GRIP };

void inverse3_sim_init(inverse3_sim *sim, double seconds, int strokes);

/* Its first message, into `text`; returns the length. */
int inverse3_sim_greet(inverse3_sim *sim, double seconds, char text[INVERSE3_SIM_ROOM]);

/* Hears a message, ended by a 0, and writes the answer. */
int inverse3_sim_hear(inverse3_sim *sim, double seconds, const char *message, char text[INVERSE3_SIM_ROOM]);

/* Unplugs the device's cable: its motors have no force any more. */
void inverse3_sim_unplug(inverse3_sim *sim, double seconds);

/* Switches its power supply: without it its motors play no force. */
void inverse3_sim_power(inverse3_sim *sim, double seconds, int is_on);

#endif
