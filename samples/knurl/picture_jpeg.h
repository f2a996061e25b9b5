/* JPEG, by libjpeg-turbo. SPDX-License-Identifier: MIT */
#ifndef KNURL_PICTURE_JPEG_H
#define KNURL_PICTURE_JPEG_H

#include "raster.h"

/* As picture_read(). */
int picture_read_jpeg(const unsigned char *data, size_t size, picture *read, char why[256]);

#endif
