/* The serial WoodenHaptics' row in the table of faults. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_SERIAL_DOUBLE_H
#define KNURL_TEST_SERIAL_DOUBLE_H

#include "device/rawhid/serial.h"
#include "support/double.h"

extern const device_double serial_double;

/** The simulated port that the double is opened on. After serial_double.open(). */
extern const knurl_serial_ports serial_double_ports;

/** Its button is pressed. */
void serial_double_press(void);

/** Imitates another device's firmware: the first number of each line. */
void serial_double_model(int model);

/** Replaces every answer from now on; null: real answers. */
void serial_double_say(const char *line);

/** Opens the driver on it with options. */
knurl_device *serial_double_open(const char *options);

#endif
