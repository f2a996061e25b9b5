/* The Inverse3's row in the table of faults: the driver over a simulated service. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_INVERSE3_DOUBLE_H
#define KNURL_TEST_INVERSE3_DOUBLE_H

#include "device/inverse3/channel.h"
#include "device/inverse3/inverse3_sim.h"
#include "support/double.h"

extern const device_double inverse3_double;

/** Resets the simulated service and opens the driver on it; null on failure. */
knurl_device *inverse3_double_open(const char *options);

/** The simulation. Valid from inverse3_double_begin() or an opening to the device's end. */
inverse3_sim *inverse3_double_sim(void);

/** The same while a device is open: the driver's thread waits until it is given back. */
inverse3_sim *inverse3_double_take(void);
void inverse3_double_give_back(void);

void inverse3_double_begin(void);
const knurl_inverse3_service *inverse3_double_service(void);

/** Replaces every answer from now on; null: real answers. */
void inverse3_double_say(const char *text, size_t size);

/** The next event at its other port; the latest two of those that come within one exchange are kept. */
void inverse3_double_tell(const char *event);

/** Connections that are open. */
int inverse3_double_connections(void);

/** 1: the service has ended: connections are closed and none is made. */
void inverse3_double_end_service(int is_ended);

#endif
