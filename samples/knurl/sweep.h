/* The response of a device in a hand, measured: how far its grip moves per newton, over frequency.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SWEEP_H
#define KNURL_SWEEP_H

#include <knurl/device.h>

#include <signal.h>
#include <stdio.h>

/** Sixths of an octave from 20 to 453 Hz, and 500 Hz; at 1 kHz they end at 403 Hz. */
#define SWEEP_ROWS 29

/** N: the most that sine and slow motion command together. */
#define SWEEP_FORCE_MAX 1.0

typedef struct sweep_row {
    double hz;
    double gain;  /**< m of motion per N of the commanded sine, the hold over a tick included */
    double noise; /**< m/N: beside the line, per bin */
} sweep_row;

typedef struct sweep {
    double rate;    /**< Hz */
    double newtons; /**< peak of the force: 1 N, or the device's continuous force if that is less */
    double seconds; /**< that it took */
    uint64_t overruns;
    sweep_row rows[SWEEP_ROWS];
    uint32_t row_count;
} sweep;

/** Plays sines along y, one after the other, each faded in and out, and measures the positions along y. A slow sine of
 * a fifth of the force carries the grip over several of an encoder's counts meanwhile, so that motions far smaller than
 * a count are found in the mean. The force ramps to zero and no row is returned after a fault of the device, after
 * *interrupted is set or a key is pressed (watch.h), and if the grip leaves its place by 30 mm.
 * rate: KNURL_UPDATE_RATE_MIN to _MAX, at least 1000 Hz. simulated: 1: as fast as the machine can, for a fake device.
 * Errors: as knurl_loop_create(), KNURL_ERROR_CANCELLED, KNURL_ERROR_DEVICE_NOT_READY (a fault), KNURL_ERROR_STATE (the
 * grip went away). [game thread] */
knurl_result sweep_run(knurl_device *device, double rate, int simulated, volatile sig_atomic_t *interrupted,
                       sweep *result);

/** Number of rows, from the first one on, that stand out from the noise. */
uint32_t sweep_count_clear(const sweep *s);

/** Writes these as a file for --response. */
void sweep_write(const sweep *s, FILE *stream, const char *name);

#endif
