/* Parses device URIs: after "driver:" a name, then "?key=value&key=value". SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_URI_H
#define KNURL_SRC_URI_H

#include "base/finite.h"

#include <knurl/base.h>

#define KNURL_URI_ROOM 512

/* One key that a driver knows, and where its value goes (KNURL_URI_ROOM bytes; "" where the URI does not name it). */
typedef struct knurl_uri_key {
    const char *key;
    char *value;
} knurl_uri_key;

/* Splits `options` into a name (KNURL_URI_ROOM bytes, may be "") and values; values are taken as they are.
 * Errors: KNURL_ERROR_ARGUMENT (an unknown key, no '=', too long), naming the device and the keys that are known. */
knurl_result knurl_uri_parse(const char *driver, const char *options, char *name, const knurl_uri_key *keys,
                             size_t key_count);

/* A key's value that is "0", "1" or "" (0). Errors: KNURL_ERROR_ARGUMENT. */
knurl_result knurl_uri_flag(const char *driver, const char *key, const char *value, uint32_t *flag);

#endif
