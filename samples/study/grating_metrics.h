/* Metrics of a grating under a given motion: cycles played and crossed, phase error, dropouts, net force, spurious
 * energy. For studies.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_STUDY_GRATING_METRICS_H
#define KNURL_STUDY_GRATING_METRICS_H

#include <knurl/knurl.h>

#include <stddef.h>

/** How crossed cycles are counted. MAP: Eq. 11's sign changes, fsx |dx| + fsy |dy|. PATH: Eq. 12, the integral of
 * max(fsx |vx|, fsy |vy|). On an axis the two are the same. */
enum { STUDY_CROSSED_MAP = 0, STUDY_CROSSED_PATH = 1 };

/** Cycles that an event of T3 counts as: 1, the six-tick mix 6/2.5 = 2.4. */
double study_event_cycles(const knurl_vibration_event *event);

/** 1 if the tick was part of an event: BANDLIMITED counts ridges and plays no events. */
int study_plays_event(const knurl_grating *grating, const knurl_grating_output *out);

/** Motion of the HIP at one tick. */
typedef struct study_motion {
    double position[2]; /**< m along the surface's x and y */
    double velocity[2]; /**< m/s, held until the next tick */
} study_motion;

/** A grating's ticks under a motion. Free with study_scan_free(). */
typedef struct study_scan {
    double *height;  /**< m, `ticks` of them */
    double *crossed; /**< cycles crossed since the start, before each tick and after the last: ticks + 1 */
    double *played;  /**< cycles played since the start, likewise. A tick of an event plays study_event_cycles() over
                          its length; without an event every change of the height's sign is half a cycle */
    double *within;  /**< the elapsed share of the event before each tick, [0, 1); below 0 without an event */
    double *cycles;  /**< study_event_cycles() of the event that plays in each tick; 0 without */
    size_t ticks;
    size_t whole; /**< the last tick boundary between events (S1: `ticks`) */
    double update_rate_hz;
    int64_t events;
} study_scan;

/** A straight line at a steady speed: `ticks` motions from `start` (m) at `velocity` (m/s). */
void study_motion_line(const double start[2], const double velocity[2], double update_rate_hz, study_motion *motion,
                       size_t ticks);

/** Plays a checked grating from a fresh state. crossed: STUDY_CROSSED_. Returns 0 if memory runs out. */
int study_scan_run(const knurl_grating *grating, const study_motion *motion, size_t ticks, int crossed,
                   study_scan *scan);

void study_scan_free(study_scan *scan);

/** A scan from one value per tick, without events: cycles played (each change of sign is half a cycle; 0 keeps the
 * previous sign) against the cycles of a wave of `period_ticks`. `values` are copied. */
int study_scan_of_values(const double *values, size_t ticks, double period_ticks, double update_rate_hz,
                         study_scan *scan);

/** Drift: played over crossed cycles, less 1, up to the last boundary between events; NaN if none was crossed. */
double study_scan_drift(const study_scan *scan);

/** Phase error: the greatest |played - crossed| at a tick, in cycles. S1 without aliasing stays within half a cycle. */
double study_scan_phase_error(const study_scan *scan);

/** Step of a scan with the surface, independent of the scan's start. */
typedef struct study_step {
    double error;   /**< cycles, the worst of all ticks */
    double played;  /**< cycles from the start of the first to the start of the last */
    double crossed; /**< cycles crossed between those two ticks */
    double longest; /**< ticks of the longest event */
} study_step;

/** Counts played cycles from the heights and their events alone. An event has whole cycles that start at a rising edge;
 * without events, each change of sign starts the next half cycle, and the error is the phase's distance from the felt
 * half cycle. phase: cycles crossed before each tick, `ticks` of them; it is a whole number at a rising edge of the
 * surface, forwards (fs x + 1/4), and may turn back: backwards the surface rises half a cycle off. At the start and
 * after each turn, the first felt half cycle is matched to the nearest one of its sign; from there on half cycles are
 * counted, so that missing and extra ones are errors. An event that a turn interrupts is not judged. While H is 0, no
 * cycle is played. */
study_step study_scan_step(const study_scan *scan, const double *phase);

/** Dropout: of the half cycles crossed, the share never played. Half cycle j is the range of 2 crossed in [j, j + 1).
 * It is played if 2 played passes a whole number while 2 crossed is in [j - 1, j + 2), that is, at most half a cycle
 * early or late; each passing counts for one half cycle, the earliest that is still open. Half cycles still open at the
 * end do not count. NaN if none was decided. */
double study_scan_dropout(const study_scan *scan);

/** Net force of one-sided contact (Eq. 9) at a steady depth (m below the smooth surface; its force is K depth): the
 * mean over the ticks to `whole` of K max(0, H + depth), less K max(0, depth). N; stiffness in N/m. */
double study_scan_net(const study_scan *scan, double stiffness, double depth);

/** Mean over blocks of |mean height|: the push over the length of a block, which is the number of whole cycles of
 * `frequency` nearest to `seconds` (at least one; a block's ends are rounded to ticks). m. NaN if the scan is shorter
 * than a block. */
double study_scan_push(const study_scan *scan, double frequency, double seconds);

/** Spurious energy at a steady speed: the share (0..1) of the held height's varying power that is further than
 * `tolerance` x frequency from every odd multiple of `frequency`. Hann window over all ticks, lines to 10 f_h. The
 * tolerance must be above 2 f_h / (ticks x frequency), the window's width. NaN if the height is constant or memory runs
 * out. */
double study_scan_spurious(const study_scan *scan, double frequency, double tolerance);

#endif
