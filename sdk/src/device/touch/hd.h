/* The part of 3D Systems' OpenHaptics HD API that Knurl uses: types, constants and functions, rewritten from its public
 * reference. The library is loaded at run time (hd_load.c). Lengths mm, stiffness N/mm, forces N.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_HD_H
#define KNURL_SRC_HD_H

#include "base/finite.h"

#include <knurl/base.h>

#include <stdint.h>

/* Of functions and callbacks; other platforms have one convention. */
#if defined(_WIN32) && !defined(_WIN64)
#define HD_CALL __stdcall
#else
#define HD_CALL
#endif

typedef uint32_t hd_enum;
typedef uint32_t hd_device;              /* HHD */
typedef unsigned long hd_scheduler_code; /* HDSchedulerHandle: 8 bytes on 64-bit Linux, 4 on Windows */
typedef uint32_t(HD_CALL *hd_callback)(void *user);

/* Returned by value, newest first. */
typedef struct hd_error {
    uint32_t code; /* 0: no (further) error */
    int32_t internal;
    hd_device device; /* current when it occurred */
} hd_error;

#define HD_NO_DEVICE ((hd_device)0xFFFFFFFF)

/* Handles count from 0. After a failed hdInitDevice(), the next call may return a larger number without an error,
 * although it is not a device (a warning in HAPI's PhantomHapticsDevice.cpp). */
#define HD_DEVICE_MOST 1024u

/* Return values of a callback. */
enum { HD_DONE = 0, HD_AGAIN = 1 };

#define HD_PRIORITY_MOST ((unsigned short)65535)

enum {
    HD_BUTTONS = 0x2000,
    HD_POSITION = 0x2050,  /* 3 doubles, mm */
    HD_TRANSFORM = 0x2052, /* 16 doubles, column by column: from the stylus' axes to the device's, mm */
    HD_JOINTS = 0x2100,    /* 3 doubles, rad: turret, thigh, shin */
    HD_GIMBAL = 0x2150,    /* 3 doubles, rad: of the stylus */
    HD_VERSION = 0x2500,
    HD_MODEL = 0x2501,
    HD_DRIVER_VERSION = 0x2502,
    HD_USABLE_WORKSPACE = 0x2551,  /* 6 doubles, mm: minimum x, y, z, maximum x, y, z */
    HD_CALIBRATION_STYLE = 0x2555, /* an integer: mask of the device's HD_STYLE_ */
    HD_MAX_STIFFNESS = 0x2602,     /* N/mm */
    HD_MAX_FORCE = 0x2603,         /* N */
    HD_CONTINUOUS_FORCE = 0x2604,  /* N */
    HD_MAX_DAMPING = 0x2609,       /* N s/mm */
    HD_FORCE = 0x2700,             /* 3 doubles, N */
    HD_FORCE_OUTPUT = 0x4000,      /* a capability */
    HD_CALIBRATED = 0x5000,        /* results of hdCheckCalibration(): this and the next two */
    HD_CALIBRATION_STALE = 0x5001, /* hdUpdateCalibration() corrects it */
    HD_CALIBRATION_MANUAL = 0x5002 /* needs a person's help */
};

/* Calibration styles. hdUpdateCalibration() takes one of them. */
enum { HD_STYLE_ENCODER = 1, HD_STYLE_AUTO = 2, HD_STYLE_INKWELL = 4 };

/* Functions: field, symbol, return type, parameters. Loaded only if all exist. */
#define HD_FUNCTIONS(X)                                                                                                \
    X(init, hdInitDevice, hd_device, (const char *name))                                                               \
    X(disable_device, hdDisableDevice, void, (hd_device device))                                                       \
    X(make_current, hdMakeCurrentDevice, void, (hd_device device))                                                     \
    X(current, hdGetCurrentDevice, hd_device, (void))                                                                  \
    X(begin_frame, hdBeginFrame, void, (hd_device device))                                                             \
    X(end_frame, hdEndFrame, void, (hd_device device))                                                                 \
    X(enable, hdEnable, void, (hd_enum what))                                                                          \
    X(disable, hdDisable, void, (hd_enum what))                                                                        \
    X(get_integers, hdGetIntegerv, void, (hd_enum what, int32_t *values))                                              \
    X(get_doubles, hdGetDoublev, void, (hd_enum what, double *values))                                                 \
    X(set_doubles, hdSetDoublev, void, (hd_enum what, const double *values))                                           \
    X(get_string, hdGetString, const char *, (hd_enum what))                                                           \
    X(next_error, hdGetError, hd_error, (void))                                                                        \
    X(check_calibration, hdCheckCalibration, hd_enum, (void))                                                          \
    X(update_calibration, hdUpdateCalibration, void, (hd_enum style))                                                  \
    X(start_scheduler, hdStartScheduler, void, (void))                                                                 \
    X(stop_scheduler, hdStopScheduler, void, (void))                                                                   \
    X(set_rate, hdSetSchedulerRate, void, (unsigned long rate))                                                        \
    X(schedule, hdScheduleAsynchronous, hd_scheduler_code,                                                             \
      (hd_callback callback, void *user, unsigned short priority))                                                     \
    X(call_in_turn, hdScheduleSynchronous, void, (hd_callback callback, void *user, unsigned short priority))          \
    X(unschedule, hdUnschedule, void, (hd_scheduler_code what))

typedef struct hd_api {
/* NOLINTNEXTLINE(bugprone-macro-parentheses): a type and a list of parameters cannot stand in any */
#define HD_FIELD(field, symbol, result, arguments) result(HD_CALL *field) arguments;
    HD_FUNCTIONS(HD_FIELD)
#undef HD_FIELD
} hd_api;

/* Errors: code, and problem; remedy. */
#define HD_ERRORS(X)                                                                                                   \
    X(0x0100, "HD has no such parameter; another version of OpenHaptics may have it")                                  \
    X(0x0101, "HD does not allow this value")                                                                          \
    X(0x0102, "HD does not allow this now")                                                                            \
    X(0x0103, "HD has no such parameter of this type; another version of OpenHaptics may have it")                     \
    X(0x0104, "HD no longer has this device; open it again")                                                           \
    X(0x0200, "its motors are too warm; let it rest for some minutes")                                                 \
    X(0x0201, "the force is greater than it can play; play weaker forces")                                             \
    X(0x0202, "the force rises faster than it allows; play softer surfaces")                                           \
    X(0x0203, "it moves faster than it allows; hold it more firmly, or let it cool down if its motors are warm")       \
    X(0x0204, "it could not play the force; see that the arm is free, and unplug its power for a moment")              \
    X(0x0300, "it reports a fault of its own; unplug power and cable for a moment, then run Touch_Diagnostic")         \
    X(0x0301, "it is in use already; close the other program (or the other part of this one) that has opened it")      \
    X(0x0302, "it does not answer; see that its cable and its power are plugged in, then run its set-up program "      \
              "(Touch Setup; Linux: Touch_AdvancedConfig), which must find it")                                        \
    X(0x0303,                                                                                                          \
      "it cannot be reached by the connection in its set-up; run its set-up program again (Touch Setup; Linux: "       \
      "Touch_AdvancedConfig), and see that GTDD_HOME names the folder of its configuration")                           \
    X(0x0304, "the system gave HD no timer for its scheduler; see that no other program runs one")                     \
    X(0x0400, "a frame was begun at a time when that is not allowed")                                                  \
    X(0x0401, "a frame was ended that was not begun")                                                                  \
    X(0x0402, "a frame was begun twice")                                                                               \
    X(0x0500, "HD's scheduler has no such priority")                                                                   \
    X(0x0501, "HD's scheduler is full; end other uses of it")                                                          \
    X(0x0600, "HD found no valid licence; install the OpenHaptics edition that goes with the device's driver")

/* The sentence of an error; static, never null, also for unknown codes. */
const char *knurl_hd_error_sentence(uint32_t code);

/* 1 if after this error the device is gone until it is initialised again. */
int knurl_hd_error_is_loss(uint32_t code);

/* 1 if after this error the device does not play the force it was sent. */
int knurl_hd_error_is_refusal(uint32_t code);

/* Removes the errors that HD has queued, newest first. Returns their number. */
#define HD_ERRORS_AT_ONCE 16
int knurl_hd_take_errors(const hd_api *hd, hd_error errors[HD_ERRORS_AT_ONCE]);

/* Loads the library, or counts one more user if it is loaded. `path`: the library, or "" for the environment variable
 * KNURL_HD_LIBRARY, then the usual names. `device`: for messages. Errors: KNURL_ERROR_UNSUPPORTED (every attempt, with
 * the system's reason), KNURL_ERROR_ARGUMENT (another library is loaded). [one thread at a time] */
knurl_result knurl_hd_acquire(const char *path, const char *device, const hd_api **hd);

/* Counts one user less, and unloads the library after the last one. */
void knurl_hd_release(void);

#endif
