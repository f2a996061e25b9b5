/* Reads and writes messages of the Haply Inverse Service. SPDX-License-Identifier: MIT */
#include "device/inverse3/message.h"

#include "base/number.h"
#include "base/vec3.h"

#include <stdio.h>
#include <string.h>

void knurl_inverse3_to_knurl(const double from[3], double to[3]) {
    to[0] = from[0];
    to[1] = from[2];
    to[2] = -from[1];
}

void knurl_inverse3_from_knurl(const double from[3], double to[3]) {
    to[0] = from[0];
    to[1] = -from[2];
    to[2] = from[1];
}

/* Returns 1 if the service's quaternion is of unit length. */
static int turn_to_knurl(const double o[4], double q[4]) {
    const double square = vec3_dot(o, o) + o[3] * o[3];
    if (!(fabs(square - 1.0) < 0.01)) {
        return 0;
    }
    knurl_inverse3_to_knurl(o, q);
    q[3] = o[3];
    for (int k = 0; k < 4; k++) {
        q[k] /= sqrt(square);
    }
    return 1;
}

void knurl_inverse3_find_grip(const knurl_inverse3_state *state, const char *id, knurl_inverse3_grip *found) {
    uint32_t first = 0;
    memset(found, 0, sizeof *found);
    while (!id[0] && first < state->grip_count && !turn_to_knurl(state->grips[first].orientation, found->orientation)) {
        first++;
    }
    id = id[0] ? id : state->grips[first < state->grip_count ? first : 0].id;
    for (uint32_t i = 0; i < state->grip_count; i++) {
        const knurl_inverse3_grip *grip = &state->grips[i];
        if (strcmp(grip->id, id) == 0) {
            memcpy(found->id, grip->id, sizeof found->id);
            found->buttons |= grip->buttons;
            found->battery = fmax(found->battery, grip->battery);
            (void)turn_to_knurl(grip->orientation, found->orientation);
        }
    }
}

const knurl_inverse3_entry *knurl_inverse3_find(const knurl_inverse3_state *state, const char *id) {
    for (int i = 0; i < KNURL_INVERSE3_DEVICES; i++) {
        const knurl_inverse3_entry *entry = &state->entries[i];
        if (entry->id[0] && (!id[0] || strcmp(entry->id, id) == 0)) {
            return entry;
        }
    }
    return NULL;
}

/* --- writing --- */

/* With six decimals. */
static void put_number(char text[32], double value) {
    const long millionths = lround(1e6 * fabs(value));
    (void)snprintf(text, 32, "%s%ld.%06ld", value < 0.0 ? "-" : "", millionths / 1000000, millionths % 1000000);
}

#define CONFIGURE "\"configure\":{\"preset\":{\"preset\":\"arm_front_centered\"},\"damping\":{\"scalar\":0}"

const char *knurl_inverse3_configuration(const char *gravity) {
    return gravity[0] == '1'   ? CONFIGURE ",\"gravity_compensation\":{\"enabled\":true}},"
           : gravity[0] == '0' ? CONFIGURE ",\"gravity_compensation\":{\"enabled\":false}},"
                               : CONFIGURE "},";
}

size_t knurl_inverse3_command(char text[KNURL_INVERSE3_COMMAND], const char *id, const double force[3],
                              const char *configuration) {
    char numbers[3][32];
    double f[3];
    knurl_inverse3_from_knurl(force, f);
    for (int axis = 0; axis < 3; axis++) {
        put_number(numbers[axis], f[axis]);
    }
    return (size_t)snprintf(text, KNURL_INVERSE3_COMMAND,
                            "{\"inverse3\":[{\"device_id\":\"%s\",%s\"commands\":{\"set_cursor_force\":{\"vector\":{"
                            "\"x\":%s,\"y\":%s,\"z\":%s}}}}]}",
                            id, configuration, numbers[0], numbers[1], numbers[2]);
}

/* --- reading --- */

#ifndef KNURL_HAVE_INVERSE3

int knurl_inverse3_read(const char *text, size_t size, knurl_inverse3_state *state) {
    (void)text;
    (void)size;
    (void)state;
    return 0;
}

int knurl_inverse3_read_brake(const char *text, size_t size, const char *id) {
    (void)text;
    (void)size;
    (void)id;
    return -1;
}

#else

#define JSMN_STATIC
#define JSMN_STRICT
#define JSMN_PARENT_LINKS /* so that the time to parse only grows linearly with the length */
#include <jsmn.h>

#define TOKENS 2048 /* per message: a device with its configuration has about 150 */

typedef struct json {
    const char *text;
    int count;
    jsmntok_t tokens[TOKENS];
} json;

/* Values are referred to by their token's index; NONE if there is no such value. */
#define NONE   (-1)

static int has_text(const json *j, int at, const char *text) {
    const jsmntok_t *token = &j->tokens[at];
    const size_t length = (size_t)(token->end - token->start);
    return length == strlen(text) && memcmp(j->text + token->start, text, length) == 0;
}

/* The first token after a value and its contents. */
static int behind(const json *j, int at) {
    const int end = j->tokens[at].end;
    do {
        at++;
    } while (at < j->count && j->tokens[at].start < end);
    return at;
}

static int member(const json *j, int object, const char *key) {
    if (object == NONE || j->tokens[object].type != JSMN_OBJECT) {
        return NONE;
    }
    const int end = behind(j, object);
    for (int at = object + 1; at + 1 < end && j->tokens[at].size == 1; at = behind(j, at + 1)) {
        if (has_text(j, at, key)) {
            return at + 1;
        }
    }
    return NONE;
}

/* The first element of an array if `at` is NONE, otherwise the one after `at`. */
static int element(const json *j, int array, int at) {
    if (array == NONE || j->tokens[array].type != JSMN_ARRAY) {
        return NONE;
    }
    const int next = at == NONE ? array + 1 : behind(j, at);
    return next < behind(j, array) ? next : NONE;
}

/* Reads a JSON number. The service prints up to 17 significant digits, knurl_number() takes 15: the rest is cut off. */
static int take_number(const json *j, int at, double *value) {
    char kept[32];
    size_t count = 0;
    int significant = 0;
    int has_point = 0;
    double exponent = 0.0;
    if (at == NONE || j->tokens[at].type != JSMN_PRIMITIVE) {
        return 0;
    }
    const char *text = j->text + j->tokens[at].start;
    const size_t size = (size_t)(j->tokens[at].end - j->tokens[at].start);
    size_t end = 0; /* of its digits */
    while (end < size && text[end] != 'e' && text[end] != 'E') {
        end++;
    }
    if (end + 2 < size && text[end + 1] == '-' && knurl_number(text + end + 2, size - end - 2, &exponent) &&
        exponent > 8.0) {
        *value = 0.0; /* less than 0.1 um; with 15 digits out of knurl_number()'s range */
        return 1;
    }
    for (size_t i = 0; i < size && count < sizeof kept; i++) {
        const int is_digit = i < end && text[i] >= '0' && text[i] <= '9';
        if (!strchr("0123456789+-.eE", text[i])) {
            return 0; /* jsmn accepts more than JSON allows */
        }
        has_point |= text[i] == '.';
        significant += is_digit && (significant > 0 || text[i] != '0');
        if (!is_digit || !has_point || significant <= 15) {
            kept[count++] = text[i];
        }
    }
    return count < sizeof kept && knurl_number(kept, count, value);
}

/* Reads numbers by their keys. Returns 1 if all are present. */
static int take_named(const json *j, int object, const char *const *keys, int wanted, double *values) {
    int has_all = 1;
    for (int i = 0; i < wanted; i++) {
        has_all &= take_number(j, member(j, object, keys[i]), &values[i]);
    }
    return has_all;
}

/* Reads the numbers x, y, z and (4) w. Returns 1 if all are present. */
static int take_numbers(const json *j, int object, int wanted, double *values) {
    static const char *const keys[] = {"x", "y", "z", "w"};
    return take_named(j, object, keys, wanted, values);
}

static uint32_t is_true(const json *j, int at) {
    return at != NONE && j->tokens[at].type == JSMN_PRIMITIVE && has_text(j, at, "true");
}

/* 1 if it is present and not true. */
static uint32_t is_denied(const json *j, int at) {
    return at != NONE && !is_true(j, at);
}

/* Commands contain the id: it must not end the string around it. */
static void take_id(const json *j, int at, char id[KNURL_INVERSE3_ID_ROOM]) {
    static const char allowed[] = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz-_";
    const size_t size = at == NONE ? 0 : (size_t)(j->tokens[at].end - j->tokens[at].start);
    if (size < KNURL_INVERSE3_ID_ROOM && size > 0 && j->tokens[at].type == JSMN_STRING) {
        memcpy(id, j->text + j->tokens[at].start, size);
        id[size] = '\0';
        id[strspn(id, allowed) == size ? size : 0] = '\0';
    }
}

static void take_device(const json *j, int at, knurl_inverse3_entry *entry) {
    static const char *const angles[] = {"a0", "a1", "a2"};
    const int config = member(j, at, "config");
    const int status = member(j, at, "status");
    const int preset = member(j, config, "preset");
    take_id(j, member(j, at, "device_id"), entry->id);
    take_id(j, member(j, config, "type"), entry->type);
    entry->has_preset = preset != NONE && j->tokens[preset].type == JSMN_STRING;
    if (!take_number(j, member(j, member(j, member(j, config, "filters"), "force_gate"), "gain"), &entry->force_gate)) {
        entry->force_gate = 0.0;
    }
    entry->is_unpowered = is_denied(j, member(j, status, "power_supply"));
    entry->is_uncalibrated = is_denied(j, member(j, status, "calibrated"));
    entry->is_not_ready = is_denied(j, member(j, status, "ready"));
    const int state = member(j, at, "state");
    entry->has_position = (uint32_t)take_numbers(j, member(j, state, "cursor_position"), 3, entry->position);
    if (!take_named(j, member(j, state, "angular_position"), angles, 3, entry->joints)) {
        memset(entry->joints, 0, sizeof entry->joints);
    }
}

static void take_grip(const json *j, int at, knurl_inverse3_grip *grip) {
    const int state = member(j, at, "state");
    const int buttons = member(j, state, "buttons");
    take_id(j, member(j, at, "device_id"), grip->id);
    if (!take_number(j, member(j, state, "battery_level"), &grip->battery) || !(fabs(grip->battery - 0.5) <= 0.5)) {
        grip->battery = 0.0;
    }
    if (!take_numbers(j, member(j, state, "orientation"), 4, grip->orientation)) {
        memset(grip->orientation, 0, sizeof grip->orientation);
    }
    grip->buttons = is_true(j, member(j, buttons, "a")) | is_true(j, member(j, buttons, "b")) << 1 |
                    is_true(j, member(j, buttons, "c")) << 2 | is_true(j, member(j, state, "button"));
}

static void take_grips(const json *j, knurl_inverse3_state *state) {
    static const char *const kinds[] = {"wireless_verse_grip", "custom_verse_grip", "verse_grip"};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        const int grips = member(j, 0, kinds[i]);
        for (int at = element(j, grips, NONE); at != NONE && state->grip_count < KNURL_INVERSE3_DEVICES;
             at = element(j, grips, at)) {
            take_grip(j, at, &state->grips[state->grip_count++]);
        }
    }
}

/* Returns 1 if the text is one JSON object. */
static int parse(json *j, const char *text, size_t size) {
    jsmn_parser parser;
    jsmn_init(&parser);
    j->text = text;
    j->count = size > KNURL_INVERSE3_LONGEST ? 0 : jsmn_parse(&parser, text, size, j->tokens, TOKENS);
    return j->count > 0 && j->tokens[0].type == JSMN_OBJECT && behind(j, 0) == j->count;
}

static int is_text(const json *j, int at, const char *text) {
    return at != NONE && j->tokens[at].type == JSMN_STRING && has_text(j, at, text);
}

int knurl_inverse3_read_brake(const char *text, size_t size, const char *id) {
    json j;
    if (!parse(&j, text, size) || !is_text(&j, member(&j, 0, "name"), "device-safety-triggered")) {
        return -1;
    }
    const int data = member(&j, 0, "data");
    const int type = member(&j, data, "safety_type");
    return !is_text(&j, member(&j, data, "device_id"), id) ? -1
           : is_text(&j, type, "ebrake_triggered")         ? 1
           : is_text(&j, type, "ebrake_released")          ? 0
                                                           : -1;
}

int knurl_inverse3_read(const char *text, size_t size, knurl_inverse3_state *state) {
    json j;
    memset(state, 0, sizeof *state);
    if (!parse(&j, text, size)) {
        return 0;
    }
    const int devices = member(&j, 0, "inverse3");
    int at = element(&j, devices, NONE);
    for (int i = 0; i < KNURL_INVERSE3_DEVICES && at != NONE; i++) {
        take_device(&j, at, &state->entries[i]);
        at = element(&j, devices, at);
    }
    take_grips(&j, state);
    return 1;
}

#endif
