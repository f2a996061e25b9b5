/* knurl inspect: what a file's tagged surfaces come to. SPDX-License-Identifier: MIT */
#include "tool.h"

#include <knurl/knurl.h>

static const char hint[] = "nothing in this file is tagged: give a material the custom properties "
                           "knurl_spatial_frequency (cycles/m), knurl_amplitude (m) and knurl_stiffness (N/m), "
                           "and export them as glTF extras";

static void print_material(tool_json *json, const knurl_material_desc *m) {
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

static void print_surface(tool_json *json, const knurl_surface_info *info) {
    json_open(json, NULL, '{');
    json_string(json, "name", info->name);
    json_string(json, "shape", info->shape);
    json_string(json, "model", info->model);
    json_number(json, "triangles", info->triangle_count);
    json_number(json, "dropped_triangles", info->dropped_triangles);
    json_number(json, "bytes", (double)info->bytes);
    print_material(json, &info->material);
    json_open(json, "stretch", '{');
    json_number(json, "min", info->stretch[0]);
    json_number(json, "mean", info->stretch[1]);
    json_number(json, "max", info->stretch[2]);
    json_close(json, '}');
    json_close(json, '}');
}

static void print_scene(tool_json *json, const knurl_scene *scene, uint32_t skipped) {
    const uint32_t count = knurl_scene_surface_count(scene);
    json_open(json, NULL, '{');
    json_open(json, "surfaces", '[');
    for (uint32_t i = 0; i < count; i++) {
        knurl_surface_info info;
        knurl_surface_info_init(&info, sizeof info);
        if (knurl_scene_surface_info(scene, knurl_scene_surface_at(scene, i), &info) == KNURL_OK) {
            print_surface(json, &info);
        }
    }
    json_close(json, ']');
    json_number(json, "skipped", skipped);
    json_number(json, "bytes", (double)knurl_scene_bytes(scene));
    if (count == 0) {
        json_string(json, "hint", hint);
    }
    json_close(json, '}');
    json_end(json);
}

int cmd_inspect(int argc, char **argv) {
    const char *path = NULL;
    int pretty = 0;
    const tool_option options[] = {{"--pretty", TOOL_FLAG, &pretty, 0, 0, ""}};
    if (tool_parse(argc, argv, options, 1, &path) != TOOL_OK) {
        return TOOL_USAGE;
    }
    if (!path) {
        return tool_error(TOOL_USAGE, "inspect: expected a .gltf or .glb file, found none");
    }
    knurl_scene *scene = NULL;
    knurl_gltf_report report;
    knurl_gltf_report_init(&report, sizeof report);
    if (knurl_scene_create(NULL, &scene) || knurl_gltf_load_file(scene, path, &report)) {
        knurl_scene_destroy(scene);
        return tool_library_error(TOOL_FAILURE, NULL);
    }
    tool_json json = {pretty, 0, 1};
    print_scene(&json, scene, report.skipped);
    if (knurl_scene_surface_count(scene) == 0) {
        fprintf(stderr, "knurl: hint: %s: %s\n", path, hint);
    }
    knurl_scene_destroy(scene);
    return TOOL_OK;
}
