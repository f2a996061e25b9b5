/* knurl tag: sets, changes, removes or lists the tags of a glTF file. SPDX-License-Identifier: MIT */
#include "os.h"
#include "tag.h"
#include "tool.h"
#include "whole_file.h"

#include <knurl/knurl.h>

#include <stdlib.h>
#include <string.h>

/* --- objects --- */

typedef struct search {
    const char *array; /* of the object, or null: any */
    const char *name;
    uint32_t index; /* of the first object found */
    uint32_t found;
    uint32_t materials;
} search;

static int is_index(const char *name, uint32_t index) {
    char digits[16];
    (void)snprintf(digits, sizeof digits, "%u", index);
    return strcmp(name, digits) == 0;
}

static void match(void *user, const char *array, uint32_t index, const char *object, const char *tag) {
    search *s = user;
    (void)tag;
    s->materials += strcmp(array, "materials") == 0;
    if (strcmp(array, s->array) == 0 && (!s->name || strcmp(object, s->name) == 0)) {
        s->index = s->found++ ? s->index : index;
    }
}

static void match_index(void *user, const char *array, uint32_t index, const char *object, const char *tag) {
    search *s = user;
    (void)object;
    (void)tag;
    if (strcmp(array, s->array) == 0 && is_index(s->name, index)) {
        s->index = index;
        s->found = 1;
    }
}

/* The object that the options name: by its name, or if no object has that, by its index. */
static int find_object(const whole_file *file, const char *path, search *s) {
    if (knurl_gltf_list_tags(file->data, file->size, path, match, s)) {
        return tool_library_error(TOOL_FAILURE, NULL);
    }
    if (s->found == 0 && s->name) {
        (void)knurl_gltf_list_tags(file->data, file->size, path, match_index, s);
    }
    if (s->found == 1) {
        return TOOL_OK;
    }
    if (!s->name) {
        return tool_error(TOOL_USAGE,
                          "tag: %s has %u materials: expected --material, --mesh or --node with a name or an index; "
                          "'knurl tag FILE --list' shows them",
                          path, s->materials);
    }
    return tool_error(TOOL_USAGE, "tag: %s: expected one object '%s' in %s, found %u; %s", path, s->name, s->array,
                      s->found, s->found ? "choose one by its index, which --list shows" : "--list shows all");
}

static void list_object(void *user, const char *array, uint32_t index, const char *object, const char *tag) {
    json_writer *json = user;
    json_open(json, NULL, '{');
    json_string(json, "in", array);
    json_number(json, "index", index);
    json_string(json, "name", object);
    json_raw(json, "tag", tag ? tag : "null");
    json_close(json, '}');
}

static int list(const whole_file *file, const char *path, int pretty) {
    json_writer json;
    search s = {"", NULL, 0, 0, 0};
    if (knurl_gltf_list_tags(file->data, file->size, path, match, &s)) { /* before anything is printed */
        return tool_library_error(TOOL_FAILURE, NULL);
    }
    json_start(&json, stdout, pretty);
    json_open(&json, NULL, '[');
    (void)knurl_gltf_list_tags(file->data, file->size, path, list_object, &json);
    json_close(&json, ']');
    return TOOL_OK;
}

/* --- the result --- */

/* Loads the tagged file as `run` would, from the folder that it is written to. A file that would not load is not
 * written. */
static int check_result(const whole_file *file, const char *out) {
    char folder[4096];
    knurl_scene *scene = NULL;
    knurl_gltf_report report;
    const size_t length = (size_t)(os_base_name(out) - out);
    (void)snprintf(folder, sizeof folder, "%.*s", (int)length, length ? out : "");
    knurl_gltf_report_init(&report, sizeof report);
    if (knurl_scene_create(NULL, &scene) ||
        knurl_gltf_load_memory(scene, file->data, file->size, out, length ? folder : ".", NULL, &report) ||
        knurl_scene_commit(scene)) {
        knurl_scene_destroy(scene);
        return tool_library_error(TOOL_FAILURE, "tag: nothing is written, as the file would not load");
    }
    (void)tool_warn(scene);
    knurl_scene_destroy(scene);
    if (report.surfaces == 0) {
        tool_tell("note", "%s: no node shows the tagged object, so nothing in the file can be felt", out);
    }
    return TOOL_OK;
}

static int write_file(const whole_file *file, const char *out) {
    out_file target;
    memset(&target, 0, sizeof target);
    if (out_open(&target, out)) {
        return TOOL_FAILURE;
    }
    if (fwrite(file->data, 1, file->size, target.stream) != file->size) {
        out_discard(&target);
        return tool_error(TOOL_FAILURE, "%s: cannot be written", out);
    }
    return out_keep(&target) ? TOOL_FAILURE : TOOL_OK;
}

/* found: the keys from a picture, or "". Those that are given are set last. */
static int edit(whole_file *file, const char *path, const search *object, const tag_options *options,
                const char *found) {
    const char *patches[] = {options->preset, found[0] ? found : NULL, options->keys};
    for (int i = 0; i < 3; i++) {
        const char *patch = options->remove ? NULL : patches[i];
        if (!options->remove && !patch) {
            continue;
        }
        if (knurl_gltf_set_tag(file->data, file->size, path, object->array, object->index, patch, whole_file_replace,
                               file)) {
            return tool_library_error(TOOL_FAILURE, "tag");
        }
        if (!file->data) {
            return tool_error(TOOL_FAILURE, "tag: %s: out of memory", path);
        }
    }
    return TOOL_OK;
}

static int searches(const tag_options *options) {
    return options->texture.from_texture || options->texture.from_picture;
}

static int tag_file(whole_file *file, const char *path, const tag_options *options) {
    if (options->list) {
        return list(file, path, options->pretty);
    }
    search object = {options->array, options->object, 0, 0, 0};
    const char *out = options->in_place ? path : options->out;
    char found[256] = "";
    int code = find_object(file, path, &object);
    if (code == TOOL_OK && searches(options)) {
        code = texture_keys(&options->texture, file, path, object.array, object.index, !out, options->pretty, found);
    }
    if (code || !out) {
        return code;
    }
    code = edit(file, path, &object, options, found);
    code = code || options->remove ? code : check_result(file, out);
    code = code ? code : write_file(file, out);
    if (code == TOOL_OK && strcmp(out, "-") != 0) {
        say(stdout, "%s: %s[%u] %s\n", out, object.array, object.index, options->remove ? "untagged" : "tagged");
    }
    return code;
}

int cmd_tag(int argc, char **argv) {
    tag_options options;
    const char *path = NULL;
    whole_file file = {NULL, 0};
    int code = tag_read_options(argc, argv, &options, &path);
    if (code == TOOL_OK && !path) { /* an image file alone */
        char found[256];
        return texture_keys(&options.texture, NULL, NULL, NULL, 0, 1, options.pretty, found);
    }
    if (code == TOOL_OK) {
        if (!options.in_place) {
            out_protect(path);
        }
        code = whole_file_read(path, &file);
        code = code ? code : tag_file(&file, path, &options);
    }
    free(file.data);
    return code;
}
