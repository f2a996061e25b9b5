/* Firmware images of the Falcon. SPDX-License-Identifier: MIT */
#include "device/falcon/image.h"

#include "base/regular_file.h"

#include <stdio.h>

enum { KEY = 0x08aa, HEADER_BYTES = 2 + 8 * 2 + 4, BLOCK_HEADER_BYTES = 2 + 4 };

static uint32_t word_at(const uint8_t *image, size_t at) {
    return (uint32_t)image[at] | (uint32_t)image[at + 1] << 8;
}

static uint32_t address_at(const uint8_t *image, size_t at) {
    return word_at(image, at) << 16 | word_at(image, at + 2);
}

static knurl_result refuse(const char *path, const char *expected, size_t at) {
    return knurl_fail(KNURL_ERROR_FORMAT, "device 'falcon': firmware '%s': byte %lu: expected %s: it is not a Falcon's",
                      path, (unsigned long)at, expected);
}

static knurl_result check_image(const char *path, const uint8_t *image, size_t size) {
    size_t at = HEADER_BYTES;
    int is_entry_loaded = 0;
    const uint32_t entry = address_at(image, HEADER_BYTES - 4);
    if (word_at(image, 0) != KEY) {
        return refuse(path, "the boot loader's key, aa 08", 0);
    }
    while (at + 2 <= size && word_at(image, at) > 0) {
        const size_t words = word_at(image, at);
        if (size - at < BLOCK_HEADER_BYTES + 2 * words) {
            return refuse(path, "a block that ends within the file", at);
        }
        const uint32_t destination = address_at(image, at + 2);
        is_entry_loaded |= entry >= destination && entry - destination < words;
        at += BLOCK_HEADER_BYTES + 2 * words;
    }
    if (at + 2 != size) {
        return refuse(path, "a block of 0 words, and then the file's end", at);
    }
    return is_entry_loaded ? KNURL_OK : refuse(path, "an entry point in one of the blocks", HEADER_BYTES - 4);
}

knurl_result knurl_falcon_read_image(const char *path, uint8_t *image, size_t *size) {
    char why[160];
    uint64_t there = 0;
    FILE *file = knurl_regular_open(NULL, path, &there, why, sizeof why);
    if (!file) {
        return knurl_fail(KNURL_ERROR_IO, "device 'falcon': firmware '%s': %s", path, why);
    }
    const size_t got = fread(image, 1, KNURL_FALCON_IMAGE_MOST + 1, file);
    const int failed = ferror(file);
    (void)fclose(file);
    if (failed) {
        return knurl_fail(KNURL_ERROR_IO, "device 'falcon': firmware '%s' cannot be read", path);
    }
    if (got < KNURL_FALCON_IMAGE_LEAST || got > KNURL_FALCON_IMAGE_MOST) {
        return knurl_fail(KNURL_ERROR_FORMAT,
                          "device 'falcon': firmware '%s': expected an image of %d to %d bytes, found %lu%s", path,
                          KNURL_FALCON_IMAGE_LEAST, KNURL_FALCON_IMAGE_MOST, (unsigned long)got,
                          got > KNURL_FALCON_IMAGE_MOST ? " or more" : "");
    }
    const knurl_result result = check_image(path, image, got);
    if (!result) {
        *size = got;
    }
    return result;
}
