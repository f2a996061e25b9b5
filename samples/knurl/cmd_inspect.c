/* knurl inspect: describes a file's tagged surfaces. SPDX-License-Identifier: MIT */
#include "tool.h"

#include <knurl/knurl.h>

static const char hint[] = "nothing in this file is tagged: give a material the custom properties "
                           "knurl_spatial_frequency (cycles/m), knurl_amplitude (m) and knurl_stiffness (N/m), "
                           "and export them as glTF extras";

static void print_material(json_writer *json, const knurl_material_desc *m) {
    json_open(json, "material", '{');
    json_open(json, "spatial_frequency", '[');
    json_number(json, NULL, m->spatial_frequency[0]);
    json_number(json, NULL, m->spatial_frequency[1]);
    json_close(json, ']');
    json_number(json, "amplitude", m->amplitude);
    json_number(json, "stiffness", m->stiffness);
    json_number(json, "damping", m->damping);
    json_number(json, "friction", m->friction);
    json_number(json, "orientation", m->orientation);
    json_string(json, "method", knurl_method_name(m->method));
    json_close(json, '}');
}

/* True if a device with its workspace at the default pose can touch the surface's bounds. Surfaces out of reach cost a
 * tick nothing. */
static int in_reach(const knurl_scene *scene, const knurl_device_info *device, const knurl_surface_info *info) {
    knurl_workspace workspace;
    if (knurl_scene_get_workspace(scene, 0, &workspace)) {
        return 0;
    }
    for (int axis = 0; axis < 3; axis++) { /* the default has no rotation, and a scale of 1 */
        if (info->bounds_min[axis] > workspace.origin[axis] + device->workspace_max[axis] ||
            info->bounds_max[axis] < workspace.origin[axis] + device->workspace_min[axis]) {
            return 0;
        }
    }
    return 1;
}

static void print_stretch(json_writer *json, const char *key, const double stretch[3]) {
    json_open(json, key, '{');
    json_number(json, "min", stretch[0]);
    json_number(json, "mean", stretch[1]);
    json_number(json, "max", stretch[2]);
    json_close(json, '}');
}

static void print_angles(json_writer *json, const char *key, const double angles[2]) {
    json_open(json, key, '{');
    json_number(json, "mean", angles[0]);
    json_number(json, "max", angles[1]);
    json_close(json, '}');
}

static void print_smoothness(json_writer *json, const knurl_surface_info *info) {
    static const char *const names[] = {"auto", "off", "on"};
    json_string(json, "smooth", names[info->smooth]);
    json_number(json, "curved_triangles", info->curved_triangles);
    json_number(json, "bad_normals", info->bad_normals);
    json_number(json, "bulge", info->bulge);
}

static void print_surface(json_writer *json, const knurl_surface_info *info, const knurl_material_desc *material,
                          int reachable) {
    json_open(json, NULL, '{');
    json_string(json, "name", info->name);
    json_string(json, "shape", info->shape);
    json_string(json, "model", info->model);
    json_number(json, "triangles", info->triangle_count);
    json_number(json, "dropped_triangles", info->dropped_triangles);
    json_number(json, "reversed_twins", info->reversed_twins);
    json_number(json, "turned_triangles", info->turned_triangles);
    json_number(json, "bytes", (double)info->bytes);
    json_string(json, "why", info->why);
    json_number(json, "model_error", info->model_error);
    json_number(json, "seam", info->seam);
    json_number(json, "touching_pairs", (double)info->touching_pairs);
    print_smoothness(json, info);
    json_flag(json, "in_reach", reachable);
    json_flag(json, "double_sided", info->double_sided != 0);
    json_string(json, "coordinates", info->coordinates);
    json_number(json, "uneven", info->uneven);
    json_number(json, "projection_seams", info->projection_seams);
    print_material(json, material);
    print_stretch(json, "stretch", info->stretch);
    print_stretch(json, "stretch_y", info->stretch_y);
    json_number(json, "edges", info->edges);
    json_number(json, "hard_edges", info->hard_edges);
    print_angles(json, "facet_angle", info->facet_angle);
    print_angles(json, "felt_angle", info->felt_angle);
    json_close(json, '}');
}

/* Returns the number of surfaces out of reach. */
static uint32_t print_scene(json_writer *json, const knurl_scene *scene, const knurl_device_info *device,
                            uint32_t skipped) {
    uint32_t out_of_reach = 0;
    const uint32_t count = knurl_scene_get_surface_count(scene);
    json_open(json, NULL, '{');
    json_open(json, "surfaces", '[');
    for (uint32_t i = 0; i < count; i++) {
        knurl_surface_info info;
        knurl_surface_info_init(&info, sizeof info);
        knurl_material_desc material;
        knurl_material_desc_init(&material, sizeof material);
        const knurl_surface_id surface = knurl_scene_get_surface(scene, i);
        if (knurl_scene_get_surface_info(scene, surface, &info) == KNURL_OK &&
            knurl_scene_get_material(scene, surface, &material) == KNURL_OK) {
            const int reachable = in_reach(scene, device, &info);
            out_of_reach += !reachable;
            print_surface(json, &info, &material, reachable);
        }
    }
    json_close(json, ']');
    json_number(json, "skipped", skipped);
    tool_print_even(json, scene);
    json_number(json, "bytes", (double)knurl_scene_get_bytes(scene));
    if (count == 0) {
        json_string(json, "hint", hint);
    }
    json_close(json, '}');
    return out_of_reach;
}

/* --check: for build pipelines. warnings: number of surfaces that exceed the device's limits. */
static int check(const char *path, const knurl_scene *scene, uint32_t warnings, uint32_t out_of_reach) {
    if (knurl_scene_get_surface_count(scene) > 0 && warnings == 0 && out_of_reach == 0) {
        return TOOL_OK;
    }
    return tool_error(TOOL_CHECK,
                      "inspect: --check: %s: expected tagged surfaces within a Touch's limits and reach, found "
                      "%u surfaces, %u warnings, %u out of reach",
                      path, knurl_scene_get_surface_count(scene), warnings, out_of_reach);
}

/* Sets the scene up for a Touch, by the fake device's values. */
static int measure_device(knurl_scene *scene, int even, const char *response, knurl_device_info *info) {
    knurl_device *device = NULL;
    knurl_device_info_init(info, sizeof *info);
    int code = knurl_device_open("fake", &device) || knurl_device_get_info(device, info)
                   ? tool_library_error(TOOL_FAILURE, NULL)
                   : TOOL_OK;
    if (code == TOOL_OK && (even || response)) {
        code = tool_even(scene, response, device, 1000.0);
    }
    knurl_device_close(device);
    return code;
}

int cmd_inspect(int argc, char **argv) {
    const char *path = NULL;
    int pretty = 0;
    int full = 0;
    int checks = 0;
    int even = 0;
    const char *limits = NULL;
    const char *response = NULL;
    knurl_gltf_options budget;
    const tool_option options[] = {{"--pretty", TOOL_FLAG, &pretty, 0, 0, ""},
                                   {"--full-model", TOOL_FLAG, &full, 0, 0, ""},
                                   {"--check", TOOL_FLAG, &checks, 0, 0, ""},
                                   {"--even", TOOL_FLAG, &even, 0, 0, ""},
                                   {"--response", TOOL_TEXT, (void *)&response, 0, 0, ""},
                                   {"--budget", TOOL_TEXT, &limits, 0, 0, ""}};
    if (tool_parse(argc, argv, options, sizeof options / sizeof *options, &path) != TOOL_OK ||
        tool_parse_budget(limits, &budget) != TOOL_OK) {
        return TOOL_USAGE;
    }
    if (!path || !path[0]) {
        return tool_error(TOOL_USAGE, "inspect: expected a .gltf or .glb file, found none");
    }
    if (tool_check_even("inspect", even, response) != TOOL_OK) {
        return TOOL_USAGE;
    }
    knurl_scene *scene = NULL;
    uint32_t skipped = 0;
    knurl_scene_desc desc;
    knurl_scene_desc_init(&desc, sizeof desc);
    desc.full_model = full != 0;
    knurl_device_info device;
    if (knurl_scene_create(&desc, &scene) || tool_load(scene, path, &budget, &skipped) || knurl_scene_commit(scene)) {
        knurl_scene_destroy(scene);
        return tool_library_error(TOOL_FAILURE, NULL);
    }
    if (measure_device(scene, even, response, &device) != TOOL_OK) {
        knurl_scene_destroy(scene);
        return TOOL_FAILURE;
    }
    json_writer json;
    json_start(&json, stdout, pretty);
    const uint32_t out_of_reach = print_scene(&json, scene, &device, skipped);
    const uint32_t warnings = tool_warn(scene);
    if (knurl_scene_get_surface_count(scene) == 0) {
        (void)tool_error(TOOL_OK, "hint: %s: %s", path, hint);
    }
    const int code = checks ? check(path, scene, warnings, out_of_reach) : TOOL_OK;
    knurl_scene_destroy(scene);
    return code;
}
