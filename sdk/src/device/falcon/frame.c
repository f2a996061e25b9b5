/* Frames of a Novint Falcon. SPDX-License-Identifier: MIT */
#include "device/falcon/frame.h"

#define FIRST  0x41u /* 'A' is 0 */
#define FLAGS  13u
#define SPARE  14u
#define END    15u
#define DIGITS 4u /* per number, the lowest first */

void knurl_falcon_encode(const int16_t motors[3], uint32_t flags, uint8_t frame[KNURL_FALCON_FRAME_BYTES]) {
    frame[0] = '<';
    for (uint32_t leg = 0; leg < 3; leg++) {
        const uint16_t value = (uint16_t)motors[leg];
        for (uint32_t digit = 0; digit < DIGITS; digit++) {
            frame[1 + DIGITS * leg + digit] = (uint8_t)(FIRST + ((value >> (4 * digit)) & 15u));
        }
    }
    frame[FLAGS] = (uint8_t)(FIRST + (flags & 15u));
    frame[SPARE] = FIRST;
    frame[END] = '>';
}

/* 1 if `byte` is valid at this place. The spare byte may be anything but a bracket. */
static int fits(uint32_t at, uint8_t byte) {
    const uint32_t most = at < FLAGS ? FIRST + 15u : FIRST + 127u;
    return at == 0 ? byte == '<' : at == END ? byte == '>' : byte >= FIRST && byte <= most;
}

static void take(const uint8_t *frame, knurl_falcon_state *state) {
    for (uint32_t leg = 0; leg < 3; leg++) {
        uint32_t value = 0;
        for (uint32_t digit = 0; digit < DIGITS; digit++) {
            value |= (frame[1 + DIGITS * leg + digit] - FIRST) << (4 * digit);
        }
        state->counts[leg] = (int16_t)(value < 0x8000u ? (int32_t)value : (int32_t)value - 0x10000);
    }
    state->buttons = (uint8_t)((frame[FLAGS] - FIRST) & 15u);
    state->homed = (uint8_t)(((frame[FLAGS] - FIRST) >> 4) & 7u);
}

uint32_t knurl_falcon_decode(knurl_falcon_decoder *decoder, const uint8_t *bytes, size_t count) {
    uint32_t frames = 0;
    for (size_t i = 0; i < count; i++) {
        if (!fits(decoder->count, bytes[i])) { /* no earlier byte of the frame is a '<', so start again here */
            decoder->bad_bytes += decoder->count;
            decoder->count = 0;
            if (bytes[i] != '<') {
                decoder->bad_bytes++;
                continue;
            }
        }
        decoder->bytes[decoder->count++] = bytes[i];
        if (decoder->count == KNURL_FALCON_FRAME_BYTES) {
            take(decoder->bytes, &decoder->newest);
            decoder->count = 0;
            frames++;
        }
    }
    return frames;
}
