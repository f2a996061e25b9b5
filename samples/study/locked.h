/* How the method LOCKED keeps step with the surface, beside S1 and S2: at constant speed and in strokes, from ideal or
 * quantised positions. SPDX-License-Identifier: MIT */
#ifndef KNURL_STUDY_LOCKED_H
#define KNURL_STUDY_LOCKED_H

#include "grating_metrics.h"

/** What is scanned, and how. */
typedef struct locked_scan {
    int32_t method;
    double rate;       /**< f_h: Hz */
    double period;     /**< m, along x; A is 1 */
    double quantum;    /**< m: positions come in it and speed is FOAW's; 0: ideal positions, speed as it is */
    double crossover;  /**< Hz; 0: the library's */
    double start;      /**< cycles: where on the grating it begins */
    double seconds;    /**< how long; 0: 1000 cycles at a constant speed, of a stroke two repetitions */
    double per_second; /**< strokes a second from rest to the top frequency and back; 0: constant speed */
    int turns;         /**< 1: each stroke goes back where the one before came from */
} locked_scan;

/** What it came to. */
typedef struct locked_found {
    study_step step;
    double unbalanced; /**< the greatest |sum of an event's heights|, of those that played to their end; A ticks */
    double push;       /**< study_scan_push() over 50 ms at constant speed; A */
    double net;        /**< |study_scan_net()| at a depth of 2 A; K A */
    double spurious;   /**< study_scan_spurious() of 2 s at constant speed, a tolerance of a quarter; share */
} locked_found;

/** Scans at f_t = `frequency` Hz, of a stroke its top. push, net and spurious are found only where `all` is 1. 1, or 0
 * where memory is not to be had. */
int locked_scan_run(const locked_scan *what, double frequency, int all, locked_found *found);

/** The worst of `starts` start phases. */
int locked_scan_worst(const locked_scan *what, double frequency, int starts, int all, locked_found *found);

#endif
