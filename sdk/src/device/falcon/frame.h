/* The frames of a Novint Falcon's firmware, both directions: 16 bytes, '<', fourteen characters, '>'. Pure computation.
 * Source: libnifalcon (FalconFirmwareNovintSDK).
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_FALCON_FRAME_H
#define KNURL_SRC_FALCON_FRAME_H

#include "base/finite.h"

#include <stddef.h>
#include <stdint.h>

#define KNURL_FALCON_FRAME_BYTES 16

/* Flags of a frame to the device. */
enum {
    KNURL_FALCON_HOMING = 1, /* in every frame: when a leg passes its index, its encoder is set, and stays homed */
    KNURL_FALCON_GREEN = 2,
    KNURL_FALCON_BLUE = 4,
    KNURL_FALCON_RED = 8
};

#define KNURL_FALCON_ALL_HOMED 7u

/* A frame from the device. */
typedef struct knurl_falcon_state {
    int16_t counts[3]; /* encoders */
    uint8_t buttons;   /* bits 0 to 3 */
    uint8_t homed;     /* one bit per leg */
} knurl_falcon_state;

/* Finds frames in received bytes; zeroed at first. A frame has no checksum and no number. A lost, doubled or foreign
 * character is always detected; if one of the sixteen replaces another, it never is. In the highest digit that gives a
 * position that no hand reaches (refused by the driver), or a jump (refused by every device's position check: 20 mm);
 * in the low two it shifts the position by up to 10 mm for one reading, which may be accepted. */
typedef struct knurl_falcon_decoder {
    uint8_t bytes[KNURL_FALCON_FRAME_BYTES]; /* of the unfinished frame */
    uint32_t count;
    uint64_t bad_bytes; /* discarded so far */
    knurl_falcon_state newest;
} knurl_falcon_decoder;

void knurl_falcon_encode(const int16_t motors[3], uint32_t flags, uint8_t frame[KNURL_FALCON_FRAME_BYTES]);

/* Adds bytes, without their packets' status bytes; returns the number of completed frames. The last one is `newest`. */
uint32_t knurl_falcon_decode(knurl_falcon_decoder *decoder, const uint8_t *bytes, size_t count);

#endif
