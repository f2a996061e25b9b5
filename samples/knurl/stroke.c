/* Strokes and traces in scene coordinates. SPDX-License-Identifier: MIT */
#include "stroke.h"

#include "tool.h"

#include <math.h>
#include <stdlib.h>

/* The distance that a device position can move along +-direction inside the workspace; negative outside. */
static double room(const knurl_device_info *device, const double from[3], const double direction[3]) {
    double reach = HUGE_VAL;
    for (int axis = 0; axis < 3; axis++) {
        const double space = fmin(device->workspace_max[axis] - from[axis], from[axis] - device->workspace_min[axis]);
        if (space < 0.0) {
            return -1.0;
        }
        if (fabs(direction[axis]) > 1e-6) {
            reach = fmin(reach, space / fabs(direction[axis]));
        }
    }
    return reach;
}

/* Puts the workspace's origin on the surface's anchor. */
static int move_workspace(knurl_scene *scene, const knurl_surface_info *info, knurl_workspace *workspace) {
    knurl_hip_desc desc;
    knurl_hip_desc_init(&desc, sizeof desc);
    for (int axis = 0; axis < 3; axis++) {
        workspace->origin[axis] = info->anchor[axis];
    }
    desc.workspace = workspace;
    if (knurl_scene_configure_hip(scene, 0, &desc)) {
        return tool_library_error(TOOL_FAILURE, "run");
    }
    tool_tell("note", "surface '%s' lies outside the workspace around all surfaces; the workspace is moved to it",
              info->name);
    return TOOL_OK;
}

int stroke_place(knurl_scene *scene, knurl_device *device, knurl_surface_id surface) {
    knurl_workspace workspace;
    knurl_surface_info info;
    knurl_device_info limits;
    double centre[3];
    double normal[3];
    knurl_surface_info_init(&info, sizeof info);
    knurl_device_info_init(&limits, sizeof limits);
    if (knurl_scene_get_surface_info(scene, surface, &info) || knurl_device_get_info(device, &limits) ||
        knurl_scene_get_workspace(scene, 0, &workspace)) {
        return tool_library_error(TOOL_FAILURE, "run");
    }
    knurl_workspace_to_device(&workspace, info.anchor, centre);
    knurl_workspace_vector_to_device(&workspace, info.anchor_normal, normal);
    /* a stroke starts 5 mm above the surface */
    return room(&limits, centre, normal) < 0.01 ? move_workspace(scene, &info, &workspace) : TOOL_OK;
}

int stroke_lay(knurl_scene *scene, knurl_device *device, knurl_surface_id surface, int32_t stroke, double *length) {
    knurl_stroke_report report;
    knurl_stroke_report_init(&report, sizeof report);
    const int code = stroke_place(scene, device, surface);
    if (code != TOOL_OK) {
        return code;
    }
    if (knurl_fake_lay_stroke(device, scene, 0, surface, stroke, &report)) {
        return tool_library_error(TOOL_FAILURE, "run");
    }
    *length = report.length;
    return TOOL_OK;
}

/* m: larger than any workspace: a longer trace was probably written in mm. */
#define TRACE_SPAN_MAX 2.0

static void warn_of_millimetres(const char *path, const tool_table *table) {
    for (uint32_t axis = 1; axis <= 3; axis++) {
        double low = table->cells[axis];
        double high = low;
        for (uint64_t i = 1; i < table->row_count; i++) {
            low = fmin(low, table->cells[4 * i + axis]);
            high = fmax(high, table->cells[4 * i + axis]);
        }
        if (high - low > TRACE_SPAN_MAX) {
            tool_tell("warning", "%s: %c spans %g m; positions are taken as metres: are these millimetres?", path,
                      "txyz"[axis], high - low);
            return;
        }
    }
}

int stroke_play(knurl_scene *scene, knurl_device *device, const char *path, double *last_t) {
    static const char *const columns[] = {"t", "x", "y", "z"};
    tool_table table;
    knurl_workspace workspace;
    int code = tool_read_csv(path, columns, 4, &table);
    if (code != TOOL_OK) {
        return code;
    }
    const double last = table.cells[4 * (table.row_count - 1)];
    if (!(last >= 0.0 && last <= RUN_SECONDS_MAX)) {
        code = tool_error(TOOL_FAILURE,
                          "%s: expected times in s from the start of the run, the last from 0 to %g, found %g", path,
                          RUN_SECONDS_MAX, last);
        free(table.cells);
        return code;
    }
    *last_t = last;
    warn_of_millimetres(path, &table);
    knurl_result result = knurl_scene_get_workspace(scene, 0, &workspace);
    for (uint64_t i = 0; i < table.row_count && !result; i++) {
        double *row = &table.cells[4 * i];
        knurl_workspace_to_device(&workspace, row + 1, row + 1);
    }
    result = result ? result : knurl_fake_set_trace(device, table.cells, table.row_count);
    free(table.cells);
    return result ? tool_library_error(TOOL_FAILURE, path) : TOOL_OK;
}
