/* Scenes, their queries and the sound when memory runs out. SPDX-License-Identifier: MIT */
#include "memory/failing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define CELLS 12 /* along each side of the hills */

static knurl_scene *scene;
static knurl_audio *audio;
static knurl_surface_id plane, hills; /* in it */

static float positions[(CELLS + 1) * (CELLS + 1) * 3];
static float uvs[(CELLS + 1) * (CELLS + 1) * 2];
static uint32_t indices[CELLS * CELLS * 6];

/* --- surfaces to add --- */

static knurl_material_desc a_material(void) {
    knurl_material_desc material;
    knurl_material_desc_init(&material, sizeof material);
    material.stiffness = 400.0;
    material.amplitude = 2e-4;
    material.spatial_frequency[0] = 800.0;
    return material;
}

static knurl_result add_plane(knurl_surface_id *id) {
    const knurl_material_desc material = a_material();
    knurl_plane_desc shape;
    knurl_surface_desc desc;
    knurl_plane_desc_init(&shape, sizeof shape);
    knurl_surface_desc_init(&desc, sizeof desc);
    desc.material = &material;
    desc.plane = &shape;
    desc.name = "plane";
    return knurl_scene_add_surface(scene, &desc, id);
}

/* 12 x 12 cells of hills with a corner cut off; flat: they become a plane with an outline. */
static knurl_mesh_desc a_mesh(int flat) {
    knurl_mesh_desc mesh;
    uint32_t corner = 0;
    for (uint32_t i = 0; i <= CELLS; i++) {
        for (uint32_t j = 0; j <= CELLS; j++) {
            const uint32_t v = i * (CELLS + 1) + j;
            positions[3 * v] = 0.01f * (float)j;
            positions[3 * v + 1] = 0.01f * (float)i;
            positions[3 * v + 2] = flat ? 0.0f : 0.002f * (float)((i * j) % 5);
            uvs[2 * v] = (float)j / CELLS;
            uvs[2 * v + 1] = (float)i / CELLS;
            if (i < CELLS && j < CELLS && i + j < 2 * CELLS - 3) {
                const uint32_t next = v + CELLS + 1;
                const uint32_t quad[6] = {v, v + 1, next + 1, v, next + 1, next};
                memcpy(&indices[corner], quad, sizeof quad);
                corner += 6;
            }
        }
    }
    knurl_mesh_desc_init(&mesh, sizeof mesh);
    mesh.vertex_count = (CELLS + 1) * (CELLS + 1);
    mesh.positions = positions;
    mesh.uvs = uvs;
    mesh.indices = indices;
    mesh.index_count = corner;
    return mesh;
}

static knurl_result with_mesh(int flat, knurl_surface_id replaced, knurl_surface_id *id) {
    const knurl_material_desc material = a_material();
    const knurl_mesh_desc mesh = a_mesh(flat);
    knurl_surface_desc desc;
    knurl_surface_desc_init(&desc, sizeof desc);
    desc.material = &material;
    desc.mesh = &mesh;
    desc.name = flat ? "flat" : "hills";
    desc.position[2] = -0.005;
    return replaced ? knurl_scene_replace_surface(scene, replaced, &desc) : knurl_scene_add_surface(scene, &desc, id);
}

static knurl_result add_twin(void) {
    const knurl_material_desc material = a_material();
    knurl_surface_desc desc;
    knurl_surface_desc_init(&desc, sizeof desc);
    desc.material = &material;
    desc.shape_of = hills;
    desc.position[0] = 0.2;
    return knurl_scene_add_surface(scene, &desc, NULL);
}

/* --- before and after --- */

static void make_empty(void) {
    knurl_scene_desc desc;
    knurl_scene_desc_init(&desc, sizeof desc);
    desc.hip_count = 2;
    failing_need(knurl_scene_create(&desc, &scene));
}

static void tick(int count) {
    for (int i = 0; i < count; i++) {
        const knurl_tick_input input = {{0.01 + 1e-5 * i, 0.01, -0.0005}, {0.0, 0.0, 0.0}, 0, 0, 0.0, 0, {0}};
        knurl_tick_output output;
        failing_need(knurl_scene_tick(scene, 0, &input, &output));
    }
}

static void make_uncommitted(void) {
    make_empty();
    failing_need(add_plane(&plane));
    failing_need(with_mesh(0, 0, &hills));
    for (int i = 0; i < 2; i++) { /* one more makes the tables grow */
        failing_need(add_plane(NULL));
    }
}

/* A plane and hills, committed and ticked: an edit must keep objects that a tick may use. */
static void make_full(void) {
    make_uncommitted();
    failing_need(knurl_scene_commit(scene));
    tick(20);
}

static void free_scene(void) {
    knurl_scene_destroy(scene);
    scene = NULL;
}

static void scene_state(char *text, size_t size) {
    knurl_scene_collect(scene);
    size_t used = 0; /* bytes are left out: tables that have grown stay */
    for (uint32_t i = 0; i < knurl_scene_get_surface_count(scene) && used < size; i++) {
        const knurl_surface_id id = knurl_scene_get_surface(scene, i);
        knurl_surface_info info;
        knurl_material_desc material;
        knurl_surface_info_init(&info, sizeof info);
        knurl_material_desc_init(&material, sizeof material);
        failing_need(knurl_scene_get_surface_info(scene, id, &info));
        failing_need(knurl_scene_get_material(scene, id, &material));
        used += (size_t)snprintf(text + used, size - used, "%llx %s %s %u %g; ", (unsigned long long)id, info.name,
                                 info.model, (unsigned)info.triangle_count, material.stiffness);
    }
    knurl_workspace workspace;
    knurl_hip_counts counts;
    knurl_tick_output output;
    if (used < size && knurl_scene_get_workspace(scene, 0, &workspace) == KNURL_OK &&
        knurl_scene_get_tick(scene, 0, &output, &counts) == KNURL_OK) {
        (void)snprintf(text + used, size - used, "%g %g, %llu ticks, %g", workspace.origin[0], workspace.scale,
                       (unsigned long long)counts.ticks, output.force[2]);
    }
}

/* --- calls --- */

static knurl_result call_create(void) {
    knurl_scene_desc desc;
    knurl_scene *made = NULL;
    knurl_scene_desc_init(&desc, sizeof desc);
    const knurl_result result = knurl_scene_create(&desc, &made);
    failing_need(result && made ? KNURL_ERROR_STATE : KNURL_OK); /* outputs are untouched */
    knurl_scene_destroy(made);
    return result;
}

static knurl_result call_add_plane(void) {
    return add_plane(NULL);
}

static knurl_result call_add_hills(void) {
    return with_mesh(0, 0, NULL);
}

static knurl_result call_add_flat(void) {
    return with_mesh(1, 0, NULL);
}

static knurl_result call_replace(void) {
    return with_mesh(1, hills, NULL);
}

static knurl_result call_replace_plane(void) {
    return with_mesh(0, plane, NULL);
}

static knurl_result call_remove(void) {
    return knurl_scene_has_surface(scene, hills) ? knurl_scene_remove_surface(scene, hills) : KNURL_OK;
}

static knurl_result call_commit(void) {
    return knurl_scene_commit(scene);
}

static knurl_result call_set_material(void) {
    knurl_material_desc material = a_material();
    material.stiffness = 500.0;
    return knurl_scene_set_material(scene, hills, &material);
}

static knurl_result call_set_transform(void) {
    const double position[3] = {0.01, 0.0, 0.0};
    const double rotation[4] = {0.0, 0.0, 0.0, 1.0};
    return knurl_scene_set_transform(scene, hills, position, rotation, 0.5);
}

static knurl_result call_configure(void) {
    knurl_hip_desc hip;
    knurl_hip_desc_init(&hip, sizeof hip);
    hip.max_force = 2.0;
    const knurl_gain gains[] = {{30.0, 1.0}, {300.0, 0.5}};
    const knurl_result result = knurl_scene_configure_hip(scene, 0, &hip);
    return result ? result : knurl_scene_set_gains(scene, 0, gains, 2);
}

static knurl_result call_set_effects(void) {
    knurl_effect effect;
    const knurl_result result = knurl_effect_prepare(KNURL_EFFECT_SPRING, &effect);
    return result ? result : knurl_scene_set_effects(scene, 0, &effect, 1, 0.0);
}

static knurl_result call_set_workspace(void) {
    knurl_workspace workspace;
    knurl_workspace_set_identity(&workspace);
    workspace.origin[0] = 0.02;
    return knurl_scene_set_workspace(scene, 0, &workspace, 0.1);
}

static knurl_result call_find_surface(void) {
    knurl_surface_id id = 0;
    char name[KNURL_NAME_SIZE];
    const knurl_result result = knurl_scene_find_surface(scene, "hills", &id);
    return result ? result : knurl_scene_get_surface_name(scene, id, name);
}

static knurl_result call_find_unknown(void) {
    knurl_surface_id id = 0;
    return knurl_scene_find_surface(scene, "valleys", &id);
}

static knurl_result call_find_closest(void) {
    const double at[3] = {0.03, 0.03, 0.02};
    const double below[3] = {0.03, 0.03, -0.02};
    knurl_surface_point point;
    knurl_surface_point_init(&point, sizeof point);
    knurl_result result = knurl_scene_find_closest(scene, at, 0.1, &point);
    result = result ? result : knurl_scene_find_closest_batch(scene, at, 1, 0.1, &point);
    return result ? result : knurl_scene_cast_ray(scene, at, below, &point);
}

static knurl_result call_check_surface(void) {
    knurl_surface_check check;
    knurl_surface_check_init(&check, sizeof check);
    return knurl_scene_check_surface(scene, 0, hills, &check);
}

/* Everything that reads, and ticks. */
static knurl_result call_getters(void) {
    char text[4096];
    knurl_hip_contact contacts[4];
    const knurl_tick_input inputs[2] = {{{0.0, 0.0, -0.001}, {0.0, 0.0, 0.0}, 0, 0, 0.0, 0, {0}},
                                        {{0.0, 0.0, -0.002}, {0.0, 0.0, 0.0}, 0, 0, 0.0, 0, {0}}};
    knurl_tick_output outputs[2];
    scene_state(text, sizeof text);
    (void)knurl_scene_get_contacts(scene, 0, contacts, 4);
    (void)knurl_scene_get_bytes(scene);
    (void)knurl_scene_lock_memory(scene);
    return knurl_scene_tick_batch(scene, 0, inputs, 2, outputs);
}

static double no_height(const knurl_method_input *input, double *memory, void *user) KNURL_NONBLOCKING {
    (void)input;
    (void)memory;
    (void)user;
    return 0.0;
}

static knurl_result call_small_things(void) {
    char line[32];
    int32_t method = 0;
    knurl_velocity velocity;
    knurl_workspace workspace;
    knurl_grating grating;
    knurl_wave wave;
    knurl_vibration_event event;
    knurl_gain gains[KNURL_GAINS];
    memset(&grating, 0, sizeof grating);
    knurl_workspace_set_identity(&workspace);
    (void)knurl_grating_check(&grating);
    (void)knurl_workspace_check(&workspace);
    (void)knurl_text_line(line, sizeof line, "a\nb");
    (void)knurl_method_name(1);
    (void)knurl_method_from_name("S2", &method);
    (void)knurl_method_from_name("S3", &method);
    (void)knurl_method_add("own", 1.0, no_height, NULL, &method);
    (void)knurl_wave_prepare(KNURL_WAVE_T3, 0.01, 1e-4, 1000.0, &wave);
    (void)knurl_vibration_event_prepare(10.0, 1e-4, &event);
    (void)knurl_velocity_prepare(KNURL_VELOCITY_FOAW, 1e-5, 1000.0, &velocity);
    (void)knurl_gains_from_plant(0.045, 0.5, 1000.0, gains);
    (void)knurl_gains_from_response("", 0, gains);
    (void)knurl_result_string(KNURL_ERROR_MEMORY);
    (void)knurl_version_string();
    (void)knurl_version_number();
    (void)knurl_fail(KNURL_ERROR_STATE, "%s", "a message");
    return strcmp(knurl_error_message(), "a message") == 0 ? KNURL_OK : KNURL_ERROR_STATE;
}

static knurl_result call_audio_create(void) {
    float samples[64];
    const knurl_tick_output output = {.height = 1e-4};
    const knurl_result result = knurl_audio_create(NULL, &audio);
    if (!result) {
        knurl_audio_take(&output, audio);
        double rumble[2];
        knurl_audio_fill(audio, samples, 64);
        return knurl_audio_get_rumble(audio, rumble);
    }
    return result;
}

static void free_audio(void) {
    knurl_audio_destroy(audio);
    audio = NULL;
}

TEST(a_scene_is_as_it_was_wherever_memory_runs_out) {
    const failing_call calls[] = {
        {"knurl_scene_create()", NULL, call_create, NULL, NULL, 0, 0},
        {"knurl_scene_add_surface() of the first plane", make_empty, call_add_plane, free_scene, scene_state, 0, 0},
        {"... of a plane", make_full, call_add_plane, free_scene, scene_state, 0, 0},
        {"... of hills", make_full, call_add_hills, free_scene, scene_state, 0, 0},
        {"... of a flat mesh", make_full, call_add_flat, free_scene, scene_state, 0, 0},
        {"... of a shape that is there", make_full, add_twin, free_scene, scene_state, 0, 0},
        {"knurl_scene_replace_surface() of hills", make_full, call_replace, free_scene, scene_state, 0, 0},
        {"... of a plane", make_full, call_replace_plane, free_scene, scene_state, 0, 0},
        {"knurl_scene_remove_surface()", make_full, call_remove, free_scene, scene_state, 0, 0},
        {"knurl_scene_commit()", make_uncommitted, call_commit, free_scene, scene_state, 0, 0},
        {"knurl_scene_set_material()", make_full, call_set_material, free_scene, scene_state, 0, 0},
        {"knurl_scene_set_transform()", make_full, call_set_transform, free_scene, scene_state, 0, 0},
        {"knurl_scene_configure_hip()", make_full, call_configure, free_scene, scene_state, 0, 0},
        {"knurl_scene_set_effects()", make_full, call_set_effects, free_scene, scene_state, 0, 0},
        {"knurl_scene_set_workspace()", make_full, call_set_workspace, free_scene, scene_state, 0, 0},
        {"knurl_scene_find_surface()", make_full, call_find_surface, free_scene, scene_state, 0, 0},
        {"... of an unknown name", make_full, call_find_unknown, free_scene, scene_state, 1, 0},
        {"knurl_scene_find_closest(), _find_closest_batch(), _cast_ray()", make_full, call_find_closest, free_scene,
         scene_state, 0, 0},
        {"knurl_scene_check_surface()", make_full, call_check_surface, free_scene, scene_state, 0, 0},
        {"knurl_scene_get_...(), _collect(), _tick()", make_full, call_getters, free_scene, NULL, 0, 0},
        {"gratings, estimators, workspaces, names", NULL, call_small_things, NULL, NULL, 0, 0},
        {"knurl_audio_create()", NULL, call_audio_create, free_audio, NULL, 0, 0},
    };
    failing_run(calls, COUNT_OF(calls));
}
