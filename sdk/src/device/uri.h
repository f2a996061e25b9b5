/* Parses device URIs: "driver:name?key=value&key=value". SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_URI_H
#define KNURL_SRC_URI_H

#include "base/finite.h"

#include <knurl/base.h>

#define KNURL_URI_ROOM 512

/* A key that a driver accepts, and the buffer for its value (KNURL_URI_ROOM bytes; "" if the URI lacks it). */
typedef struct knurl_uri_key {
    const char *key;
    char *value;
} knurl_uri_key;

/* Splits `options` into a name (KNURL_URI_ROOM bytes, may be "") and values, without decoding. Errors:
 * KNURL_ERROR_ARGUMENT (an unknown key, no '=', too long), with the device and its keys. */
knurl_result knurl_uri_parse(const char *driver, const char *options, char *name, const knurl_uri_key *keys,
                             size_t key_count);

/* Parses a flag: "1", or "0" or "" for 0. Errors: KNURL_ERROR_ARGUMENT. */
knurl_result knurl_uri_flag(const char *driver, const char *key, const char *value, uint32_t *flag);

#endif
