/* A host's program, compiled with the host's flags: bad input, and strokes over gratings with some positions that are
 * not finite. Prints every result and every force, bit for bit. Its own numbers are made of integers and powers of two,
 * which no flag rounds differently. SPDX-License-Identifier: MIT */
#include <knurl/knurl.h>

#include <stdio.h>
#include <string.h>

#define TICKS 1500
#define ROWS  9 /* of vertices in the bent sheet */

static double from_bits(uint64_t bits) {
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static uint64_t bits_of(double value) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

/* NaN, a signalling NaN, infinities, the largest number. */
static const uint64_t bad_bits[] = {UINT64_C(0x7ff8000000000000), UINT64_C(0x7ff0000000000001),
                                    UINT64_C(0x7ff0000000000000), UINT64_C(0xfff0000000000000),
                                    UINT64_C(0x7fefffffffffffff)};
#define BAD_COUNT (sizeof bad_bits / sizeof *bad_bits)

/* Ridges a millimetre apart. */
static knurl_material_desc good_material(int32_t method) {
    knurl_material_desc material;
    knurl_material_desc_init(&material, sizeof material);
    material.method = method;
    material.spatial_frequency[0] = 1000.0;
    material.amplitude = 0.0002;
    material.stiffness = 400.0;
    material.friction = 0.3;
    return material;
}

/* --- bad input --- */

static void tell(const char *what, size_t which, knurl_result result) {
    printf("%s %u: %d\n", what, (unsigned)which, (int)result);
}

static knurl_result try_surface(const knurl_material_desc *material, const double position[3]) {
    knurl_plane_desc plane;
    knurl_surface_desc surface;
    knurl_scene *scene = NULL;
    knurl_plane_desc_init(&plane, sizeof plane);
    knurl_surface_desc_init(&surface, sizeof surface);
    surface.plane = &plane;
    surface.material = material;
    memcpy(surface.position, position, sizeof surface.position);
    knurl_result result = knurl_scene_create(NULL, &scene);
    result = result ? result : knurl_scene_add_surface(scene, &surface, NULL);
    knurl_scene_destroy(scene);
    return result;
}

static knurl_result try_vertex(double value) {
    float positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    knurl_mesh_desc mesh;
    const knurl_material_desc material = good_material(KNURL_METHOD_S1);
    knurl_surface_desc surface;
    knurl_scene *scene = NULL;
    positions[4] = (float)value;
    knurl_mesh_desc_init(&mesh, sizeof mesh);
    mesh.vertex_count = 3;
    mesh.positions = positions;
    knurl_surface_desc_init(&surface, sizeof surface);
    surface.mesh = &mesh;
    surface.material = &material;
    knurl_result result = knurl_scene_create(NULL, &scene);
    result = result ? result : knurl_scene_add_surface(scene, &surface, NULL);
    knurl_scene_destroy(scene);
    return result;
}

static knurl_result try_hip(const knurl_workspace *workspace, double rate) {
    knurl_hip_desc hip;
    knurl_scene *scene = NULL;
    knurl_hip_desc_init(&hip, sizeof hip);
    hip.workspace = workspace;
    hip.update_rate_hz = rate;
    knurl_result result = knurl_scene_create(NULL, &scene);
    result = result ? result : knurl_scene_configure_hip(scene, 0, &hip);
    knurl_scene_destroy(scene);
    return result;
}

static void give_bad_input(void) {
    const double origin[3] = {0.0, 0.0, 0.0};
    for (size_t i = 0; i < BAD_COUNT; i++) {
        const double bad = from_bits(bad_bits[i]);
        double *fields[7];
        knurl_material_desc material = good_material(KNURL_METHOD_S1);
        fields[0] = &material.spatial_frequency[0];
        fields[1] = &material.spatial_frequency[1];
        fields[2] = &material.amplitude;
        fields[3] = &material.stiffness;
        fields[4] = &material.damping;
        fields[5] = &material.friction;
        fields[6] = &material.orientation;
        for (int k = 0; k < 7; k++) {
            material = good_material(KNURL_METHOD_S1);
            *fields[k] = bad;
            tell("material", 10 * (size_t)k + i, try_surface(&material, origin));
        }
        material = good_material(KNURL_METHOD_S1);
        const double position[3] = {0.0, bad, 0.0};
        tell("position", i, try_surface(&material, position));
        tell("vertex", i, try_vertex(bad));
        knurl_workspace workspace;
        knurl_workspace_set_identity(&workspace);
        tell("rate", i, try_hip(&workspace, bad));
        workspace.scale = bad;
        tell("scale", i, try_hip(&workspace, 1000.0));
        knurl_workspace_set_identity(&workspace);
        workspace.origin[2] = bad;
        tell("origin", i, try_hip(&workspace, 1000.0));
        knurl_wave wave;
        tell("wave", i, knurl_wave_prepare(KNURL_WAVE_T2, 0.01, bad, 1000.0, &wave));
        knurl_velocity velocity;
        tell("velocity", i, knurl_velocity_prepare(KNURL_VELOCITY_FOAW, bad, 1000.0, &velocity));
    }
}

/* --- strokes --- */

/* A sheet of 64 x 32 mm along x and y, bent about y. */
static knurl_result add_sheet(knurl_scene *scene, const knurl_material_desc *material) {
    float positions[2 * ROWS * 3];
    float uvs[2 * ROWS * 2];
    uint32_t indices[(ROWS - 1) * 6];
    knurl_mesh_desc mesh;
    knurl_surface_desc surface;
    for (int i = 0; i < 2 * ROWS; i++) {
        const int along = i / 2 - (ROWS - 1) / 2;
        positions[3 * i] = (float)along / 128.0f;
        positions[3 * i + 1] = (i % 2 ? 1.0f : -1.0f) / 64.0f;
        positions[3 * i + 2] = (float)(-along * along) / 8192.0f;
        uvs[2 * i] = (float)(i / 2) / 8.0f;
        uvs[2 * i + 1] = (float)(i % 2) / 2.0f;
    }
    for (uint32_t i = 0; i < ROWS - 1; i++) {
        const uint32_t corners[6] = {0, 2, 1, 1, 2, 3};
        for (uint32_t k = 0; k < 6; k++) {
            indices[6 * i + k] = 2 * i + corners[k];
        }
    }
    knurl_mesh_desc_init(&mesh, sizeof mesh);
    mesh.vertex_count = 2 * ROWS;
    mesh.positions = positions;
    mesh.uvs = uvs;
    mesh.indices = indices;
    mesh.index_count = (ROWS - 1) * 6;
    knurl_surface_desc_init(&surface, sizeof surface);
    surface.mesh = &mesh;
    surface.material = material;
    return knurl_scene_add_surface(scene, &surface, NULL);
}

static knurl_result add_plane(knurl_scene *scene, const knurl_material_desc *material) {
    knurl_plane_desc plane;
    knurl_surface_desc surface;
    knurl_plane_desc_init(&plane, sizeof plane);
    knurl_surface_desc_init(&surface, sizeof surface);
    surface.plane = &plane;
    surface.material = material;
    return knurl_scene_add_surface(scene, &surface, NULL);
}

/* 1 mm below a plane, back and forth in x at 0.13 m/s, with pauses and invalid positions. */
static void place(int tick, double position[3]) {
    const int phase = tick % 400;
    position[0] = (double)(phase < 200 ? phase - 100 : 300 - phase) / 8192.0;
    position[1] = (double)(tick % 64) / 65536.0;
    position[2] = -1.0 / 1024.0 - (double)(tick % 16) / 65536.0;
    if (tick % 97 == 96) {
        position[tick / 97 % 3] = from_bits(bad_bits[(size_t)(tick / 97) % BAD_COUNT]);
    }
}

static int stroke(int32_t method, int is_sheet) {
    knurl_material_desc material = good_material(method);
    knurl_workspace workspace;
    knurl_hip_desc hip;
    knurl_scene *scene = NULL;
    material.spatial_frequency[1] = is_sheet ? 300.0 : 0.0;
    knurl_workspace_set_identity(&workspace);
    knurl_hip_desc_init(&hip, sizeof hip);
    hip.workspace = &workspace;
    knurl_result result = knurl_scene_create(NULL, &scene);
    result = result ? result : is_sheet ? add_sheet(scene, &material) : add_plane(scene, &material);
    result = result ? result : knurl_scene_configure_hip(scene, 0, &hip);
    result = result ? result : knurl_scene_commit(scene);
    for (int tick = 0; tick < TICKS && !result; tick++) {
        knurl_tick_input input;
        knurl_tick_output out;
        memset(&input, 0, sizeof input);
        place(tick, input.position);
        result = knurl_scene_tick(scene, 0, &input, &out);
        printf("force %d %d %d: %x", (int)method, is_sheet, tick, (unsigned)out.flags);
        for (int axis = 0; axis < 3; axis++) {
            printf(" %016llx", (unsigned long long)bits_of(out.device_force[axis]));
        }
        printf(" %016llx\n", (unsigned long long)bits_of(out.height));
    }
    knurl_scene_destroy(scene);
    if (result) {
        (void)fprintf(stderr, "host: %s\n", knurl_error_message());
    }
    return result != KNURL_OK;
}

int main(void) {
#if defined(__x86_64__) || defined(__i386__) /* code linked by gcc -ffast-math sets this for the whole process */
    (void)fprintf(stderr, "subnormal numbers are %s\n", __builtin_ia32_stmxcsr() & 0x8040u ? "flushed to 0" : "kept");
#endif
    give_bad_input();
    int failed = 0;
    for (int is_sheet = 0; is_sheet < 2; is_sheet++) {
        failed |= stroke(KNURL_METHOD_S1, is_sheet) | stroke(KNURL_METHOD_S2, is_sheet) |
                  stroke(KNURL_METHOD_BANDLIMITED, is_sheet);
    }
    return failed;
}
