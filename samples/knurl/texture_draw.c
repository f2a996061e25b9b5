/* Draws the result of a search: the picture with ridges over its right half, and its spectrum.
 * SPDX-License-Identifier: MIT */
#include "texture.h"

#include "tool.h"

#include "picture.h"
#include "picture_png.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SIDE   360 /* of a panel, in the SVG's units */
#define RIDGES 16  /* shown of the finer axis */
#define PIXELS 256 /* of the spectrum's image */
#define MARGIN 12

static const char *const colours[RIDGES_AXES] = {"#ff5a36", "#2f9bff"};

static void put_base64(FILE *to, const unsigned char *data, size_t size) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        const unsigned left = size - i > 2 ? 3U : (unsigned)(size - i);
        const uint32_t word = (uint32_t)data[i] << 16 | (left > 1 ? (uint32_t)data[i + 1] << 8 : 0U) |
                              (left > 2 ? (uint32_t)data[i + 2] : 0U);
        for (unsigned k = 0; k < 4; k++) {
            (void)fputc(k > left ? '=' : digits[word >> (18 - 6 * k) & 63], to);
        }
    }
}

/* An image of a panel's size. 0 if there is no memory. */
static int put_image(FILE *to, const unsigned char *pixels, uint32_t width, uint32_t height, int channels) {
    size_t size = 0;
    unsigned char *png = picture_write_png(pixels, width, height, channels, &size);
    if (!png) {
        return 0;
    }
    (void)fprintf(to, "<image width=\"%d\" height=\"%d\" preserveAspectRatio=\"none\" href=\"data:image/png;base64,",
                  SIDE, SIDE);
    put_base64(to, png, size);
    (void)fputs("\"/>\n", to);
    free(png);
    return 1;
}

/* A square of the part that shows some ridges: its side in samples. */
static uint32_t crop_side(const texture_result *r, const picture_part *part) {
    double finest = 0.0;
    for (int i = 0; i < r->found.count; i++) {
        finest = fmax(finest, hypot(r->found.frequency[i][0], r->found.frequency[i][1]));
    }
    const uint32_t least = part->width < part->height ? part->width : part->height;
    const double side = finest > 0.0 ? RIDGES / finest : least;
    return (uint32_t)fmin(least, fmax(24.0, side));
}

static int put_crop(FILE *to, const picture_part *part, uint32_t left, uint32_t top, uint32_t side) {
    unsigned char *pixels = malloc(3 * (size_t)side * side);
    for (uint32_t y = 0; y < side && pixels; y++) {
        for (uint32_t i = 0; i < 3 * side; i++) {
            const float c = part->rgb[3 * ((size_t)(top + y) * part->width + left) + i];
            pixels[3 * (size_t)y * side + i] = (unsigned char)(255.0F * fminf(fmaxf(c, 0.0F), 1.0F) + 0.5F);
        }
    }
    const int ok = pixels && put_image(to, pixels, side, side, 3);
    free(pixels);
    return ok;
}

/* Lines along the crests of one axis, in the right half of the square. */
static void put_ridges(FILE *to, const texture_result *r, const field *f, int axis, const uint32_t corner[2],
                       uint32_t side) {
    const double *k = r->found.frequency[axis];
    const double sample[2] = {1.0, 1.0};
    profile p;
    ridges_profile(f, k, sample, 0, &p);
    const double scale = (double)SIDE / side, length = hypot(k[0], k[1]);
    const double begin = k[0] * corner[0] + k[1] * corner[1];
    const double ends[4] = {0.0, k[0] * side, k[1] * side, (k[0] + k[1]) * side};
    double low = 0.0, high = 0.0;
    for (int i = 0; i < 4; i++) {
        low = fmin(low, ends[i]);
        high = fmax(high, ends[i]);
    }
    (void)fprintf(to, "<g clip-path=\"url(#half)\" stroke=\"%s\" stroke-width=\"1.5\">\n", colours[axis]);
    const int last = (int)floor(begin + high - p.crest);
    for (int n = (int)ceil(begin + low - p.crest); n <= last; n++) {
        const double off = (n + p.crest - begin) / length; /* samples along the frequency from the square's corner */
        const double x = off * k[0] / length * scale, y = off * k[1] / length * scale;
        const double along[2] = {-k[1] / length * 2.0 * SIDE, k[0] / length * 2.0 * SIDE};
        (void)fprintf(to, "<path d=\"M%.1f %.1fL%.1f %.1f\"/>\n", x - along[0], y - along[1], x + along[0],
                      y + along[1]);
    }
    (void)fputs("</g>\n", to);
}

/* The highest frequency of the panel: some harmonics of the finer axis. */
static double range_of(const texture_result *r) {
    double range = 0.0;
    for (int i = 0; i < r->found.count; i++) {
        range = fmax(range, 3.5 * hypot(r->found.frequency[i][0], r->found.frequency[i][1]));
    }
    return range > 0.0 && range < 0.5 ? range : 0.5;
}

/* The spectrum as an image: 60 dB of power, the mean of each pixel's places. */
static int put_spectrum(FILE *to, const spectrum *s, double range) {
    unsigned char *pixels = malloc((size_t)PIXELS * PIXELS);
    double *levels = calloc((size_t)PIXELS * PIXELS, sizeof *levels);
    double highest = 1e-30;
    for (int y = 0; y < PIXELS && pixels && levels; y++) {
        for (int x = 0; x < PIXELS; x++) {
            const double fx = range * (2.0 * (x + 0.5) / PIXELS - 1.0), fy = range * (2.0 * (y + 0.5) / PIXELS - 1.0);
            const double half[2] = {range / PIXELS, range / PIXELS};
            double most = 0.0;
            for (int j = (int)floor((fy - half[1]) * s->height); j <= (int)ceil((fy + half[1]) * s->height); j++) {
                for (int i = (int)floor((fx - half[0]) * s->width); i <= (int)ceil((fx + half[0]) * s->width); i++) {
                    most = fmax(most, spectrum_at(s, i, j));
                }
            }
            levels[y * PIXELS + x] = most;
            highest = fmax(highest, most);
        }
    }
    for (int i = 0; i < PIXELS * PIXELS && pixels && levels; i++) {
        const double db = 10.0 * log10(levels[i] / highest + 1e-30);
        pixels[i] = (unsigned char)(255.0 * fmax(0.0, 1.0 + db / 60.0));
    }
    const int ok = pixels && levels && put_image(to, pixels, PIXELS, PIXELS, 1);
    free(pixels);
    free(levels);
    return ok;
}

static void put_peaks(FILE *to, const texture_result *r, double range) {
    for (int axis = 0; axis < r->found.count; axis++) {
        for (int sign = -1; sign <= 1; sign += 2) {
            const double x = SIDE * (0.5 + 0.5 * sign * r->found.frequency[axis][0] / range);
            const double y = SIDE * (0.5 + 0.5 * sign * r->found.frequency[axis][1] / range);
            (void)fprintf(to,
                          "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"9\" fill=\"none\" stroke=\"%s\" stroke-width=\"2\"/>\n",
                          x, y, colours[axis]);
        }
    }
}

static void put_words(FILE *to, const texture_result *r) {
    if (!r->is_regular) {
        (void)fprintf(to, "<text x=\"%d\" y=\"%d\">no regular pattern (confidence %.2f)</text>\n", MARGIN,
                      SIDE + MARGIN + 22, r->found.confidence);
        return;
    }
    for (int i = 0; i < r->found.count; i++) {
        (void)fprintf(
            to, "<text x=\"%d\" y=\"%d\"><tspan style=\"fill:%s\">&#9632;</tspan> %.3g mm apart, across %.1f&#176;",
            MARGIN, SIDE + MARGIN + 22 + 20 * i, colours[i], 1e3 * r->apart[i],
            180.0 / 3.14159265358979323846 * r->direction[i]);
        if (!isnan(r->amplitude[i])) {
            (void)fprintf(to, ", amplitude %.2g mm", 1e3 * r->amplitude[i]);
        }
        (void)fprintf(to, "; %.0f %% of the variation", 100.0 * r->found.share[i]);
        (void)fprintf(to, i == 0 ? "; confidence %.2f</text>\n" : "</text>\n", r->found.confidence);
    }
}

static int put_panels(FILE *to, const texture_result *r, const picture_part *part, const field *f) {
    spectrum s;
    const double range = range_of(r);
    const uint32_t side = crop_side(r, part);
    const uint32_t corner[2] = {(part->width - side) / 2, (part->height - side) / 2};
    (void)fprintf(
        to,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" width=\"%d\" height=\"%d\">\n"
        "<style>text{font:14px sans-serif;fill:#1f2328}image{image-rendering:pixelated}"
        "@media(prefers-color-scheme:dark){text{fill:#e6edf3}}</style>\n"
        "<clipPath id=\"half\"><path d=\"M%d 0h%dv%dh-%dz\"/></clipPath>\n<g transform=\"translate(%d %d)\">\n",
        2 * SIDE + 3 * MARGIN, SIDE + MARGIN + 56, 2 * SIDE + 3 * MARGIN, SIDE + MARGIN + 56, SIDE / 2, SIDE / 2, SIDE,
        SIDE / 2, MARGIN, MARGIN);
    int ok = put_crop(to, part, corner[0], corner[1], side);
    for (int axis = 0; axis < r->found.count && ok; axis++) {
        put_ridges(to, r, f, axis, corner, side);
    }
    (void)fprintf(to, "</g>\n<g transform=\"translate(%d %d)\">\n", SIDE + 2 * MARGIN, MARGIN);
    ok = ok && spectrum_make(f, &s);
    if (ok) {
        ok = put_spectrum(to, &s, range);
        spectrum_free(&s);
    }
    put_peaks(to, r, range);
    (void)fputs("</g>\n", to);
    put_words(to, r);
    (void)fputs("</svg>\n", to);
    return ok;
}

int texture_draw(const texture_result *result, const char *path) {
    out_file target;
    picture read;
    field f;
    char why[256];
    memset(&target, 0, sizeof target);
    if (out_open(&target, path)) {
        return TOOL_FAILURE;
    }
    int ok = picture_read(result->from.data, result->from.size, &read, why) == 0;
    const picture_part *part = ok && result->in_middle ? &read.middle : &read.whole;
    if (ok && texture_field(result, part, &f)) {
        ok = put_panels(target.stream, result, part, &f);
        free((void *)f.right);
    } else {
        ok = 0;
    }
    if (ok == 0) {
        out_discard(&target);
        picture_free(&read);
        return tool_error(TOOL_FAILURE, "tag: --drawing: %s: out of memory", path);
    }
    picture_free(&read);
    return out_keep(&target) ? TOOL_FAILURE : TOOL_OK;
}
