/* Knurl: the fake device, a simulated Touch in a simulated hand: its strokes, recorded traces and exact state.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_FAKE_H
#define KNURL_FAKE_H

#include <knurl/device.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The fake device's strokes: motions of the simulated hand's target over a surface. */
enum {
    KNURL_STROKE_LINE = 1,   /**< back and forth along x at constant speed, slower at the ends */
    KNURL_STROKE_SWEEP = 2,  /**< back and forth along x, speed 0 to `speed` and back to 0 within `period` */
    KNURL_STROKE_CIRCLE = 3, /**< a circle at constant speed: every direction of the grating */
    KNURL_STROKE_PRESS = 4,  /**< down to three times the depth and up again, at one point */
    KNURL_STROKE_REST = 5    /**< rests at the depth */
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
    double speed;         /**< m/s, > 0; default 0: 0.25 for SWEEP, else 0.1 */
    double period;        /**< s, for SWEEP and PRESS, > 0; default 5 */
    const double *path;   /**< a path over a curved surface, instead of centre, x, normal and reach: rows of x, y, z on
                               the surface (m) and its outward normal (unit); copied. LINE and SWEEP start in its middle
                               and move back and forth between its ends; CIRCLE moves from the first row to the last and
                               then loops from row path_loop; the others stay in its middle. Default null */
    uint32_t path_rows;   /**< 2 to KNURL_PATH_ROWS_MAX; 0 without a path */
    uint32_t path_loop;   /**< CIRCLE: the row, below path_rows - 1, that closes the loop: the same point as the last */
} knurl_stroke_desc;

/** The most rows of a stroke's path. */
#define KNURL_PATH_ROWS_MAX 65536

/** Fills in defaults; `size` is the caller's sizeof. [any thread] */
KNURL_API void knurl_stroke_desc_init(knurl_stroke_desc *desc, uint32_t size);

/** The keys of a fake URI with units, defaults and meaning, one per line; static. [any thread] */
KNURL_API const char *knurl_fake_keys(void);

/** Sets the stroke of the fake device's hand, from the next knurl_device_start() on.
 * Errors: KNURL_ERROR_ARGUMENT, KNURL_ERROR_UNSUPPORTED (not a fake device), KNURL_ERROR_STATE (a loop with a haptic
 * thread uses it). [game thread] */
KNURL_API knurl_result knurl_fake_set_stroke(knurl_device *device, const knurl_stroke_desc *desc);

/** The exact state of the simulation, for studies and tests; no real device could report it. */
typedef struct knurl_fake_truth {
    double position[3]; /**< m, device frame: before quantisation */
    double velocity[3]; /**< m/s */
    double motor[3];    /**< N: the motors' force during the last period, after delay and limits */
    double hand[3];     /**< N: the force of the hand's spring and damper now */
} knurl_fake_truth;

/** The fake device's state at its last reading. Errors: KNURL_ERROR_UNSUPPORTED (not a fake device, or one that plays a
 * trace). No heap or lock. [haptic thread] */
KNURL_API knurl_result knurl_fake_get_truth(const knurl_device *device, knurl_fake_truth *truth);

/** Plays recorded positions instead of a simulated hand: rows of t (s, ascending), x, y, z (m, device frame). Copied;
 * interpolated linearly; the last one is held, and no force moves them. Positions that were recorded in an encoder's
 * counts are recognised, also if they were written with few digits, and the device's resolution is that of the counts;
 * otherwise, and if it is not certain, they are exact. A resolution in the URI quantises them (0: they are exact).
 * Errors: KNURL_ERROR_ARGUMENT (which row), KNURL_ERROR_UNSUPPORTED (not a fake device), KNURL_ERROR_STATE (a loop with
 * a haptic thread uses it), KNURL_ERROR_MEMORY. [game thread] */
KNURL_API knurl_result knurl_fake_set_trace(knurl_device *device, const double *rows, uint64_t row_count);

/** Finds a stroke by its name ("line", "sweep", "circle", "press", "rest").
 * Errors: KNURL_ERROR_UNKNOWN, with the known names. [any thread] */
KNURL_API knurl_result knurl_stroke_from_name(const char *name, int32_t *stroke);

#ifdef __cplusplus
}
#endif
#endif
