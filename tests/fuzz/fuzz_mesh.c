/* Meshes of any triangles against an oracle: the nearest point, found by looking at every triangle in turn, and a
 * stroke through the scene that they are put into. SPDX-License-Identifier: MIT */
#include "fuzz.h"

#include "contact/mesh_build.h"
#include "contact/mesh_query.h"

/* The square of the distance from p to a triangle, by its plane if p is above it, otherwise by its edges: another
 * method than the library's. */
static double square_to_segment(const double p[3], const double a[3], const double b[3]) {
    double along = 0.0;
    double length2 = 0.0;
    double square = 0.0;
    for (int i = 0; i < 3; i++) {
        along += (p[i] - a[i]) * (b[i] - a[i]);
        length2 += (b[i] - a[i]) * (b[i] - a[i]);
    }
    const double t = length2 > 0.0 ? fmin(1.0, fmax(0.0, along / length2)) : 0.0;
    for (int i = 0; i < 3; i++) {
        const double d = p[i] - a[i] - t * (b[i] - a[i]);
        square += d * d;
    }
    return square;
}

static void cross(const double a[3], const double b[3], double out[3]) {
    for (int i = 0; i < 3; i++) {
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
    }
}

static double square_to_triangle(const double p[3], double c[3][3]) {
    double e1[3];
    double e2[3];
    double n[3];
    double best = HUGE_VAL;
    double height = 0.0;
    double area2 = 0.0;
    int inside = 1;
    for (int i = 0; i < 3; i++) {
        e1[i] = c[1][i] - c[0][i];
        e2[i] = c[2][i] - c[0][i];
    }
    cross(e1, e2, n);
    for (int i = 0; i < 3; i++) {
        height += (p[i] - c[0][i]) * n[i];
        area2 += n[i] * n[i];
    }
    for (int k = 0; k < 3; k++) {
        const double *a = c[k];
        const double *b = c[(k + 1) % 3];
        double edge[3];
        double to[3];
        double side[3];
        for (int i = 0; i < 3; i++) {
            edge[i] = b[i] - a[i];
            to[i] = p[i] - a[i];
        }
        cross(edge, to, side);
        inside &= side[0] * n[0] + side[1] * n[1] + side[2] * n[2] >= 0.0;
        best = fmin(best, square_to_segment(p, a, b));
    }
    return inside && area2 > 0.0 ? fmin(best, height * height / area2) : best;
}

static void compare(const knurl_mesh *mesh, const double p[3]) {
    knurl_contact found;
    double square = HUGE_VAL;
    double there = 0.0;
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        double corners[3][3];
        knurl_mesh_corners(mesh, i, corners);
        square = fmin(square, square_to_triangle(p, corners));
    }
    EXPECT(knurl_mesh_closest(mesh, p, 1e6, NULL, NULL, &found));
    for (int i = 0; i < 3; i++) {
        there += (found.proxy[i] - p[i]) * (found.proxy[i] - p[i]);
    }
    EXPECT(fabs(sqrt(there) - sqrt(square)) <= 1e-7 * (1.0 + sqrt(square)));
}

static void stroke(const knurl_mesh_desc *mesh, supply *s) {
    knurl_scene *scene = NULL;
    knurl_material_desc material;
    knurl_surface_desc surface;
    knurl_material_desc_init(&material, sizeof material);
    knurl_surface_desc_init(&surface, sizeof surface);
    material.stiffness = 400.0;
    material.amplitude = 2e-4;
    material.spatial_frequency[0] = 700.0;
    material.friction = take_byte(s) / 256.0;
    surface.mesh = mesh;
    surface.material = &material;
    surface.double_sided = take_byte(s) & 1u;
    surface.axis[0] = 1.0;
    EXPECT(knurl_scene_create(NULL, &scene) == KNURL_OK);
    if (knurl_scene_add_surface(scene, &surface, NULL) == KNURL_OK) {
        EXPECT(knurl_scene_commit(scene) == KNURL_OK);
        expect_good_ticks(scene, s, 30);
    }
    knurl_scene_destroy(scene);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    supply s = {data, size};
    float positions[3 * 24], normals[3 * 24];
    uint32_t indices[3 * 40];
    const uint32_t vertices = 3 + take_byte(&s) % 22;
    const uint32_t corners = 3 * (1 + take_byte(&s) % 40);
    int measurable = 1;
    for (uint32_t i = 0; i < 3 * vertices; i++) {
        positions[i] = (float)take_number(&s);
        measurable &= fabs((double)positions[i]) < 10.0;
    }
    for (uint32_t i = 0; i < corners; i++) {
        indices[i] = take_byte(&s) % vertices;
    }
    knurl_mesh_desc desc;
    knurl_mesh_desc_init(&desc, sizeof desc);
    desc.vertex_count = vertices;
    desc.positions = positions;
    desc.indices = indices;
    desc.index_count = corners;
    knurl_heap heap;
    knurl_mesh *mesh = NULL;
    knurl_heap_init(&heap, NULL);
    if (knurl_mesh_check(&desc) == KNURL_OK && knurl_mesh_create(&heap, &desc, &mesh) == KNURL_OK) {
        for (int i = 0; measurable && i < 8; i++) {
            double p[3];
            for (int axis = 0; axis < 3; axis++) {
                p[axis] = (take_byte(&s) - 128.0) / 600.0;
            }
            compare(mesh, p);
        }
        knurl_mesh_destroy(&heap, mesh);
    }
    EXPECT(heap.bytes == 0);
    stroke(&desc, &s);
    for (uint32_t i = 0; i < 3 * vertices; i++) { /* some are unit vectors, most nearly are */
        normals[i] = i % 3 == 2 ? 1.0f : (float)take_byte(&s) / 512.0f - 0.25f;
    }
    normals[take_byte(&s) % (3 * vertices)] = (float)take_number(&s);
    desc.normals = normals;
    stroke(&desc, &s);
    return 0;
}
