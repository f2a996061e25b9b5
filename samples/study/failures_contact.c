/* Failures of contact: surfaces that are open, reversed, too many in one place, or close over the HIP.
 * SPDX-License-Identifier: MIT */
#include "failures.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define K    400.0 /* N/m */
#define TICK 0.001 /* s */
#define PI   3.141592653589793

/* An empty scene with a HIP in its axes; without: KNURL_PROTECT_ bits. 0, or 1 with the library's message. */
static int make_scene(uint32_t without, knurl_scene **scene) {
    knurl_hip_desc hip;
    knurl_workspace workspace;
    knurl_workspace_set_identity(&workspace);
    knurl_hip_desc_init(&hip, sizeof hip);
    hip.workspace = &workspace;
    hip.resolution = 0.0;
    hip.protections = KNURL_PROTECT_ALL & ~without;
    return knurl_scene_create(NULL, scene) || knurl_scene_configure_hip(*scene, 0, &hip);
}

/* Adds a surface: smooth, or with crests if amplitude is not 0. */
static int add_surface(knurl_scene *scene, knurl_surface_desc *desc, double amplitude, knurl_surface_id *id) {
    knurl_material_desc material;
    knurl_material_desc_init(&material, sizeof material);
    material.method = KNURL_METHOD_S1;
    material.stiffness = K;
    material.amplitude = amplitude;
    material.spatial_frequency[0] = amplitude > 0.0 ? 500.0 : 0.0;
    desc->material = &material;
    desc->axis[0] = desc->shape_of ? 0.0 : 1.0; /* it comes with the shape */
    const int failed = knurl_scene_add_surface(scene, desc, id) != KNURL_OK;
    desc->material = NULL;
    return failed;
}

/* A plane of 40 by 40 mm about a point, its front turned about y by an angle (rad) from +z. */
static int add_plane(knurl_scene *scene, double x, double z, double angle, knurl_surface_id *id) {
    knurl_surface_desc desc;
    knurl_plane_desc plane;
    knurl_surface_desc_init(&desc, sizeof desc);
    knurl_plane_desc_init(&plane, sizeof plane);
    plane.half_extents[0] = plane.half_extents[1] = 0.02;
    desc.plane = &plane;
    desc.position[0] = x;
    desc.position[2] = z;
    desc.rotation[1] = sin(0.5 * angle);
    desc.rotation[3] = cos(0.5 * angle);
    return add_surface(scene, &desc, 0.0, id);
}

static int tick_at(knurl_scene *scene, double x, double y, double z, knurl_tick_output *out) {
    knurl_tick_input input;
    memset(&input, 0, sizeof input);
    input.position[0] = x;
    input.position[1] = y;
    input.position[2] = z;
    return knurl_scene_tick(scene, 0, &input, out);
}

static double length(const double v[3]) {
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* --- a crack between two planes --- */

#define CRACK 0.0002 /* m */

/* 1 mm deep over the crack at a speed (m/s). *held: 1 if there is a force 3 mm beyond it. */
static int cross_crack(const failure_sink *sink, const char *series, double speed, int *held) {
    knurl_scene *scene = NULL;
    knurl_surface_id id;
    knurl_tick_output out;
    int failed = make_scene(KNURL_PROTECT_ALL, &scene) || add_plane(scene, -0.02 - 0.5 * CRACK, 0.0, 0.0, &id) ||
                 add_plane(scene, 0.02 + 0.5 * CRACK, 0.0, 0.0, &id) || knurl_scene_commit(scene) ||
                 tick_at(scene, -0.003, 0.0, 0.001, &out);
    double x = -0.003;
    while (!failed && x < 0.003) {
        failed = tick_at(scene, x, 0.0, -0.001, &out);
        *held = length(out.force) > 0.0;
        failure_point(sink, series, 1e3 * x, length(out.force));
        x += speed * TICK;
    }
    knurl_scene_destroy(scene);
    return failed;
}

int failure_contact_crack(const failure_sink *sink, double *number) {
    const failure_sink nowhere = {NULL, sink->id};
    int held = 0;
    int failed = cross_crack(sink, "N at 60 mm/s", 0.06, &held) || cross_crack(sink, "at 20 mm/s", 0.02, &held);
    held = 0;
    for (int i = 20; !failed && !held && i < 100; i++) {
        *number = i;
        failed = cross_crack(&nowhere, "", 1e-3 * i, &held);
    }
    return !failed;
}

/* --- mixed winding that is not repaired --- */

/* A flat sheet of 16 by 16 quads of 2.5 mm, of which every second triangle faces down, and one edge is split: a
 * T-junction. */
static int add_mixed_sheet(knurl_scene *scene) {
    enum { CELLS = 16, TRIANGLES = 2 * CELLS * CELLS + 1 };
    static const int quad[6][2] = {{0, 0}, {1, 0}, {1, 1}, {1, 1}, {0, 0}, {0, 1}}; /* the second one faces down */
    float *p = malloc(9 * TRIANGLES * sizeof *p);
    knurl_surface_desc desc;
    knurl_mesh_desc mesh;
    knurl_surface_id id;
    if (!p) {
        return 1;
    }
    for (int i = 0; i < 6 * CELLS * CELLS; i++) {
        const int column = i / 6 / CELLS + quad[i % 6][0], row = i / 6 % CELLS + quad[i % 6][1];
        p[3 * i] = 0.0025f * (float)column - 0.02f;
        p[3 * i + 1] = 0.0025f * (float)row - 0.02f;
        p[3 * i + 2] = 0.0f;
    }
    float *last = &p[9 * (TRIANGLES - 1)], *first = &p[18 * (CELLS * CELLS / 2 + CELLS / 2)];
    memcpy(last, first, 9 * sizeof *p);
    last[0] = first[3] = 0.5f * (first[0] + first[3]);
    knurl_surface_desc_init(&desc, sizeof desc);
    knurl_mesh_desc_init(&mesh, sizeof mesh);
    mesh.positions = p;
    mesh.vertex_count = 3 * TRIANGLES;
    desc.mesh = &mesh;
    const int failed = add_surface(scene, &desc, 0.0, &id);
    free(p);
    return failed;
}

/* Presses of 1 mm, 1 mm apart. */
int failure_contact_winding(const failure_sink *sink, double *number) {
    enum { PRESSES = 31, TICKS = 20 };
    knurl_scene *scene = NULL;
    knurl_tick_output out;
    int lost = 0;
    int failed = make_scene(KNURL_PROTECT_ALL, &scene) || add_mixed_sheet(scene) || knurl_scene_commit(scene);
    for (int i = 0; i < PRESSES * PRESSES && !failed; i++) {
        const int column = i / PRESSES, row = i % PRESSES;
        const double x = 0.001 * column - 0.0151, y = 0.001 * row - 0.0153;
        for (int k = 0; k <= TICKS && !failed; k++) {
            failed = tick_at(scene, x, y, 0.001 - 0.0001 * k, &out);
        }
        lost += !(length(out.force) > 0.0);
        if (column == 1) {
            failure_point(sink, "N, 1 mm deep", 1e3 * y, length(out.force));
        }
        failed = failed || tick_at(scene, x, y, 0.002, &out);
    }
    knurl_scene_destroy(scene);
    *number = 100.0 * lost / (PRESSES * PRESSES);
    return !failed;
}

/* --- many meshes in one place, and crests that reach through a mesh --- */

#define RADIUS 0.03 /* m */

/* `count` spheres of 96 by 48 quads, 10 um apart. */
static int add_spheres(knurl_scene *scene, int count, double radius, double amplitude) {
    enum { ROUND = 96, DOWN = 48 };
    float *p = malloc(3 * (ROUND + 1) * (DOWN + 1) * sizeof *p);
    uint32_t *indices = malloc(6 * ROUND * DOWN * sizeof *indices);
    knurl_surface_desc desc;
    knurl_mesh_desc mesh;
    knurl_surface_id id = 0;
    int failed = !p || !indices;
    for (uint32_t v = 0; !failed && v < (ROUND + 1) * (DOWN + 1); v++) {
        const uint32_t column = v % (ROUND + 1) % ROUND, row = v / (ROUND + 1);
        const double a = 2.0 * PI * column / ROUND, b = PI * row / DOWN;
        p[3 * v] = (float)(radius * cos(a) * sin(b));
        p[3 * v + 1] = (float)(radius * sin(a) * sin(b));
        p[3 * v + 2] = (float)(radius * cos(b));
    }
    for (uint32_t i = 0; !failed && i < ROUND * DOWN; i++) {
        const uint32_t v = i / ROUND * (ROUND + 1) + i % ROUND;
        const uint32_t corners[6] = {v, v + ROUND + 1, v + 1, v + 1, v + ROUND + 1, v + ROUND + 2};
        memcpy(&indices[6 * i], corners, sizeof corners);
    }
    knurl_surface_desc_init(&desc, sizeof desc);
    knurl_mesh_desc_init(&mesh, sizeof mesh);
    mesh.positions = p;
    mesh.vertex_count = (ROUND + 1) * (DOWN + 1);
    mesh.indices = indices;
    mesh.index_count = 6 * ROUND * DOWN;
    desc.mesh = &mesh;
    for (int i = 0; i < count && !failed; i++) {
        desc.position[0] = 1e-5 * i;
        failed = add_surface(scene, &desc, amplitude, &id);
        desc.mesh = NULL;
        desc.shape_of = id;
    }
    free(p);
    free(indices);
    return failed;
}

/* 32 spheres: in by 1 mm, then along at 100 mm/s. */
int failure_contact_crowd(const failure_sink *sink, double *number) {
    knurl_scene *scene = NULL;
    knurl_tick_output out;
    double radius = RADIUS + 0.002, angle = 0.29;
    int failed =
        make_scene(KNURL_PROTECT_ALL, &scene) || add_spheres(scene, 32, RADIUS, 0.0) || knurl_scene_commit(scene);
    *number = 0.0;
    for (int k = 0; k < 160 && !failed; k++) {
        radius = fmax(RADIUS - 0.001, radius - 1e-4);
        angle += radius > RADIUS - 0.001 ? 0.0 : 1e-4 / RADIUS;
        failed = tick_at(scene, radius * sin(angle), 0.0, radius * cos(angle), &out);
        const double off[3] = {out.proxy[0] - out.hip[0], out.proxy[1] - out.hip[1], out.proxy[2] - out.hip[2]};
        const double behind = 1e3 * (length(off) - fmax(0.0, RADIUS - radius));
        *number = fmax(*number, behind);
        failure_point(sink, "proxy from the HIP, mm", k, 1e3 * length(off));
        failure_point(sink, "its depth", k, 1e3 * fmax(0.0, RADIUS - radius));
    }
    knurl_scene_destroy(scene);
    return !failed;
}

int failure_contact_visits(const failure_sink *sink, double *number) {
    enum { TICKS = 240 };
    knurl_scene *scene = NULL;
    knurl_tick_output out;
    int failed =
        make_scene(KNURL_PROTECT_ALL, &scene) || add_spheres(scene, 1, 0.01, 0.02) || knurl_scene_commit(scene);
    *number = 0.0;
    for (int k = 0; k < TICKS && !failed; k++) {
        const double z = 0.03 - 0.000125 * k;
        failed = tick_at(scene, 0.0001, 0.0002, z, &out);
        *number += (out.flags & KNURL_TICK_VISIT_LIMIT) ? 100.0 / TICKS : 0.0;
        failure_point(sink, "1: the limit is met", 1e3 * z, (out.flags & KNURL_TICK_VISIT_LIMIT) != 0);
    }
    knurl_scene_destroy(scene);
    return !failed;
}

/* --- two planes that close --- */

#define HEIGHT 0.004 /* m: of the HIP above the floor */

/* A lid comes down on a floor at 100 mm/s, over a HIP that does not move. The lid is turned by an angle (rad) about
 * its lower edge. *most: N; *squeezed: 1 if the HIP was squeezed. */
static int close_over(const failure_sink *sink, double angle, double *most, int *squeezed) {
    knurl_scene *scene = NULL;
    knurl_surface_id floor, lid;
    knurl_tick_output out;
    const double rotation[4] = {0.0, sin(0.5 * (PI - angle)), 0.0, cos(0.5 * (PI - angle))};
    double at[3] = {0.0, 0.0, HEIGHT + 0.001};
    int failed = make_scene(0, &scene) || add_plane(scene, 0.0, 0.0, 0.0, &floor) ||
                 add_plane(scene, 0.0, at[2], PI - angle, &lid) || knurl_scene_commit(scene) ||
                 tick_at(scene, 0.0, 0.0, HEIGHT, &out);
    *most = 0.0;
    *squeezed = 0;
    for (int k = 0; k < 70 && !failed; k++) {
        at[2] -= 0.0001;
        failed = knurl_scene_set_transform(scene, lid, at, rotation, TICK) || tick_at(scene, 0.0, 0.0, HEIGHT, &out);
        *most = fmax(*most, length(out.force));
        *squeezed |= (out.flags & KNURL_TICK_SQUEEZED) != 0;
        failure_point(sink, "N", k, length(out.force));
    }
    knurl_scene_destroy(scene);
    return failed;
}

int failure_contact_squeezed(const failure_sink *sink, double *number) {
    int squeezed;
    return !close_over(sink, 0.0, number, &squeezed) && squeezed;
}

/* Finds the angle that pushes the HIP out, in steps of 0.1 degrees. */
int failure_contact_wedge(const failure_sink *sink, double *number) {
    const failure_sink nowhere = {NULL, sink->id};
    double most;
    int squeezed = 1;
    int failed = 0;
    for (int i = 10; !failed && squeezed && i < 200; i++) {
        *number = 0.1 * i;
        failed = close_over(&nowhere, *number * PI / 180.0, &most, &squeezed);
        failure_point(sink, "N at most", *number, most);
        failure_point(sink, "1: squeezed", *number, squeezed);
    }
    return !failed;
}
