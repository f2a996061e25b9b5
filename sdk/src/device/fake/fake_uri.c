/* Parses the keys of a fake URI. SPDX-License-Identifier: MIT */
#include "device/fake/fake_uri.h"

#include "base/number.h"

#include <string.h>

static const knurl_field keys[] = {
#define KNURL_FAKE_KEY(name, standard, range, kind, meaning)                                                           \
    {#name, offsetof(knurl_fake_settings, name), {range, kind}},
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

/* "touch, falcon, " etc. */
#define KNURL_FAKE_PRESET_WORD(name, about, options) #name ", "
#define PRESET_WORDS                                 KNURL_FAKE_PRESETS(KNURL_FAKE_PRESET_WORD)

const char *knurl_fake_preset_name(int32_t preset) {
    return presets[preset].about;
}

const char *knurl_fake_keys(void) {
    return "preset=touch \t" PRESET_WORDS "each of which sets all keys anew\n"
#define KNURL_FAKE_UNIT(least, greatest, unit) unit
#define KNURL_FAKE_LINE(name, standard, range, kind, meaning)                                                          \
    #name "=" #standard " " KNURL_FAKE_UNIT(range) "\t" meaning "\n"
        KNURL_FAKE_KEYS(KNURL_FAKE_LINE)
#undef KNURL_FAKE_LINE
#undef KNURL_FAKE_UNIT
            ;
}

static knurl_result set_value(const knurl_field *key, const char *text, size_t length, knurl_fake_settings *settings) {
    double value = 0.0;
    char expected[KNURL_RANGE_ROOM];
    if (!knurl_number(text, length, &value) || !knurl_range_holds(&key->range, value)) { /* in any locale */
        return knurl_fail(KNURL_ERROR_ARGUMENT, "device fake: %s: expected %s, found '%.*s'", key->name,
                          knurl_range_text(&key->range, expected), (int)length, text);
    }
    memcpy((char *)settings + key->offset, &value, sizeof value);
    settings->resolution_named |= key->offset == offsetof(knurl_fake_settings, resolution);
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
#define KNURL_FAKE_DEFAULT(name, standard, range, kind, meaning) standard,
        KNURL_FAKE_KEYS(KNURL_FAKE_DEFAULT)
#undef KNURL_FAKE_DEFAULT
            0,
        0};
    for (size_t i = 0; i < sizeof presets / sizeof *presets; i++) {
        if (strlen(presets[i].name) == length && strncmp(presets[i].name, text, length) == 0) {
            *settings = defaults;
            const knurl_result result = set_pairs(presets[i].options, settings);
            settings->preset = (int32_t)i;
            settings->resolution_named = 0; /* a preset's resolution does not apply to traces */
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
