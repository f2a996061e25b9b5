/* Reads a picture, finds its ridges, and describes them in a tag's words. SPDX-License-Identifier: MIT */
#include "texture.h"

#include "options.h"
#include "picture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define RIGHT_ANGLE 0.0872             /* cosine of 85 degrees: a grid's axes may be so far from right angles */
#define NEARLY      (0.5 * PI / 180.0) /* so that upright ridges are not at -90 degrees now and at 90 then */
#define PI          3.14159265358979323846
#define STEEPEST    1e6 /* a file may ask for more than a float holds */

/* --- the meaning of a picture's colours --- */

/* Colours of a normal map point to the front, on a sphere, and in no direction more than in others. */
static int looks_like_normals(const picture_part *part) {
    const size_t count = (size_t)part->width * part->height;
    double sum[3] = {0.0, 0.0, 0.0}, off = 0.0;
    for (size_t i = 0; i < count; i++) {
        double square = 0.0;
        for (size_t c = 0; c < 3; c++) {
            const double n = 2.0 * (double)part->rgb[3 * i + c] - 1.0;
            sum[c] += n;
            square += n * n;
        }
        off += fabs(sqrt(square) - 1.0);
    }
    const double n = (double)count;
    return off < 0.1 * n && sum[2] > 0.5 * n && fabs(sum[0]) < 0.2 * n && fabs(sum[1]) < 0.2 * n;
}

static int is_normal(const texture_result *r) {
    return strcmp(r->use, "normal") == 0;
}

int texture_field(const texture_result *r, const picture_part *part, field *made) {
    const size_t count = (size_t)part->width * part->height;
    float *samples = malloc(2 * count * sizeof *samples);
    float *down = samples ? samples + count : NULL;
    const float steepness = (float)fmax(-STEEPEST, fmin(STEEPEST, r->from.steepness));
    for (size_t i = 0; i < count && samples; i++) {
        const float *c = &part->rgb[3 * i];
        if (is_normal(r)) { /* x to the right and y up, both of the height's fall */
            const float z = fmaxf(2.0F * c[2] - 1.0F, 0.05F);
            samples[i] = -(2.0F * c[0] - 1.0F) / z * steepness;
            down[i] = (2.0F * c[1] - 1.0F) / z * steepness;
        } else if (strcmp(r->use, "occlusion") == 0) {
            samples[i] = c[0];
        } else {
            samples[i] = 0.2126F * c[0] + 0.7152F * c[1] + 0.0722F * c[2];
        }
    }
    made->width = part->width;
    made->height = part->height;
    made->stride = part->width;
    made->right = samples;
    made->down = is_normal(r) ? down : NULL;
    return samples != NULL;
}

/* --- from samples to metres --- */

static void measure_axis(texture_result *r, const picture_part *part, const field *f, int axis) {
    const double *k = r->found.frequency[axis];
    const double *across = r->in_picture[axis];
    r->in_picture[axis][0] = k[0] * r->width / part->step;
    r->in_picture[axis][1] = k[1] * r->height / part->step;
    const double x = r->from.map[0][0] * across[0] + r->from.map[0][1] * across[1];
    const double y = r->from.map[1][0] * across[0] + r->from.map[1][1] * across[1];
    double direction = atan2(y, x);
    direction += direction > 0.5 * PI + NEARLY ? -PI : direction <= NEARLY - 0.5 * PI ? PI : 0.0;
    r->apart[axis] = 1.0 / hypot(x, y);
    r->direction[axis] = direction;
    const double sample[2] = {r->from.metres[0] * part->step / r->width, r->from.metres[1] * part->step / r->height};
    profile made;
    ridges_profile(f, k, sample, part->step > 1, &made);
    r->amplitude[axis] = is_normal(r)                    ? made.amplitude
                         : strcmp(r->use, "height") == 0 ? made.amplitude * r->from.depth
                                                         : NAN;
}

/* Searches a part, and takes its ridges if they are surer than those so far. 0 if there is no memory. */
static int search_part(texture_result *r, const picture_part *part) {
    field f;
    ridges found;
    if (!part->rgb || part->width < RIDGES_SIZE_MIN || part->height < RIDGES_SIZE_MIN) {
        return 1;
    }
    if (!texture_field(r, part, &f)) {
        return 0;
    }
    const int ok = ridges_find(&f, &found);
    if (ok && found.count > 0 && found.confidence > r->found.confidence) {
        r->found = found;
        r->in_middle = part->step < r->step;
        for (int axis = 0; axis < found.count; axis++) {
            measure_axis(r, part, &f, axis);
        }
    }
    free((void *)f.right);
    return ok;
}

/* --- the tag --- */

/* Numbers without the noise of the last digits. */
static double rounded(double value, double digits) {
    const double unit = pow(10.0, floor(log10(fabs(value) + 1e-300)) + 1.0 - digits);
    return round(value / unit) * unit;
}

/* A grating has one axis, or two at right angles; x is the one that is nearer to the surface's x. */
static void write_tag(texture_result *r) {
    const double *d = r->direction;
    const int is_grid = r->found.count == 2 && fabs(cos(d[0] - d[1])) < RIGHT_ANGLE;
    const int first = is_grid && fabs(d[1]) < fabs(d[0]);
    const double turn = fabs(d[first]) < NEARLY ? 0.0 : round(d[first] * 1e4) / 1e4;
    double amplitude = r->amplitude[first];
    if (is_grid && !isnan(amplitude)) {
        amplitude = fmax(amplitude, r->amplitude[!first]);
    }
    int length =
        snprintf(r->tag, sizeof r->tag, "{\"spatial_frequency\":[%.10g,%.10g],\"orientation\":%.10g",
                 rounded(1.0 / r->apart[first], 5.0), is_grid ? rounded(1.0 / r->apart[!first], 5.0) : 0.0, turn);
    if (!isnan(amplitude)) {
        length +=
            snprintf(r->tag + length, sizeof r->tag - (size_t)length, ",\"amplitude\":%.10g", rounded(amplitude, 3.0));
    }
    (void)snprintf(r->tag + length, sizeof r->tag - (size_t)length, ",\"axis\":null,\"coordinates\":null}");
    r->note = r->found.count == 2 && !is_grid
                  ? "the pattern's second axis is left out: a grid's axes are at right angles, these are not"
                  : NULL;
}

/* An image file's: x to the right, y up. */
static void place_upright(texture *t, uint32_t width, uint32_t height) {
    t->metres[1] = t->metres[1] > 0.0 ? t->metres[1] : t->metres[0] * height / width;
    t->map[0][0] = 1.0 / t->metres[0];
    t->map[1][1] = -1.0 / t->metres[1];
}

int texture_search(const texture *from, texture_result *result, char why[256]) {
    picture read;
    memset(result, 0, sizeof *result);
    result->from = *from;
    result->use = from->use;
    if (picture_read(from->data, from->size, &read, why)) {
        return TOOL_FAILURE;
    }
    result->width = read.width;
    result->height = read.height;
    result->step = read.whole.step;
    if (from->map[0][0] == 0.0 && from->map[0][1] == 0.0) {
        place_upright(&result->from, read.width, read.height);
    }
    if (read.width < RIDGES_SIZE_MIN || read.height < RIDGES_SIZE_MIN) {
        (void)snprintf(why, 256, "expected at least %d x %d pixels, found %u x %u", RIDGES_SIZE_MIN, RIDGES_SIZE_MIN,
                       read.width, read.height);
        picture_free(&read);
        return TOOL_FAILURE;
    }
    if (strcmp(from->use, "picture") == 0 && looks_like_normals(&read.whole)) {
        result->use = "normal";
    }
    if (!search_part(result, &read.whole) || !search_part(result, &read.middle)) {
        (void)snprintf(why, 256, "out of memory");
        picture_free(&read);
        return TOOL_FAILURE;
    }
    picture_free(&read);
    result->is_regular = result->found.confidence >= RIDGES_CONFIDENT;
    if (result->is_regular) {
        write_tag(result);
    }
    return TOOL_OK;
}
