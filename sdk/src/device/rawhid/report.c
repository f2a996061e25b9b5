/* HID reports: little-endian, two's complement, on any machine. SPDX-License-Identifier: MIT */
#include "device/rawhid/report.h"

#include <string.h>

enum { CURRENTS = 0, SET_COUNTERS = 1 }; /* the firmware's commands */

static int16_t get(const uint8_t *bytes) {
    const int32_t raw = bytes[0] | bytes[1] << 8;
    return (int16_t)(raw < 32768 ? raw : raw - 65536);
}

static void put(uint8_t *bytes, int16_t value) {
    const uint16_t raw = (uint16_t)value;
    bytes[0] = (uint8_t)(raw & 0xffu);
    bytes[1] = (uint8_t)(raw >> 8);
}

int knurl_rawhid_parse(const uint8_t *bytes, size_t size, size_t report_bytes, knurl_rawhid_in *in) {
    if (size != report_bytes || size < KNURL_RAWHID_LEAST_BYTES) {
        return 0;
    }
    const int16_t info = get(bytes + 12);
    if (info != 0 && info != 1) {
        return 0;
    }
    for (int i = 0; i < 6; i++) {
        in->counts[i] = get(bytes + 2 * i);
    }
    in->info = info;
    return 1;
}

static size_t put_report(uint8_t *bytes, size_t report_bytes, const int16_t first[3], int16_t command,
                         const int16_t attributes[3]) {
    memset(bytes, 0, KNURL_RAWHID_MOST_BYTES + 1);
    for (int i = 0; i < 3; i++) { /* after the report ID */
        put(bytes + 1 + 2 * i, first[i]);
        put(bytes + 9 + 2 * i, attributes[i]);
    }
    put(bytes + 7, command);
    return report_bytes + 1;
}

static const int16_t none[3];

size_t knurl_rawhid_put_currents(uint8_t bytes[KNURL_RAWHID_MOST_BYTES + 1], size_t report_bytes, const int16_t ma[3]) {
    return put_report(bytes, report_bytes, ma, CURRENTS, none);
}

size_t knurl_rawhid_put_counters(uint8_t bytes[KNURL_RAWHID_MOST_BYTES + 1], size_t report_bytes,
                                 const int16_t counts[3]) {
    return put_report(bytes, report_bytes, none, SET_COUNTERS, counts);
}

/* HID 1.11, 6.2.2: an item is a prefix (two bits of length, two of type, four of tag) and 0, 1, 2 or 4 bytes. */
enum { REPORT_SIZE = 0x74, REPORT_COUNT = 0x94, INPUT = 0x80, OUTPUT = 0x90, LONG_ITEM = 0xfe };

int knurl_rawhid_measure(const uint8_t *descriptor, size_t size, knurl_rawhid_sizes *sizes) {
    static const size_t lengths[4] = {0, 1, 2, 4};
    uint64_t bits = 0;
    uint64_t count = 0;
    uint64_t in = 0;
    uint64_t out = 0;
    for (size_t at = 0; at < size;) {
        const uint8_t prefix = descriptor[at];
        const size_t length = lengths[prefix & 3u];
        if (prefix == LONG_ITEM || length >= size - at) {
            return 0;
        }
        uint64_t value = 0;
        for (size_t i = 0; i < length; i++) {
            value |= (uint64_t)descriptor[at + 1 + i] << (8 * i);
        }
        switch (prefix & 0xfcu) {
        case REPORT_SIZE:
            bits = value;
            break;
        case REPORT_COUNT:
            count = value;
            break;
        case INPUT:
            in += bits * count;
            break;
        case OUTPUT:
            out += bits * count;
            break;
        default:
            break;
        }
        if (bits > 65536 || count > 65536 || in > 1000000 || out > 1000000) {
            return 0;
        }
        at += 1 + length;
    }
    sizes->in = (uint32_t)(in / 8);
    sizes->out = (uint32_t)(out / 8);
    return 1;
}
