/* Knurl: force-feedback devices behind one interface. This version has the fake one: a simulated Touch in a simulated
 * hand, for people with no device on the desk.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_DEVICE_H
#define KNURL_DEVICE_H

#include <knurl/base.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct knurl_device knurl_device;

/** What a device is. An output: set struct_size with knurl_device_info_init() first. Device frame, SI. */
typedef struct knurl_device_info {
    uint32_t struct_size;
    uint32_t reserved;       /**< 0 */
    char name[64];           /**< for people */
    double workspace_min[3]; /**< m */
    double workspace_max[3]; /**< m */
    double resolution;       /**< position quantum, m; 0: not quantised */
    double max_force;        /**< N */
    double delay;            /**< ticks from a force written to a force felt, beyond the tick itself */
    double continuous_force; /**< N that the motors can hold for ever; INFINITY: no limit but max_force */
    double heat_time;        /**< s: time constant with which the motors warm up, > 0 */
    double mass;             /**< kg: apparent mass at the grip, without the hand's */
    double viscous;          /**< N s/m: the device's own viscous friction */
    double coulomb;          /**< N: the device's own dry friction */
    double max_stiffness;    /**< N/m: the stiffest wall that its maker promises; INFINITY: nothing is promised */
} knurl_device_info;

/** One reading. Device frame: x right, y up, z towards the user. */
typedef struct knurl_device_sample {
    double position[3]; /**< m */
    uint32_t buttons;   /**< bit 0: first button */
    uint32_t reserved;  /**< 0 */
} knurl_device_sample;

/** One kind of device in a listing. */
typedef struct knurl_device_listing {
    const char *uri;    /**< what to open it with; static */
    const char *name;   /**< for people; static */
    const char *reason; /**< why it cannot be used, or "" where it can; static */
} knurl_device_listing;

/** The fake device's strokes: how its hand's target moves over the stroke frame. */
enum {
    KNURL_STROKE_LINE = 1,   /**< back and forth along x at a steady speed, slower at the turns */
    KNURL_STROKE_SWEEP = 2,  /**< back and forth along x, speed 0 to `speed` and back to 0 within `period` */
    KNURL_STROKE_CIRCLE = 3, /**< round and round at a steady speed: every direction of the grating */
    KNURL_STROKE_PRESS = 4,  /**< down to three times the depth and up again, on the spot */
    KNURL_STROKE_REST = 5    /**< stands still at the depth */
};

/** A stroke of the fake device's hand, in device coordinates. The target starts 5 mm above the surface, comes down
 * within 0.25 s and then moves, `depth` below the surface. */
typedef struct knurl_stroke_desc {
    uint32_t struct_size; /**< set by knurl_stroke_desc_init() */
    int32_t stroke;       /**< KNURL_STROKE_; default LINE */
    double centre[3];     /**< on the surface, m; default 0 */
    double x[3];          /**< unit: the direction of the stroke; default 1, 0, 0 */
    double normal[3];     /**< unit, outward, at right angles to x; default 0, 1, 0 */
    double reach[2];      /**< m either side of the centre along x and along normal x x, > 0; default 0.05, 0.02 */
    double depth;         /**< m below the surface; default 0.001 */
    double speed;         /**< m/s, > 0; default 0 means: 0.25 for SWEEP, else 0.1 */
    double period;        /**< s, of SWEEP and PRESS, > 0; default 5 */
} knurl_stroke_desc;

/** Fill in defaults; `size` is the caller's sizeof. [any thread] */
KNURL_API void knurl_device_info_init(knurl_device_info *info, uint32_t size);
KNURL_API void knurl_stroke_desc_init(knurl_stroke_desc *desc, uint32_t size);

/** Opens a device by URI: "fake", or "fake:?key=value&..." with any of the keys that knurl_fake_keys() lists; a later
 * key counts over an earlier one, and `preset` sets all of them anew.
 * Errors: KNURL_ERROR_UNKNOWN (device), KNURL_ERROR_ARGUMENT (key or value), KNURL_ERROR_UNSUPPORTED (touch, falcon and
 * rawhid: their drivers are not in this version), KNURL_ERROR_MEMORY. [game thread] */
KNURL_API knurl_result knurl_device_open(const char *uri, knurl_device **device);

/** Lets go of the motors and closes; null is allowed. No loop may use the device. [game thread] */
KNURL_API void knurl_device_close(knurl_device *device);

/** The kinds of device: fills at most `capacity` listings, returns how many there are. [any thread] */
KNURL_API uint32_t knurl_device_list(knurl_device_listing *listings, uint32_t capacity);

/** What the device is. Errors: KNURL_ERROR_ARGUMENT. [any thread] */
KNURL_API knurl_result knurl_device_get_info(const knurl_device *device, knurl_device_info *info);

/** Prepares for reading once every 1/update_rate_hz; the fake device starts its simulated time anew.
 * Errors: KNURL_ERROR_ARGUMENT (rate). [game thread] */
KNURL_API knurl_result knurl_device_start(knurl_device *device, double update_rate_hz);

/** Reads the newest sample; the fake device's simulated time moves on by one period.
 * Errors: KNURL_ERROR_DEVICE_LOST. No heap, lock or message. [haptic thread] */
KNURL_API knurl_result knurl_device_read(knurl_device *device, knurl_device_sample *sample);

/** Writes the force (device axes, N). A force that is not finite is written as 0; longer than max_force is shortened.
 * Errors: KNURL_ERROR_DEVICE_LOST. No heap, lock or message. [haptic thread] */
KNURL_API knurl_result knurl_device_write(knurl_device *device, const double force[3]);

/** Lets go of the motors at once, whatever the haptic thread does; what it writes afterwards counts again only after
 * knurl_device_release_halt(). [any thread] */
KNURL_API void knurl_device_halt(knurl_device *device);

/** Ends a halt. [haptic thread] */
KNURL_API void knurl_device_release_halt(knurl_device *device);

/** 1 while halted. [any thread] */
KNURL_API uint32_t knurl_device_is_halted(const knurl_device *device);

/** The keys of a fake URI, their units, defaults and meaning, a line each; static. [any thread] */
KNURL_API const char *knurl_fake_keys(void);

/** Gives the fake device's hand a stroke; from the next knurl_device_start().
 * Errors: KNURL_ERROR_ARGUMENT, KNURL_ERROR_UNSUPPORTED (not a fake device). [game thread] */
KNURL_API knurl_result knurl_fake_set_stroke(knurl_device *device, const knurl_stroke_desc *desc);

/** What the simulated world really is, for studies and tests: nothing that a real device could tell. */
typedef struct knurl_fake_truth {
    double position[3]; /**< m, device frame: before it is quantised */
    double velocity[3]; /**< m/s */
    double motor[3];    /**< N: the force that acted over the period that ends now, delayed and limited */
    double hand[3];     /**< N: what the hand's spring and damper pull with now */
} knurl_fake_truth;

/** The fake device as of its latest reading. Errors, without a message: KNURL_ERROR_UNSUPPORTED (not a fake device, or
 * one that plays a trace). No heap, lock or message. [haptic thread] */
KNURL_API knurl_result knurl_fake_get_truth(const knurl_device *device, knurl_fake_truth *truth);

/** Plays positions instead of a hand: rows of t (s, ascending), x, y, z (m, device frame), copied, interpolated
 * linearly, the last one held. The positions are exact unless the URI names a resolution; no force moves them. Errors:
 * KNURL_ERROR_ARGUMENT (which row), KNURL_ERROR_UNSUPPORTED (not a fake device), KNURL_ERROR_MEMORY. [game thread] */
KNURL_API knurl_result knurl_fake_set_trace(knurl_device *device, const double *rows, uint64_t row_count);

/** The stroke of a name ("line", "sweep", "circle", "press", "rest").
 * Errors: KNURL_ERROR_UNKNOWN, with the names that are known. [any thread] */
KNURL_API knurl_result knurl_stroke_from_name(const char *name, int32_t *stroke);

#ifdef __cplusplus
}
#endif
#endif
