/* Pictures in memory. SPDX-License-Identifier: MIT */
#include "picture.h"

#include "picture_jpeg.h"
#include "picture_png.h"

#include <stdio.h>
#include <string.h>

static const struct {
    const char *begin;
    size_t at, length;
    const char *name;
} formats[] = {{"\x89PNG", 0, 4, "PNG"},     {"\xff\xd8\xff", 0, 3, "JPEG"},
               {"\xabKTX 2", 0, 6, "KTX2"},  {"\xabKTX 1", 0, 6, "KTX"},
               {"WEBP", 8, 4, "WebP"},       {"GIF8", 0, 4, "GIF"},
               {"DDS ", 0, 4, "DDS"},        {"II*\0", 0, 4, "TIFF"},
               {"MM\0*", 0, 4, "TIFF"},      {"\x76\x2f\x31\x01", 0, 4, "EXR"},
               {"#?", 0, 2, "Radiance HDR"}, {"ftypavif", 4, 8, "AVIF"},
               {"BM", 0, 2, "BMP"}};

static const char *format_of(const unsigned char *data, size_t size) {
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++) {
        if (size >= formats[i].at + formats[i].length &&
            memcmp(data + formats[i].at, formats[i].begin, formats[i].length) == 0) {
            return formats[i].name;
        }
    }
    return size == 0 ? "an empty file" : "another format";
}

int picture_read(const unsigned char *data, size_t size, picture *read, char why[256]) {
    memset(read, 0, sizeof *read);
    const char *format = format_of(data, size);
    int code = -1;
    if (strcmp(format, "PNG") == 0) {
        code = picture_read_png(data, size, read, why);
    } else if (strcmp(format, "JPEG") == 0) {
        code = picture_read_jpeg(data, size, read, why);
    } else {
        (void)snprintf(why, 256, "expected a PNG or JPEG picture, found %s: convert it first", format);
    }
    if (code) {
        picture_free(read);
    }
    return code;
}
