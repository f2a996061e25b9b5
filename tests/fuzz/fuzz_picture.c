/* PNG and JPEG files, as knurl tag --from-texture reads them, and the search for ridges in what they hold.
 * SPDX-License-Identifier: MIT */
#include "fuzz.h"

#include "texture.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const texture from = {data, size, "picture", "fuzz", {{0.0}}, {0.04, 0.0}, 0.0, 1.0};
    texture_result found;
    picture read;
    char why[256] = "";
    if (picture_read(data, size, &read, why)) {
        EXPECT(why[0] != '\0' && !read.whole.rgb && !read.middle.rgb);
        return 0;
    }
    EXPECT(read.width > 0 && read.width <= PICTURE_SIDE_MAX && read.whole.width <= PICTURE_PART_MAX);
    EXPECT(read.height > 0 && read.height <= PICTURE_SIDE_MAX && read.whole.height <= PICTURE_PART_MAX);
    const int is_small = read.whole.width <= 256 && read.whole.height <= 256; /* so that it takes milliseconds */
    picture_free(&read);
    if (is_small && texture_search(&from, &found, why) == 0) {
        EXPECT(found.found.confidence >= 0.0 && found.found.confidence <= 1.0);
        EXPECT(!found.is_regular || (found.apart[0] > 0.0 && found.apart[0] < 0.04));
    }
    return 0;
}
