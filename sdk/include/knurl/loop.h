/* Knurl: the real-time loop. Each cycle reads a device, ticks a scene (or calls a force callback) and writes the force.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_LOOP_H
#define KNURL_LOOP_H

#include <knurl/device.h>
#include <knurl/hip.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A loop can be started once; it can be paused and resumed. The heat of the motors belongs to the device: its next
 * loop starts with the last one's heat, cooled by the time since then if both use the same clock. In a stepped loop,
 * each tick is one period of heating or cooling. */
typedef struct knurl_loop knurl_loop;

/** Computes the force instead of a scene. tick: counts from 0. force: to be written, N, device axes. [haptic thread] */
typedef void (*knurl_force_callback)(uint64_t tick, const knurl_device_sample *sample, double force[3], void *user);

/** Computes a torque and a gripper's force, of which it gets zeros; called in each tick after the scene or the force
 * callback. Whatever shortens the force to zero (a halt, a pause, the ramps, the gain, a lost position) applies to them
 * in the same tick. Then the torque is shortened to max_torque and the gripper's force to max_grip; if one of the
 * numbers is not finite, all are zero. [haptic thread] */
typedef void (*knurl_torque_callback)(uint64_t tick, const knurl_device_sample *sample, knurl_device_torque *torque,
                                      void *user);

/** Called with every tick's output once its force is written, for recording. It must not allocate, lock or wait. The
 * forces in `output` are as sent: ramps included, zero while the device is halted. The ramp at the loop's end has no
 * ticks; see knurl_scene_get_tick() for its forces. [haptic thread] */
typedef void (*knurl_tick_callback)(const knurl_tick_output *output, void *user);

/** A monotonic clock that replaces the system's, for tests. [haptic thread] */
typedef struct knurl_clock {
    int64_t (*now_ns)(void *user);
    void (*sleep_until_ns)(int64_t deadline_ns, void *user);
    void *user;
} knurl_clock;

typedef struct knurl_loop_desc {
    uint32_t struct_size; /**< set by knurl_loop_desc_init() */
    uint32_t hip;         /**< index of the scene's HIP; default 0. No other loop can use it while this one exists */
    knurl_device *device; /**< required. No other loop can use it while this one exists */
    knurl_scene *scene;   /**< committed, its HIP configured with the same update rate; or null */
    knurl_force_callback force_callback; /**< used if scene is null */
    knurl_tick_callback tick_callback;   /**< or null */
    void *user;                          /**< passed to all callbacks */
    double update_rate_hz;               /**< KNURL_UPDATE_RATE_MIN to _MAX; default 1000 */
    uint64_t tick_limit;                 /**< the loop ends after so many ticks; 0 (default): never */
    double ramp_s;                       /**< s from full force to zero, and back up; 0 to 1; default 0.02 */
    double watchdog_s; /**< s without a tick after which the watchdog zeroes the force; default 0.05; 0: no watchdog. If
                          the haptic thread wakes more than 50 ms late, it always zeroes the force, reports
                          KNURL_FAULT_GAP and ramps up again */
    const knurl_clock *clock; /**< copied; null: the system's */
    uint32_t protections;     /**< with a force callback: KNURL_PROTECT_HEAT (default; without it continuous_force is
                                 ignored) and KNURL_PROTECT_SLEW: the force grows and turns by at most max_force in 5 ms
                                 (off by default: jumps may be a texture). A scene's HIP has its own */
    uint32_t reconnect;       /**< 1: search for a lost device four times a second; default 0: the loop ends */
    double heartbeat_s; /**< if knurl_loop_heartbeat() is not called for so many s, the force ramps down to zero until
                           the next call; 0 (default): no heartbeat is needed */
    knurl_torque_callback torque_callback; /**< or null: no torque, no gripper's force */
} knurl_loop_desc;

/** Percentiles of a duration, ns. */
typedef struct knurl_percentiles {
    double p50, p99, max;
} knurl_percentiles;

/** A loop's states. */
enum {
    KNURL_LOOP_IDLE = 0,    /**< never started */
    KNURL_LOOP_RUNNING = 1, /**< ticks */
    KNURL_LOOP_DONE = 2,    /**< ended: tick limit, stop, device closed or scene destroyed */
    KNURL_LOOP_LOST = 3     /**< ended: the device was lost */
};

/** Statistics of a loop. An output: set struct_size with knurl_loop_stats_init() first. */
typedef struct knurl_loop_stats {
    uint32_t struct_size;
    int32_t state;     /**< KNURL_LOOP_ */
    uint64_t ticks;    /**< not counting the ramp at the end */
    uint64_t overruns; /**< ticks more than half a period late. Missed ticks are not repeated: the loop continues at the
                          next whole period */
    uint64_t watchdog_trips;     /**< number of times that the watchdog zeroed the force */
    uint32_t realtime;           /**< 1: the haptic thread runs under SCHED_FIFO, or (a Touch's) SCHED_RR */
    uint32_t memory_locked;      /**< 1: the scene and the loop's stack are locked into RAM */
    knurl_percentiles tick_ns;   /**< duration of the scene's tick or the force callback; within 3 % */
    knurl_percentiles jitter_ns; /**< lateness of the thread's wake-ups; within 3 % */
    uint64_t heat_ticks; /**< force callback: ticks with a force shortened because the motors are warm (for a scene see
                            knurl_hip_counts) */
    double heat; /**< heat of the device's motors: 0 is cold, 1 as warm as continuous_force makes them in the long run;
                    above 1 only without KNURL_PROTECT_HEAT, or if the HIP has a larger continuous_force */
    uint64_t absences;    /**< cycles without a tick: the device was lost or had no valid position */
    uint32_t absent;      /**< 1: the last cycle had no tick */
    uint32_t paused;      /**< 1: paused */
    uint32_t io_realtime; /**< 1: the device's I/O thread runs under SCHED_FIFO; 0 also without such a thread */
    uint32_t reserved;    /**< 0 */
} knurl_loop_stats;

/** Fill in defaults; `size` is the caller's sizeof. [any thread] */
KNURL_API void knurl_loop_desc_init(knurl_loop_desc *desc, uint32_t size);
KNURL_API void knurl_loop_stats_init(knurl_loop_stats *stats, uint32_t size);

/** Creates a loop, which does not run yet. Until it is destroyed, no other loop can use its device and HIP. If the
 * device is closed or the scene destroyed before that, the force is zero at once, the loop ends, and they are freed
 * with the loop.
 * Errors: KNURL_ERROR_ARGUMENT, KNURL_ERROR_STATE (another loop uses the device or the HIP; or the scene is not
 * committed), KNURL_ERROR_MEMORY, those of knurl_device_start(). [game thread] */
KNURL_API knurl_result knurl_loop_create(const knurl_loop_desc *desc, knurl_loop **loop);

/** Stops the loop and frees it, together with a device and a scene that were closed or destroyed before; null is
 * allowed. If called from one of the loop's callbacks, it only requests the stop, as knurl_loop_request_stop(): call it
 * again from outside. [game thread, or any while no other thread uses the loop] */
KNURL_API void knurl_loop_destroy(knurl_loop *loop);

/** Starts the haptic thread: absolute deadlines, SCHED_FIFO if permitted (see stats.realtime).
 * Errors: KNURL_ERROR_STATE (started before, or its device was closed or its scene destroyed), KNURL_ERROR_SYSTEM.
 * [game thread] */
KNURL_API knurl_result knurl_loop_start(knurl_loop *loop);

/** Runs up to `ticks` ticks on the calling thread, as fast as the machine can, instead of knurl_loop_start(). Forces
 * are the same, tick for tick. It returns earlier at the tick limit, at a stop, or if the device is lost (see
 * stats.state). Errors: KNURL_ERROR_STATE (a haptic thread was started). [game thread] */
KNURL_API knurl_result knurl_loop_step(knurl_loop *loop, uint64_t ticks);

/** Requests a stop and returns: the force ramps down to zero, then the loop ends. May be repeated. [any thread] */
KNURL_API void knurl_loop_request_stop(knurl_loop *loop);

/** Requests a stop and waits for it; if called from one of the loop's callbacks, it does not wait. May be repeated. A
 * forked child has no haptic thread, so it does not wait either, and its parent's loop continues. [any thread] */
KNURL_API void knurl_loop_stop(knurl_loop *loop);

/** Pauses: the force ramps down to zero and contacts end. Ticks continue to report the HIP's position and velocity, the
 * motors cool, and no heartbeat is needed. A force callback is still called, but its force is not sent. Before
 * knurl_loop_start(): the loop starts paused. May be repeated. [any thread] */
KNURL_API void knurl_loop_pause(knurl_loop *loop);

/** Ends a pause: the force ramps up again (KNURL_FAULT_RESUMED). The first tick is like a scene's first: if the HIP is
 * up to 10 mm inside a surface, it is in contact with it, under the entry ramp. May be repeated. [any thread] */
KNURL_API void knurl_loop_resume(knurl_loop *loop);

/** Sets a gain for all forces that the loop sends, for example a player's setting. gain: 0 to 1, initially 1. The
 * change follows the ramp, even if the device has no position. At 0 no force is sent, but contacts continue. Errors:
 * KNURL_ERROR_ARGUMENT. [any thread] */
KNURL_API knurl_result knurl_loop_set_gain(knurl_loop *loop, double gain);

/** Adds a constant force to the surfaces' forces, until the next call. force: N, scene axes, at most 1000 N; zeros end
 * it. The sum passes the HIP's protections: the slew limit, the heat limit and max_force. It ramps down to zero during
 * a pause and if the heartbeat is missing. Errors: KNURL_ERROR_ARGUMENT, KNURL_ERROR_STATE (the loop has a force
 * callback). [game thread] */
KNURL_API knurl_result knurl_loop_set_force(knurl_loop *loop, const double force[3]);

/** Adds a vibration to the force, from the next tick on; replaces the playing one. method: KNURL_WAVE_T1, KNURL_WAVE_T2
 * or KNURL_WAVE_T3 (a T3 vibration ends after a complete event). frequency_hz: 0.1 to half the update rate. amplitude:
 * 0 to 1000 N. direction: scene axes, any length > 0. seconds: 0 to 3600; 0 ends the playing one. The sum passes the
 * HIP's protections, except that the slew limit does not apply to the vibration's own steps. Errors:
 * KNURL_ERROR_ARGUMENT, KNURL_ERROR_UNKNOWN (method), KNURL_ERROR_STATE (the loop has a force callback). [game
 * thread] */
KNURL_API knurl_result knurl_loop_vibrate(knurl_loop *loop, int32_t method, double frequency_hz, double amplitude,
                                          const double direction[3], double seconds);

/** A heartbeat from the game; see heartbeat_s. [any thread] */
KNURL_API void knurl_loop_heartbeat(knurl_loop *loop);

/** Waits up to `seconds` for the loop's end. Returns 1 if the loop is not running or the handle is invalid, else 0.
 * [any thread but the haptic] */
KNURL_API uint32_t knurl_loop_wait(knurl_loop *loop, double seconds);

/** Gets a loop's statistics. Errors: KNURL_ERROR_ARGUMENT. [any thread] */
KNURL_API knurl_result knurl_loop_get_stats(const knurl_loop *loop, knurl_loop_stats *stats);

#ifdef __cplusplus
}
#endif
#endif
