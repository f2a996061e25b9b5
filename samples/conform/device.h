/* The device under test, if it is the caller's own functions. SPDX-License-Identifier: MIT */
#ifndef KNURL_CONFORM_DEVICE_H
#define KNURL_CONFORM_DEVICE_H

#include <knurl/device_functions.h>

/* Fills in the functions (initialised to defaults) of a device that is about to be opened. The only function that your
 * file needs; see device.c. seed: of a simulated device, so that a run can be repeated; real devices ignore it. Set
 * motors_known, because the pulses by which Knurl detects backwards motors are not forces of a scene. */
void conform_device(knurl_device_functions *functions, uint64_t seed);

#endif
