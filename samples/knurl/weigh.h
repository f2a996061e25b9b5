/* Measures the weight on a device's grip, in the device's uncalibrated newtons. SPDX-License-Identifier: MIT */
#ifndef KNURL_WEIGH_H
#define KNURL_WEIGH_H

#include <knurl/device.h>

/** Duration of a weighing, s. */
#define WEIGH_SECONDS 12.0

/** N along each axis. */
#define WEIGH_FORCE_MAX 5.0

/** Set height and most, all others to 0. */
typedef struct weighing {
    double most;   /**< N, along each axis */
    double height; /**< m; NAN: the present one */
    double latest[3];
    double speed[3]; /**< low-passed */
    double lag;      /**< m s */
    double sum;      /**< N: of the forces, and their number, once it has settled */
    uint64_t count;
    uint64_t cut; /**< of these, forces that `most` cut */
} weighing;

/** The force callback of weigh(), at 1 kHz for WEIGH_SECONDS. user: a weighing. [haptic thread] */
void weigh_hold(uint64_t tick, const knurl_device_sample *sample, double force[3], void *user);

/** Moves the grip slowly up and down, 6 mm each way about `height` (m) or, if that is not finite, about its present
 * height, and averages the vertical force over two whole turns, so that friction cancels out. Writes the mean (N,
 * upwards) and the height. Errors: as knurl_loop_create(), and KNURL_ERROR_DEVICE_NOT_READY if the device had no
 * position for some time. [game thread] */
knurl_result weigh(knurl_device *device, double *height, double *newtons);

/** The gain that calibrates the force: with `gain`, `kilograms` weighed `heavier` newtons more than the empty grip. */
double weigh_gain(double gain, double kilograms, double heavier);

#endif
