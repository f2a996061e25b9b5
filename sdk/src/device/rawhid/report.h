/* The HID reports of a WoodenHaptics, byte by byte. Pure. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_RAWHID_REPORT_H
#define KNURL_SRC_RAWHID_REPORT_H

#include "base/finite.h"

#include <stddef.h>
#include <stdint.h>

#define KNURL_RAWHID_LEAST_BYTES 14 /* of a report that holds all seven numbers */
#define KNURL_RAWHID_MOST_BYTES  64 /* of a full-speed interrupt transfer */

/* What the device says. */
typedef struct knurl_rawhid_in {
    int16_t counts[6]; /* encoders a to f */
    int16_t info;      /* 1: its button was pressed, which asks for homing, until the counters are set; else 0 */
} knurl_rawhid_in;

/* 1: `bytes` is one whole report of `report_bytes`; 0, and *in untouched, where it is too short, too long, or says what
 * no firmware says. */
int knurl_rawhid_parse(const uint8_t *bytes, size_t size, size_t report_bytes, knurl_rawhid_in *in);

/* Reports to the device: the report ID (0) and `report_bytes` behind it; returns how many that are. Motor currents in
 * mA; or a command that sets the encoders a to c (and d to f to 0) and carries no current. */
size_t knurl_rawhid_put_currents(uint8_t bytes[KNURL_RAWHID_MOST_BYTES + 1], size_t report_bytes, const int16_t ma[3]);
size_t knurl_rawhid_put_counters(uint8_t bytes[KNURL_RAWHID_MOST_BYTES + 1], size_t report_bytes,
                                 const int16_t counts[3]);

/* What a HID report descriptor promises. */
typedef struct knurl_rawhid_sizes {
    uint32_t in, out; /* bytes of all reports that come and go */
} knurl_rawhid_sizes;

/* 1 and *sizes; 0 where the descriptor ends in the middle of an item, or promises what no transfer can hold. */
int knurl_rawhid_measure(const uint8_t *descriptor, size_t size, knurl_rawhid_sizes *sizes);

#endif
