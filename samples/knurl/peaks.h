/* Peaks of a picture's spectrum that stand out everywhere in the picture. SPDX-License-Identifier: MIT */
#ifndef KNURL_PEAKS_H
#define KNURL_PEAKS_H

#include "spectrum.h"

#include <stddef.h>

#define PEAKS_MAX         16
#define PEAKS_PERIODS_MIN 4    /* across the picture: fewer are no pattern */
#define PEAKS_SHORTEST    2.25 /* samples from ridge to ridge */

typedef struct peak {
    double frequency[2]; /* cycles per sample */
    double power;
    double height;   /* over the median of the power around it */
    double evenness; /* of its amplitude over the picture, 0 to 1 */
} peak;

/* The peaks by their power, highest first. Returns their number, or -1 if there is no memory. */
int peaks_find(const field *from, const spectrum *whole, peak peaks[PEAKS_MAX]);

#endif
