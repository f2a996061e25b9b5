/* The samples of a picture, filled in by a decoder row by row, and reduced for the search for ridges.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_RASTER_H
#define KNURL_RASTER_H

#include <stddef.h>
#include <stdint.h>

#define PICTURE_SIDE_MAX 8192 /* pixels: 2^26 in all. A decoder may hold all of them, 400 MB at most */
#define PICTURE_PART_MAX 1024 /* samples of a part, along its longer side */

/* Samples in rows from the top left, red, green and blue from 0 to 1 each. */
typedef struct picture_part {
    uint32_t width, height;
    uint32_t step; /* pixels for each sample, along both sides */
    float *rgb;
} picture_part;

/* A larger picture is in both parts: all of it, averaged over squares of pixels, and its middle as it is. Together they
 * hold fine and coarse patterns. */
typedef struct picture {
    uint32_t width, height; /* pixels */
    picture_part whole;
    picture_part middle; /* no samples if the whole is not reduced */
} picture;

/* Takes the size before any row. 0, or -1 if it is out of range or there is no memory. */
int picture_begin(picture *p, uint32_t width, uint32_t height, char why[256]);

/* Adds row y: three numbers from 0 to 65535 for each pixel. */
void picture_add_row(picture *p, uint32_t y, const uint16_t *rgb);

void picture_free(picture *p);

#endif
