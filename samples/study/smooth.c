/* Study `smooth`: a stroke over a low-poly ring, felt as triangles and as the smooth surface that its normals describe,
 * compared with the ring's closed form; and the costs. SPDX-License-Identifier: MIT */
#include "study.h"

#include "say.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define PI        3.14159265358979323846
#define MAJOR     0.03 /* m, to the middle of the tube */
#define MINOR     0.012
#define DEPTH     0.001
#define STIFFNESS 800.0  /* N/m */
#define WAY       0.0001 /* m a tick: 100 mm/s */
#define TICKS     2000
#define DRAWN     600 /* ticks in the table */
#define ROUNDS    9   /* the fastest one is reported */
#define SMALLEST  0   /* index of the drawn ring */

static const uint32_t rings[] = {24, 36, 72, 144}; /* quads around the ring; half as many around the tube */

typedef struct outcome {
    double degrees, depth,
        step; /* mean error of the normal; worst error of depth as a share of DEPTH; largest step, N */
    double ns;
} outcome;

static void ring_at(double u, double v, double point[3], double normal[3]) {
    normal[0] = cos(v) * cos(u);
    normal[1] = cos(v) * sin(u);
    normal[2] = sin(v);
    for (int i = 0; i < 3; i++) {
        point[i] = MINOR * normal[i] + (i == 0 ? MAJOR * cos(u) : i == 1 ? MAJOR * sin(u) : 0.0);
    }
}

/* A slanted path round the tube, one step per tick. */
static void place(int tick, double hip[3], double normal[3]) {
    ring_at(0.3 + 0.8 * WAY * tick / (MAJOR + MINOR), 0.4 + 0.6 * WAY * tick / MINOR, hip, normal);
    for (int i = 0; i < 3; i++) {
        hip[i] -= DEPTH * normal[i];
    }
}

/* Fills in a ring of 2 n (n / 2) triangles. */
static void make_ring(uint32_t n, float *positions, float *normals, uint32_t *indices) {
    const uint32_t tube = n / 2;
    for (uint32_t i = 0; i < n * tube; i++) {
        double point[3], normal[3];
        const uint32_t round = i / tube;
        ring_at(2.0 * PI * round / n, 2.0 * PI * (i % tube) / tube, point, normal);
        for (uint32_t k = 0; k < 3; k++) {
            positions[3 * i + k] = (float)point[k];
            normals[3 * i + k] = (float)normal[k];
        }
        const uint32_t u = i / tube, v = i % tube, u1 = (u + 1) % n * tube, v1 = (v + 1) % tube;
        const uint32_t corners[6] = {i, u1 + v, u1 + v1, i, u1 + v1, u * tube + v1};
        memcpy(&indices[6 * (size_t)i], corners, sizeof corners);
    }
}

static knurl_result build(uint32_t n, int is_smooth, knurl_scene **scene) {
    const uint32_t vertices = n * (n / 2);
    float *positions = calloc(vertices, 6 * sizeof *positions);
    uint32_t *indices = calloc(vertices, 6 * sizeof *indices);
    knurl_mesh_desc mesh;
    knurl_surface_desc desc;
    knurl_material_desc material;
    knurl_hip_desc hip;
    knurl_workspace workspace;
    knurl_mesh_desc_init(&mesh, sizeof mesh);
    knurl_surface_desc_init(&desc, sizeof desc);
    knurl_material_desc_init(&material, sizeof material);
    knurl_hip_desc_init(&hip, sizeof hip);
    knurl_workspace_set_identity(&workspace);
    knurl_result result = positions && indices ? knurl_scene_create(NULL, scene) : KNURL_ERROR_MEMORY;
    if (!result) {
        make_ring(n, positions, positions + 3 * (size_t)vertices, indices);
        mesh.vertex_count = vertices;
        mesh.positions = positions;
        mesh.normals = is_smooth ? positions + 3 * (size_t)vertices : NULL;
        mesh.indices = indices;
        mesh.index_count = 6 * (uint64_t)vertices;
        material.stiffness = STIFFNESS;
        desc.mesh = &mesh;
        desc.material = &material;
        desc.axis[2] = 1.0;
        hip.workspace = &workspace;
        hip.protections = 0;
        result = knurl_scene_add_surface(*scene, &desc, NULL);
        result = result ? result : knurl_scene_commit(*scene);
        result = result ? result : knurl_scene_configure_hip(*scene, 0, &hip);
    }
    free(positions);
    free(indices);
    return result;
}

static double length_of(const double a[3]) {
    return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

static void judge(const knurl_tick_output *out, const double normal[3], const double last[3], outcome *o) {
    const double force = length_of(out->force);
    const double along = out->force[0] * normal[0] + out->force[1] * normal[1] + out->force[2] * normal[2];
    const double change[3] = {out->force[0] - last[0], out->force[1] - last[1], out->force[2] - last[2]};
    o->degrees += force > 0.0 ? acos(fmin(1.0, along / force)) * 180.0 / PI / TICKS : 0.0;
    o->depth = fmax(o->depth, fabs(force / (STIFFNESS * DEPTH) - 1.0));
    o->step = fmax(o->step, length_of(change));
}

/* One stroke. csv: null, or receives the forces along and across the true normal. */
static knurl_result stroke(knurl_scene *scene, const char *kind, FILE *csv, outcome *o) {
    double last[3] = {0.0, 0.0, 0.0};
    knurl_result result = KNURL_OK;
    struct timespec from, to;
    knurl_tick_output out;
    memset(&out, 0, sizeof out);
    (void)clock_gettime(CLOCK_MONOTONIC, &from);
    for (int tick = -60; tick < TICKS && !result; tick++) { /* first from outside down to the stroke's start */
        knurl_tick_input input;
        double normal[3];
        memset(&input, 0, sizeof input);
        place(tick < 0 ? 0 : tick, input.position, normal);
        for (int i = 0; i < 3 && tick < 0; i++) {
            input.position[i] -= WAY * tick * normal[i];
        }
        input.has_velocity = 1;
        input.absent = tick == -60; /* ends the previous round's contact */
        result = knurl_scene_tick(scene, 0, &input, &out);
        if (o && tick > 0) {
            judge(&out, normal, last, o);
        }
        if (csv && tick >= 0 && tick < DRAWN) {
            const double along = out.force[0] * normal[0] + out.force[1] * normal[1] + out.force[2] * normal[2];
            const double force = length_of(out.force);
            fprintf(csv, "%s", kind);
            study_end_row(
                csv, (const double[3]){1e3 * WAY * tick, along, sqrt(fmax(0.0, force * force - along * along))}, 3);
        }
        memcpy(last, out.force, sizeof last);
    }
    (void)clock_gettime(CLOCK_MONOTONIC, &to);
    if (!o) {
        return result;
    }
    const double ns = (1e9 * (double)(to.tv_sec - from.tv_sec) + (double)(to.tv_nsec - from.tv_nsec)) / (TICKS + 60);
    o->ns = o->ns > 0.0 ? fmin(o->ns, ns) : ns;
    return result;
}

static void print_row(json_writer *json, uint32_t triangles, const char *kind, const outcome *o) {
    json_open(json, NULL, '{');
    json_number(json, "triangles", triangles);
    json_string(json, "kind", kind);
    json_number(json, "degrees", o->degrees);
    json_number(json, "depth", o->depth);
    json_number(json, "step", o->step);
    json_number(json, "ns", o->ns);
    json_close(json, '}');
    say(stdout, "| %s", kind);
    printf(" | %u | %.3f | %.3f %% | %.4f N | %.0f ns |\n", (unsigned)triangles, o->degrees, 100.0 * o->depth, o->step,
           o->ns);
}

static int write_all(FILE *csv, json_writer *json, void *user) {
    static const char *const kinds[] = {"triangles", "smooth"};
    (void)user;
    fputs("kind,mm,along,across\n", csv);
    json_string(json, "study", "smooth");
    json_string(json, "table", "smooth.csv");
    const uint32_t tube = rings[SMALLEST] / 2;
    json_number(json, "drawn", 2.0 * rings[SMALLEST] * tube);
    json_open(json, "rows", '[');
    printf(
        "| felt as | triangles | mean angle (degrees) | worst depth | largest step | tick |\n|---|---|---|---|---|---|\n");
    for (size_t i = 0; i < 2 * sizeof rings / sizeof *rings; i++) {
        const uint32_t n = rings[i / 2];
        knurl_scene *scene = NULL;
        outcome o = {0.0, 0.0, 0.0, 0.0};
        knurl_result result = build(n, i % 2 == 1, &scene);
        for (int round = 0; round < ROUNDS && !result; round++) {
            outcome again = {0.0, 0.0, 0.0, o.ns};
            result = stroke(scene, kinds[i % 2], round == 0 && i / 2 == SMALLEST ? csv : NULL, &again);
            o = again;
        }
        knurl_scene_destroy(scene);
        if (result) {
            return tool_error(2, "study: smooth: %s", knurl_error_message());
        }
        print_row(json, 2 * n * (n / 2), kinds[i % 2], &o);
    }
    json_close(json, ']');
    return 0;
}

int study_smooth(const char *folder) {
    return study_write(folder, "smooth", write_all, NULL);
}
