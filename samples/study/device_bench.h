/* A test bench: the simulated Touch with its HIP fixed to a force sensor. SPDX-License-Identifier: MIT */
#ifndef KNURL_STUDY_DEVICE_BENCH_H
#define KNURL_STUDY_DEVICE_BENCH_H

#include "metrics.h"

#define BENCH_UPDATE_RATE   1000.0  /* Hz, of the command */
#define BENCH_OVERSAMPLING  40      /* samples a tick */
#define BENCH_SAMPLING_RATE 40000.0 /* Hz, of the force sensor, as in the appendix */

/* The Touch of the fake device: apparent mass and dry friction as on its data sheet. */
#define BENCH_MASS          0.045 /* kg */
#define BENCH_COULOMB       0.26  /* N */
#define BENCH_DAMPING_RATIO 0.1   /* of the fixture: assumed */

/** The stiffness and damping of fixture and device. */
typedef struct bench_fixture {
    double stiffness; /**< N/m, 1e4 to 4.5e5 */
    double damping;   /**< of the fixture, felt by the sensor: N s/m */
    double viscous;   /**< of the device, not felt by the sensor: N s/m */
} bench_fixture;

/** The sensor's reading at rest, N. */
typedef struct bench_reading {
    double before; /**< mean of 0.1 s before the signal */
    double after;  /**< and after it */
} bench_reading;

/** A fixture with BENCH_DAMPING_RATIO, of a device with `viscous` friction (N s/m). */
bench_fixture bench_make_fixture(double stiffness, double viscous);

/** Hz: of the mass in the fixture, undamped. */
double bench_resonance(const bench_fixture *fixture);

/** Plays whole periods of a command (N per tick, at BENCH_UPDATE_RATE) and returns the sensor's readings once they have
 * settled: at least half a second, a whole number of periods from the start of a period. Returns 0 if memory runs out.
 * Free `measured` with study_signal_free(). */
int bench_measure(const bench_fixture *fixture, const study_signal *command, study_signal *measured,
                  bench_reading *reading);

#endif
