/* knurl run: loads the scene, opens the device, lays its hand, opens the outputs, makes the loop.
 * SPDX-License-Identifier: MIT */
#include "machine.h"
#include "run.h"
#include "stroke.h"

#include <math.h>
#include <stdlib.h>
#include <unistd.h>

/* --method: for every surface, instead of its own. */
static knurl_result set_methods(knurl_scene *scene, int32_t method) {
    for (uint32_t i = 0; i < knurl_scene_get_surface_count(scene); i++) {
        const knurl_surface_id surface = knurl_scene_get_surface(scene, i);
        knurl_material_desc material;
        knurl_material_desc_init(&material, sizeof material);
        knurl_result result = knurl_scene_get_material(scene, surface, &material);
        material.method = method;
        result = result ? result : knurl_scene_set_material(scene, surface, &material);
        if (result) {
            char name[KNURL_NAME_SIZE] = "";
            (void)knurl_scene_get_surface_name(scene, surface, name);
            return knurl_fail(result, "surface '%s': %s", name, knurl_error_message());
        }
    }
    return KNURL_OK;
}

/* Protects files that a device's URI names after geometry=, firmware= and library=. */
static void protect_device_files(const char *uri) {
    const char *pair = strchr(uri, '?');
    while (pair) {
        char path[4096];
        const char *value = pair + 1 + strcspn(pair + 1, "=&");
        if (*value == '=') {
            (void)snprintf(path, sizeof path, "%.*s", (int)strcspn(value + 1, "&"), value + 1);
            out_protect(path); /* a number is not normally a file's name */
        }
        pair = strchr(pair + 1, '&');
    }
}

int run_load(run *r) {
    const run_options *o = &r->options;
    uint32_t skipped = 0;
    knurl_scene_desc desc;
    knurl_scene_desc_init(&desc, sizeof desc);
    desc.full_model = o->full_model != 0;
    if (knurl_scene_create(&desc, &r->scene) || tool_load(r->scene, o->path, &o->budget, &skipped) ||
        (o->method && set_methods(r->scene, o->method_id)) || knurl_scene_commit(r->scene)) {
        return tool_library_error(TOOL_FAILURE, NULL);
    }
    if (knurl_scene_get_surface_count(r->scene) == 0) {
        return tool_error(TOOL_FAILURE,
                          "%s: nothing is tagged, so there is nothing to feel; 'knurl inspect' explains how to tag",
                          o->path);
    }
    return TOOL_OK;
}

/* Prints a note if the trace is in an encoder's counts. */
static int tell_counts(const run *r) {
    knurl_device_info info;
    knurl_device_info_init(&info, sizeof info);
    (void)knurl_device_get_info(r->device, &info);
    if (info.resolution > 0.0 && !(r->options.device && strstr(r->options.device, "resolution="))) {
        tool_tell("note", "%s: positions are in counts of %.4g mm and felt as such; --exact takes them as exact",
                  r->options.trace, 1e3 * info.resolution);
    }
    return TOOL_OK;
}

/* Gives a fake device its hand or trace; a real one is moved by its user. */
static int lay(run *r, knurl_surface_id surface, double *last_t) {
    const run_options *o = &r->options;
    if (!run_is_fake(o)) {
        const char *fakes = o->fast ? "--fast" : o->stroke ? "--stroke" : o->trace ? "--trace" : NULL;
        return fakes ? tool_error(TOOL_USAGE, "run: only the fake device takes %s, found --device %s", fakes, o->device)
                     : stroke_place(r->scene, r->device, surface);
    }
    if (o->trace) {
        const int code = stroke_play(r->scene, r->device, o->trace, last_t);
        return code ? code : tell_counts(r);
    }
    r->travel.stroke = o->stroke_id;
    return stroke_lay(r->scene, r->device, surface, o->stroke_id, &r->travel.stroke_length);
}

/* --exact: positions have no counts, a resolution of 0. */
static knurl_result open_uri(const run_options *o, knurl_device **device) {
    const char *named = o->device ? o->device : "fake";
    if (!o->exact || !run_is_fake(o)) {
        return knurl_device_open(named, device);
    }
    const char *joint = strchr(named, '?') ? "&" : strchr(named, ':') ? "?" : ":?";
    const size_t size = strlen(named) + sizeof ":?resolution=0";
    char *uri = malloc(size);
    if (!uri) {
        return knurl_fail(KNURL_ERROR_MEMORY, "could not get %zu bytes", size);
    }
    (void)snprintf(uri, size, "%s%sresolution=0", named, joint);
    const knurl_result result = knurl_device_open(uri, device);
    free(uri);
    return result;
}

static int open_device(run *r) {
    const run_options *o = &r->options;
    protect_device_files(o->device ? o->device : "");
    const knurl_result result = open_uri(o, &r->device);
    if (result) { /* a device that cannot be opened is a failure; an unknown name is wrong usage */
        const int is_usage = result == KNURL_ERROR_UNKNOWN || result == KNURL_ERROR_ARGUMENT;
        return tool_library_error(is_usage ? TOOL_USAGE : TOOL_FAILURE, "run: --device");
    }
    knurl_surface_id surface = knurl_scene_get_surface(r->scene, 0);
    if (o->surface && knurl_scene_find_surface(r->scene, o->surface, &surface)) {
        return tool_library_error(TOOL_FAILURE, o->path);
    }
    double last_t = 0.0;
    r->surface = surface;
    const int code = lay(r, surface, &last_t);
    if (!isnan(o->seconds)) {
        r->ticks = (uint64_t)fmax(1.0, floor(o->seconds * o->rate + 0.5));
    } else if (o->trace) {
        r->ticks = (uint64_t)floor(last_t * o->rate + 1e-6) + 1; /* including its last row */
    } else {
        r->ticks = (uint64_t)((o->view ? 600.0 : 5.0) * o->rate);
    }
    r->seconds = run_is_fake(o) ? 0.0 : (double)r->ticks / o->rate;
    return code;
}

/* --clamp: keeps the HIP's other settings, such as a workspace that was moved. */
static knurl_result clamp(knurl_scene *scene) {
    knurl_hip_desc desc;
    knurl_workspace workspace;
    knurl_hip_desc_init(&desc, sizeof desc);
    knurl_result result = knurl_scene_get_workspace(scene, 0, &workspace);
    desc.workspace = &workspace;
    desc.clamp = 1;
    return result ? result : knurl_scene_configure_hip(scene, 0, &desc);
}

static void take_tick(const knurl_tick_output *output, void *user) {
    run *r = user;
    travel_add(&r->travel, output);
    if (r->recorder.ring.rows) {
        tick_ring_put(&r->recorder.ring, output);
    }
    if (r->sound.audio) {
        sound_take(&r->sound, output);
    }
    if (r->view) {
        view_take(r->view, output);
    }
}

/* The page is in build/web, beside the preset's folder, where ./run web puts it. */
static int open_view(run *r) {
    char page[4096];
    char index[4096 + 16];
    knurl_device_info device;
    knurl_device_info_init(&device, sizeof device);
    (void)knurl_device_get_info(r->device, &device);
    (void)machine_program("../web", page, sizeof page);
    const view_desc desc = {r->scene, r->options.path, page, device.name, r->options.rate};
    if (view_open(&desc, &r->view) != TOOL_OK) {
        return TOOL_FAILURE;
    }
    (void)snprintf(index, sizeof index, "%s/index.html", page);
    if (access(index, R_OK) != 0) {
        tool_tell("note", "the page is not built, so a browser has nothing to open: ./run web");
    }
    tool_tell("note", "to see what is felt, open %s", view_url(r->view));
    return TOOL_OK;
}

static int make_loop(run *r) {
    knurl_loop_desc desc;
    if (r->options.clamp && clamp(r->scene)) {
        return tool_library_error(TOOL_FAILURE, "run: --clamp");
    }
    if ((r->options.even || r->options.response) &&
        tool_even(r->scene, r->options.response, r->device, r->options.rate) != TOOL_OK) {
        return TOOL_FAILURE;
    }
    knurl_loop_desc_init(&desc, sizeof desc);
    desc.device = r->device;
    desc.scene = r->scene;
    desc.update_rate_hz = r->options.rate;
    desc.tick_limit = r->ticks;
    desc.reconnect = (uint32_t)r->options.reconnect;
    int code = TOOL_OK;
    if (r->options.out) {
        code = recorder_open(&r->recorder, r->options.out, r->scene, r->options.rate);
    }
    if (code == TOOL_OK && r->options.wav) {
        code = sound_open(&r->sound, r->options.wav, r->options.rate);
    }
    if (code == TOOL_OK && r->options.view) {
        code = open_view(r);
    }
    if (code != TOOL_OK) {
        return code;
    }
    desc.tick_callback = take_tick;
    desc.user = r;
    r->travel.period = 1.0 / r->options.rate;
    if (knurl_loop_create(&desc, &r->loop)) {
        return tool_library_error(TOOL_FAILURE, "run");
    }
    (void)tool_warn(r->scene); /* after the loop has passed the device's limits to the scene */
    return TOOL_OK;
}

int run_prepare(run *r) {
    const int code = open_device(r);
    return code == TOOL_OK ? make_loop(r) : code;
}
