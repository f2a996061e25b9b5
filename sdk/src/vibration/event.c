/* One T3 event: Algorithms 2, 4 and 5 with Eqs. 7 and 8, chosen by Algorithm 6. SPDX-License-Identifier: MIT */
#include "vibration/event.h"
#include "base/handle.h"
#include "base/rule.h"
#include "vibration/ticks.h"

#include <math.h>

/* Algorithm 5 in units of A: Algorithm 2 at 2 ticks with 2/sqrt(13) plus Algorithm 4 at 3 ticks with 3/sqrt(13) (Eq. 8;
 * by Eq. 7 the 3-tick part is +sqrt(1/2) for two ticks and -sqrt(2) for one), in phase. */
#define EVEN (2.0 / 3.605551275463989)                      /* 2/sqrt(13) */
#define UP   (3.0 / 3.605551275463989 * 0.7071067811865476) /* 3/sqrt(13) sqrt(1/2) */
#define DOWN (3.0 / 3.605551275463989 * 1.4142135623730951) /* 3/sqrt(13) sqrt(2) */
const double knurl_mixed_heights[6] = {EVEN + UP, -EVEN + UP, EVEN - DOWN, -EVEN + UP, EVEN + UP, -EVEN - DOWN};

static void init_even(int32_t length, double amplitude, knurl_vibration_event *event) {
    event->kind = KNURL_EVENT_EVEN;
    event->length = length;
    event->positive_ticks = length / 2;
    event->positive = amplitude;
    event->negative = amplitude;
}

/* Algorithm 4; Eq. 7 with the period that is played, so that impulse and energy balance exactly: with T = Tp + Tn it
 * becomes Ap = A sqrt(Tn / Tp), and An = Ap Tp / Tn (Eq. 5). */
static void init_odd(int32_t length, double amplitude, knurl_vibration_event *event) {
    const double ratio = (length - 1.0) / (length + 1.0);
    event->kind = KNURL_EVENT_ODD;
    event->length = length;
    event->positive_ticks = (length + 1) / 2;
    event->positive = amplitude * sqrt(ratio);
    event->negative = event->positive / ratio;
}

void knurl_vibration_event_fill(double period_ticks, double amplitude, knurl_vibration_event *event) {
    const double ticks = knurl_snap_ticks(period_ticks);
    event->above_nyquist = ticks < 2.0;
    if (ticks < 2.25) {
        init_even(2, amplitude, event);
    } else if (ticks <= 2.75) {
        event->kind = KNURL_EVENT_MIXED;
        event->length = 6;
        event->positive_ticks = 0;
        event->positive = amplitude;
        event->negative = 0.0;
    } else {
        const int32_t length = (int32_t)floor(ticks + 0.5); /* half up, as the paper rounds */
        if (length % 2 == 0) {
            init_even(length, amplitude, event);
        } else {
            init_odd(length, amplitude, event);
        }
    }
}

knurl_result knurl_vibration_event_prepare(double period_ticks, double amplitude, knurl_vibration_event *event) {
    KNURL_RULE(NOT_HAPTIC, NULL);
    if (KNURL_IS_NULL(event)) {
        return KNURL_ERROR_ARGUMENT;
    }
    if (!(period_ticks > 0.0 && period_ticks <= KNURL_MAX_PERIOD_TICKS)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "period: expected above 0 and up to %g ticks, found %g",
                          KNURL_MAX_PERIOD_TICKS, period_ticks);
    }
    if (!(amplitude >= 0.0 && knurl_is_finite(amplitude))) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "amplitude: expected a finite number >= 0, found %g", amplitude);
    }
    knurl_vibration_event_fill(period_ticks, amplitude, event);
    return KNURL_OK;
}

double knurl_vibration_event_height(const knurl_vibration_event *event, int32_t index) {
    return event && index >= 0 && index < event->length ? knurl_vibration_event_value(event, index) : 0.0;
}
