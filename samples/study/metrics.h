/* Metrics of held (zero-order) periodic signals, over whole actual periods. For studies; a game does not need them.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_STUDY_METRICS_H
#define KNURL_STUDY_METRICS_H

#include <knurl/knurl.h>

#include <stddef.h>

/** The longest actual period that is searched for, ticks. */
#define STUDY_MAX_PERIOD 200000

/** One whole actual period of a signal, one value per tick. Free `values` with study_signal_free(). */
typedef struct study_signal {
    double *values;
    size_t length; /**< ticks: the actual period (T2: the least common multiple of its parts'; T1: the smallest number
                      of ticks that is a whole number of periods) */
    double update_rate_hz; /**< f_h */
} study_signal;

/** One spectral line of a held signal. */
typedef struct study_line {
    double frequency; /**< Hz */
    double amplitude; /**< peak, in the signal's unit */
} study_line;

/** The smallest number of ticks that is a whole number of periods, to 1e-9 of it (T1's rule for its edges); 0: more
 * than STUDY_MAX_PERIOD. */
size_t study_whole_ticks(double period_ticks);

/** Plays one actual period of a wave. Returns 0 if memory runs out or the period exceeds STUDY_MAX_PERIOD. */
int study_signal_of_wave(const knurl_wave *wave, double update_rate_hz, study_signal *signal);

/** Copies `length` ticks that are a whole number of periods. Returns 0 if memory runs out. */
int study_signal_of_values(const double *values, size_t length, double update_rate_hz, study_signal *signal);

void study_signal_free(study_signal *signal);

/** Mean over the period: the net force. */
double study_net(const study_signal *signal);

/** Root mean square about 0. */
double study_rms(const study_signal *signal);

/** The amplitude of the line at frequency line x f_h / length of the held signal, in double: |DFT| times the hold's
 * sinc. line: 1, 2, ...; beyond length/2 these are the hold's images. */
double study_line_amplitude(const study_signal *signal, size_t line);

/** |DFT| / length for lines 0 to length - 1, in single precision; free it. Null if memory runs out. */
double *study_magnitudes(const study_signal *signal);

/** The strongest line up to f_h/2. The FFT (KissFFT, single precision) finds it, study_line_amplitude() measures it; of
 * lines that are equal to 1e-5 the lowest is taken. Returns 0 if memory runs out. */
int study_dominant(const study_signal *signal, study_line *line);

/** Pearson's correlation over the least common multiple of both periods: independent of scale and offset. NaN if either
 * is constant, or that multiple exceeds 1000 STUDY_MAX_PERIOD. */
double study_pcc(const study_signal *a, const study_signal *b);

/** The share (0..1) of the held signal's varying power outside the line at `frequency` and its odd harmonics, which
 * have all the power of a true square wave. Harmonics are summed to the 20,001st; the rest is below 1e-5. NaN if the
 * signal is constant. */
double study_spurious(const study_signal *signal, double frequency);

#endif
