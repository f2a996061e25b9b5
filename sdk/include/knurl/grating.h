/* Knurl: haptic gratings, methods S1 and S2 of the paper (section III) and this project's own, `locked` and `area`.
 * A grating is a height map that repeats along a surface's x and y. State per HIP and surface: one struct, no heap.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_GRATING_H
#define KNURL_GRATING_H

#include <knurl/vibration.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The spatial methods. S1 looks the height up at the position (Eqs. 10, 11); S2 plays complete T3 events at the
 * frequency that the velocity calls for (Algorithm 7); LOCKED, this project's own, plays balanced events whose lengths
 * keep step with the surface above a crossover frequency, and follows the position below it; AREA, also its own, gives
 * the mean of the surface over the way since the last tick, and LOCKED's events near f_h/2. */
enum { KNURL_METHOD_DEFAULT = 0, KNURL_S1 = 1, KNURL_S2 = 2, KNURL_LOCKED = 3, KNURL_AREA = 4 };

/** No event: S1, S2 while idle, LOCKED below its crossover, AREA before its first ridge. */
#define KNURL_NO_EVENT (-1)

/** Below this speed (m/s) S2 starts no event (Algorithm 7); with positions that are quantised it goes on down to half
 * of it once it has begun, so that a speed that flickers about it does not start and stop events. */
#define KNURL_S2_DEADBAND 0.001

/** Hz: where LOCKED goes over from following the position to playing events. Chosen by the chart of `knurl study
 * locked`: in strokes of up to two a second to 480 Hz over 0.5 mm, positions in counts of 0.055 mm, played cycles stay
 * within 0.42 of those crossed at 1 to 10 kHz; at 100 Hz and below whole cycles are lost, because an event that begins
 * where the hand speeds up outlasts its cycle. Above it nothing is won at 1 kHz, and what follows the position pushes
 * the more, by up to A/9 at 111 Hz and A/5 at 200 Hz. */
#define KNURL_LOCKED_CROSSOVER_HZ 120.0

/** What a grating is; filled in by its owner, constant while it is felt. */
typedef struct knurl_grating {
    double spatial_frequency[2]; /**< fsx, fsy: cycles per metre along x and y, >= 0 */
    double amplitude;            /**< A: m, half peak to peak of the desired square wave, >= 0 */
    double update_rate_hz;       /**< f_h: 1 to 100,000 Hz */
    int32_t method;              /**< KNURL_S1, KNURL_S2, KNURL_LOCKED or KNURL_AREA */
    uint32_t reserved;           /**< 0 */
    double resolution;           /**< m: the quantum that positions come in, 0 where they are exact. LOCKED, AREA: a
                                      position that comes back by no more than it has not moved */
    double crossover_hz;         /**< LOCKED: >= 1; 0 means KNURL_LOCKED_CROSSOVER_HZ, or f_h/4 where that is lower */
} knurl_grating;

/** Where one HIP is on one grating. Zero it to start anew. */
typedef struct knurl_grating_state {
    knurl_vibration_event event; /**< all but S1: the event that plays; its amplitude and kind are held to its end */
    int64_t event_count;         /**< events started since the state was zeroed; AREA: ridges begun */
    int32_t next_tick;           /**< all but S1: index into the event of the next tick; AREA: 0 outside of events */
    int32_t playing;             /**< all but S1: 1 while an event has ticks left */
    double phase;                /**< LOCKED: cycles crossed in the direction of motion, from a rising edge; AREA
 too, on a grid and near f_h/2 */
    double played;               /**< LOCKED, AREA: cycles played to the end of the event, on the same count */
    double held;                 /**< LOCKED, AREA: the position behind its hysteresis, m; on a grid along `axis` */
    int32_t direction;           /**< LOCKED, AREA: +1 or -1; 0 before the first tick */
    int32_t moving; /**< S2: an event was played, so the deadband is halved; else 1 where events follow one another */
    int32_t sign;   /**< of the latest height that was not 0: +1 or -1; 0: there was none */
    int32_t axis;   /**< AREA on a grid: 0 or 1, the axis whose cycles are counted */
    double across;  /**< AREA on a grid: the position along the other axis, m */
} knurl_grating_state;

/** What a grating does in one tick. */
typedef struct knurl_grating_output {
    double height;             /**< H: m */
    double spatial_frequency;  /**< fs of Eq. 12: cycles per metre in the direction of motion; 0 when at rest */
    double temporal_frequency; /**< f_t = max(fsx |vx|, fsy |vy|): Hz, as the motion asks for it, unclamped */
    int64_t event;             /**< 0, 1, ...: which event plays since the state was zeroed, or KNURL_NO_EVENT. AREA:
                                    which ridge was the latest to begin */
    uint32_t saturated;        /**< 1: f_t is above f_h/2, which no method can render; AREA: or a jump of a cycle */
    uint32_t turned;           /**< 1: the height changed its sign with this tick (a height of 0 in between, where S2
                                    is idle, does not count): the next half cycle of the square wave begins */
} knurl_grating_output;

/** Checks a grating once, so that its steps need not. method KNURL_METHOD_DEFAULT is resolved to KNURL_LOCKED in place.
 * Errors: KNURL_ERROR_ARGUMENT, KNURL_ERROR_UNKNOWN (method). [any thread] */
KNURL_API knurl_result knurl_grating_check(knurl_grating *grating);

/** The temporal frequency of a scan, Eqs. 12 and 13 without trigonometry: max(fsx |vx|, fsy |vy|), in Hz.
 * spatial_frequency: cycles/m along x and y. velocity: m/s along x and y. [any thread; allowed in a tick] */
KNURL_API double knurl_grating_frequency(const double spatial_frequency[2], const double velocity[2]) KNURL_NONBLOCKING;

/** S1 in 2D, Eq. 10: +amplitude while the fractional phase of position x spatial_frequency is below one half.
 * position: m. spatial_frequency: cycles/m. amplitude: m. [any thread; allowed in a tick] */
KNURL_API double knurl_grating_s1_line(double position, double spatial_frequency, double amplitude) KNURL_NONBLOCKING;

/** S1 in 3D, Eq. 11: the sign of a product of cosines, decided on fractional phases: a checkerboard, or bars where one
 * frequency is 0. position: m along x and y. [any thread; allowed in a tick] */
KNURL_API double knurl_grating_s1(const double position[2], const double spatial_frequency[2],
                                  double amplitude) KNURL_NONBLOCKING;

/** One tick of a checked grating. position: m along the surface's x and y (S1, LOCKED, AREA); null for LOCKED and AREA
 * where there is none, which then count the way by the velocity. velocity: m/s along x and y, of the HIP relative to
 * the surface, as the position changes. state and output: caller's. Null elsewhere, or where S1 has no position:
 * nothing is done. S2: a new period and amplitude are taken only when an event has ended (Algorithm 7); with no event,
 * below the deadband or where an event would last over 1e6 ticks, the height is 0. LOCKED: phase p counts cycles
 * crossed in the direction of motion: on a grating of one direction from the position (a cycle begins where Eq. 11
 * rises), on a grid the integral of Eq. 12's frequency. Below the crossover the height is +A in the first half of p's
 * cycle, else -A. Above it, from a cycle's boundary on, T3's even and odd events follow one another; after n of them
 * the next has the whole number of ticks nearest T (1 - (p - n)), kept within T/1.38 to 1.38 T or to the whole numbers
 * either side of T, so that played cycles keep step with those crossed. A reversal begins a new count from p; f_t above
 * f_h/2, or more than a cycle's difference, moves n by whole cycles. AREA: the mean of the square wave over the way
 * since the last tick, with the box filter's droop made up for, so that the fundamental of the heights is 4/pi A at any
 * f_t; up to pi/2 A. The way is the position's on a grating of one direction; on a grid that of the coordinate along
 * which the most cycles go by (Eq. 12), with a phase that goes on where the other one takes over (at 1.1 times its
 * cycles); without a position the velocity's. From 0.46 f_h until 0.44 f_h LOCKED's events play, in phase. A jump of a
 * cycle or more gives a height of 0 for a tick and is told as saturated. Null positions are as for LOCKED. [haptic
 * thread] */
KNURL_API void knurl_grating_step(const knurl_grating *grating, knurl_grating_state *state, const double position[2],
                                  const double velocity[2], knurl_grating_output *output) KNURL_NONBLOCKING;

/** "S1", "S2", "locked" or "area" for a method, null for any other number. [any thread] */
KNURL_API const char *knurl_method_name(int32_t method);

/** The method of a name ("S1", "S2", "locked", "area").
 * Errors: KNURL_ERROR_UNKNOWN, with the names that are known. [any thread] */
KNURL_API knurl_result knurl_method_from_name(const char *name, int32_t *method);

#ifdef __cplusplus
}
#endif
#endif
