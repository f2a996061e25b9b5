/* The frames of a Novint Falcon's firmware, both directions: 16 bytes, '<', fourteen characters, '>'. Pure computation.
 * Source: libnifalcon (FalconFirmwareNovintSDK).
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_FALCON_FRAME_H
#define KNURL_SRC_FALCON_FRAME_H

#include "base/finite.h"

#include <stddef.h>
#include <stdint.h>

#define KNURL_FALCON_FRAME_BYTES 16

/* The flags of a frame to the device. */
enum {
    KNURL_FALCON_HOMING = 1, /* in every frame: legs that pass their index set their encoders to it, and keep that */
    KNURL_FALCON_GREEN = 2,
    KNURL_FALCON_BLUE = 4,
    KNURL_FALCON_RED = 8
};

#define KNURL_FALCON_ALL_HOMED 7u

/* A frame from the device. */
typedef struct knurl_falcon_state {
    int16_t counts[3]; /* encoders */
    uint8_t buttons;   /* bits 0 to 3 */
    uint8_t homed;     /* a bit a leg */
} knurl_falcon_state;

/* Finds frames in what comes; zeroed: none yet. A frame has no checksum and no number. A lost, doubled or foreign
 * character is always seen; one of the sixteen in another's place never is. In the highest digit that is a position
 * that no hand reaches (the driver), or a jump (the position check of every device: 20 mm); in the low two it moves the
 * position by up to 10 mm for one reading, which may be believed. */
typedef struct knurl_falcon_decoder {
    uint8_t bytes[KNURL_FALCON_FRAME_BYTES]; /* of the frame that is under way */
    uint32_t count;
    uint64_t bad_bytes; /* thrown away so far */
    knurl_falcon_state newest;
} knurl_falcon_decoder;

void knurl_falcon_encode(const int16_t motors[3], uint32_t flags, uint8_t frame[KNURL_FALCON_FRAME_BYTES]);

/* Takes bytes in, less the status bytes of their packets; returns how many frames they ended, the last of which is
 * `newest` now. */
uint32_t knurl_falcon_decode(knurl_falcon_decoder *decoder, const uint8_t *bytes, size_t count);

#endif
