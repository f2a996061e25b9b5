/* Knurl: haptic gratings by methods S1 and S2 of the paper (section III), `bandlimited`, and the caller's own. A
 * grating is a height map that repeats along a surface's x and y. State per HIP and surface: one struct, no heap.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_GRATING_H
#define KNURL_GRATING_H

#include <knurl/vibration.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The spatial methods.
 * - S1: the height at the position (Eq. 11).
 * - S2: complete T3 events at the frequency given by the velocity (Algorithm 7).
 * - BANDLIMITED, the default: those of the square wave's harmonics that the update rate can represent, at the phase of
 *   the position. */
enum { KNURL_METHOD_DEFAULT = 0, KNURL_METHOD_S1 = 1, KNURL_METHOD_S2 = 2, KNURL_METHOD_BANDLIMITED = 3 };

/** No event is playing: S1 always, S2 while idle, BANDLIMITED before its first ridge. */
#define KNURL_NO_EVENT (-1)

/** m/s: below this speed S2 starts no event (Algorithm 7). With quantised positions, an event may follow another down
 * to half of this speed, so that noise in the speed does not start and stop events. */
#define KNURL_S2_DEADBAND 0.001

/** A grating's parameters; filled in by the caller, constant while it is played. */
typedef struct knurl_grating {
    int32_t method;              /**< KNURL_METHOD_, or one from knurl_method_add() */
    uint32_t reserved[3];        /**< 0 */
    double spatial_frequency[2]; /**< fsx, fsy: cycles per metre along x and y, >= 0 */
    double amplitude;            /**< A: m, half peak to peak of the desired square wave, >= 0 */
    double update_rate_hz;       /**< f_h: 1 to 100,000 Hz */
    double resolution; /**< m: quantum of the positions, 0 if they are exact. S2: if above 0, an event halves the
                          deadband */
} knurl_grating;

/** The state of one HIP on one grating. Zero it to restart. */
typedef struct knurl_grating_state {
    knurl_vibration_event event; /**< S2: the playing event; its amplitude and kind do not change until its end. An own
                                    method: its memory */
    int64_t event_count;         /**< S2: events started, BANDLIMITED: ridges begun, since the state was zeroed */
    int32_t next_tick;           /**< S2: the next tick's index in the event. An own method: minus its number */
    int32_t playing;             /**< S2: 1 if an event has ticks left */
    int32_t moving;              /**< S2: 1 after an event: halves the deadband */
    int32_t sign;                /**< sign of the last height other than 0: +1 or -1; 0 before the first */
    double tracked[2];           /**< BANDLIMITED and own methods: the position along x and y, m */
    double phase;                /**< BANDLIMITED: cycles; a crest is at 0 */
    double offset;               /**< BANDLIMITED on a grid: the phase's lead over the position's, cycles */
    int32_t axis;                /**< BANDLIMITED on a grid: 0 or 1, the axis whose cycles are counted */
    int32_t direction;           /**< BANDLIMITED: of the last motion, +1 or -1; 0 before the first tick */
    uint64_t reserved[2];        /**< 0 */
} knurl_grating_state;

/** A grating's output in one tick. */
typedef struct knurl_grating_output {
    double height;             /**< H: m */
    double spatial_frequency;  /**< fs of Eq. 12: cycles per metre in the direction of motion; 0 when at rest */
    double temporal_frequency; /**< f_t = max(fsx |vx|, fsy |vy|): Hz, not clamped */
    int64_t event; /**< number of the playing event, from 0 since the state was zeroed, or KNURL_NO_EVENT. BANDLIMITED:
                      number of the last ridge */
    uint32_t above_nyquist; /**< 1: f_t is above f_h/2, which no method can render */
    uint32_t turned;   /**< 1: the height changed sign in this tick: a half cycle begins. Heights of 0 between (idle S2)
                          are ignored */
    uint64_t reserved; /**< 0 */
} knurl_grating_output;

/** Checks a grating's parameters, because knurl_grating_step() does not. Replaces KNURL_METHOD_DEFAULT by
 * KNURL_METHOD_BANDLIMITED.
 * Errors: KNURL_ERROR_ARGUMENT, KNURL_ERROR_UNKNOWN (method). [any thread] */
KNURL_API knurl_result knurl_grating_check(knurl_grating *grating);

/** The temporal frequency of a motion, Eqs. 12 and 13 without trigonometry: max(fsx |vx|, fsy |vy|), in Hz.
 * spatial_frequency: cycles/m along x and y. velocity: m/s along x and y. [any thread; allowed in a tick] */
KNURL_API double knurl_grating_frequency(const double spatial_frequency[2], const double velocity[2]) KNURL_NONBLOCKING;

/** Runs one tick of a checked grating.
 *
 * position: m along the surface's x and y (S1, BANDLIMITED); if it comes in counts, from knurl_velocity_track(). For
 * BANDLIMITED it may be null: the velocity is then integrated. velocity: m/s along x and y, of the HIP relative to the
 * surface. state, output: the caller's. Does nothing if another pointer is null.
 *
 * - S1: the height at the position.
 * - S2: when an event ends, the next one gets its period and amplitude from the current velocity (Algorithm 7). Below
 *   the deadband, or if an event would last over 1e6 ticks, the height is 0.
 * - BANDLIMITED: with p the phase, d = f_t/f_h and w a fade from 1 to 0 for n d from 0.38 to 0.5,
 *   H = 4/pi A (cos 2 pi p - w/3 cos 6 pi p + w/5 cos 10 pi p). Below d = 1/12 it fades into the mean of the square
 *   wave from the last tick's phase to this one's, which alone is used below 0.06. Above 1/2 the height is 0.7 A and
 *   changes sign every tick. p is fs times the position. On a grid, p counts cycles along the axis that crosses
 *   the most ridges (Eq. 12), and continues without a jump if the other axis takes over, at 1.1 times as many.
 *
 * [haptic thread] */
KNURL_API void knurl_grating_step(const knurl_grating *grating, knurl_grating_state *state, const double position[2],
                                  const double velocity[2], knurl_grating_output *output) KNURL_NONBLOCKING;

/** One tick, for an own method's height function. Later versions may append to it. */
typedef struct knurl_method_input {
    double cycles[2]; /**< the phase: the position along x and y times fsx and fsy, cycles. S1 has the middle of a crest
                         at each whole number. Without surface coordinates the velocity is integrated */
    double velocity[2];          /**< m/s along x and y, of the HIP relative to the surface */
    double spatial_frequency[2]; /**< fsx, fsy: cycles per metre along x and y */
    double temporal_frequency;   /**< f_t = max(fsx |vx|, fsy |vy|): Hz */
    double period;               /**< s: 1/f_h */
} knurl_method_input;

/** The height function of an own method: returns the height of this tick in units of A. memory: four numbers that it
 * may change and finds again at the next tick; zeros when a contact begins, and after S2 or another own method has
 * played in it. user: as registered. It is called on haptic threads, by several at once if there are several HIPs: no
 * heap, lock, file, system call or unbounded loop, and no state but `memory`. */
typedef double (*knurl_method_function)(const knurl_method_input *input, double memory[4],
                                        void *user) KNURL_NONBLOCKING;

/** Adds a method of the caller's own, for this process and until its end: its number is used as KNURL_METHOD_ are, its
 * name wherever a method is chosen by name. Numbers may differ from process to process; store names.
 *
 * name: 1 to 31 letters, digits, '_' and '-', copied. crest: the greatest height in units of A, above 0 to 10; heights
 * are held within -crest and crest, and one that is NaN or infinite becomes 0, so limits and protections of force apply
 * to it as to other methods. height, user: used until the process ends. method: receives the number.
 * Errors: KNURL_ERROR_ARGUMENT (name, also if a method has it; crest; height), KNURL_ERROR_FULL (there are 16). [any
 * thread but the haptic, one at a time; others may use methods meanwhile] */
KNURL_API knurl_result knurl_method_add(const char *name, double crest, knurl_method_function height, void *user,
                                        int32_t *method);

/** How many heights of an own method were not finite or beyond its crest, in this process; 0 for any other number. [any
 * thread; allowed in a tick] */
KNURL_API uint64_t knurl_method_get_faults(int32_t method) KNURL_NONBLOCKING;

/** A method's name: "S1", "S2", "bandlimited" or that of an own method; null for any other number. [any thread] */
KNURL_API const char *knurl_method_name(int32_t method);

/** Finds a method by its name ("S1", "S2", "bandlimited" or that of an own method).
 * Errors: KNURL_ERROR_UNKNOWN, with the known names. [any thread] */
KNURL_API knurl_result knurl_method_from_name(const char *name, int32_t *method);

#ifdef __cplusplus
}
#endif
#endif
