/* Messages of the Haply Inverse Service, version 3.5: JSON, one answer per message. Written from its public
 * documentation (docs.haply.co/inverseSDK). Its axes: x right, y away from the user, z up; m, N.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_INVERSE3_MESSAGE_H
#define KNURL_SRC_INVERSE3_MESSAGE_H

#include "base/finite.h"

#include <stddef.h>
#include <stdint.h>

#define KNURL_INVERSE3_ID_ROOM 16    /* bytes of a device's id; documented ids have four characters */
#define KNURL_INVERSE3_DEVICES 8     /* read at most; more are ignored */
#define KNURL_INVERSE3_COMMAND 320   /* bytes of the longest command */
#define KNURL_INVERSE3_LONGEST 65536 /* bytes of the longest message accepted */

/* One device in a message, in the service's axes. */
typedef struct knurl_inverse3_entry {
    char id[KNURL_INVERSE3_ID_ROOM];
    char type[KNURL_INVERSE3_ID_ROOM]; /* "inverse3", "inverse3x", "minverse"; "": not sent, as in all but the first */
    double position[3];                /* m */
    double joints[3];                  /* degrees; zeros if one is missing */
    double force_gate;                 /* gain of the session's filter; 0: no filter, or not sent */
    uint32_t has_position;             /* 1: all three of its numbers were present */
    uint32_t has_preset;               /* 1: its configuration has a preset: the service is 3.5 or newer */
    /* 1: reported by the service */
    uint32_t is_unpowered, is_uncalibrated, is_not_ready;
} knurl_inverse3_entry;

/* A handle: a VerseGrip, or another maker's. */
typedef struct knurl_inverse3_grip {
    char id[KNURL_INVERSE3_ID_ROOM];
    double orientation[4]; /* x, y, z, w */
    double battery;        /* its charge, 0 to 1; 0: not sent */
    uint32_t buttons;      /* bit 0: a, or the only one; bit 1: b; bit 2: c */
} knurl_inverse3_grip;

typedef struct knurl_inverse3_state {
    knurl_inverse3_entry entries[KNURL_INVERSE3_DEVICES];
    /* wireless, custom, wired; a custom one may be in the list twice */
    knurl_inverse3_grip grips[KNURL_INVERSE3_DEVICES];
    uint32_t grip_count;
} knurl_inverse3_state;

/* Reads a message. Returns 0 if it is not a JSON object. Fields that are missing or invalid are 0 or "". */
int knurl_inverse3_read(const char *text, size_t size, knurl_inverse3_state *state);

/* Reads an event of the service: 1 if the emergency brake of the device with this id is on now, 0 if it is released, -1
 * for other events and anything else. */
int knurl_inverse3_read_brake(const char *text, size_t size, const char *id);

/* The entry with this id, or the first if id is ""; null if there is no such entry. */
const knurl_inverse3_entry *knurl_inverse3_find(const knurl_inverse3_state *state, const char *id);

/* The handle with this id; or, if id is "", the first that tells its orientation. Zeros without a match. Its
 * orientation is in Knurl's axes, and of unit length or zeros. */
void knurl_inverse3_find_grip(const knurl_inverse3_state *state, const char *id, knurl_inverse3_grip *found);

/* Convert positions to Knurl's axes (x right, y up, z towards the user), and forces to the service's. */
void knurl_inverse3_to_knurl(const double from[3], double to[3]);
void knurl_inverse3_from_knurl(const double from[3], double to[3]);

/* Writes the command for a device to play this force (N, Knurl's axes, each component below 1000), with a decimal point
 * in every locale. configuration: knurl_inverse3_configuration() to set up the session too, else "". Returns its
 * length. */
size_t knurl_inverse3_command(char text[KNURL_INVERSE3_COMMAND], const char *id, const double force[3],
                              const char *configuration);

/* Part of a command: positions from the middle of the workspace, no damping by the service; gravity: "1" or "0"
 * switches its compensation, "" leaves it alone. */
const char *knurl_inverse3_configuration(const char *gravity);

#endif
