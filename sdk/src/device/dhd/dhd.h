/* The part of Force Dimension's DHD library that Knurl uses: constants and functions, rewritten from its public header
 * (3.7 and later). The library is loaded at run time. Axes: x towards the user, y right, z up; m, N.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_DHD_H
#define KNURL_SRC_DHD_H

#include <knurl/base.h>

#if defined(_WIN32) && !defined(_WIN64)
#define DHD_CALL __stdcall
#else
#define DHD_CALL
#endif

#define DHD_USB_VENDOR 0x1451u

/* Results of dhdGetSystemType(). */
enum {
    DHD_OMEGA = 32,
    DHD_OMEGA3 = 33,
    DHD_OMEGA6 = 34,
    DHD_OMEGA7 = 35,
    DHD_OMEGA6_LEFT = 36,
    DHD_OMEGA7_LEFT = 37,
    DHD_FALCON = 60,
    DHD_DELTA3 = 63,
    DHD_DELTA6 = 64,
    DHD_SIGMA7 = 104,
    DHD_SIGMA7_LEFT = 105,
    DHD_SIGMA6 = 106, /* "33P" */
    DHD_SIGMA6_LEFT = 107,
    DHD_SIGMA3 = 206,
    DHD_LAMBDA7 = 108, /* 3.8 and later */
    DHD_LAMBDA7_LEFT = 109,
    DHD_LAMBDA6 = 131,
    DHD_LAMBDA6_LEFT = 132,
    DHD_LAMBDA3 = 203
};

/* Indices into the status array of dhdGetStatus(). */
enum {
    DHD_STATUS_POWER = 0,
    DHD_STATUS_CONNECTED = 1,
    DHD_STATUS_RESET = 3,
    DHD_STATUS_FORCE = 5,            /* 1 if the controller is in its force mode */
    DHD_STATUS_FORCE_OFF_CAUSE = 14, /* of the last time: KNURL_FORCE_OFF_BUTTON to _DEADMAN; kept afterwards */
    DHD_STATUS_ROOM = 64             /* 16 in 3.7, more in later ones */
};

#define DHD_ANGLES 8 /* written by dhdGetJointAngles() */

/* Results of dhdErrorGetLast() if the device is gone. */
enum { DHD_ERROR_COM = 2, DHD_ERROR_NO_DEVICE = 5, DHD_ERROR_NOT_AVAILABLE = 6 };

/* Functions: field, return type, symbol, parameters. Loaded only if all exist. Results below 0 are errors; 1 and 2 mean
 * that the library has waited, or that a motor is at its limit. */
#define DHD_FUNCTIONS(X)                                                                                               \
    X(count, int, dhdGetDeviceCount, (void))                                                                           \
    X(open, int, dhdOpenID, (char index))                                                                              \
    X(close, int, dhdClose, (char id))                                                                                 \
    X(enable_force, int, dhdEnableForce, (unsigned char on, char id))                                                  \
    X(type, int, dhdGetSystemType, (char id))                                                                          \
    X(name, const char *, dhdGetSystemName, (char id))                                                                 \
    X(status, int, dhdGetStatus, (int *status, char id))                                                               \
    X(buttons, unsigned, dhdGetButtonMask, (char id))                                                                  \
    X(get_position, int, dhdGetPosition, (double *x, double *y, double *z, char id))                                   \
    X(get_orientation, int, dhdGetOrientationFrame, (double *rows, char id))                                           \
    X(get_grip, int, dhdGetGripperAngleRad, (double *angle, char id))                                                  \
    X(get_joints, int, dhdGetJointAngles, (double *angles, char id))                                                   \
    X(is_left, unsigned char, dhdIsLeftHanded, (char id)) /* C++'s bool */                                             \
    X(set_gravity, int, dhdSetGravityCompensation, (int on, char id))                                                  \
    X(set_force, int, dhdSetForceAndTorqueAndGripperForce,                                                             \
      (double fx, double fy, double fz, double tx, double ty, double tz, double grip, char id))                        \
    X(error, int, dhdErrorGetLast, (void))                                                                             \
    X(error_text, const char *, dhdErrorGetLastStr, (void))

typedef struct dhd_api {
/* NOLINTNEXTLINE(bugprone-macro-parentheses): a type and a list of parameters cannot stand in any */
#define DHD_FIELD(field, result, symbol, arguments) result(DHD_CALL *field) arguments;
    DHD_FUNCTIONS(DHD_FIELD)
#undef DHD_FIELD
} dhd_api;

#endif
