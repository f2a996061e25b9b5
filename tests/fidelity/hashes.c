/* Hashes of the library's results, one line each: ticks of every method on a plane, a mesh, in a corner and on a
 * surface that moves, and temporal signals. Builds by other compilers or for other machines must print the same
 * (same_numbers.py). Nothing in this file calls libm, which differs between machines; the library does for
 * surfaces that move.
 * SPDX-License-Identifier: MIT */
#include <knurl/knurl.h>

#include <inttypes.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define TICKS 8000
#define SIDE  24 /* vertices of the mesh along x and y */

static void need(int good, const char *what) {
    if (!good) {
        fprintf(stderr, "hashes: %s: %s\n", what, knurl_error_message());
        exit(1);
    }
}

/* FNV-1a. */
static uint64_t hash_bytes(uint64_t hash, const void *data, size_t size) {
    const unsigned char *byte = data;
    for (size_t i = 0; i < size; i++) {
        hash = (hash ^ byte[i]) * UINT64_C(1099511628211);
    }
    return hash;
}

/* By fields, because an id names its scene. */
static uint64_t hash_tick(uint64_t hash, const knurl_tick_output *out) {
    hash = hash_bytes(hash, out, offsetof(knurl_tick_output, surface));
    hash = hash_bytes(hash, &out->flags, sizeof out->flags + sizeof out->contacts);
    return hash_bytes(hash, out->cycles, sizeof out->cycles);
}

/* -1 to 1 and back within 2 of t, smooth at both ends. */
static double swing(double t) {
    const int64_t whole = (int64_t)(0.5 * t);
    const double u = t - 2.0 * (double)whole;
    const double s = u < 1.0 ? u : 2.0 - u;
    return 2.0 * s * s * (3.0 - 2.0 * s) - 1.0;
}

static void find_position(int tick, double position[3]) {
    const double t = (double)tick;
    position[0] = 0.04 * swing(t / 260.0);
    position[1] = 0.03 * swing(t / 710.0);
    position[2] = 0.002 * swing(t / 1900.0) - 0.0005;
}

static void make_mesh(float *positions, float *uvs, uint32_t *indices, knurl_mesh_desc *mesh) {
    uint32_t n = 0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        const double u = (double)(i % SIDE) / (SIDE - 1), v = (double)(i / SIDE) / (SIDE - 1); // NOLINT
        positions[3 * i] = (float)(0.1 * u - 0.05);
        positions[3 * i + 1] = (float)(0.1 * v - 0.05);
        positions[3 * i + 2] = (float)(0.002 * swing(6.0 * u) * swing(5.0 * v));
        uvs[2 * i] = (float)u;
        uvs[2 * i + 1] = (float)(v * (0.8 + 0.2 * u));
    }
    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        if (i % SIDE + 1 < SIDE && i + SIDE < SIDE * SIDE) {
            const uint32_t corners[6] = {i, i + 1, i + SIDE, i + SIDE, i + 1, i + SIDE + 1};
            memcpy(indices + n, corners, sizeof corners);
            n += 6;
        }
    }
    knurl_mesh_desc_init(mesh, sizeof *mesh);
    mesh->positions = positions;
    mesh->uvs = uvs;
    mesh->indices = indices;
    mesh->vertex_count = SIDE * SIDE;
    mesh->index_count = n;
}

enum { PLANE, MESH, CORNER, MOVING, KINDS };

static knurl_surface_id fill_scene(knurl_scene *scene, int kind, int32_t method) {
    static float positions[3 * SIDE * SIDE], uvs[2 * SIDE * SIDE];
    static uint32_t indices[6 * SIDE * SIDE];
    knurl_mesh_desc mesh;
    knurl_plane_desc plane;
    knurl_material_desc material;
    knurl_surface_desc surface;
    knurl_surface_id id = 0;
    make_mesh(positions, uvs, indices, &mesh);
    knurl_plane_desc_init(&plane, sizeof plane);
    knurl_material_desc_init(&material, sizeof material);
    knurl_surface_desc_init(&surface, sizeof surface);
    material.method = method;
    material.amplitude = method ? 0.0002 : 0.0;
    material.spatial_frequency[0] = 700.0;
    material.spatial_frequency[1] = kind == PLANE ? 300.0 : 0.0;
    material.friction = 0.4;
    material.damping = 0.5;
    surface.material = &material;
    surface.plane = kind == MESH ? NULL : &plane;
    surface.mesh = kind == MESH ? &mesh : NULL;
    need(knurl_scene_add_surface(scene, &surface, &id) == KNURL_OK, "surface");
    if (kind == CORNER) { /* a wall that leans: a turn about y by 2 atan(3/4) */
        surface.rotation[1] = 0.6;
        surface.rotation[3] = 0.8;
        need(knurl_scene_add_surface(scene, &surface, NULL) == KNURL_OK, "wall");
    }
    return id;
}

static uint64_t run_scene(int kind, int32_t method, uint32_t has_velocity) {
    static const double place[3] = {0.01, 0.005, 0.001}, turned[4] = {0.0, 0.0, 0.28, 0.96};
    knurl_scene *scene = NULL;
    knurl_hip_desc hip;
    knurl_workspace workspace;
    uint64_t hash = UINT64_C(14695981039346656037);
    need(knurl_scene_create(NULL, &scene) == KNURL_OK, "scene");
    const knurl_surface_id id = fill_scene(scene, kind, method);
    knurl_workspace_set_identity(&workspace);
    knurl_hip_desc_init(&hip, sizeof hip);
    hip.workspace = &workspace;
    need(knurl_scene_configure_hip(scene, 0, &hip) == KNURL_OK, "HIP");
    need(knurl_scene_commit(scene) == KNURL_OK, "commit");
    for (int tick = 0; tick < TICKS; tick++) {
        knurl_tick_input input;
        knurl_tick_output output;
        memset(&input, 0, sizeof input);
        find_position(tick, input.position);
        input.has_velocity = has_velocity;
        input.velocity[0] = 0.1 * swing((double)tick / 300.0);
        if (kind == MOVING && tick == 1000) {
            need(knurl_scene_set_transform(scene, id, place, turned, 2.0) == KNURL_OK, "motion");
        }
        need(knurl_scene_tick(scene, 0, &input, &output) == KNURL_OK, "tick");
        hash = hash_tick(hash, &output);
    }
    knurl_scene_destroy(scene);
    return hash;
}

static uint64_t run_signal(int32_t method) {
    uint64_t hash = UINT64_C(14695981039346656037);
    for (int hz = 20; hz <= 480; hz += 20) {
        knurl_wave wave;
        need(knurl_wave_prepare(method, 1.0 / hz, 1.0, 1000.0, &wave) == KNURL_OK, "signal");
        for (uint64_t tick = 0; tick < 2000; tick++) {
            const double value = knurl_wave_value(&wave, tick);
            hash = hash_bytes(hash, &value, sizeof value);
        }
    }
    return hash;
}

int main(void) {
    static const char *const kinds[KINDS] = {"plane", "mesh", "corner", "moving"};
    static const char *const methods[] = {"smooth", "S1", "S2", "bandlimited"};
    for (int kind = 0; kind < KINDS; kind++) {
        for (int32_t method = 0; method <= KNURL_METHOD_BANDLIMITED; method++) {
            printf("%s %s %016" PRIx64 " %016" PRIx64 "\n", kinds[kind], methods[method], run_scene(kind, method, 0),
                   run_scene(kind, method, 1));
        }
    }
    for (int32_t method = KNURL_WAVE_T1; method <= KNURL_WAVE_T3; method++) {
        printf("T%d %016" PRIx64 "\n", (int)(method - KNURL_WAVE_T1 + 1), run_signal(method));
    }
    return 0;
}
