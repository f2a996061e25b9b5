/* What hangs on a device's grip, in newtons of what the device takes for one. SPDX-License-Identifier: MIT */
#ifndef KNURL_WEIGH_H
#define KNURL_WEIGH_H

#include <knurl/device.h>

/** s that a weighing takes. */
#define WEIGH_SECONDS 12.0

/** Moves the grip slowly up and down, 6 mm each way about the height `height` (m) or, where that is not finite, about
 * where it is, and takes the mean of the vertical force over two whole turns, so that friction cancels out. Writes the
 * mean (N, upwards) and the height. Errors: as knurl_loop_create(), and KNURL_ERROR_DEVICE_NOT_READY where the device
 * did not give a position all the time. [game thread] */
knurl_result weigh(knurl_device *device, double *height, double *newtons);

/** The gain that makes a newton a newton: with `gain`, `kilograms` took `heavier` newtons more than nothing took. */
double weigh_gain(double gain, double kilograms, double heavier);

#endif
