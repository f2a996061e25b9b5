/* The stand-in for OpenHaptics: its interface for tests. It simulates the project's plant in the project's hand, one
 * per device. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_STUB_HD_H
#define KNURL_TEST_STUB_HD_H

#include "base/system.h"

/** The devices that are plugged in: "Default Device" (null), "Left Device", "Right Device". */
enum { STUB_DEFAULT, STUB_LEFT, STUB_RIGHT, STUB_DEVICES };

/** Settings, initially 0. Of a device, or of the library if noted. */
enum {
    STUB_ABSENT,        /* 1: unplugged: cannot be initialised, and each frame fails */
    STUB_FAIL_AT,       /* frames until STUB_ABSENT is set; 0: never */
    STUB_ERROR,         /* an error code that each frame brings */
    STUB_ERRORS,        /* number per frame; 0 means 1; negative: without end */
    STUB_NAN,           /* 1: positions are NaN */
    STUB_JUMP,          /* m added to x */
    STUB_CALIBRATION,   /* 0: calibrated, otherwise the result of hdCheckCalibration() */
    STUB_STYLES,        /* a mask of the styles of calibration that it offers; 0 means: automatic and inkwell */
    STUB_MENDS,         /* 1: hdUpdateCalibration() with one of these styles makes it calibrated */
    STUB_STROKE,        /* KNURL_STROKE_ of the hand at the next initialisation; 0: line */
    STUB_LOOSE,         /* 1: no hand holds it */
    STUB_RANDOM,        /* 1: results and errors are random */
    STUB_TELLS_NOTHING, /* 1: knows none of its properties */
    STUB_INIT_ERROR,    /* an error code that initialising brings */
    STUB_REFUSED_RATE,  /* library: Hz that the scheduler refuses */
    STUB_RATE_ERROR,    /* library: an error code that setting any rate brings, and the rate stays */
    STUB_GARBAGE,       /* library: 1: after a call of hdInitDevice() that failed, the next returns a great number */
    STUB_STALL,         /* library: 1: the scheduler stops calling */
    STUB_DRIFTS,        /* library: 1: in frames, the current device becomes another, as if another thread had changed
                           it */
    STUB_DAWDLES,       /* library: 1: threads but the scheduler's take their time after hdMakeCurrentDevice(), and the
                           scheduler's before it takes a force */
    STUB_BY_HAND,       /* library: 1: turns only by stub_turn() */
    STUB_SETTINGS
};

/** Queries. */
enum {
    STUB_INITIALISED,  /* 1: in use */
    STUB_UPDATES,      /* calls of hdUpdateCalibration() */
    STUB_LAST_STYLE,   /* its argument */
    STUB_FRAMES,       /* ended */
    STUB_TOLD,         /* N: length of the commanded force */
    STUB_TOLD_MOST,    /* N: the greatest so far */
    STUB_GAPS,         /* frames without force after one that had some */
    STUB_TOLD_BAD,     /* forces that were not finite */
    STUB_DEPTH,        /* m below y = 0 */
    STUB_MISUSES,      /* library: calls that HD's reference does not allow */
    STUB_STARTS,       /* library: of the scheduler */
    STUB_RUNNING,      /* library: 1: the scheduler is */
    STUB_CALLBACKS,    /* library: on its list */
    STUB_RATE,         /* library: Hz */
    STUB_ERRORS_TAKEN, /* library: most calls of hdGetError() in one turn */
    STUB_QUESTIONS
};

/** The default device's commanded force, for a process that survives this one. */
typedef struct stub_told {
    double newton;
    int64_t limp_since; /* as stub_limp_function */
} stub_told;

/** The library's functions for tests; STUB_FUNCTIONS(X): type, name. */
typedef void (*stub_set_function)(int device, int setting, double value);
typedef double (*stub_ask_function)(int device, int question);
typedef int64_t (*stub_limp_function)(
    int device); /* ns on the monotonic clock: start of zero force; 0: there is a force */
typedef void (*stub_mirror_function)(stub_told *to); /* kept: commanded forces are written there as well */
typedef void (*stub_turn_function)(uint64_t turns);
/** The clock, sleeps and threads that it uses (copied): the test program's, which may simulate time; the default: the
 * system's. */
typedef struct stub_time {
    int64_t (*now_ns)(void);
    void (*sleep_until_ns)(int64_t deadline_ns);
    knurl_thread *(*start_thread)(void (*entry)(void *argument), void *argument, size_t stack_bytes);
    void (*join_thread)(knurl_thread *thread);
} stub_time;
typedef void (*stub_use_time_function)(const stub_time *time);

/** Those that a test program is linked with. */
static const stub_time stub_program_time = {knurl_system_now_ns, knurl_system_sleep_until_ns, knurl_system_start_thread,
                                            knurl_system_join_thread};

typedef void (*stub_reset_function)(void); /* as new; nothing may be in use */

#endif
