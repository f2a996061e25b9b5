/* Functions for the page's worker, in WebAssembly: one scene with one HIP, and the same stroke by every method.
 * Positions and forces are in scene axes, m and N. SPDX-License-Identifier: MIT */
#include "web.h"

#include <knurl/gltf.h>
#include <knurl/query.h>

#include <emscripten.h>
#include <math.h>
#include <string.h>

#define ROW     23 /* doubles per tick, see web_tick() */
#define METHODS 3

static knurl_scene *scene;
static knurl_hip_desc hip;
static double quantum; /* m: positions are rounded to it; 0: exact */
static int is_real;    /* 1: the HIP is a device's; 0: the page's hand */
static struct {
    knurl_grating grating;
    knurl_grating_state state;
} others[METHODS]; /* the touched surface by each method */
static knurl_surface_id other_surface;

/* Applies settings that the page made before the first load. */
static void begin_hip(void) {
    if (hip.struct_size == 0) {
        knurl_hip_desc_init(&hip, sizeof hip);
        hip.update_rate_hz = 1000.0;
        hip.resolution = 0.0;
    }
}

static knurl_result open_hip(void) {
    knurl_workspace workspace;
    knurl_workspace_set_identity(&workspace); /* the hand's axes are the scene's */
    hip.workspace = is_real ? NULL : &workspace;
    other_surface = 0;
    return knurl_scene_configure_hip(scene, 0, &hip);
}

knurl_result web_read(const void *data, uint32_t size, const char *name, knurl_scene **out) {
    knurl_scene *fresh = NULL;
    knurl_result result = knurl_scene_create(NULL, &fresh);
    result = result ? result : knurl_gltf_load_memory(fresh, data, size, name, NULL, NULL, NULL);
    result = result ? result : knurl_scene_commit(fresh);
    if (result) {
        knurl_scene_destroy(fresh);
        return result;
    }
    knurl_scene_destroy(*out);
    *out = fresh;
    return KNURL_OK;
}

/* Loads a .glb in place of the present scene. 0, or an error, see web_message(); then the present scene stays. */
EMSCRIPTEN_KEEPALIVE int web_load(const void *data, uint32_t size, const char *name) {
    const knurl_result result = web_read(data, size, name, &scene);
    begin_hip();
    return result ? result : open_hip();
}

EMSCRIPTEN_KEEPALIVE const char *web_message(void) {
    return knurl_error_message();
}

EMSCRIPTEN_KEEPALIVE uint32_t web_count(void) {
    return knurl_scene_get_surface_count(scene);
}

/* A surface's name, valid until the next call, or null. numbers: fsx, fsy, amplitude, stiffness, friction, method,
 * anchor (3), normal (3), x (3), m to the edge along +x and -x. */
EMSCRIPTEN_KEEPALIVE const char *web_surface(uint32_t index, double numbers[17]) {
    static knurl_surface_info info;
    knurl_surface_info_init(&info, sizeof info);
    knurl_material_desc m;
    knurl_material_desc_init(&m, sizeof m);
    const knurl_surface_id surface = knurl_scene_get_surface(scene, index);
    if (knurl_scene_get_surface_info(scene, surface, &info) || knurl_scene_get_material(scene, surface, &m)) {
        return NULL;
    }
    const double first[6] = {
        m.spatial_frequency[0], m.spatial_frequency[1], m.amplitude, m.stiffness, m.friction, m.method};
    memcpy(numbers, first, sizeof first);
    memcpy(numbers + 6, info.anchor, sizeof info.anchor);
    memcpy(numbers + 9, info.anchor_normal, sizeof info.anchor_normal);
    memcpy(numbers + 12, info.anchor_x, sizeof info.anchor_x);
    memcpy(numbers + 15, info.anchor_reach, 2 * sizeof *info.anchor_reach);
    return info.name;
}

/* Changes a surface's material; numbers: the first six of web_surface(). */
EMSCRIPTEN_KEEPALIVE int web_feel(uint32_t index, const double numbers[6]) {
    const knurl_surface_id surface = knurl_scene_get_surface(scene, index);
    knurl_material_desc material;
    knurl_material_desc_init(&material, sizeof material);
    const knurl_result result = knurl_scene_get_material(scene, surface, &material);
    material.spatial_frequency[0] = numbers[0];
    material.spatial_frequency[1] = numbers[1];
    material.amplitude = numbers[2];
    material.stiffness = numbers[3];
    material.friction = numbers[4];
    material.method = (int32_t)numbers[5];
    other_surface = 0;
    return result ? result : knurl_scene_set_material(scene, surface, &material);
}

/* Sets the update rate (Hz), the encoder's count (m; 0: exact), and KNURL_PROTECT_ bits, before or after a load. For an
 * Inverse3 max_force (N, that its motors hold for long, so that their heat needs no memory) and max_stiffness (N/m) are
 * its limits; 0: the HIP is the page's hand. Resets the HIP; after an error all stays. */
EMSCRIPTEN_KEEPALIVE int web_device(double rate, double resolution, uint32_t protections, double max_force,
                                    double max_stiffness) {
    const knurl_hip_desc hip_before = hip;
    const double quantum_before = quantum;
    const int was_real = is_real;
    knurl_hip_desc_init(&hip, sizeof hip);
    hip.update_rate_hz = rate;
    hip.resolution = quantum = resolution;
    hip.protections = protections;
    is_real = max_force > 0.0;
    if (is_real) { /* as sdk/src/device/inverse3 has them */
        hip.clamp = 1;
        hip.resolution = fmax(resolution, 0.00001);
        hip.max_force = hip.continuous_force = max_force;
        hip.max_stiffness = max_stiffness;
        hip.viscous = 0.5;
        hip.delay = 2.0;
    }
    const knurl_result result = scene ? open_hip() : KNURL_OK;
    if (result) {
        hip = hip_before;
        quantum = quantum_before;
        is_real = was_real;
    }
    return result;
}

/* --- ticks --- */

double web_find_index(const knurl_scene *in, knurl_surface_id surface) {
    static uint32_t last;
    if (!surface || knurl_scene_get_surface(in, last) == surface) {
        return surface ? last : -1.0;
    }
    const uint32_t count = knurl_scene_get_surface_count(in);
    for (uint32_t i = 0; i < count; i++) {
        if (knurl_scene_get_surface(in, i) == surface) {
            return last = i;
        }
    }
    return -1.0;
}

/* Gives each method the touched surface's grating, from its first tick on. */
static void begin_others(knurl_surface_id surface) {
    knurl_material_desc m;
    knurl_material_desc_init(&m, sizeof m);
    memset(others, 0, sizeof others);
    other_surface = surface;
    for (int i = 0; i < METHODS && surface && !knurl_scene_get_material(scene, surface, &m); i++) {
        knurl_grating *g = &others[i].grating;
        g->method = KNURL_METHOD_S1 + i;
        memcpy(g->spatial_frequency, m.spatial_frequency, sizeof m.spatial_frequency);
        g->amplitude = m.amplitude;
        g->update_rate_hz = hip.update_rate_hz;
        g->resolution = quantum;
    }
}

/* heights: m, by each method, at the same place and speed. */
static void step_others(const knurl_tick_output *out, float heights[METHODS]) {
    const knurl_surface_id surface = out->flags & KNURL_TICK_CONTACT ? out->surface : 0;
    if (surface != other_surface) {
        begin_others(surface);
    }
    for (int i = 0; i < METHODS; i++) {
        const knurl_grating *g = &others[i].grating;
        knurl_grating_output made = {0};
        double position[2];
        for (int axis = 0; axis < 2; axis++) {
            const double fs = g->spatial_frequency[axis];
            position[axis] = fs > 0.0 ? out->cycles[axis] / fs : 0.0;
        }
        if (surface) {
            knurl_grating_step(g, &others[i].state, position, out->surface_velocity, &made);
        }
        heights[i] = (float)made.height;
    }
}

/* Ticks at `count` positions (3 doubles each; NaN: no position), with a gain of 0 to 1 on the force. rows: force (3),
 * HIP (3), proxy (3), depth, height, f_t, cycles (2), 1 in contact, surface index or -1, t, vx, vy, fs, normal (3);
 * rows.js names them, and knurl run --view sends the same. heights: by S1, S2 and BANDLIMITED, of the same stroke. */
EMSCRIPTEN_KEEPALIVE void web_tick(uint32_t count, const double *positions, double gain, double *rows, float *heights) {
    for (uint32_t k = 0; k < count; k++) {
        knurl_tick_input in;
        knurl_tick_output out = {0}; /* if there is no scene */
        double *row = rows + (size_t)ROW * k;
        memset(&in, 0, sizeof in);
        memcpy(in.position, positions + (size_t)3 * k, sizeof in.position);
        in.absent = !isfinite(in.position[0]);
        in.attenuation = 1.0 - gain;
        for (int i = 0; i < 3 && quantum > 0.0; i++) {
            in.position[i] = quantum * floor(in.position[i] / quantum + 0.5);
        }
        (void)knurl_scene_tick(scene, 0, &in, &out);
        web_voice_take(&out);
        step_others(&out, heights + (size_t)METHODS * k);
        memcpy(row, out.force, sizeof out.force);
        memcpy(row + 3, out.hip, sizeof out.hip);
        memcpy(row + 6, out.proxy, sizeof out.proxy);
        row[9] = out.depth;
        row[10] = out.height;
        row[11] = out.temporal_frequency;
        row[12] = out.cycles[0];
        row[13] = out.cycles[1];
        row[14] = (out.flags & KNURL_TICK_CONTACT) != 0;
        row[15] = web_find_index(scene, out.surface);
        row[16] = (double)out.tick / hip.update_rate_hz;
        row[17] = out.surface_velocity[0];
        row[18] = out.surface_velocity[1];
        row[19] = out.spatial_frequency;
        memcpy(row + 20, out.normal, sizeof out.normal);
    }
}

/* The surface that a straight line meets: line: from (3), to (3); found: point (3), normal (3). 0: no surface. */
EMSCRIPTEN_KEEPALIVE int web_cast(const double line[6], double found[6]) {
    knurl_surface_point point;
    knurl_surface_point_init(&point, sizeof point);
    if (!scene || knurl_scene_cast_ray(scene, line, line + 3, &point) || !point.surface) {
        return 0;
    }
    memcpy(found, point.position, sizeof point.position);
    memcpy(found + 3, point.normal, sizeof point.normal);
    return 1;
}
