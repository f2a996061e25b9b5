/* The device that is judged, where it is a maker's own functions. SPDX-License-Identifier: MIT */
#ifndef KNURL_CONFORM_DEVICE_H
#define KNURL_CONFORM_DEVICE_H

#include <knurl/device.h>

/* Fills in the functions (which come with defaults) of a device that is about to be opened. A maker's file has this one
 * function; see device.c. seed: for a device that is simulated, so that a run can be repeated; others leave it alone.
 * Set motors_known: the pulses by which Knurl looks for backwards motors are no forces of a scene. */
void conform_device(knurl_device_functions *functions, uint64_t seed);

#endif
