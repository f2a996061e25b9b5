/* knurl tag --from-texture and --from-picture: from an object in a file, or an image file, to the tag's keys.
 * SPDX-License-Identifier: MIT */
#include "texture.h"

#include "os.h"
#include "tool.h"

#include <knurl/knurl.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- the size of a picture on the surfaces that show it --- */

/* Marks the object's surfaces among all that a load makes. */
#define MARK 0.123456789

/* Smooth, with all required keys, and on UVs, so that a file without a tag loads. */
static const char probe[] = "{\"spatial_frequency\":[0,0],\"amplitude\":0,\"stiffness\":100,\"friction\":0.123456789,"
                            "\"axis\":null,\"coordinates\":null}";

/* The object: a file, and the surfaces that it shows there. */
typedef struct object {
    const whole_file *file;
    const char *path;
    const char *folder;
    const char *array;
    uint32_t index;
    double uv_scale[2]; /* m for each unit of u and v */
} object;

static int load_probe(const object *o, knurl_scene *scene) {
    whole_file marked = {NULL, 0};
    int code = TOOL_OK;
    if (knurl_gltf_set_tag(o->file->data, o->file->size, o->path, o->array, o->index, probe, whole_file_replace,
                           &marked)) {
        code = tool_library_error(TOOL_FAILURE, "tag");
    } else if (!marked.data) {
        code = tool_error(TOOL_FAILURE, "tag: %s: out of memory", o->path);
    } else if (knurl_gltf_load_memory(scene, marked.data, marked.size, o->path, o->folder, NULL, NULL) ||
               knurl_scene_commit(scene)) {
        code = tool_library_error(TOOL_FAILURE, "tag: the size of the picture on the mesh cannot be found");
    }
    free(marked.data);
    return code;
}

/* One more surface of the object. */
static int take_scale(object *o, const knurl_surface_info *info) {
    if (strcmp(info->coordinates, "uvs") != 0) {
        return tool_error(TOOL_FAILURE,
                          "tag: %s: surface '%s' has no UVs that place a picture on it (its ridges follow %s): unwrap "
                          "it, or give --ridges",
                          o->path, info->name, info->coordinates);
    }
    for (int i = 0; i < 2; i++) {
        const double old = o->uv_scale[i], scale = info->uv_scale[i];
        if (old > 0.0 && fabs(scale - old) > 0.02 * old) {
            return tool_error(TOOL_FAILURE,
                              "tag: %s: the picture is %.4g mm %s on one surface and %.4g mm on '%s', so that one tag "
                              "cannot fit both: tag each with --mesh or --node",
                              o->path, 1e3 * old, i ? "high" : "wide", 1e3 * scale, info->name);
        }
        o->uv_scale[i] = old > 0.0 ? old : scale;
    }
    return TOOL_OK;
}

static int find_scale(object *o) {
    knurl_scene *scene = NULL;
    if (knurl_scene_create(NULL, &scene)) {
        return tool_library_error(TOOL_FAILURE, "tag");
    }
    int code = load_probe(o, scene);
    for (uint32_t i = 0; i < knurl_scene_get_surface_count(scene) && code == TOOL_OK; i++) {
        knurl_surface_info info;
        knurl_material_desc material;
        const knurl_surface_id surface = knurl_scene_get_surface(scene, i);
        knurl_surface_info_init(&info, sizeof info);
        knurl_material_desc_init(&material, sizeof material);
        if (knurl_scene_get_material(scene, surface, &material) == KNURL_OK && material.friction == MARK &&
            knurl_scene_get_surface_info(scene, surface, &info) == KNURL_OK) {
            code = take_scale(o, &info);
        }
    }
    knurl_scene_destroy(scene);
    return code || o->uv_scale[0] > 0.0
               ? code
               : tool_error(TOOL_FAILURE, "tag: %s: no node shows the object, so the size of its picture is unknown",
                            o->path);
}

/* --- an object's textures --- */

typedef struct choice {
    const object *object;
    texture_result best;
    whole_file kept; /* of the best one */
    char name[128];
    char why[256]; /* about the last picture that could not be read */
    uint32_t count, unread;
} choice;

/* k = diag(1/su, -1/sv) from_uv^T (across, down): v runs down, the surface's y up. */
static void place_texture(const object *o, const knurl_gltf_texture *from, texture *t) {
    for (int i = 0; i < 2; i++) {
        const double per_metre = (i ? -1.0 : 1.0) / o->uv_scale[i];
        t->map[i][0] = per_metre * from->from_uv[0][i];
        t->map[i][1] = per_metre * from->from_uv[1][i];
    }
    for (int i = 0; i < 2; i++) {
        t->metres[i] = 1.0 / hypot(t->map[0][i], t->map[1][i]);
    }
}

static void note_unread(choice *c, const char *name, const char *why) {
    c->unread++;
    (void)snprintf(c->why, sizeof c->why, "%.100s: %.150s", name, why);
    tool_tell("note", "tag: %s: %s", name, why);
}

static void try_texture(void *user, const knurl_gltf_texture *from) {
    choice *c = user;
    char why[256];
    texture t = {from->data, (size_t)from->size, from->use, from->name, {{0.0}}, {0.0}, 0.0, from->scale};
    texture_result result;
    c->count++;
    if (from->problem) {
        note_unread(c, from->name[0] ? from->name : from->use, from->problem);
        return;
    }
    if (from->texcoord != 0) {
        note_unread(c, from->name, "laid out by a second set of UVs, which ridges do not follow");
        return;
    }
    place_texture(c->object, from, &t);
    if (texture_search(&t, &result, why)) {
        note_unread(c, from->name, why);
    } else if (!c->best.is_regular && (!c->kept.data || result.found.confidence > c->best.found.confidence)) {
        c->best = result;
        whole_file_replace(&c->kept, from->data, from->size);
        (void)snprintf(c->name, sizeof c->name, "%s", from->name);
        c->best.from.data = c->kept.data;
        c->best.from.name = c->name;
    }
}

static int search_object(object *o, choice *c) {
    int code = find_scale(o);
    if (code) {
        return code;
    }
    if (knurl_gltf_read_textures(o->file->data, o->file->size, o->path, o->folder, o->array, o->index, try_texture,
                                 c)) {
        return tool_library_error(TOOL_FAILURE, "tag");
    }
    if (c->kept.data) {
        return TOOL_OK;
    }
    return c->count == 0
               ? tool_error(TOOL_FAILURE,
                            "tag: %s: expected a normal, occlusion or base colour texture in the material, "
                            "found none: give --from-picture",
                            o->path)
               : tool_error(TOOL_FAILURE, "tag: %s: no texture of the material can be read: %s", o->path, c->why);
}

/* --- an image file --- */

static int search_picture(const texture_options *options, choice *c) {
    char why[256];
    int code = whole_file_read(options->from_picture, &c->kept);
    if (code) {
        return code;
    }
    out_protect(options->from_picture);
    texture t = {c->kept.data,          c->kept.size, options->depth > 0.0 ? "height" : "picture",
                 options->from_picture, {{0.0}},      {0.0},
                 options->depth,        1.0};
    t.metres[0] = options->size[0];
    t.metres[1] = options->size[1];
    if (texture_search(&t, &c->best, why)) {
        return tool_error(TOOL_FAILURE, "tag: %s: %s", options->from_picture, why);
    }
    return TOOL_OK;
}

/* --- the result --- */

static void print_result(const texture_result *r, int pretty) {
    json_writer json;
    json_start(&json, stdout, pretty);
    json_open(&json, NULL, '{');
    json_string(&json, "picture", r->from.name);
    json_string(&json, "read_as", r->use);
    json_number(&json, "width", r->width);
    json_number(&json, "height", r->height);
    json_flag(&json, "regular", r->is_regular);
    json_number(&json, "confidence", r->found.confidence);
    json_open(&json, "ridges", '[');
    for (int i = 0; i < RIDGES_AXES && i < r->found.count && r->is_regular; i++) {
        json_open(&json, NULL, '{');
        json_number(&json, "apart", r->apart[i]);
        json_number(&json, "direction", r->direction[i]);
        json_number(&json, "amplitude", r->amplitude[i]);
        json_number(&json, "share", r->found.share[i]);
        json_number(&json, "evenness", r->found.evenness[i]);
        json_close(&json, '}');
    }
    json_close(&json, ']');
    json_raw(&json, "tag", r->is_regular ? r->tag : "null");
    json_close(&json, '}');
}

static void tell_result(const texture_result *r) {
    for (int i = 0; i < r->found.count; i++) {
        tool_tell("note", "tag: %s (%s): ridges %.4g mm apart across %.1f degrees, %.0f %% of its variation%s",
                  r->from.name, r->use, 1e3 * r->apart[i], 180.0 / 3.14159265358979323846 * r->direction[i],
                  100.0 * r->found.share[i], isnan(r->amplitude[i]) ? "; colours have no depth: --amplitude" : "");
    }
    if (r->note) {
        tool_tell("note", "tag: %s: %s", r->from.name, r->note);
    }
}

static int report(const texture_options *options, const texture_result *r, int print, int pretty, char keys[256]) {
    int code = options->drawing ? texture_draw(r, options->drawing) : TOOL_OK;
    if (code == TOOL_OK && print) {
        print_result(r, pretty);
    }
    if (code == TOOL_OK && !r->is_regular) {
        return tool_error(TOOL_CHECK,
                          "tag: %s: no regular pattern: this is no grating (confidence %.2f, expected at least %.2f)",
                          r->from.name, r->found.confidence, RIDGES_CONFIDENT);
    }
    if (code == TOOL_OK) {
        tell_result(r);
        (void)snprintf(keys, 256, "%s", r->tag);
    }
    return code;
}

int texture_keys(const texture_options *options, const whole_file *file, const char *path, const char *array,
                 uint32_t index, int print, int pretty, char keys[256]) {
    char folder[4096];
    object o = {file, path, folder, array, index, {0.0, 0.0}};
    choice c;
    memset(&c, 0, sizeof c);
    c.object = &o;
    if (path) {
        const size_t length = (size_t)(os_base_name(path) - path);
        (void)snprintf(folder, sizeof folder, "%.*s", (int)length, path);
        o.folder = length ? folder : ".";
    }
    int code = options->from_texture ? search_object(&o, &c) : search_picture(options, &c);
    code = code ? code : report(options, &c.best, print, pretty, keys);
    free(c.kept.data);
    return code;
}
