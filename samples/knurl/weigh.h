/* Measures the weight on a device's grip, in the device's uncalibrated newtons. SPDX-License-Identifier: MIT */
#ifndef KNURL_WEIGH_H
#define KNURL_WEIGH_H

#include <knurl/device.h>

/** Duration of a weighing, s. */
#define WEIGH_SECONDS 12.0

/** Moves the grip slowly up and down, 6 mm each way about `height` (m) or, if that is not finite, about its present
 * height, and averages the vertical force over two whole turns, so that friction cancels out. Writes the mean (N,
 * upwards) and the height. Errors: as knurl_loop_create(), and KNURL_ERROR_DEVICE_NOT_READY if the device had no
 * position for some time. [game thread] */
knurl_result weigh(knurl_device *device, double *height, double *newtons);

/** The gain that calibrates the force: with `gain`, `kilograms` weighed `heavier` newtons more than the empty grip. */
double weigh_gain(double gain, double kilograms, double heavier);

#endif
