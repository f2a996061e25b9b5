/* Knurl: haptic gratings by methods S1 and S2 of the paper (section III) and by `locked` and `area`, this project's
 * own. A grating is a height map that repeats along a surface's x and y. State per HIP and surface: one struct, no
 * heap.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_GRATING_H
#define KNURL_GRATING_H

#include <knurl/vibration.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The spatial methods.
 * - S1: the height at the position (Eqs. 10, 11).
 * - S2: complete T3 events at the frequency that follows from the velocity (Algorithm 7).
 * - LOCKED: above a crossover frequency, balanced events whose lengths keep step with the surface; below it, the height
 *   at the position.
 * - AREA: the mean height over the distance moved since the last tick; near f_h/2 LOCKED's events. */
enum { KNURL_METHOD_DEFAULT = 0, KNURL_METHOD_S1 = 1, KNURL_METHOD_S2 = 2, KNURL_METHOD_LOCKED = 3, KNURL_METHOD_AREA = 4 };

/** No event is being played: S1 always, S2 while idle, LOCKED below its crossover, AREA before its first ridge. */
#define KNURL_NO_EVENT (-1)

/** m/s: below this speed S2 starts no event (Algorithm 7). With quantised positions, events that have begun continue
 * down to half of it, so that noise in the speed does not start and stop them. */
#define KNURL_S2_DEADBAND 0.001

/** Hz: below this LOCKED follows the position, above it plays events. Chosen by the chart of `knurl study locked`:
 * strokes of up to two a second to 480 Hz over 0.5 mm, positions in steps of 0.055 mm, 1 to 10 kHz. With 120 Hz,
 * played cycles stay within 0.44 of those crossed. At 100 Hz and below whole cycles are lost, because an event that
 * begins while the hand speeds up outlasts its cycle. A higher crossover gains nothing at 1 kHz, and following the
 * position has a larger net force: up to A/9 at 111 Hz and A/5 at 200 Hz. */
#define KNURL_LOCKED_CROSSOVER_HZ 120.0

/** A grating's parameters; filled in by the caller, constant while it is played. */
typedef struct knurl_grating {
    int32_t method;              /**< KNURL_METHOD_S1, KNURL_METHOD_S2, KNURL_METHOD_LOCKED or KNURL_METHOD_AREA */
    uint32_t reserved[3];        /**< 0 */
    double spatial_frequency[2]; /**< fsx, fsy: cycles per metre along x and y, >= 0 */
    double amplitude;            /**< A: m, half peak to peak of the desired square wave, >= 0 */
    double update_rate_hz;       /**< f_h: 1 to 100,000 Hz */
    double resolution;           /**< m: quantisation of positions, 0 where they are exact. LOCKED, AREA: a backward
                                      motion of up to this is ignored */
    double crossover_hz;         /**< LOCKED: >= 1; 0 means KNURL_LOCKED_CROSSOVER_HZ, or f_h/4 where that is lower */
} knurl_grating;

/** The state of one HIP on one grating. Zero it to restart. */
typedef struct knurl_grating_state {
    knurl_vibration_event event; /**< all but S1: the event being played; its amplitude and kind do not change until its
                                      end */
    int64_t event_count;         /**< events started since the state was zeroed; AREA: ridges begun */
    int32_t next_tick;           /**< all but S1: index into the event of the next tick; AREA: 0 outside of events */
    int32_t playing;             /**< all but S1: 1 while an event has ticks left */
    double phase;                /**< LOCKED; AREA on a grid and near f_h/2: cycles crossed in the direction of motion,
                                      from a rising edge */
    double played;               /**< LOCKED, AREA: cycles played up to the end of the event, counted as phase is */
    double held;                 /**< LOCKED, AREA: the position after hysteresis, m; on a grid along `axis` */
    int32_t direction;           /**< LOCKED, AREA: +1 or -1; 0 before the first tick */
    int32_t moving;       /**< S2: 1 after an event: the deadband is halved; others: 1 while events follow each other */
    int32_t sign;         /**< sign of the latest height that was not 0: +1, -1, or 0 for none yet */
    int32_t axis;         /**< AREA on a grid: 0 or 1, the axis whose cycles are counted */
    double across;        /**< AREA on a grid: the position along the other axis, m */
    uint64_t reserved[2]; /**< 0 */
} knurl_grating_state;

/** A grating's output in one tick. */
typedef struct knurl_grating_output {
    double height;             /**< H: m */
    double spatial_frequency;  /**< fs of Eq. 12: cycles per metre in the direction of motion; 0 when at rest */
    double temporal_frequency; /**< f_t = max(fsx |vx|, fsy |vy|): Hz, not clamped */
    int64_t event;             /**< number of the event being played, from 0 since the state was zeroed, or
                                    KNURL_NO_EVENT. AREA: number of the latest ridge */
    uint32_t saturated;        /**< 1: f_t is above f_h/2, which no method can render; AREA: also a jump of a whole
                                    cycle */
    uint32_t turned;           /**< 1: the height changed sign in this tick: a half cycle begins. Heights of 0 in
                                    between (idle S2) are skipped */
    uint64_t reserved;         /**< 0 */
} knurl_grating_output;

/** Checks a grating's parameters, so that knurl_grating_step() need not. Replaces KNURL_METHOD_DEFAULT by KNURL_METHOD_LOCKED.
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

/** Runs one tick of a checked grating.
 *
 * position: m along the surface's x and y (S1, LOCKED, AREA). LOCKED and AREA accept null and then integrate the
 * velocity. velocity: m/s along x and y, of the HIP relative to the surface. state, output: the caller's. With any
 * other null nothing is done.
 *
 * - S1: the height at the position.
 * - S2: when an event ends, the next takes its period and amplitude from the present velocity (Algorithm 7). Below the
 *   deadband, or where an event would last over 1e6 ticks, the height is 0.
 * - LOCKED: the phase p counts cycles crossed in the direction of motion: by position on a grating in one direction
 *   (cycles begin at Eq. 11's rising edges), by the integral of Eq. 12's frequency on a grid. Below the crossover the
 *   height is +A in the first half of each cycle, else -A; -A also in what is left of a first half, up to a tenth of
 *   a cycle, when the event that has played it ends. Above it, from the next cycle's begin on, T3 events follow each
 *   other. After n events the next lasts the whole number of ticks nearest T (1 - (p - n)), limited to T/1.38 to
 *   1.38 T or to the whole numbers next to T, so that cycles played keep step with cycles crossed. A reversal restarts
 *   the count from p. f_t above f_h/2, or a difference of more than a cycle, changes n by whole cycles.
 * - AREA: the mean of the square wave over the distance since the last tick, scaled so that the fundamental keeps 4/pi
 *   A at any f_t; heights reach pi/2 A. The distance is by position on a grating in one direction; on a grid along the
 *   axis that crosses the most cycles (Eq. 12), where the phase continues when the other axis takes over (at 1.1 times
 *   as many cycles); without a position by velocity. From 0.46 f_h on, until f_t falls below 0.44 f_h, LOCKED's events
 *   are played, in phase. A jump of a cycle or more gives height 0 for one tick and counts as saturated.
 *
 * [haptic thread] */
KNURL_API void knurl_grating_step(const knurl_grating *grating, knurl_grating_state *state, const double position[2],
                                  const double velocity[2], knurl_grating_output *output) KNURL_NONBLOCKING;

/** A method's name: "S1", "S2", "locked" or "area"; null for any other number. [any thread] */
KNURL_API const char *knurl_method_name(int32_t method);

/** Finds a method by its name ("S1", "S2", "locked", "area").
 * Errors: KNURL_ERROR_UNKNOWN, with the known names. [any thread] */
KNURL_API knurl_result knurl_method_from_name(const char *name, int32_t *method);

#ifdef __cplusplus
}
#endif
#endif
