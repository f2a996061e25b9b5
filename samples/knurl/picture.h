/* Pictures in memory: PNG and JPEG. SPDX-License-Identifier: MIT */
#ifndef KNURL_PICTURE_H
#define KNURL_PICTURE_H

#include "raster.h"

/* Reads a picture. 0; or -1, and why holds the reason: a sentence without the picture's name. */
int picture_read(const unsigned char *data, size_t size, picture *read, char why[256]);

#endif
