/* The power spectrum of a field in the plane. SPDX-License-Identifier: MIT */
#ifndef KNURL_SPECTRUM_H
#define KNURL_SPECTRUM_H

#include <stdint.h>

/* Samples in rows from the top left: a height or a brightness, or, with `down`, a slope to the right and one down. */
typedef struct field {
    uint32_t width, height;
    const float *right;
    const float *down; /* or null */
    uint32_t stride;   /* of a row, samples */
} field;

/* Power at the frequencies (x cycles in `width` samples, y in `height`), both sizes powers of two; negative ones behind
 * the others, as a Fourier transform leaves them. */
typedef struct spectrum {
    int width, height;
    float *power;
    double variance; /* of the field, in the window, without the trend */
    double bin[2];   /* cycles per sample: the resolution, 1 / size of the field */
} spectrum;

/* Power of the field without its mean and quadratic trend, in a Hann window. 0 if there is no memory. */
int spectrum_make(const field *from, spectrum *made);
void spectrum_free(spectrum *s);

/* Power at a place of the table; any whole numbers. */
double spectrum_at(const spectrum *s, int x, int y);

/* Median of the power around a place, without the peak itself. */
double spectrum_floor(const spectrum *s, int x, int y);

/* The highest place within `reach` bins of a frequency (cycles per sample). */
void spectrum_climb(const spectrum *s, const double frequency[2], double reach, int place[2]);

/* A peak's frequency between the places of the table, by a parabola through the logarithms of its neighbours. */
void spectrum_refine(const spectrum *s, const int place[2], double frequency[2]);

#endif
