/* The samples of a picture. SPDX-License-Identifier: MIT */
#include "raster.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void picture_free(picture *p) {
    free(p->whole.rgb);
    free(p->middle.rgb);
    memset(p, 0, sizeof *p);
}

static int make_part(picture_part *part, uint32_t width, uint32_t height, uint32_t step) {
    part->width = width;
    part->height = height;
    part->step = step;
    part->rgb = calloc((size_t)width * height, 3 * sizeof *part->rgb);
    return part->rgb != NULL;
}

static uint32_t at_most(uint32_t size) {
    return size < PICTURE_PART_MAX ? size : PICTURE_PART_MAX;
}

int picture_begin(picture *p, uint32_t width, uint32_t height, char why[256]) {
    if (width == 0 || height == 0 || width > PICTURE_SIDE_MAX || height > PICTURE_SIDE_MAX) {
        (void)snprintf(why, 256, "expected at most %d x %d pixels, found %u x %u: make it smaller first",
                       PICTURE_SIDE_MAX, PICTURE_SIDE_MAX, width, height);
        return -1;
    }
    const uint32_t longer = width > height ? width : height;
    const uint32_t step = (longer + PICTURE_PART_MAX - 1) / PICTURE_PART_MAX;
    p->width = width;
    p->height = height;
    if (!make_part(&p->whole, width < step ? 1 : width / step, height < step ? 1 : height / step, step) ||
        (step > 1 && !make_part(&p->middle, at_most(width), at_most(height), 1))) {
        (void)snprintf(why, 256, "out of memory");
        return -1;
    }
    return 0;
}

void picture_add_row(picture *p, uint32_t y, const uint16_t *rgb) {
    const picture_part *w = &p->whole, *m = &p->middle;
    if (y / w->step < w->height) {
        float *to = &w->rgb[(size_t)(y / w->step) * w->width * 3];
        const float share = 1.0F / (65535.0F * (float)w->step * (float)w->step);
        const uint32_t used = w->width * w->step < p->width ? w->width * w->step : p->width;
        for (uint32_t x = 0; x < used; x++) {
            for (uint32_t c = 0; c < 3; c++) {
                to[x / w->step * 3 + c] += share * (float)rgb[x * 3 + c];
            }
        }
    }
    const uint32_t left = (p->width - m->width) / 2, top = (p->height - m->height) / 2;
    if (m->rgb && y >= top && y - top < m->height) {
        float *to = &m->rgb[(size_t)(y - top) * m->width * 3];
        for (uint32_t i = 0; i < 3 * m->width; i++) {
            to[i] = (float)rgb[left * 3 + i] / 65535.0F;
        }
    }
}
