/* Knurl: velocity estimation from (quantised) positions, and the map from a device's workspace into the scene.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_MOTION_H
#define KNURL_MOTION_H

#include <knurl/base.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Velocity estimators.
 * - DIFFERENCE: the difference of the last two positions; exact without quantisation, half a tick late.
 * - FOAW (Janabi-Sharifi 2000): the widest window, of 1, 2, 3, 4, 6, 8, 11 or 15 samples, whose straight line stays
 *   within one quantum of all samples. The velocity is the mean of the window's newest third minus that of its oldest,
 *   divided by the time between them. Before that, positions pass a backlash of one quantum: if an encoder flickers
 *   between two neighbouring values, the velocity is exactly 0; constant motion is unchanged; a reversal loses one
 *   quantum, a first motion half of one.
 *   Samples are round(rate / 1 kHz) ticks apart, at least one and at most 10, so that the widest window is 15 ms at
 *   whole kilohertz up to 10; from 10.5 kHz on it is 150 ticks. The newest sample is always this tick's.
 * - AUTO: FOAW if the resolution is known (> 0), DIFFERENCE if it is 0.
 *
 * FOAW was chosen by the study `velocity` (samples/study/README.md). Errors (rms) at 0.055 mm and 1 kHz from 5 to 200
 * mm/s: FOAW 0.4 to 1.5 mm/s, a low pass of equal delay 1.9 to 2.3, a difference 16 to 26; at 10 kHz the same. A
 * window of 30 ms has 0.7 times the error at 10 mm/s, 7 ms more delay, and a larger error from 100 mm/s on. Below one
 * quantum in 15 ms (3.7 mm/s) FOAW gives pulses of up to 5 mm/s. */
enum { KNURL_VELOCITY_AUTO = 0, KNURL_VELOCITY_DIFFERENCE = 1, KNURL_VELOCITY_FOAW = 2 };

/** A velocity estimator of one point; one per HIP, set up by knurl_velocity_prepare(). It may be copied and needs no
 * freeing. Its size is the same in all versions; its contents are the library's and may change. */
typedef struct knurl_velocity {
    uint64_t alignment; /**< of `state` */
    char state[11256];
} knurl_velocity;

/** Sets up an estimator. method: KNURL_VELOCITY_. resolution: position quantum in m, 0 to 1 (0: not quantised; FOAW
 * needs >= 1e-9). update_rate_hz: 1 to 100,000 Hz. FOAW covers 2^30 quanta to either side of 0 (1 m at 1e-9); its
 * choice of the window is exact if 15 samples span less than 2^24 quanta, and rounded to doubles beyond.
 * Errors: KNURL_ERROR_ARGUMENT, KNURL_ERROR_UNKNOWN (method). [any thread] */
KNURL_API knurl_result knurl_velocity_prepare(int32_t method, double resolution, double update_rate_hz,
                                              knurl_velocity *velocity);

/** Adds this tick's position (m, finite) and computes the velocity (m/s); 0 at the first tick. [haptic thread] */
KNURL_API void knurl_velocity_update(knurl_velocity *velocity, const double position[3],
                                     double out[3]) KNURL_NONBLOCKING;

/** s: over which knurl_velocity_track() takes the mean of velocities. By the study `tracking`, 0.1 s is as clean at
 * steady speeds, but follows a tremor or a hand whose speed wavers less well; 0.01 s lets more of the counts' steps
 * through. */
#define KNURL_TRACK_S 0.02

/** Finds a position between an encoder's counts, as smooth as the motion: the last one moved on by the mean of
 * `velocity` over KNURL_TRACK_S, and within half the resolution of the measured one on each axis. So it is off by at
 * most a count, and stands still if the encoder flickers. With resolution 0 it is the measured position. Once a tick,
 * after knurl_velocity_update() if that gives the velocity (m/s). position: m, finite. [haptic thread] */
KNURL_API void knurl_velocity_track(knurl_velocity *estimator, const double position[3], const double velocity[3],
                                    double tracked[3]) KNURL_NONBLOCKING;

/** Device to scene: scene = origin + rotation * scale * device. */
typedef struct knurl_workspace {
    double origin[3];   /**< scene position of the device's origin, m, within KNURL_COORDINATE_MAX */
    double rotation[9]; /**< device axes in the scene: a row-major rotation matrix (right-handed, orthonormal) */
    double scale;       /**< scene metres per device metre, 1e-9 to 1e9. At the device a wall of K N/m has K * scale */
    double reserved[3]; /**< 0 */
} knurl_workspace;

/** Sets the identity: origin 0, no rotation, scale 1. [any thread] */
KNURL_API void knurl_workspace_set_identity(knurl_workspace *workspace);

/** Checks a workspace map. Errors: KNURL_ERROR_ARGUMENT if origin or scale is out of range, or the rotation is off
 * orthonormal by more than 1e-6. [any thread] */
KNURL_API knurl_result knurl_workspace_check(const knurl_workspace *workspace);

/** Maps a device position (m) into the scene (m). [any thread; allowed in a tick] */
KNURL_API void knurl_workspace_to_scene(const knurl_workspace *workspace, const double device[3],
                                        double scene[3]) KNURL_NONBLOCKING;

/** Maps a scene position (m) to device coordinates (m). [any thread; allowed in a tick] */
KNURL_API void knurl_workspace_to_device(const knurl_workspace *workspace, const double scene[3],
                                         double device[3]) KNURL_NONBLOCKING;

/** Rotates a scene direction or force (N) into device axes; lengths are kept. [any thread; allowed in a tick] */
KNURL_API void knurl_workspace_vector_to_device(const knurl_workspace *workspace, const double scene[3],
                                                double device[3]) KNURL_NONBLOCKING;

#ifdef __cplusplus
}
#endif
#endif
