/* PNG by libpng: any depth, palettes, interlaced; checksums are checked. SPDX-License-Identifier: MIT */
#include "picture_png.h"

#include <png.h>

#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CHUNK_BYTES_MAX (1 << 20) /* of a text or a profile, which are not read */

/* All that is freed after an error, which jumps. */
typedef struct png_job {
    const unsigned char *data;
    size_t left;
    png_structp png;
    png_infop info;
    uint16_t *rows; /* one, or all if the picture is interlaced */
    char *why;
    jmp_buf failed;
} png_job;

static void fail(png_structp png, png_const_charp text) {
    png_job *job = png_get_error_ptr(png);
    (void)snprintf(job->why, 256, "damaged PNG: %s", text);
    longjmp(job->failed, 1);
}

static void ignore(png_structp png, png_const_charp text) {
    (void)png;
    (void)text;
}

static void take_bytes(png_structp png, png_bytep to, size_t count) {
    png_job *job = png_get_io_ptr(png);
    if (count > job->left) {
        png_error(png, "it ends too early");
    }
    memcpy(to, job->data, count);
    job->data += count;
    job->left -= count;
}

/* Whatever it holds: red, green and blue of 16 bits, without alpha, as stored (no gamma). */
static void ask_for_rgb(png_structp png) {
    const uint16_t one = 1;
    png_set_expand_16(png);
    png_set_gray_to_rgb(png);
    png_set_strip_alpha(png);
    if (*(const unsigned char *)&one) {
        png_set_swap(png);
    }
}

static void read_rows(png_job *job, picture *read) {
    png_structp png = job->png;
    const int passes = png_set_interlace_handling(png);
    png_read_update_info(png, job->info);
    const size_t row = 3 * (size_t)read->width;
    if (png_get_rowbytes(png, job->info) != row * sizeof *job->rows) {
        png_error(png, "unknown kind of pixels");
    }
    job->rows = calloc(passes > 1 ? read->height : 1, row * sizeof *job->rows);
    if (!job->rows) {
        png_error(png, "out of memory");
    }
    for (int pass = 0; pass < passes; pass++) {
        for (uint32_t y = 0; y < read->height; y++) {
            uint16_t *at = job->rows + (passes > 1 ? y * row : 0);
            png_read_row(png, (png_bytep)at, NULL);
            if (pass == passes - 1) {
                picture_add_row(read, y, at);
            }
        }
    }
    png_read_end(png, NULL);
}

static int read_png(png_job *job, picture *read) {
    if (setjmp(job->failed)) {
        return -1;
    }
    job->png = png_create_read_struct(PNG_LIBPNG_VER_STRING, job, fail, ignore);
    job->info = job->png ? png_create_info_struct(job->png) : NULL;
    if (!job->info) {
        (void)snprintf(job->why, 256, "out of memory");
        return -1;
    }
    png_set_read_fn(job->png, job, take_bytes);
    png_set_user_limits(job->png, 0x7fffffff, 0x7fffffff); /* picture_begin() has our own */
    png_set_chunk_malloc_max(job->png, CHUNK_BYTES_MAX);
    png_read_info(job->png, job->info);
    if (picture_begin(read, png_get_image_width(job->png, job->info), png_get_image_height(job->png, job->info),
                      job->why)) {
        return -1;
    }
    ask_for_rgb(job->png);
    read_rows(job, read);
    return 0;
}

int picture_read_png(const unsigned char *data, size_t size, picture *read, char why[256]) {
    png_job job;
    memset(&job, 0, sizeof job);
    job.data = data;
    job.left = size;
    job.why = why;
    const int code = read_png(&job, read);
    png_destroy_read_struct(&job.png, &job.info, NULL);
    free(job.rows);
    return code;
}

unsigned char *picture_write_png(const unsigned char *pixels, uint32_t width, uint32_t height, int channels,
                                 size_t *size) {
    png_image image;
    png_alloc_size_t bytes = 0;
    memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    image.width = width;
    image.height = height;
    image.format = channels == 3 ? PNG_FORMAT_RGB : PNG_FORMAT_GRAY;
    if (!png_image_write_get_memory_size(image, bytes, 0, pixels, 0, NULL)) {
        return NULL;
    }
    unsigned char *made = malloc(bytes);
    if (made && !png_image_write_to_memory(&image, made, &bytes, 0, pixels, 0, NULL)) {
        free(made);
        return NULL;
    }
    *size = bytes;
    return made;
}
