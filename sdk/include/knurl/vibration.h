/* Knurl: temporal square waves, methods T1, T2 and T3 of the paper (section II).
 * Pure functions: no state but a tick index. Periods are handled in ticks (period x update rate), never in seconds.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_VIBRATION_H
#define KNURL_VIBRATION_H

#include <knurl/base.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The paper's temporal methods: T1 samples the square wave, T2 mixes two even periods, T3 balances odd periods. The
 * numbers differ from the spatial methods' (KNURL_METHOD_), so that one passed for the other is refused. */
enum { KNURL_WAVE_T1 = 17, KNURL_WAVE_T2 = 18, KNURL_WAVE_T3 = 19 };

/** The kinds of T3 events. MIXED is the paper's 400 Hz case, 2.5 ticks per cycle. */
enum { KNURL_EVENT_EVEN = 0, KNURL_EVENT_ODD = 1, KNURL_EVENT_MIXED = 2 };

/** One complete T3 event (Algorithms 2, 4, 5): a whole number of ticks with zero impulse, whose RMS is the amplitude.
 * It stores its own kind and amplitude, so that no change during the event unbalances it. */
typedef struct knurl_vibration_event {
    double positive;        /**< height of the first part; for MIXED the amplitude that scales its six values */
    double negative;        /**< minus the height of the second part (>= 0); unused for MIXED */
    int32_t length;         /**< ticks, >= 2 */
    int32_t positive_ticks; /**< ticks of the first part; unused for MIXED */
    int32_t kind;           /**< KNURL_EVENT_EVEN, _ODD or _MIXED */
    uint32_t above_nyquist; /**< 1: the requested period was below 2 ticks and is played as 2 */
} knurl_vibration_event;

/** A temporal signal of method T1, T2 or T3, ready to be played. */
typedef struct knurl_wave {
    double period_ticks; /**< the period that is played (T1) or approached (T2, T3), in ticks, >= 2 */
    double amplitude;    /**< half peak to peak of the requested square wave; the signal's RMS at integer periods */
    knurl_vibration_event parts[2]; /**< T3: one event, repeated; T2: one or two even events, summed */
    int32_t method;                 /**< KNURL_WAVE_T1, KNURL_WAVE_T2 or KNURL_WAVE_T3 */
    int32_t part_count;             /**< 0 for T1 */
    uint32_t above_nyquist;         /**< 1: the requested period was below 2 ticks and is played as 2 */
    uint32_t reserved;              /**< 0 */
} knurl_wave;

/** Prepares the T3 event for one period (Algorithms 4, 5, 6; Eqs. 7, 8).
 * period_ticks: temporal period in ticks, > 0, at most 1e6; if below 2, it is played as 2 and marked above_nyquist.
 * amplitude: finite, >= 0, in the unit of the heights. event: the caller's.
 * Errors: KNURL_ERROR_ARGUMENT, with a message. [any thread, never from a tick] */
KNURL_API knurl_result knurl_vibration_event_prepare(double period_ticks, double amplitude,
                                                     knurl_vibration_event *event);

/** The event's height at tick `index`, 0 <= index < event->length; else 0. [any thread; allowed in a tick] */
KNURL_API double knurl_vibration_event_height(const knurl_vibration_event *event, int32_t index) KNURL_NONBLOCKING;

/** Prepares a temporal signal (Algorithms 1-6; Eqs. 1-8).
 * method: KNURL_WAVE_T1, KNURL_WAVE_T2 or KNURL_WAVE_T3. period_s: (0, 10] s. amplitude: finite, >= 0, in the unit of
 * the output (N). update_rate_hz: 1 to 100,000 Hz. wave: the caller's.
 * Errors: KNURL_ERROR_ARGUMENT, KNURL_ERROR_UNKNOWN (method). [any thread] */
KNURL_API knurl_result knurl_wave_prepare(int32_t method, double period_s, double amplitude, double update_rate_hz,
                                          knurl_wave *wave);

/** The signal's value at tick `tick` (any; the signal starts with its positive part at 0), in the unit of its
 * amplitude. Peaks: T1 A; T2 up to sqrt(2) A; T3 up to 1.414 A, in the mixed case 1.732 A. [any thread; allowed in a
 * tick] */
KNURL_API double knurl_wave_value(const knurl_wave *wave, uint64_t tick) KNURL_NONBLOCKING;

#ifdef __cplusplus
}
#endif
#endif
