/* JPEG by libjpeg-turbo: grey and colour. Files that libjpeg would repair are refused. SPDX-License-Identifier: MIT */
#include "picture_jpeg.h"

#include <setjmp.h>
#include <stdio.h> /* jpeglib.h expects it */
#include <stdlib.h>
#include <string.h>

#include <jpeglib.h>

#define SCANS_MAX  64                /* a progressive file of a few kB may ask for thousands over a large picture */
#define MEMORY_MAX ((long)512 << 20) /* of a progressive picture's coefficients */

/* All that is freed after an error, which jumps. */
typedef struct jpeg_job {
    struct jpeg_error_mgr errors;
    struct jpeg_progress_mgr progress;
    struct jpeg_decompress_struct jpeg;
    unsigned char *row;
    uint16_t *wide;
    char *why;
    jmp_buf failed;
} jpeg_job;

static void fail(j_common_ptr jpeg) {
    jpeg_job *job = jpeg->client_data;
    char text[JMSG_LENGTH_MAX];
    jpeg->err->format_message(jpeg, text);
    (void)snprintf(job->why, 256, "damaged JPEG: %.200s", text);
    longjmp(job->failed, 1);
}

/* A warning (level -1) is about damage, such as a file that ends too early. */
static void tell(j_common_ptr jpeg, int level) {
    if (level < 0) {
        fail(jpeg);
    }
}

static void watch(j_common_ptr jpeg) {
    jpeg_job *job = jpeg->client_data;
    if (job->jpeg.input_scan_number > SCANS_MAX) {
        (void)snprintf(job->why, 256, "damaged JPEG: expected at most %d scans", SCANS_MAX);
        longjmp(job->failed, 1);
    }
}

static int read_rows(jpeg_job *job, picture *read) {
    const size_t numbers = 3 * (size_t)read->width;
    job->row = malloc(numbers);
    job->wide = malloc(numbers * sizeof *job->wide);
    if (!job->row || !job->wide) {
        (void)snprintf(job->why, 256, "out of memory");
        return -1;
    }
    (void)jpeg_start_decompress(&job->jpeg);
    while (job->jpeg.output_scanline < read->height) {
        const uint32_t y = job->jpeg.output_scanline;
        (void)jpeg_read_scanlines(&job->jpeg, &job->row, 1);
        for (size_t i = 0; i < numbers; i++) {
            job->wide[i] = (uint16_t)(257 * job->row[i]);
        }
        picture_add_row(read, y, job->wide);
    }
    (void)jpeg_finish_decompress(&job->jpeg);
    return 0;
}

static int read_jpeg(jpeg_job *job, const unsigned char *data, size_t size, picture *read) {
    struct jpeg_decompress_struct *jpeg = &job->jpeg;
    if (setjmp(job->failed)) {
        return -1;
    }
    jpeg->err = jpeg_std_error(&job->errors);
    job->errors.error_exit = fail;
    job->errors.emit_message = tell;
    jpeg->client_data = job;
    jpeg_create_decompress(jpeg);
    job->progress.progress_monitor = watch;
    jpeg->progress = &job->progress;
    jpeg->mem->max_memory_to_use = MEMORY_MAX;
    jpeg_mem_src(jpeg, data, (unsigned long)size);
    (void)jpeg_read_header(jpeg, TRUE);
    if (jpeg->num_components != 1 && jpeg->num_components != 3) {
        (void)snprintf(job->why, 256, "expected a grey or RGB JPEG, found one of %d colours: convert it first",
                       jpeg->num_components);
        return -1;
    }
    jpeg->out_color_space = JCS_RGB;
    return picture_begin(read, jpeg->image_width, jpeg->image_height, job->why) || read_rows(job, read) ? -1 : 0;
}

int picture_read_jpeg(const unsigned char *data, size_t size, picture *read, char why[256]) {
    jpeg_job *job = calloc(1, sizeof *job);
    if (!job) {
        (void)snprintf(why, 256, "out of memory");
        return -1;
    }
    job->why = why;
    const int code = read_jpeg(job, data, size, read);
    jpeg_destroy_decompress(&job->jpeg);
    free(job->row);
    free(job->wide);
    free(job);
    return code;
}
