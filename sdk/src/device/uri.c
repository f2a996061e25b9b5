/* Parses device URIs. SPDX-License-Identifier: MIT */
#include "device/uri.h"

#include <stdio.h>
#include <string.h>

static knurl_result take(const char *driver, const char *what, const char *from, size_t length, char *to) {
    if (length >= KNURL_URI_ROOM) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "device '%s': %s: expected fewer than %d characters, found %lu", driver,
                          what, KNURL_URI_ROOM, (unsigned long)length);
    }
    memcpy(to, from, length);
    to[length] = '\0';
    return KNURL_OK;
}

static knurl_result refuse(const char *driver, const char *pair, size_t length, const knurl_uri_key *keys,
                           size_t key_count) {
    char known[256] = "";
    for (size_t i = 0; i < key_count; i++) {
        const size_t used = strlen(known);
        (void)snprintf(known + used, sizeof known - used, "%s%s=", i > 0 ? " or " : "", keys[i].key);
    }
    return knurl_fail(KNURL_ERROR_ARGUMENT, "device '%s': expected %s, found '%.*s'", driver,
                      key_count > 0 ? known : "a name and no keys", (int)(length < 200 ? length : 200), pair);
}

knurl_result knurl_uri_parse(const char *driver, const char *options, char *name, const knurl_uri_key *keys,
                             size_t key_count) {
    const char *at = options + strcspn(options, "?");
    knurl_result result = take(driver, "name", options, (size_t)(at - options), name);
    for (size_t i = 0; i < key_count; i++) {
        keys[i].value[0] = '\0';
    }
    while (!result && *at && at[1]) { /* at '?' or '&' */
        const char *pair = at + 1;
        const size_t length = strcspn(pair, "&");
        const size_t key_length = strcspn(pair, "=&");
        size_t i = 0;
        while (i < key_count && (strlen(keys[i].key) != key_length || strncmp(keys[i].key, pair, key_length) != 0)) {
            i++;
        }
        if (i == key_count || pair[key_length] != '=') {
            return refuse(driver, pair, length, keys, key_count);
        }
        result = take(driver, keys[i].key, pair + key_length + 1, length - key_length - 1, keys[i].value);
        at = pair + length;
    }
    return result;
}

knurl_result knurl_uri_flag(const char *driver, const char *key, const char *value, uint32_t *flag) {
    if (value[0] && strcmp(value, "0") != 0 && strcmp(value, "1") != 0) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "device '%s': %s: expected 0 or 1, found '%.100s'", driver, key, value);
    }
    *flag = value[0] == '1';
    return KNURL_OK;
}
