/* Study `creases`: a stroke along the crease of two walls of 5 to 175 degrees, as one mesh, two meshes, two meshes
 * without reductions, and two planes: smooth against the closed form, with ridges against one mesh.
 * SPDX-License-Identifier: MIT */
#include "study.h"

#include "say.h"

#include <math.h>
#include <string.h>

#define PI        3.14159265358979323846
#define SIZE      0.1   /* m: of each wall, up and along */
#define DEPTH     0.002 /* m, below the crease */
#define STIFFNESS 800.0 /* N/m */
#define RIDGES    500.0 /* cycles/m, along the crease */
#define AMPLITUDE 0.0002
#define APPROACH  420 /* ticks of 0.1 mm down from above */
#define STROKE    600 /* ticks at 50 mm/s */

enum { ONE_MESH, TWO_MESHES, FULL_MODEL, TWO_PLANES, CUTS };

static const char *const cuts[CUTS] = {"one mesh", "two meshes", "two meshes, full model", "two planes"};

/* Smooth, then the methods. */
static const int32_t methods[] = {0, KNURL_METHOD_S1, KNURL_METHOD_S2, KNURL_METHOD_BANDLIMITED};

#define KINDS (sizeof methods / sizeof *methods)

/* N: of a stroke on one cut. */
typedef struct outcome {
    double rest;      /* the force before it moves */
    double off;       /* largest difference from the closed form if smooth, else from one mesh */
    double low, high; /* of what the ridges add, away from the crease */
} outcome;

/* Corners and indices of a wall from the crease up, to the right (1) or left (-1). */
static void add_wall(double half, float side, float *positions, uint32_t first, uint32_t *indices) {
    const float x = side * (float)(SIZE * sin(half)), y = side * (float)(SIZE / 2), z = (float)(SIZE * cos(half));
    const float corners[12] = {0.0f, -y, 0.0f, 0.0f, y, 0.0f, x, y, z, x, -y, z};
    const uint32_t triangles[6] = {0, 2, 1, 0, 3, 2};
    memcpy(positions, corners, sizeof corners);
    for (int i = 0; i < 6; i++) {
        indices[i] = first + triangles[i];
    }
}

static knurl_result add_surfaces(knurl_scene *scene, int cut, double half, const knurl_surface_desc *like) {
    float positions[24];
    uint32_t indices[12];
    knurl_mesh_desc mesh;
    knurl_plane_desc plane;
    knurl_surface_desc surface = *like;
    knurl_result result = KNURL_OK;
    knurl_mesh_desc_init(&mesh, sizeof mesh);
    knurl_plane_desc_init(&plane, sizeof plane);
    for (int i = 0; i < (cut == ONE_MESH ? 1 : 2) && !result; i++) {
        const float side = i ? -1.0f : 1.0f;
        add_wall(half, side, positions, 0, indices);
        add_wall(half, -side, positions + 12, 4, indices + 6);
        mesh.positions = positions;
        mesh.indices = indices;
        mesh.vertex_count = cut == ONE_MESH ? 8 : 4;
        mesh.index_count = cut == ONE_MESH ? 12 : 6;
        surface.mesh = &mesh;
        if (cut == TWO_PLANES) {
            const double tilt = 0.25 * PI - 0.5 * half;
            plane.half_extents[0] = plane.half_extents[1] = SIZE / 2;
            surface.mesh = NULL;
            surface.plane = &plane;
            surface.position[0] = (double)side * 0.5 * SIZE * sin(half);
            surface.position[2] = 0.5 * SIZE * cos(half);
            surface.rotation[1] = (double)-side * sin(tilt);
            surface.rotation[3] = cos(tilt);
        }
        result = knurl_scene_add_surface(scene, &surface, NULL);
    }
    return result;
}

static knurl_result build(int cut, double half, int32_t method, knurl_scene **scene) {
    knurl_scene_desc desc;
    knurl_surface_desc surface;
    knurl_material_desc material;
    knurl_hip_desc hip;
    knurl_workspace workspace;
    knurl_scene_desc_init(&desc, sizeof desc);
    knurl_surface_desc_init(&surface, sizeof surface);
    knurl_material_desc_init(&material, sizeof material);
    knurl_hip_desc_init(&hip, sizeof hip);
    knurl_workspace_set_identity(&workspace);
    desc.full_model = cut == FULL_MODEL;
    material.stiffness = STIFFNESS;
    if (method) {
        material.method = method;
        material.spatial_frequency[0] = RIDGES;
        material.amplitude = AMPLITUDE;
    }
    surface.material = &material;
    surface.axis[1] = 1.0;
    hip.workspace = &workspace;
    hip.resolution = 0.0;
    hip.protections = 0;
    knurl_result result = knurl_scene_create(&desc, scene);
    result = result ? result : add_surfaces(*scene, cut, half, &surface);
    result = result ? result : knurl_scene_commit(*scene);
    return result ? result : knurl_scene_configure_hip(*scene, 0, &hip);
}

/* Down to below the crease, then along it, aside and back within the wedge that it holds. */
static void place(int tick, double half, knurl_tick_input *input) {
    const int k = tick - APPROACH;
    memset(input, 0, sizeof *input);
    input->has_velocity = 1;
    input->position[0] = k < 0 ? 0.0 : fmin(0.5 * DEPTH / tan(half), 0.0015) * sin(PI * k / 75.0);
    input->position[1] = 0.00131 + (k < 0 ? 0.0 : 5e-5 * k);
    input->position[2] = k < 0 ? 1e-4 * (APPROACH - tick) - DEPTH : -DEPTH;
    input->velocity[1] = k < 0 ? 0.0 : 0.05;
    input->velocity[2] = k < 0 ? -0.1 : 0.0;
}

static double apart(const double a[3], const double b[3]) {
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

/* Strokes all cuts side by side. */
static knurl_result stroke(double half, int32_t method, outcome found[CUTS]) {
    knurl_scene *scenes[CUTS] = {NULL};
    knurl_result result = KNURL_OK;
    memset(found, 0, CUTS * sizeof *found);
    for (int cut = 0; cut < CUTS && !result; cut++) {
        result = build(cut, half, method, &scenes[cut]);
    }
    for (int tick = 0; tick <= APPROACH + STROKE && !result; tick++) {
        knurl_tick_input input;
        knurl_tick_output out[CUTS];
        place(tick, half, &input);
        for (int cut = 0; cut < CUTS && !result; cut++) {
            result = knurl_scene_tick(scenes[cut], 0, &input, &out[cut]);
        }
        const double away[3] = {-STIFFNESS * input.position[0], 0.0, STIFFNESS * DEPTH};
        const double none[3] = {0.0, 0.0, 0.0};
        const double length = apart(away, none);
        for (int cut = 0; cut < CUTS && tick >= APPROACH && !result; cut++) {
            const double *force = out[cut].force;
            const double more = (force[0] * away[0] + force[2] * away[2]) / length - length;
            outcome *o = &found[cut];
            o->rest = tick == APPROACH ? apart(force, none) : o->rest;
            o->off = fmax(o->off, apart(force, method ? out[ONE_MESH].force : away));
            o->low = fmin(o->low, more);
            o->high = fmax(o->high, more);
        }
    }
    for (int cut = 0; cut < CUTS; cut++) {
        knurl_scene_destroy(scenes[cut]);
    }
    return result;
}

static int write_all(FILE *csv, json_writer *json, void *user) {
    outcome worst[KINDS][CUTS];
    (void)user;
    memset(worst, 0, sizeof worst);
    fputs("degrees,felt,cut,rest_n,off_n,low_n,high_n\n", csv);
    json_string(json, "study", "creases");
    json_string(json, "table", "creases.csv");
    for (int degrees = 5; degrees <= 175; degrees += 5) {
        study_progress("creases", degrees / 175.0);
        for (size_t kind = 0; kind < KINDS; kind++) {
            outcome found[CUTS];
            if (stroke(degrees * PI / 360.0, methods[kind], found)) {
                return tool_error(2, "study: creases: %s", knurl_error_message());
            }
            for (int cut = 0; cut < CUTS; cut++) {
                const outcome *o = &found[cut];
                outcome *w = &worst[kind][cut];
                const double cells[] = {o->rest, o->off, o->low, o->high};
                fprintf(csv, "%d,%s,%s", degrees, kind ? knurl_method_name(methods[kind]) : "smooth", cuts[cut]);
                study_end_row(csv, cells, 4);
                w->rest = degrees == 5 ? o->rest : fmin(w->rest, o->rest);
                w->off = fmax(w->off, o->off);
                w->low = fmin(w->low, o->low);
                w->high = fmax(w->high, o->high);
            }
        }
    }
    printf("2 mm below a crease of 5 to 175 degrees, %g N/m; ridges of %g N. Of all angles:\n\n", STIFFNESS,
           STIFFNESS * AMPLITUDE);
    printf("| felt | cut | least force at rest | off, moving (smooth: closed form; else: one mesh) | ridges add |\n"
           "|---|---|---|---|---|\n");
    json_open(json, "rows", '[');
    for (size_t i = 0; i < KINDS * CUTS; i++) {
        const outcome *o = &worst[i / CUTS][i % CUTS];
        const char *felt = i < CUTS ? "smooth" : knurl_method_name(methods[i / CUTS]);
        json_open(json, NULL, '{');
        json_string(json, "felt", felt);
        json_string(json, "cut", cuts[i % CUTS]);
        json_number(json, "rest_n", o->rest);
        json_number(json, "off_n", o->off);
        json_number(json, "low_n", o->low);
        json_number(json, "high_n", o->high);
        json_close(json, '}');
        say(stdout, "| %s | %s", felt, cuts[i % CUTS]);
        printf(" | %.4f N | %.5f N | %.4f to %.4f N |\n", o->rest, o->off, o->low, o->high);
    }
    json_close(json, ']');
    return 0;
}

int study_creases(const char *folder) {
    return study_write(folder, "creases", write_all, NULL);
}
