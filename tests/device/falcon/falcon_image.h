/* Firmware images as the Falcon's boot loader takes them (Texas Instruments SPRU095), of bytes that mean nothing.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_FALCON_IMAGE_H
#define KNURL_TEST_FALCON_IMAGE_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* Offsets: of the entry point, of the one block's size, of its data. */
enum { FALCON_IMAGE_ENTRY = 18, FALCON_IMAGE_BLOCK = 22, FALCON_IMAGE_DATA = 28 };

/* size: bytes, even. Returns their sum. */
static inline uint32_t falcon_image_make(uint8_t *image, size_t size) {
    static const uint8_t address[] = {0x3f, 0x00, 0x02, 0x80}; /* 0x3f8002, in the processor's RAM */
    const size_t words = (size - FALCON_IMAGE_DATA - 2) / 2;
    uint32_t sum = 0;
    memset(image, 0, size);
    image[0] = 0xaa;
    image[1] = 0x08;
    memcpy(image + FALCON_IMAGE_ENTRY, address, sizeof address);
    image[FALCON_IMAGE_BLOCK] = (uint8_t)(words & 0xffu);
    image[FALCON_IMAGE_BLOCK + 1] = (uint8_t)(words >> 8);
    memcpy(image + FALCON_IMAGE_BLOCK + 2, address, sizeof address);
    for (size_t i = 0; i < 2 * words; i++) {
        image[FALCON_IMAGE_DATA + i] = (uint8_t)(i * 151 + 17);
    }
    for (size_t i = 0; i < size; i++) {
        sum += image[i];
    }
    return sum;
}

#endif
