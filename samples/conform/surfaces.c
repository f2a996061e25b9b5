/* The surfaces of a trial's scene, and the game's changes to them. SPDX-License-Identifier: MIT */
#include "trial.h"

#include <math.h>
#include <string.h>

static void random_material(trial *t, knurl_material_desc *m) {
    knurl_material_desc_init(m, sizeof *m);
    m->method = KNURL_METHOD_S1 + trial_below(t, KNURL_METHOD_BANDLIMITED);
    m->spatial_frequency[0] = trial_uniform(t) < 0.3 ? 0.0 : trial_scale(t, 50.0, 3000.0);
    m->spatial_frequency[1] = trial_uniform(t) < 0.6 ? 0.0 : trial_scale(t, 50.0, 3000.0);
    m->amplitude = trial_uniform(t) < 0.2 ? 0.0 : trial_scale(t, 1e-5, 1e-3);
    m->stiffness = trial_scale(t, 50.0, 4000.0);
    m->damping = trial_uniform(t) < 0.5 ? 0.0 : trial_between(t, 0.0, 5.0);
    m->friction = trial_uniform(t) < 0.5 ? 0.0 : trial_between(t, 0.0, 1.5);
    m->orientation = trial_between(t, -3.0, 3.0);
}

/* Near the HIP, if there was a tick, and turned at random. */
static void random_pose(trial *t, double position[3], double quaternion[4]) {
    const double spread = trial_scale(t, 0.0005, 0.03);
    knurl_tick_output latest;
    memset(&latest, 0, sizeof latest);
    (void)knurl_scene_get_tick(t->scene, 0, &latest, NULL);
    for (int axis = 0; axis < 3; axis++) {
        position[axis] = latest.hip[axis] + trial_between(t, -spread, spread);
    }
    trial_rotation(t, trial_between(t, -3.14159, 3.14159), quaternion);
}

/* A box of 12 triangles, front outwards. */
static void box(trial *t, float corners[24], knurl_mesh_desc *mesh) {
    static const uint32_t faces[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                       2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    for (int axis = 0; axis < 3; axis++) {
        const float half = (float)trial_scale(t, 0.002, 0.05);
        for (int corner = 0; corner < 8; corner++) {
            corners[3 * corner + axis] = corner >> axis & 1 ? half : -half;
        }
    }
    knurl_mesh_desc_init(mesh, sizeof *mesh);
    mesh->vertex_count = 8;
    mesh->positions = corners;
    mesh->indices = faces;
    mesh->index_count = 36;
}

/* Adds a surface, or replaces another. */
static void put_surface(trial *t, int replaced) {
    float corners[24];
    knurl_plane_desc plane;
    knurl_mesh_desc mesh;
    knurl_material_desc material;
    knurl_surface_desc desc;
    knurl_surface_id id = replaced >= 0 ? t->surfaces[replaced] : 0;
    knurl_plane_desc_init(&plane, sizeof plane);
    plane.half_extents[0] = trial_scale(t, 0.002, 0.1);
    plane.half_extents[1] = trial_scale(t, 0.002, 0.1);
    box(t, corners, &mesh);
    random_material(t, &material);
    knurl_surface_desc_init(&desc, sizeof desc);
    if (trial_uniform(t) < 0.6) {
        desc.plane = &plane;
    } else {
        desc.mesh = &mesh;
        desc.axis[trial_below(t, 3)] = trial_uniform(t) < 0.7 ? 1.0 : 0.0; /* all 0: no coordinates */
    }
    desc.double_sided = trial_uniform(t) < 0.5;
    desc.material = &material;
    random_pose(t, desc.position, desc.rotation);
    const knurl_result result = replaced >= 0 ? knurl_scene_replace_surface(t->scene, id, &desc)
                                              : knurl_scene_add_surface(t->scene, &desc, &id);
    if (result == KNURL_OK) {
        judge_surface_is(t->j, id, &material);
        t->surfaces[replaced >= 0 ? replaced : t->surface_count++] = id;
    }
}

void trial_add_surface(trial *t) {
    if (t->surface_count < TRIAL_SURFACES) {
        put_surface(t, -1);
    }
}

void trial_replace_surface(trial *t) {
    if (t->surface_count > 0) {
        put_surface(t, trial_below(t, t->surface_count));
    }
}

void trial_remove_surface(trial *t) {
    if (t->surface_count > 1) {
        const int which = trial_below(t, t->surface_count);
        (void)knurl_scene_remove_surface(t->scene, t->surfaces[which]);
        judge_surface_gone(t->j, t->surfaces[which]);
        t->surfaces[which] = t->surfaces[--t->surface_count];
    }
}

void trial_move_surface(trial *t) {
    double position[3];
    double quaternion[4];
    random_pose(t, position, quaternion);
    judge_edits(t->j);
    (void)knurl_scene_set_transform(t->scene, t->surfaces[trial_below(t, t->surface_count)], position, quaternion,
                                    trial_duration(t));
}

/* The surface's front, +z, turned to `to` (unit). */
static void face(const double to[3], double quaternion[4]) {
    const double turned = 1.0 + to[2];
    const double length = sqrt(to[1] * to[1] + to[0] * to[0] + turned * turned);
    quaternion[0] = length > 1e-6 ? -to[1] / length : 1.0;
    quaternion[1] = length > 1e-6 ? to[0] / length : 0.0;
    quaternion[2] = 0.0;
    quaternion[3] = length > 1e-6 ? turned / length : 0.0;
}

static void move_to(trial *t, knurl_surface_id id, const double at[3], const double quaternion[4], double seconds) {
    judge_wait(t->j);
    judge_edits(t->j);
    judge_leave(t->j);
    (void)knurl_scene_set_transform(t->scene, id, at, quaternion, seconds);
}

void trial_close_over(trial *t) {
    double above[3];
    double below[3];
    double against[3];
    double quaternion[4];
    knurl_tick_output latest;
    const knurl_surface_id id = t->surfaces[trial_below(t, t->surface_count)];
    memset(&latest, 0, sizeof latest);
    (void)knurl_scene_get_tick(t->scene, 0, &latest, NULL);
    if (latest.contacts == 0 || latest.surface == id) {
        return;
    }
    for (int axis = 0; axis < 3; axis++) {
        above[axis] = latest.hip[axis] + 0.002 * latest.normal[axis];
        below[axis] = latest.hip[axis] - 0.02 * latest.normal[axis];
        against[axis] = -latest.normal[axis];
    }
    face(against, quaternion);
    move_to(t, id, above, quaternion, 0.0);
    trial_advance(t, 2);
    move_to(t, id, below, quaternion, trial_between(t, 0.02, 0.1));
    for (int i = 0; i < 50 && !(latest.flags & KNURL_TICK_SQUEEZED); i++) {
        trial_advance(t, 1);
        (void)knurl_scene_get_tick(t->scene, 0, &latest, NULL);
    }
}

void trial_change_material(trial *t) {
    knurl_material_desc material;
    const knurl_surface_id id = t->surfaces[trial_below(t, t->surface_count)];
    random_material(t, &material);
    if (knurl_scene_set_material(t->scene, id, &material) == KNURL_OK) {
        judge_surface_is(t->j, id, &material);
    }
}

int trial_make_scene(trial *t) {
    if (knurl_scene_create(NULL, &t->scene)) {
        return 1;
    }
    for (int i = 1 + trial_below(t, 5); i > 0; i--) {
        trial_add_surface(t);
    }
    knurl_hip_desc hip;
    knurl_hip_desc_init(&hip, sizeof hip);
    hip.slew_rate = t->slew_rate;
    hip.clamp = trial_uniform(t) < 0.2;
    return knurl_scene_configure_hip(t->scene, 0, &hip) || knurl_scene_commit(t->scene);
}
