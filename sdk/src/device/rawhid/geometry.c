/* Reads the geometry file. SPDX-License-Identifier: MIT */
#include "device/rawhid/geometry.h"

#include "base/number.h"
#include "base/regular_file.h"

#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define TWO_PI 6.283185307179586

/* Kinds of numbers. */
#define REAL  0
#define WHOLE KNURL_WHOLE
#define HEX   (KNURL_WHOLE | 16)
#define SIGN  (KNURL_WHOLE | 32) /* -1 or 1 */

typedef struct key {
    knurl_field field;
    double standard;
} key;

static const key keys[] = {
#define KNURL_RAWHID_KEY(name, field, standard, range, kind)                                                           \
    {{#name, offsetof(knurl_rawhid_geometry, field), {range, kind}}, standard},
    KNURL_RAWHID_KEYS(KNURL_RAWHID_KEY)
#undef KNURL_RAWHID_KEY
};

#define KEY_COUNT (sizeof keys / sizeof *keys)

/* Position in the file. */
typedef struct spot {
    const char *file;
    unsigned long line;
    uint64_t seen; /* bits: keys read so far; the last bit is the name */
} spot;

typedef struct word {
    const char *at;
    size_t length;
} word;

static void set(knurl_rawhid_geometry *geometry, const key *k, double value) {
    memcpy((char *)geometry + k->field.offset, &value, sizeof value);
}

void knurl_rawhid_geometry_init(knurl_rawhid_geometry *geometry) {
    memset(geometry, 0, sizeof *geometry);
    (void)snprintf(geometry->name, sizeof geometry->name, "WoodenHaptics v2015");
    for (size_t i = 0; i < KEY_COUNT; i++) {
        set(geometry, &keys[i], keys[i].standard);
    }
}

/* Length of the part that a message quotes. */
static int shown(word w) {
    return (int)(w.length < 60 ? w.length : 60);
}

static int is_space(char c) {
    return c == ' ' || c == '\t' || c == '\r';
}

static word trim(const char *at, size_t length) {
    while (length > 0 && is_space(*at)) {
        at++;
        length--;
    }
    while (length > 0 && is_space(at[length - 1])) {
        length--;
    }
    const word made = {at, length};
    return made;
}

static int is_word(word w, const char *text) {
    return strlen(text) == w.length && memcmp(w.at, text, w.length) == 0;
}

static knurl_result refuse_key(const spot *s, word name) {
    char known[768] = "name";
    for (size_t i = 0; i < KEY_COUNT; i++) {
        const size_t used = strlen(known);
        (void)snprintf(known + used, sizeof known - used, ", %s", keys[i].field.name);
    }
    return knurl_fail(KNURL_ERROR_FORMAT, "%s: line %lu: expected a key of %s; found '%.*s'", s->file, s->line, known,
                      shown(name), name.at);
}

static knurl_result set_name(const spot *s, word value, knurl_rawhid_geometry *geometry) {
    int plain = value.length > 0 && value.length < sizeof geometry->name;
    for (size_t i = 0; i < value.length && plain; i++) {
        plain = (unsigned char)value.at[i] >= 0x20 && value.at[i] != 0x7f;
    }
    if (!plain) {
        return knurl_fail(
            KNURL_ERROR_FORMAT, "%s: line %lu: name: expected 1 to %lu printable bytes, found %lu: '%.*s'", s->file,
            s->line, (unsigned long)sizeof geometry->name - 1, (unsigned long)value.length, shown(value), value.at);
    }
    memset(geometry->name, 0, sizeof geometry->name);
    memcpy(geometry->name, value.at, value.length);
    return KNURL_OK;
}

static knurl_result set_number(const spot *s, const key *k, word text, knurl_rawhid_geometry *geometry) {
    const knurl_range *range = &k->field.range;
    char expected[KNURL_RANGE_ROOM];
    double value = 0.0;
    if (!knurl_number(text.at, text.length, &value) || !knurl_range_holds(range, value) ||
        (range->kind == SIGN && value == 0.0)) {
        return knurl_fail(KNURL_ERROR_FORMAT, "%s: line %lu: %s: expected %s%s, found '%.*s'", s->file, s->line,
                          k->field.name, range->kind == SIGN ? "-1 or 1" : knurl_range_text(range, expected),
                          range->kind == HEX ? " (hexadecimal as 0x16c0)" : "", shown(text), text.at);
    }
    set(geometry, k, value);
    return KNURL_OK;
}

static knurl_result set_line(spot *s, word line, knurl_rawhid_geometry *geometry) {
    const char *equals = memchr(line.at, '=', line.length);
    if (!equals) {
        /* the line is not quoted: a URI may name any file, and other people may read the logs */
        return knurl_fail(KNURL_ERROR_FORMAT, "%s: line %lu: expected key = value, found no '='", s->file, s->line);
    }
    const word name = trim(line.at, (size_t)(equals - line.at));
    const word value = trim(equals + 1, line.length - (size_t)(equals + 1 - line.at));
    size_t i = 0;
    while (i < KEY_COUNT && !is_word(name, keys[i].field.name)) {
        i++;
    }
    if (i == KEY_COUNT && !is_word(name, "name")) {
        return refuse_key(s, name);
    }
    if (s->seen >> i & 1u) {
        return knurl_fail(KNURL_ERROR_FORMAT, "%s: line %lu: %.*s: expected it once, found it again", s->file, s->line,
                          shown(name), name.at);
    }
    s->seen |= UINT64_C(1) << i;
    return i == KEY_COUNT ? set_name(s, value, geometry) : set_number(s, &keys[i], value, geometry);
}

void knurl_rawhid_arm_init(knurl_rawhid_arm *arm, const knurl_rawhid_geometry *geometry) {
    for (int i = 0; i < 3; i++) {
        const double gear = geometry->sign[i] * geometry->capstan[i] / geometry->body[i];
        arm->length[i] = geometry->length[i];
        arm->origin[i] = geometry->origin[i];
        arm->radians[i] = TWO_PI / geometry->counts[i] * gear;
        arm->milliamps[i] = 1000.0 * gear / geometry->torque_constant[i];
    }
    arm->max_milliamps = 1000.0 * geometry->max_current;
}

/* Checks relations between keys. */
static knurl_result check(const char *where, const knurl_rawhid_geometry *g) {
    static const double centre[3] = {0.0, 0.0, 0.0};
    knurl_rawhid_arm arm;
    double angles[3];
    if (g->report_bytes > 0.0 && g->report_bytes < 14.0) {
        return knurl_fail(KNURL_ERROR_FORMAT, "%s: report_bytes: expected 0 or 14 to 64 bytes, found %g", where,
                          g->report_bytes);
    }
    if ((g->vendor > 0.0) != (g->product > 0.0)) {
        return knurl_fail(KNURL_ERROR_FORMAT, "%s: expected both vendor and product, found %#x and %#x", where,
                          (unsigned)g->vendor, (unsigned)g->product);
    }
    if (g->continuous_force > g->max_force) {
        return knurl_fail(KNURL_ERROR_FORMAT, "%s: continuous_force: expected up to max_force (%g N), found %g N",
                          where, g->max_force, g->continuous_force);
    }
    knurl_rawhid_arm_init(&arm, g);
    if (!knurl_rawhid_inverse(&arm, centre, angles) || !knurl_rawhid_is_pose(&arm, angles)) {
        return knurl_fail(KNURL_ERROR_FORMAT,
                          "%s: expected an origin that the arm reaches with its elbow bent, found one at %g, %g, %g m "
                          "and links of %g, %g and %g m",
                          where, g->origin[0], g->origin[1], g->origin[2], g->length[0], g->length[1], g->length[2]);
    }
    return KNURL_OK;
}

knurl_result knurl_rawhid_geometry_parse(const char *where, const char *text, size_t size,
                                         knurl_rawhid_geometry *geometry) {
    knurl_rawhid_geometry made;
    spot s = {where, 0, 0};
    knurl_result result = KNURL_OK;
    knurl_rawhid_geometry_init(&made);
    for (size_t at = 0; at < size && !result;) {
        const char *end = memchr(text + at, '\n', size - at);
        const size_t length = end ? (size_t)(end - (text + at)) : size - at;
        const char *comment = memchr(text + at, '#', length);
        const word line = trim(text + at, comment ? (size_t)(comment - (text + at)) : length);
        s.line++;
        result = line.length > 0 ? set_line(&s, line, &made) : KNURL_OK;
        at += length + 1;
    }
    result = result ? result : check(where, &made);
    if (!result) {
        *geometry = made;
    }
    return result;
}

knurl_result knurl_rawhid_geometry_load(const char *path, knurl_rawhid_geometry *geometry) {
    char why[160];
    uint64_t there = 0;
    FILE *file = knurl_regular_open(NULL, path, &there, why, sizeof why);
    if (!file) {
        return knurl_fail(KNURL_ERROR_IO, "geometry file '%s': could not be opened: %s", path, why);
    }
    char *text = malloc(KNURL_RAWHID_FILE_ROOM + 1);
    const size_t size = text ? fread(text, 1, KNURL_RAWHID_FILE_ROOM + 1, file) : 0;
    knurl_result result = KNURL_OK;
    if (!text) {
        result = knurl_fail(KNURL_ERROR_MEMORY, "geometry file '%s': could not get memory", path);
    } else if (ferror(file)) {
        result = knurl_fail(KNURL_ERROR_IO, "geometry file '%s': could not be read: %s", path, strerror(errno));
    } else if (size > KNURL_RAWHID_FILE_ROOM) {
        result = knurl_fail(KNURL_ERROR_FORMAT, "geometry file '%s': expected up to %d bytes, found more", path,
                            KNURL_RAWHID_FILE_ROOM);
    } else {
        result = knurl_rawhid_geometry_parse(path, text, size, geometry);
    }
    free(text);
    (void)fclose(file);
    return result;
}
