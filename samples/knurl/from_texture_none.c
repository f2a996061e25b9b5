/* knurl tag --from-texture and --from-picture in a tool without a decoder of pictures. SPDX-License-Identifier: MIT */
#include "texture.h"

#include "tool.h"

int texture_keys(const texture_options *options, const whole_file *file, const char *path, const char *array,
                 uint32_t index, int print, int pretty, char keys[256]) {
    (void)file, (void)path, (void)array, (void)index, (void)print, (void)pretty, (void)keys;
    return tool_error(TOOL_FAILURE,
                      "tag: %s: this tool was built without pictures: install libpng-dev, libjpeg-dev and "
                      "libkissfft-dev, and build again",
                      options->from_texture ? "--from-texture" : "--from-picture");
}
