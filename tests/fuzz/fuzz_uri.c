/* Devices' URIs, numbers, and lines for terminals. SPDX-License-Identifier: MIT */
#include "fuzz.h"

#include "base/number.h"
#include "device/driver.h"

#include <knurl/device.h>

static void try_number(const char *text, size_t length) {
    double value = 7.5;
    char *end = NULL;
    if (!knurl_number(text, length, &value)) {
        EXPECT(value == 7.5);
        return;
    }
    const double expected = strtod(text, &end); /* in the C locale, and of hexadecimal numbers too */
    EXPECT(end == text + length && value == expected);
}

static void try_line(const char *text) {
    char line[64];
    const size_t length = knurl_text_line(line, sizeof line, text);
    EXPECT(length < sizeof line && strlen(line) == length);
    for (size_t i = 0; i < length; i++) {
        EXPECT((unsigned char)line[i] >= 0x20 && line[i] != 0x7f);
    }
    char again[64];
    EXPECT(knurl_text_line(again, sizeof again, line) == length && strcmp(again, line) == 0);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char name[KNURL_URI_ROOM];
    char values[2][KNURL_URI_ROOM];
    const knurl_uri_key keys[] = {{"library", values[0]}, {"serial", values[1]}};
    char *text = malloc(size + 6);
    EXPECT(text != NULL);
    memcpy(text, "fake:", 5);
    memcpy(text + 5, data, size);
    text[5 + size] = '\0';
    const char *given = text + 5;
    const size_t length = strlen(given);
    try_number(given, length);
    try_line(given);
    if (knurl_uri_parse("fuzz", given, name, keys, 2) == KNURL_OK) {
        EXPECT(strlen(name) < sizeof name && strlen(values[0]) < sizeof values[0]);
    }
    knurl_device *device = NULL;
    if (knurl_device_open(text, &device) == KNURL_OK) {
        knurl_device_info info;
        knurl_device_info_init(&info, sizeof info);
        EXPECT(knurl_device_get_info(device, &info) == KNURL_OK);
        EXPECT(isfinite(info.max_force) && info.max_force > 0.0);
        knurl_device_close(device);
    }
    free(text);
    return 0;
}
