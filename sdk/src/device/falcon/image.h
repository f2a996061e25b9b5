/* Reads and checks firmware images of the Falcon. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_FALCON_IMAGE_H
#define KNURL_SRC_FALCON_IMAGE_H

#include <knurl/base.h>

#include <stddef.h>

/* Size limits of an image, bytes; known images have 7 to 8.5 kB. */
#define KNURL_FALCON_IMAGE_LEAST 1024
#define KNURL_FALCON_IMAGE_MOST  65536

/* Reads the image at `path` and checks that the Falcon's processor, a TMS320F281x, would load all of it: the key
 * 0x08AA, 8 reserved words, an entry point, blocks (words, destination, data) and a block of 0 words at the file's end.
 * Words have 16 bits, low byte first; addresses have two, high word first. Source: Texas Instruments SPRU095, "Boot
 * Loader Data Stream Structure". image: room for KNURL_FALCON_IMAGE_MOST + 1 bytes. size: bytes. Errors:
 * KNURL_ERROR_IO, KNURL_ERROR_FORMAT, with the file and, if its content is wrong, the byte. */
knurl_result knurl_falcon_read_image(const char *path, uint8_t *image, size_t *size);

#endif
