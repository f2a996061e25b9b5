/* The HID reports of a WoodenHaptics, byte by byte. Pure. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_RAWHID_REPORT_H
#define KNURL_SRC_RAWHID_REPORT_H

#include "base/finite.h"

#include <stddef.h>
#include <stdint.h>

#define KNURL_RAWHID_LEAST_BYTES 14 /* of a report with all seven numbers */
#define KNURL_RAWHID_MOST_BYTES  64 /* of a full-speed interrupt transfer */

/* A report from the device. */
typedef struct knurl_rawhid_in {
    int16_t counts[6]; /* encoders a to f */
    int16_t info; /* 1 from a press of its button, which requests homing, until the counters are set; otherwise 0 */
} knurl_rawhid_in;

/* Parses a report of `report_bytes` and returns 1. If it is too short, too long or invalid, returns 0 and leaves *in
 * unchanged. */
int knurl_rawhid_parse(const uint8_t *bytes, size_t size, size_t report_bytes, knurl_rawhid_in *in);

/* Build reports to the device: the report ID (0), then `report_bytes`; return the total size. Motor currents in mA; or
 * a command that sets the encoders a to c (and d to f to 0) and carries no current. */
size_t knurl_rawhid_put_currents(uint8_t bytes[KNURL_RAWHID_MOST_BYTES + 1], size_t report_bytes, const int16_t ma[3]);
size_t knurl_rawhid_put_counters(uint8_t bytes[KNURL_RAWHID_MOST_BYTES + 1], size_t report_bytes,
                                 const int16_t counts[3]);

/* Report sizes in a HID report descriptor. */
typedef struct knurl_rawhid_sizes {
    uint32_t in, out; /* bytes of all input and of all output reports */
} knurl_rawhid_sizes;

/* Returns 1 and sets *sizes, or returns 0 if the descriptor ends within an item or a size is impossible. */
int knurl_rawhid_measure(const uint8_t *descriptor, size_t size, knurl_rawhid_sizes *sizes);

#endif
