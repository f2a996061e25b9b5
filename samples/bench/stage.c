/* The scenes of the bench. SPDX-License-Identifier: MIT */
#include "bench.h"

#include "sheet.h"

#include <math.h>
#include <string.h>

#define TILES         100    /* a side */
#define CROWD         40     /* likewise */
#define MOVING_ROWS   10     /* of a field: a thousand tiles */
#define FIELD_SWING   0.0001 /* m */
#define MOVING        10
#define MOVING_SWING  0.005 /* m */
#define MOVING_HEIGHT 0.05  /* m from one to the next below it: only the first is touched */

static void make_material(const bench_case *c, knurl_material_desc *m) {
    knurl_material_desc_init(m, sizeof *m);
    m->method = c->method;
    m->stiffness = BENCH_STIFFNESS;
    m->spatial_frequency[0] = c->finish == BENCH_SMOOTH ? 0.0 : 1.0 / BENCH_PERIOD;
    m->amplitude = c->finish == BENCH_SMOOTH ? 0.0 : BENCH_AMPLITUDE;
    m->friction = c->finish == BENCH_FRICTIONAL ? BENCH_FRICTION : 0.0;
}

static knurl_result add_turned_plane(knurl_scene *scene, const knurl_material_desc *m, const double position[3],
                                     const double rotation[4], double half_x, double half_y) {
    knurl_surface_id surface;
    knurl_surface_desc d;
    knurl_plane_desc plane;
    knurl_surface_desc_init(&d, sizeof d);
    knurl_plane_desc_init(&plane, sizeof plane);
    plane.half_extents[0] = half_x;
    plane.half_extents[1] = half_y;
    memcpy(d.position, position, sizeof d.position);
    memcpy(d.rotation, rotation, sizeof d.rotation);
    d.plane = &plane;
    d.material = m;
    return knurl_scene_add_surface(scene, &d, &surface);
}

static knurl_result add_plane(knurl_scene *scene, const knurl_material_desc *m, const double position[3], double half_x,
                              double half_y) {
    static const double level[4] = {0.0, 0.0, 0.0, 1.0};
    return add_turned_plane(scene, m, position, level, half_x, half_y);
}

static knurl_result add_mesh(knurl_scene *scene, const knurl_material_desc *m, const double position[3],
                             const knurl_mesh_desc *mesh, int32_t smooth) {
    knurl_surface_id surface;
    knurl_surface_desc d;
    knurl_surface_desc_init(&d, sizeof d);
    memcpy(d.position, position, sizeof d.position);
    d.mesh = mesh;
    d.smooth = smooth;
    d.material = m;
    return knurl_scene_add_surface(scene, &d, &surface);
}

/* Tiles side by side, planes and two-triangle meshes in turn. */
static knurl_result add_field(knurl_scene *scene, const knurl_material_desc *m, int tiles, double tile) {
    const float half = (float)(0.5 * tile);
    const float corners[12] = {-half, -half, 0.0F, half, -half, 0.0F, half, half, 0.0F, -half, half, 0.0F};
    const float uvs[8] = {0.0F, 0.0F, 1.0F, 0.0F, 1.0F, 1.0F, 0.0F, 1.0F};
    const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    knurl_mesh_desc mesh;
    knurl_mesh_desc_init(&mesh, sizeof mesh);
    mesh.vertex_count = 4;
    mesh.positions = corners;
    mesh.uvs = uvs;
    mesh.indices = indices;
    mesh.index_count = 6;
    knurl_result result = KNURL_OK;
    for (int i = 0; i < tiles * tiles && !result; i++) {
        const int column = i % tiles - tiles / 2; /* one is in the middle, under the stroke */
        const int row = i / tiles - tiles / 2;
        const double position[3] = {tile * column, tile * row, 0.0};
        result = (column + row) % 2 ? add_mesh(scene, m, position, &mesh, KNURL_SMOOTH_OFF)
                                    : add_plane(scene, m, position, 0.5 * tile, 0.5 * tile);
    }
    return result;
}

static knurl_result add_stack(knurl_scene *scene, const knurl_material_desc *m) {
    knurl_result result = KNURL_OK;
    for (int i = 0; i < MOVING && !result; i++) {
        const double position[3] = {0.0, 0.0, -MOVING_HEIGHT * i};
        result = add_plane(scene, m, position, SHEET_HALF_X, SHEET_HALF_Y);
    }
    return result;
}

/* Planes through the origin that face +z, +y and +x. */
static knurl_result add_corner(knurl_scene *scene, const knurl_material_desc *m, uint32_t planes) {
    static const double origin[3];
    const double quarter = sqrt(0.5);
    const double rotations[3][4] = {{0.0, 0.0, 0.0, 1.0}, {-quarter, 0.0, 0.0, quarter}, {0.0, quarter, 0.0, quarter}};
    knurl_result result = KNURL_OK;
    for (uint32_t i = 0; i < planes && !result; i++) {
        result = add_turned_plane(scene, m, origin, rotations[i], SHEET_HALF_X, SHEET_HALF_X);
    }
    return result;
}

static knurl_result add_surfaces(knurl_scene *scene, const bench_case *c, const knurl_mesh_desc *mesh) {
    static const double origin[3];
    knurl_material_desc m;
    if (bench_is_worst(c->shape)) {
        return bench_worst_add(scene, c);
    }
    make_material(c, &m);
    switch (c->shape) {
    case BENCH_PLANE:
        return add_plane(scene, &m, origin, SHEET_HALF_X, SHEET_HALF_Y);
    case BENCH_MESH:
        return add_mesh(scene, &m, origin, mesh, KNURL_SMOOTH_OFF);
    case BENCH_CURVED:
        return add_mesh(scene, &m, origin, mesh, KNURL_SMOOTH_ON);
    case BENCH_FIELD:
    case BENCH_MOVING_FIELD:
        return add_field(scene, &m, TILES, BENCH_TILE);
    case BENCH_CROWD:
        return add_field(scene, &m, CROWD, BENCH_CROWD_TILE);
    case BENCH_CORNER:
        return add_corner(scene, &m, c->triangles);
    case BENCH_MOVING:
        return add_stack(scene, &m);
    default:
        return KNURL_OK;
    }
}

/* Device axes are the scene's, and positions are exact except for FOAW, so that cases differ only in their ticks. */
static knurl_result configure_hips(knurl_scene *scene, const bench_case *c) {
    knurl_result result = KNURL_OK;
    for (uint32_t hip = 0; hip < c->hips && !result; hip++) {
        knurl_hip_desc d;
        knurl_workspace workspace;
        knurl_workspace_set_identity(&workspace);
        knurl_hip_desc_init(&d, sizeof d);
        d.update_rate_hz = BENCH_RATE;
        d.resolution = c->estimates ? BENCH_RESOLUTION : 0.0;
        d.workspace = &workspace;
        result = knurl_scene_configure_hip(scene, hip, &d);
    }
    return result;
}

static knurl_result measure(bench_stage *stage) {
    for (uint32_t i = 0; i < knurl_scene_get_surface_count(stage->scene); i++) {
        knurl_surface_info info;
        knurl_surface_info_init(&info, sizeof info);
        const knurl_result result =
            knurl_scene_get_surface_info(stage->scene, knurl_scene_get_surface(stage->scene, i), &info);
        if (result) {
            return result;
        }
        stage->bytes += (double)info.bytes;
        stage->triangles += info.triangle_count;
    }
    return KNURL_OK;
}

static knurl_result build(bench_stage *stage, const bench_case *c) {
    knurl_scene_desc d;
    wavy_sheet sheet;
    memset(&sheet, 0, sizeof sheet);
    if ((c->shape == BENCH_MESH || c->shape == BENCH_CURVED) && wavy_sheet_make(c->triangles, &sheet)) {
        return knurl_fail(KNURL_ERROR_MEMORY, "a sheet of %u triangles: no memory", (unsigned)c->triangles);
    }
    const knurl_mesh_desc mesh = wavy_sheet_desc(&sheet);
    knurl_scene_desc_init(&d, sizeof d);
    d.max_surfaces = TILES * TILES;
    d.hip_count = c->hips;
    knurl_result result = knurl_scene_create(&d, &stage->scene);
    result = result ? result : configure_hips(stage->scene, c);
    const int64_t before = bench_now();
    result = result ? result : add_surfaces(stage->scene, c, &mesh);
    result = result ? result : knurl_scene_commit(stage->scene);
    stage->build_ms = 1e-6 * (double)(bench_now() - before);
    wavy_sheet_free(&sheet);
    return result ? result : measure(stage);
}

/* The same scene with another material, so that a mesh is built once for all of its cases. */
static knurl_result change(const bench_stage *stage, const bench_case *c) {
    knurl_material_desc m;
    knurl_result result = configure_hips(stage->scene, c); /* clears their contacts */
    make_material(c, &m);
    for (uint32_t i = 0; i < knurl_scene_get_surface_count(stage->scene) && !result; i++) {
        result = knurl_scene_set_material(stage->scene, knurl_scene_get_surface(stage->scene, i), &m);
    }
    return result;
}

knurl_result bench_stage_reset(const bench_stage *stage, const bench_case *c) {
    return configure_hips(stage->scene, c);
}

knurl_result bench_stage_set(bench_stage *stage, const bench_case *c) {
    if (stage->scene && stage->shape == c->shape && stage->asked_triangles == c->triangles && stage->hips == c->hips) {
        return change(stage, c);
    }
    knurl_scene_destroy(stage->scene);
    memset(stage, 0, sizeof *stage);
    stage->shape = c->shape;
    stage->asked_triangles = c->triangles;
    stage->hips = c->hips;
    const knurl_result result = build(stage, c);
    if (result) { /* do not keep half a scene */
        knurl_scene_destroy(stage->scene);
        stage->scene = NULL;
    }
    return result;
}

/* Moves the tiles of the rows on both sides of the touched one up and down. */
static knurl_result move_field(bench_stage *stage, double seconds, uint32_t *moved) {
    static const double level[4] = {0.0, 0.0, 0.0, 1.0};
    knurl_result result = KNURL_OK;
    for (int i = 0; i < MOVING_ROWS * TILES && !result; i++) {
        const int beside = i / TILES - MOVING_ROWS / 2;
        const int row = beside + (beside >= 0);
        const int column = i % TILES - TILES / 2;
        const uint32_t at = (uint32_t)((row + TILES / 2) * TILES + i % TILES);
        const double position[3] = {BENCH_TILE * column, BENCH_TILE * row,
                                    FIELD_SWING * sin(2.0 * acos(-1.0) * seconds + i)};
        result = knurl_scene_set_transform(stage->scene, knurl_scene_get_surface(stage->scene, at), position, level,
                                           1.0 / BENCH_FRAME_RATE);
        ++*moved;
    }
    return result;
}

static knurl_result move_stack(bench_stage *stage, double seconds, uint32_t *moved) {
    knurl_result result = KNURL_OK;
    for (uint32_t i = 0; i < MOVING && !result; i++) {
        const double swing = sin(2.0 * acos(-1.0) * seconds + i);
        const double position[3] = {MOVING_SWING * swing, 0.0, -MOVING_HEIGHT * i};
        const double half_turn = i > 0 ? 0.05 * swing : 0.0; /* the touched one stays level */
        const double rotation[4] = {sin(half_turn), 0.0, 0.0, cos(half_turn)};
        result = knurl_scene_set_transform(stage->scene, knurl_scene_get_surface(stage->scene, i), position, rotation,
                                           1.0 / BENCH_FRAME_RATE);
        ++*moved;
    }
    return result;
}

knurl_result bench_stage_move(bench_stage *stage, double seconds, uint32_t *moved) {
    return stage->shape == BENCH_MOVING         ? move_stack(stage, seconds, moved)
           : stage->shape == BENCH_MOVING_FIELD ? move_field(stage, seconds, moved)
           : stage->shape == BENCH_WORST_PLANES ? bench_worst_move(stage->scene, seconds, moved)
                                                : KNURL_OK;
}
