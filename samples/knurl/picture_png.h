/* PNG, by libpng. SPDX-License-Identifier: MIT */
#ifndef KNURL_PICTURE_PNG_H
#define KNURL_PICTURE_PNG_H

#include "raster.h"

/* As picture_read(). */
int picture_read_png(const unsigned char *data, size_t size, picture *read, char why[256]);

/* Writes a PNG of 8 bits, grey or (channels 3) in colour, into memory that the caller frees. Null: no memory. */
unsigned char *picture_write_png(const unsigned char *pixels, uint32_t width, uint32_t height, int channels,
                                 size_t *size);

#endif
