/* Knurl: velocity from (quantised) positions, and the map from a device's workspace into the scene.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_MOTION_H
#define KNURL_MOTION_H

#include <knurl/base.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Velocity estimators.
 * DIFFERENCE: the last two positions; exact for positions without quantisation, half a tick late.
 * FOAW: the widest window, of 1, 2, 3, 4, 6, 8, 11 or 15 samples, whose straight line stays within one count of the
 * samples (Janabi-Sharifi 2000); of that window, the mean of the newest third less that of the oldest, over the time
 * between. Positions first pass a backlash of one count, half a count either side: an encoder that flickers between two
 * neighbouring counts stands exactly still, steady motion is as if there were none, a reversal loses one count and a
 * first move half of one. More than one count is not eaten.
 * LOWPASS: the difference, smoothed; for comparison.
 * AUTO: FOAW where the resolution is known (> 0), DIFFERENCE where it is 0. Chosen by the study `velocity`
 * (samples/study/README.md): at 0.055 mm and 1 kHz FOAW is 0.4 to 1.5 mm/s off (rms) from 5 to 200 mm/s, a low pass
 * that is as late 1.9 to 2.3, a difference 16 to 26; at 10 kHz it is as good. Below a count in 15 ms (3.7 mm/s) it
 * pulses, by up to 5 mm/s. */
enum { KNURL_VELOCITY_AUTO = 0, KNURL_VELOCITY_DIFFERENCE = 1, KNURL_VELOCITY_FOAW = 2, KNURL_VELOCITY_LOWPASS = 3 };

/** The widest FOAW window in samples: 15 ticks at 1 kHz, the common choice of the field; in the study twice that
 * is 0.7 times as far off at 10 mm/s and 7 ms later, and worse from 100 mm/s on. It is a time: samples are round(rate /
 * 1 kHz) ticks apart, at least one and at most KNURL_FOAW_STRIDE_MAX, so that it is 15 ms at whole kilohertz up to 10.
 * The newest sample is always this tick's.
 */
#define KNURL_FOAW_WINDOW 15

/** The most ticks that FOAW's samples are apart; from 10.5 kHz on the window is 150 ticks, and shrinks in time. */
#define KNURL_FOAW_STRIDE_MAX 10

/** Hz: the cutoff of LOWPASS, of first order. Chosen to be as late as FOAW's widest window, 8 ms: in the study
 * `velocity` 10 Hz halves its error and doubles its delay, 40 Hz the other way round. */
#define KNURL_VELOCITY_LOWPASS_HZ 20.0

/** Velocity of one point, three axes. Plain data: make one per HIP with knurl_velocity_init(). */
typedef struct knurl_velocity {
    double history[KNURL_FOAW_STRIDE_MAX][32][4]; /**< FOAW: a ring for every phase of the samples; rows as in `held`,
                             the newest in row `newest`, older ones after it; of 16, kept twice so that nobody has to
                             wrap */
    double held[4];     /**< FOAW: the newest position behind the backlash: whole 1024ths of a count, x, y, z, 0 */
    double last[3];     /**< DIFFERENCE, LOWPASS: the previous position, m */
    double smooth[3];   /**< LOWPASS: the previous velocity, m/s */
    double share;       /**< LOWPASS: what a new difference weighs, 0 to 1 */
    double rate;        /**< update rate, Hz */
    double steps_per_m; /**< FOAW: fixed-point steps per metre */
    double slope_unit;  /**< FOAW: m/s per step a sample */
    uint32_t newest;    /**< FOAW: row of the newest position of a ring, 0 to 15 */
    uint32_t started;   /**< 1: a position has been seen */
    int32_t method;     /**< KNURL_VELOCITY_DIFFERENCE, _FOAW or _LOWPASS */
    uint32_t avx;       /**< FOAW: 1: all axes at once, where init found AVX; 0 gives the same numbers, later */
    uint32_t stride;    /**< FOAW: ticks between samples */
    uint32_t phase;     /**< FOAW: the ring of this tick, 0 to stride - 1 */
} knurl_velocity;

/** Prepares an estimator. method: KNURL_VELOCITY_. resolution: position quantum in m, 0 to 1 (0: not quantised; FOAW
 * needs >= 1e-9; it can tell 2^30 quanta either side of 0 apart, 1 m at 1e-9, and chooses its window exactly while 15
 * samples span less than 2^24 quanta, beyond that to a double's rounding). update_rate_hz: 1 to 100,000 Hz.
 * Errors: KNURL_ERROR_ARGUMENT, KNURL_ERROR_UNKNOWN (method). [any thread] */
KNURL_API knurl_result knurl_velocity_init(int32_t method, double resolution, double update_rate_hz,
                                           knurl_velocity *velocity);

/** Takes the position (m, finite) of this tick and gives the velocity (m/s); the first tick gives 0. [haptic thread] */
KNURL_API void knurl_velocity_update(knurl_velocity *velocity, const double position[3],
                                     double out[3]) KNURL_NONBLOCKING;

/** Forgets all positions, so that the next one is a first one again. [haptic thread] */
KNURL_API void knurl_velocity_reset(knurl_velocity *velocity) KNURL_NONBLOCKING;

/** Device to scene: scene = origin + rotation * scale * device. */
typedef struct knurl_workspace {
    double origin[3];   /**< scene position of the device's origin, m */
    double rotation[9]; /**< device axes in the scene: a row-major rotation matrix (right-handed, orthonormal) */
    double scale;       /**< scene metres per device metre, > 0; a wall of K N/m feels like K * scale */
    double reserved;    /**< 0 */
} knurl_workspace;

/** origin 0, no rotation, scale 1. [any thread] */
KNURL_API void knurl_workspace_init(knurl_workspace *workspace);

/** Errors: KNURL_ERROR_ARGUMENT: not finite, scale <= 0, or a rotation off orthonormal by more than 1e-6. [any thread]
 */
KNURL_API knurl_result knurl_workspace_check(const knurl_workspace *workspace);

/** A device position (m) in the scene (m). [any thread; allowed in a tick] */
KNURL_API void knurl_workspace_to_scene(const knurl_workspace *workspace, const double device[3],
                                        double scene[3]) KNURL_NONBLOCKING;

/** A scene position (m) in device coordinates (m). [any thread; allowed in a tick] */
KNURL_API void knurl_workspace_to_device(const knurl_workspace *workspace, const double scene[3],
                                         double device[3]) KNURL_NONBLOCKING;

/** Turns a device velocity (m/s) into the scene's, scale included. [any thread; allowed in a tick] */
KNURL_API void knurl_workspace_velocity_to_scene(const knurl_workspace *workspace, const double device[3],
                                                 double scene[3]) KNURL_NONBLOCKING;

/** Turns a scene direction or force (N) into device axes; lengths are kept. [any thread; allowed in a tick] */
KNURL_API void knurl_workspace_vector_to_device(const knurl_workspace *workspace, const double scene[3],
                                                double device[3]) KNURL_NONBLOCKING;

#ifdef __cplusplus
}
#endif
#endif
