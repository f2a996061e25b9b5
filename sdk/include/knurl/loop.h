/* Knurl: the real-time loop. It reads a device, ticks a scene (or calls back), writes the force and keeps time.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_LOOP_H
#define KNURL_LOOP_H

#include <knurl/device.h>
#include <knurl/scene.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A loop runs once, and can pause. How warm the device's motors are is the device's: its next loop begins with it,
 * cooled by what has gone by on the loop's clock since (with another clock: not cooled). In a loop that is stepped each
 * tick cools or warms by one period. */
typedef struct knurl_loop knurl_loop;

/** Gives a force instead of a scene: `tick` counts from 0; write N in device axes. [haptic thread] */
typedef void (*knurl_force_callback)(uint64_t tick, const knurl_device_sample *sample, double force[3], void *user);

/** Sees every tick of a scene before its force is written, for recording; must keep the tick's rules. `output` is as
 * sent: with the loop's ramps in its forces, and none while the device is halted. The ramp at the end is no tick; the
 * scene tells its forces, and after it none (knurl_scene_get_tick()). [haptic thread] */
typedef void (*knurl_tick_callback)(const knurl_tick_output *output, void *user);

/** A monotonic clock to run by, for tests. [haptic thread] */
typedef struct knurl_clock {
    int64_t (*now_ns)(void *user);
    void (*sleep_until_ns)(int64_t deadline_ns, void *user);
    void *user;
} knurl_clock;

typedef struct knurl_loop_desc {
    uint32_t struct_size;                /**< set by knurl_loop_desc_init() */
    uint32_t hip;                        /**< which HIP of the scene; default 0; the loop's alone while it exists */
    knurl_device *device;                /**< required; the loop's alone while it exists */
    knurl_scene *scene;                  /**< committed, its HIP configured with the same update rate; or null */
    knurl_force_callback force_callback; /**< used where scene is null */
    knurl_tick_callback tick_callback;   /**< or null */
    void *user;                          /**< passed to both callbacks */
    double update_rate_hz;               /**< KNURL_UPDATE_RATE_MIN to _MAX; default 1000 */
    uint64_t tick_limit;                 /**< ends by itself after so many ticks; 0 (default): never */
    double ramp_s;                       /**< s from full force to none, and back up; 0 to 1; default 0.02 */
    double watchdog_s;        /**< s without a tick after which the force is zeroed; default 0.05; 0: never */
    const knurl_clock *clock; /**< copied; null: the system's */
    uint32_t protections;     /**< with a force callback: KNURL_PROTECT_HEAT (default) or 0, which leaves the device's
                                   continuous_force out of account; a scene's HIP has its own */
    uint32_t reconnect; /**< 1: a lost device is looked for again, four times a second; default 0: the loop ends */
    double heartbeat_s; /**< s without knurl_loop_heartbeat() after which the force goes to zero by the ramp, until the
                             next one; 0 (default): nobody has to call it */
    uint32_t dry_ticks; /**< with a scene, in a haptic thread that runs by the system's clock: 1 (default): before each
                             tick the device's latest position is ticked once for nobody, so that what the tick runs
                             and reads is in the cache when the device is read. From position to force takes 0.3 us
                             instead of 1.6, and the cycle 1 to 2 us more in all (stats.dry_tick_ns); left out in cycles
                             that come late. 0: not so */
    uint32_t reserved;  /**< 0 */
} knurl_loop_desc;

/** Nanoseconds, by percentile. */
typedef struct knurl_percentiles {
    double p50, p99, max;
} knurl_percentiles;

/** Why a loop is not running. */
enum {
    KNURL_LOOP_IDLE = 0,    /**< never started */
    KNURL_LOOP_RUNNING = 1, /**< ticks */
    KNURL_LOOP_DONE = 2,    /**< reached its tick limit, was stopped, or its device was closed or scene destroyed */
    KNURL_LOOP_LOST = 3     /**< the device no longer answered */
};

/** What a loop has done so far. An output: set struct_size with knurl_loop_stats_init() first. */
typedef struct knurl_loop_stats {
    uint32_t struct_size;
    int32_t state;             /**< KNURL_LOOP_ */
    uint64_t ticks;            /**< not counting the ramp at the end */
    uint64_t overruns;         /**< ticks whose deadline had passed by more than half a period; they are not made up for
                                    by a burst: the rhythm goes on from the next whole period */
    uint64_t watchdog_trips;   /**< times the watchdog zeroed the force */
    uint32_t realtime;         /**< 1: SCHED_FIFO was had */
    uint32_t memory_locked;    /**< 1: the scene and the loop's stack are locked into RAM */
    knurl_percentiles tick_ns; /**< the scene's tick or the force callback alone; within 3 % */
    knurl_percentiles jitter_ns; /**< wake-up after the deadline; within 3 % */
    uint64_t heat_ticks;         /**< force callback: ticks shortened to what warm motors can hold (a scene's HIP has
                                 counts of its own) */
    double heat;                 /**< the device's motors: 0 cold to 1: as warm as its continuous_force makes them for
                                      ever; above 1 only without KNURL_PROTECT_HEAT */
    uint64_t absences; /**< cycles without a tick, because the device was lost or gave no position to be trusted */
    uint32_t absent;   /**< 1: such was the latest cycle */
    uint32_t paused;   /**< 1: knurl_loop_pause() was called, and knurl_loop_resume() was not since */
    knurl_percentiles dry_tick_ns; /**< the dry ticks (knurl_loop_desc); within 3 %; 0 without any */
} knurl_loop_stats;

/** Fill in defaults; `size` is the caller's sizeof. [any thread] */
KNURL_API void knurl_loop_desc_init(knurl_loop_desc *desc, uint32_t size);
KNURL_API void knurl_loop_stats_init(knurl_loop_stats *stats, uint32_t size);

/** Makes a loop, which from now on has its device and its HIP for itself; it does not run yet. Device and scene may be
 * closed and destroyed before it: both are kept for it, their force is zero at once, and it ends by itself.
 * Errors: KNURL_ERROR_ARGUMENT, KNURL_ERROR_STATE (another loop has the device or the HIP, whatever thread made it; or
 * the scene is not committed), KNURL_ERROR_MEMORY, those of knurl_device_start(). [game thread] */
KNURL_API knurl_result knurl_loop_create(const knurl_loop_desc *desc, knurl_loop **loop);

/** Stops and gives everything back, with a device and a scene that were closed and destroyed meanwhile; null is
 * allowed. From a callback it only asks for the end, as knurl_loop_request_stop() does: the loop is still there, to be
 * destroyed outside of it. [game thread, or any that destroys what nobody else uses] */
KNURL_API void knurl_loop_destroy(knurl_loop *loop);

/** Starts the haptic thread, at an absolute-deadline rhythm, SCHED_FIFO where permitted (see stats.realtime).
 * Errors: KNURL_ERROR_STATE (started before, or its device was closed or its scene destroyed), KNURL_ERROR_SYSTEM.
 * [game thread] */
KNURL_API knurl_result knurl_loop_start(knurl_loop *loop);

/** Instead of knurl_loop_start(): runs up to `ticks` ticks here and now, as fast as the machine can, with the same
 * forces tick for tick. Fewer are run where the tick limit, a stop or a lost device comes first (see stats.state).
 * Errors: KNURL_ERROR_STATE (a haptic thread was started). [game thread] */
KNURL_API knurl_result knurl_loop_step(knurl_loop *loop, uint64_t ticks);

/** Asks for the end: the force goes to zero by the ramp, then the loop is done. Twice is fine. [any thread] */
KNURL_API void knurl_loop_request_stop(knurl_loop *loop);

/** Asks for the end and waits for it; from a callback it only asks. Twice is fine. [any thread] */
KNURL_API void knurl_loop_stop(knurl_loop *loop);

/** A pause: the force goes to zero by the ramp. From then on ticks go on, but nothing is felt: the HIP's position and
 * velocity are told, contacts end, and the motors cool. A force callback is called on, and its force is not sent. No
 * sign of life is needed meanwhile. Before the start: it starts paused. Twice is fine. [any thread] */
KNURL_API void knurl_loop_pause(knurl_loop *loop);

/** Ends a pause: the force comes back by the ramp (KNURL_FAULT_RESUMED), and walls as at a first tick: within 10 mm of
 * their surface, by the entry ramp. Twice is fine. [any thread] */
KNURL_API void knurl_loop_resume(knurl_loop *loop);

/** A sign of life from the game; see heartbeat_s. [any thread] */
KNURL_API void knurl_loop_heartbeat(knurl_loop *loop);

/** Waits up to `seconds` for the end; 1 if the loop is not running (any more, or is none), else 0. [any thread but the
 * haptic] */
KNURL_API uint32_t knurl_loop_wait(knurl_loop *loop, double seconds);

/** What the loop has done so far. Errors: KNURL_ERROR_ARGUMENT. [any thread] */
KNURL_API knurl_result knurl_loop_get_stats(const knurl_loop *loop, knurl_loop_stats *stats);

/** What a stroke that was laid over a surface came to. An output: set struct_size with knurl_stroke_report_init()
 * first.
 */
typedef struct knurl_stroke_report {
    uint32_t struct_size;
    uint32_t is_outside; /**< 1: the surface's anchor is out of the device's workspace: the stroke is cut short */
    uint32_t follows;    /**< 1: along a path over a curved surface; 0: straight */
    uint32_t reserved;   /**< 0 */
    double length; /**< m of the device: of LINE and SWEEP from one end to the other, of CIRCLE once round; else 0 */
} knurl_stroke_report;

/** Sets struct_size; `size` is the caller's sizeof. [any thread] */
KNURL_API void knurl_stroke_report_init(knurl_stroke_report *report, uint32_t size);

/** Lays a stroke of the fake device's hand over a surface, 1 mm below it, within the workspace of a HIP; from the next
 * knurl_device_start(). LINE and SWEEP run along the surface's x: from the anchor (knurl_surface_info) straight on
 * where the surface is flat, else over it as it bends, until it ends, has an edge of more than 60 degrees within a step
 * of at most 0.5 mm, or comes back to where it began, and over nine tenths of that; where x goes round in small rings,
 * as near a pole, it begins further away. CIRCLE goes round the anchor. A surface that moves is taken where it stands
 * now. stroke: KNURL_STROKE_. report: may be null. Takes some milliseconds. Errors: KNURL_ERROR_STALE_ID,
 * KNURL_ERROR_UNSUPPORTED (not a fake device), KNURL_ERROR_ARGUMENT (hip, stroke), KNURL_ERROR_STATE (the workspace is
 * chosen at the commit, and the scene is not committed), KNURL_ERROR_MEMORY. [game thread] */
KNURL_API knurl_result knurl_fake_lay_stroke(knurl_device *device, const knurl_scene *scene, uint32_t hip,
                                             knurl_surface_id surface, int32_t stroke, knurl_stroke_report *report);

#ifdef __cplusplus
}
#endif
#endif
