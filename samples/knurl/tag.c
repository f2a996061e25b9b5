/* knurl tag's options. SPDX-License-Identifier: MIT */
#include "tag.h"

#include "materials.h"
#include "tool.h"

#include <knurl/knurl.h>

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* The tag's keys as they are given, and their JSON. */
typedef struct keys {
    const char *ridges, *amplitude, *orientation, *axis, *coordinates, *method, *smooth;
    double stiffness, friction, damping;
    char json[1024];
    size_t length;
} keys;

static void put(keys *k, const char *format, ...) KNURL_PRINTF(2, 3);

static void put(keys *k, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    const int written = vsnprintf(k->json + k->length, sizeof k->json - k->length, format, arguments);
    va_end(arguments);
    k->length += written > 0 ? (size_t)written : 0;
}

static void put_key(keys *k, const char *name) {
    put(k, "%s\"%s\":", k->length ? "," : "{", name);
}

/* The shortest decimal that reads back as the same number. */
static void put_number(keys *k, double value) {
    char text[32];
    (void)snprintf(text, sizeof text, "%.15g", value);
    put(k, strtod(text, NULL) == value ? "%.15g" : "%.17g", value);
}

/* As a quotient, so that 0.2mm and 200um are both 0.0002 to the last digit. */
typedef struct unit {
    const char *name;
    double times, over;
} unit;

static const unit lengths[] = {{"mm", 1.0, 1e3},   {"um", 1.0, 1e6}, {"cm", 1.0, 1e2},
                               {"in", 254.0, 1e4}, {"m", 1.0, 1.0},  {NULL, 0.0, 1.0}};
static const unit angles[] = {{"deg", 3.14159265358979323846, 180.0}, {"rad", 1.0, 1.0}, {NULL, 0.0, 1.0}};

/* Reads a number with its unit, and sets *end behind it. Returns 0 if there is none. */
static int read_quantity(const char *text, const unit *units, double *value, const char **end) {
    char *after = NULL;
    *value = strtod(text, &after);
    for (const unit *u = units; u->name && after != text && isfinite(*value); u++) {
        if (strncmp(after, u->name, strlen(u->name)) == 0) {
            *value = *value * u->times / u->over;
            *end = after + strlen(u->name);
            return 1;
        }
    }
    return 0;
}

static int read_ridges(keys *k) {
    const char *text = k->ridges;
    double frequency[2] = {0.0, 0.0};
    for (int axis = 0; axis < 2 && strcmp(k->ridges, "none") != 0; axis++) {
        double apart;
        if (!read_quantity(text, lengths, &apart, &text) || !(apart > 0.0) || isinf(1.0 / apart) ||
            (*text && (*text != ',' || axis == 1))) {
            return tool_error(TOOL_USAGE,
                              "tag: --ridges: expected the distance from ridge to ridge with its unit, such as 1mm, "
                              "two of them for a grid, such as 1mm,2mm, or none, found '%s'",
                              k->ridges);
        }
        frequency[axis] = 1.0 / apart;
        if (!*text++) {
            break;
        }
    }
    put_key(k, "spatial_frequency");
    put(k, "[");
    put_number(k, frequency[0]);
    put(k, ",");
    put_number(k, frequency[1]);
    put(k, "]");
    return TOOL_OK;
}

static int read_one(keys *k, const char *option, const char *key, const char *text, const unit *units,
                    const char *expected) {
    double value;
    const char *end;
    if (!read_quantity(text, units, &value, &end) || *end) {
        return tool_error(TOOL_USAGE, "tag: %s: expected %s, found '%s'", option, expected, text);
    }
    put_key(k, key);
    put_number(k, value);
    return TOOL_OK;
}

static int refuse_axis(const keys *k) {
    return tool_error(TOOL_USAGE, "tag: --axis: expected X,Y,Z in object space, not all 0, found '%s'", k->axis);
}

static int read_axis(keys *k) {
    const char *text = k->axis;
    char *end = NULL;
    int is_zero = 1;
    put_key(k, "axis");
    for (int i = 0; i < 3; i++) {
        const double component = strtod(text, &end);
        if (end == text || !isfinite(component) || *end != (i < 2 ? ',' : '\0')) {
            return refuse_axis(k);
        }
        is_zero = is_zero && component == 0.0;
        put(k, i ? "," : "[");
        put_number(k, component);
        text = end + 1;
    }
    put(k, "]");
    return is_zero ? refuse_axis(k) : TOOL_OK;
}

/* A word of a given set. The loader checks the words of other keys, and names the expected ones. */
static int read_word(keys *k, const char *option, const char *key, const char *text) {
    static const char allowed[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
    if (!text[0] || strlen(text) > 32 || text[strspn(text, allowed)]) {
        return tool_error(TOOL_USAGE, "tag: %s: expected a word, found '%s'", option, text);
    }
    put_key(k, key);
    put(k, "\"%s\"", text);
    return TOOL_OK;
}

static int read_smooth(keys *k) {
    const int yes = strcmp(k->smooth, "yes") == 0;
    if (!yes && strcmp(k->smooth, "no") != 0) {
        return tool_error(TOOL_USAGE, "tag: --smooth: expected yes or no, found '%s'", k->smooth);
    }
    put_key(k, "smooth");
    put(k, yes ? "true" : "false");
    return TOOL_OK;
}

static int read_keys(keys *k) {
    int code = k->ridges ? read_ridges(k) : TOOL_OK;
    if (!code && k->amplitude) {
        code = read_one(k, "--amplitude", "amplitude", k->amplitude, lengths, "a length with its unit, such as 0.2mm");
    }
    if (!code && k->orientation) {
        code = read_one(k, "--orientation", "orientation", k->orientation, angles,
                        "an angle with its unit, such as 45deg or 0.5rad");
    }
    code = code || !k->axis ? code : read_axis(k);
    code = code || !k->coordinates ? code : read_word(k, "--coordinates", "coordinates", k->coordinates);
    code = code || !k->method ? code : read_word(k, "--method", "method", k->method);
    code = code || !k->smooth ? code : read_smooth(k);
    const struct {
        const char *key;
        double value;
    } numbers[] = {{"stiffness", k->stiffness}, {"friction", k->friction}, {"damping", k->damping}};
    for (int i = 0; i < 3; i++) {
        if (!isnan(numbers[i].value)) {
            put_key(k, numbers[i].key);
            put_number(k, numbers[i].value);
        }
    }
    put(k, k->length ? "}" : "");
    return code;
}

static int find_preset(const char *name, const char **tag) {
    const char *names[MATERIAL_COUNT];
    for (size_t i = 0; i < MATERIAL_COUNT; i++) {
        names[i] = materials[i].name;
        if (strcmp(name, names[i]) == 0) {
            *tag = materials[i].tag;
            return TOOL_OK;
        }
    }
    const char *near = tool_nearest(name, names, MATERIAL_COUNT);
    return tool_error(TOOL_USAGE, "tag: --preset: unknown material '%s'%s%s%s; 'knurl help tag' lists all", name,
                      near ? ", did you mean '" : "", near ? near : "", near ? "'?" : "");
}

/* One object at most, and one destination. */
static int choose_object(tag_options *options, const char *const names[3]) {
    static const char *const arrays[] = {"materials", "meshes", "nodes"};
    options->array = arrays[0];
    for (int i = 0; i < 3; i++) {
        if (names[i] && options->object) {
            return tool_error(TOOL_USAGE, "tag: expected one of --material, --mesh and --node");
        }
        if (names[i]) {
            options->array = arrays[i];
            options->object = names[i];
        }
    }
    return TOOL_OK;
}

/* The format is the contents', but `run` and others go by the name. */
static int is_gltf_name(const char *path) {
    const size_t length = strlen(path);
    return strcmp(path, "-") == 0 || (length > 5 && strcmp(path + length - 5, ".gltf") == 0) ||
           (length > 4 && strcmp(path + length - 4, ".glb") == 0);
}

static int check_task(const tag_options *options) {
    const int searches = options->texture.from_texture || options->texture.from_picture;
    const int changes = options->preset || options->keys || searches;
    if (options->list + options->remove + (changes != 0) != 1) {
        return tool_error(TOOL_USAGE, "tag: expected keys such as --ridges or a --preset, or else --remove or --list");
    }
    if (options->list && (options->in_place || options->out)) {
        return tool_error(TOOL_USAGE, "tag: --list changes nothing: expected neither --out nor --in-place with it");
    }
    if (options->in_place + (options->out != NULL) > 1 ||
        (!options->list && !searches && !options->in_place && !options->out)) {
        return tool_error(TOOL_USAGE, "tag: expected --out FILE, or --in-place to replace the file itself");
    }
    if (options->out && !is_gltf_name(options->out)) {
        return tool_error(TOOL_USAGE, "tag: --out: expected a name that ends in .gltf or .glb, found '%s'",
                          options->out);
    }
    return TOOL_OK;
}

/* The options of a search for ridges in a picture, as text. */
typedef struct search_texts {
    const char *size, *depth;
} search_texts;

static int read_length(const char *option, const char *text, double *value, const char **end) {
    if (!read_quantity(text, lengths, value, end) || !(*value >= 1e-6 && *value <= 1e3)) {
        return tool_error(TOOL_USAGE,
                          "tag: %s: expected a length with its unit, from 1um to 1000m, such as 40mm, found '%s'",
                          option, text);
    }
    return TOOL_OK;
}

static int read_size(const search_texts *given, texture_options *t) {
    const char *end = NULL;
    if (!given->size) {
        return tool_error(TOOL_USAGE, "tag: --from-picture: expected its width with --picture-size, such as 40mm");
    }
    if (read_length("--picture-size", given->size, &t->size[0], &end) ||
        (*end == ',' && read_length("--picture-size", end + 1, &t->size[1], &end))) {
        return TOOL_USAGE;
    }
    return *end ? tool_error(TOOL_USAGE,
                             "tag: --picture-size: expected a width, or a width and a height such as "
                             "40mm,30mm, found '%s'",
                             given->size)
                : TOOL_OK;
}

static int read_search(const keys *k, const search_texts *given, texture_options *t) {
    const char *end = NULL;
    const int searches = t->from_texture + (t->from_picture != NULL);
    if (searches > 1) {
        return tool_error(TOOL_USAGE, "tag: expected one of --from-texture and --from-picture");
    }
    if (!t->from_picture && (given->size || given->depth)) {
        return tool_error(TOOL_USAGE, "tag: expected --picture-size and --picture-depth with --from-picture only");
    }
    if (!searches && t->drawing) {
        return tool_error(TOOL_USAGE, "tag: expected --drawing with --from-texture or --from-picture only");
    }
    if (searches && (k->ridges || k->orientation || k->axis || k->coordinates)) {
        return tool_error(TOOL_USAGE,
                          "tag: %s finds the ridges and their direction on the UVs: expected no --ridges, "
                          "--orientation, --axis or --coordinates with it",
                          t->from_texture ? "--from-texture" : "--from-picture");
    }
    if (t->from_picture && read_size(given, t)) {
        return TOOL_USAGE;
    }
    if (given->depth && read_length("--picture-depth", given->depth, &t->depth, &end)) {
        return TOOL_USAGE;
    }
    return given->depth && *end
               ? tool_error(TOOL_USAGE, "tag: --picture-depth: expected one length, found '%s'", given->depth)
               : TOOL_OK;
}

int tag_read_options(int argc, char **argv, tag_options *options, const char **path) {
    static keys k;
    const char *objects[3] = {NULL, NULL, NULL};
    const char *preset = NULL;
    search_texts search = {NULL, NULL};
    memset(options, 0, sizeof *options);
    memset(&k, 0, sizeof k);
    k.stiffness = k.friction = k.damping = NAN;
    const tool_option table[] = {{"--material", TOOL_TEXT, &objects[0], 0, 0, ""},
                                 {"--mesh", TOOL_TEXT, &objects[1], 0, 0, ""},
                                 {"--node", TOOL_TEXT, &objects[2], 0, 0, ""},
                                 {"--preset", TOOL_TEXT, &preset, 0, 0, ""},
                                 {"--ridges", TOOL_TEXT, &k.ridges, 0, 0, ""},
                                 {"--amplitude", TOOL_TEXT, &k.amplitude, 0, 0, ""},
                                 {"--stiffness", TOOL_NUMBER, &k.stiffness, 1e-3, 1e6, "N/m"},
                                 {"--friction", TOOL_NUMBER, &k.friction, 0.0, 100.0, ""},
                                 {"--damping", TOOL_NUMBER, &k.damping, 0.0, 1e4, "N s/m"},
                                 {"--orientation", TOOL_TEXT, &k.orientation, 0, 0, ""},
                                 {"--axis", TOOL_TEXT, &k.axis, 0, 0, ""},
                                 {"--coordinates", TOOL_TEXT, &k.coordinates, 0, 0, ""},
                                 {"--method", TOOL_TEXT, &k.method, 0, 0, ""},
                                 {"--smooth", TOOL_TEXT, &k.smooth, 0, 0, ""},
                                 {"--from-texture", TOOL_FLAG, &options->texture.from_texture, 0, 0, ""},
                                 {"--from-picture", TOOL_TEXT, &options->texture.from_picture, 0, 0, ""},
                                 {"--picture-size", TOOL_TEXT, &search.size, 0, 0, ""},
                                 {"--picture-depth", TOOL_TEXT, &search.depth, 0, 0, ""},
                                 {"--drawing", TOOL_TEXT, &options->texture.drawing, 0, 0, ""},
                                 {"--remove", TOOL_FLAG, &options->remove, 0, 0, ""},
                                 {"--list", TOOL_FLAG, &options->list, 0, 0, ""},
                                 {"--out", TOOL_TEXT, &options->out, 0, 0, ""},
                                 {"--in-place", TOOL_FLAG, &options->in_place, 0, 0, ""},
                                 {"--pretty", TOOL_FLAG, &options->pretty, 0, 0, ""}};
    if (tool_parse(argc, argv, table, sizeof table / sizeof *table, path) || choose_object(options, objects) ||
        read_keys(&k) || read_search(&k, &search, &options->texture) ||
        (preset && find_preset(preset, &options->preset))) {
        return TOOL_USAGE;
    }
    const int needs_file = !options->texture.from_picture || options->out || options->in_place;
    if (*path ? !(*path)[0] : needs_file) {
        return tool_error(TOOL_USAGE, "tag: expected a .gltf or .glb file, found none");
    }
    options->keys = k.length ? k.json : NULL;
    return check_task(options);
}
