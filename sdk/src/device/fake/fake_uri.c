/* Parses the keys of a fake URI. SPDX-License-Identifier: MIT */
#include "device/fake/fake_uri.h"

#include "device/number.h"

#include <math.h>
#include <string.h>

typedef struct key {
    const char *name;
    const char *unit;
    double least, greatest;
    size_t offset;
} key;

static const key keys[] = {
#define KNURL_FAKE_KEY(name, standard, least, greatest, unit, meaning)                                                 \
    {#name, unit, least, greatest, offsetof(knurl_fake_settings, name)},
    KNURL_FAKE_KEYS(KNURL_FAKE_KEY)
#undef KNURL_FAKE_KEY
};

static const struct {
    const char *name, *about, *options;
} presets[] = {
#define KNURL_FAKE_PRESET(name, about, options) {#name, about, options},
    KNURL_FAKE_PRESETS(KNURL_FAKE_PRESET)
#undef KNURL_FAKE_PRESET
};

/* "touch, falcon, ", and so on. */
#define KNURL_FAKE_PRESET_WORD(name, about, options) #name ", "
#define PRESET_WORDS                                 KNURL_FAKE_PRESETS(KNURL_FAKE_PRESET_WORD)

const char *knurl_fake_preset_name(int32_t preset) {
    return presets[preset].about;
}

const char *knurl_fake_keys(void) {
    return "preset=touch \t" PRESET_WORDS "each of which sets all keys anew\n"
#define KNURL_FAKE_LINE(name, standard, least, greatest, unit, meaning) #name "=" #standard " " unit "\t" meaning "\n"
        KNURL_FAKE_KEYS(KNURL_FAKE_LINE)
#undef KNURL_FAKE_LINE
            ;
}

static knurl_result set_value(const key *k, const char *text, size_t length, knurl_fake_settings *settings) {
    double value = 0.0;
    const int is_number = knurl_number(text, length, &value); /* whatever the host's locale */
    const int real = k->offset != offsetof(knurl_fake_settings, delay) &&
                     k->offset != offsetof(knurl_fake_settings, seed) &&
                     k->offset != offsetof(knurl_fake_settings, exact);
    if (!is_number || !knurl_is_within(value, k->least, k->greatest) || !(real || value == floor(value))) {
        return knurl_fail(
            KNURL_ERROR_ARGUMENT, "device fake: %s: expected a %snumber from %g to %.10g%s%s, found '%.*s'", k->name,
            real ? "" : "whole ", k->least, k->greatest, k->unit[0] ? " " : "", k->unit, (int)length, text);
    }
    memcpy((char *)settings + k->offset, &value, sizeof value);
    settings->resolution_named |= k->offset == offsetof(knurl_fake_settings, resolution);
    return KNURL_OK;
}

static knurl_result set_preset(const char *text, size_t length, knurl_fake_settings *settings);

static knurl_result set_pair(const char *text, size_t length, knurl_fake_settings *settings) {
    char known[384] = "preset";
    const char *equals = memchr(text, '=', length);
    const size_t name_length = equals ? (size_t)(equals - text) : length;
    if (equals && name_length == strlen(known) && strncmp(known, text, name_length) == 0) {
        return set_preset(equals + 1, length - name_length - 1, settings);
    }
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) {
        if (equals && strlen(keys[i].name) == name_length && strncmp(keys[i].name, text, name_length) == 0) {
            return set_value(&keys[i], equals + 1, length - name_length - 1, settings);
        }
        strncat(known, ", ", sizeof known - strlen(known) - 1);
        strncat(known, keys[i].name, sizeof known - strlen(known) - 1);
    }
    return knurl_fail(KNURL_ERROR_ARGUMENT, "device fake: expected key=value with a key of %s; found '%.*s'", known,
                      (int)(length < 64 ? length : 64), text);
}

static knurl_result set_pairs(const char *text, knurl_fake_settings *settings) {
    while (*text) {
        const size_t length = strcspn(text, "&");
        const knurl_result result = set_pair(text, length, settings);
        if (result) {
            return result;
        }
        text += length + (text[length] == '&');
    }
    return KNURL_OK;
}

static knurl_result set_preset(const char *text, size_t length, knurl_fake_settings *settings) {
    static const knurl_fake_settings defaults = {
#define KNURL_FAKE_DEFAULT(name, standard, least, greatest, unit, meaning) standard,
        KNURL_FAKE_KEYS(KNURL_FAKE_DEFAULT)
#undef KNURL_FAKE_DEFAULT
            0,
        0};
    for (size_t i = 0; i < sizeof presets / sizeof *presets; i++) {
        if (strlen(presets[i].name) == length && strncmp(presets[i].name, text, length) == 0) {
            *settings = defaults;
            const knurl_result result = set_pairs(presets[i].options, settings);
            settings->preset = (int32_t)i;
            settings->resolution_named = 0; /* by the preset, not for a trace */
            return result;
        }
    }
    return knurl_fail(KNURL_ERROR_ARGUMENT, "device fake: preset: expected one of " PRESET_WORDS "found '%.*s'",
                      (int)(length < 64 ? length : 64), text);
}

knurl_result knurl_fake_parse(const char *options, knurl_fake_settings *settings) {
    knurl_fake_settings made;
    if (*options && *options != '?') {
        return knurl_fail(KNURL_ERROR_ARGUMENT,
                          "device fake: expected 'fake' or 'fake:?key=value&...', found 'fake:%s'", options);
    }
    (void)set_preset("touch", strlen("touch"), &made);
    const knurl_result result = set_pairs(options + (*options == '?'), &made);
    if (!result) {
        *settings = made;
    }
    return result;
}
