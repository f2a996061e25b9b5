/* Prepares an open Falcon for frames: after power-on it has a boot loader but no firmware, and it keeps a loaded one
 * until power-off. Source: libnifalcon (FalconCommLibUSB, FalconFirmware). SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_FALCON_FIRMWARE_H
#define KNURL_SRC_FALCON_FIRMWARE_H

#include "device/falcon/transport.h"

/* Size limits of an image, bytes; known images have 7 to 8.5 kB. */
#define KNURL_FALCON_IMAGE_LEAST 1024
#define KNURL_FALCON_IMAGE_MOST  65536

/* Returns when the device answers a frame of zero force. If it does not answer, loads the image at `path` ("" if
 * unknown). Takes 0.2 s at most without loading and about 3 s with. Errors: KNURL_ERROR_DEVICE_LOST (unplugged, or no
 * answer), KNURL_ERROR_IO and KNURL_ERROR_FORMAT (the image), KNURL_ERROR_MEMORY. */
knurl_result knurl_falcon_prepare(const knurl_falcon_transport *transport, const char *path);

#endif
