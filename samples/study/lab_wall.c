/* Walls, and their closed forms. SPDX-License-Identifier: MIT */
#include "lab_wall.h"

#include <math.h>
#include <string.h>

/* Waves of 0.25 mm over 30 mm: a radius of 91 mm at their crests, slopes up to 3 degrees. Eight facets a wave meet at
 * up to 2.3 degrees, as those of a sphere of 1,280 triangles do. */
#define WAVE      0.03    /* m */
#define AMPLITUDE 0.00025 /* m */
#define FACETS    8
#define WAVES     80   /* strokes pass 27 at most, either side of the middle */
#define HALF      0.02 /* m, across the stroke */
#define COLUMNS   (FACETS * WAVES)

static const double turns = 2.0 * 3.14159265358979323846 / WAVE;

double lab_wall_at(int32_t wall, double x, double normal[3]) {
    const double size = wall == LAB_PLANE ? 0.0 : AMPLITUDE;
    const double slope = size * turns * cos(turns * x), length = sqrt(1.0 + slope * slope);
    normal[0] = -slope / length;
    normal[1] = 1.0 / length;
    normal[2] = 0.0;
    return size * sin(turns * x);
}

double lab_wall_distance(int32_t wall, const double point[3], double normal[3]) {
    double foot = point[0], height = 0.0;
    for (int i = 0; i < (wall == LAB_PLANE ? 1 : 4);
         i++) { /* towards the point below it: curvature times depth is small */
        const double under = lab_wall_at(wall, foot, normal);
        height = (point[1] - under) * normal[1] + (point[0] - foot) * normal[0];
        foot = point[0] - height * normal[0];
    }
    return height;
}

static knurl_result add_waves(knurl_scene *scene, int32_t wall, const knurl_surface_desc *like) {
    static float positions[2 * (COLUMNS + 1)][3], normals[2 * (COLUMNS + 1)][3];
    static uint32_t indices[COLUMNS][6];
    knurl_mesh_desc mesh;
    knurl_surface_desc surface = *like;
    for (uint32_t i = 0; i <= COLUMNS; i++) {
        const double x = WAVE * ((double)i / FACETS - 0.5 * WAVES);
        double normal[3];
        const double height = lab_wall_at(wall, x, normal);
        for (uint32_t k = 0; k < 2; k++) {
            const double at[3] = {x, height, k ? HALF : -HALF};
            for (int axis = 0; axis < 3; axis++) {
                positions[2 * i + k][axis] = (float)at[axis];
                normals[2 * i + k][axis] = (float)normal[axis];
            }
        }
        if (i < COLUMNS) {
            const uint32_t quad[6] = {2 * i, 2 * i + 1, 2 * i + 3, 2 * i, 2 * i + 3, 2 * i + 2};
            memcpy(indices[i], quad, sizeof quad);
        }
    }
    knurl_mesh_desc_init(&mesh, sizeof mesh);
    mesh.positions = positions[0];
    mesh.normals = wall == LAB_SMOOTH ? normals[0] : NULL;
    mesh.vertex_count = 2 * (COLUMNS + 1);
    mesh.indices = indices[0];
    mesh.index_count = 6 * COLUMNS;
    surface.mesh = &mesh;
    surface.axis[0] = 1.0;
    return knurl_scene_add_surface(scene, &surface, NULL);
}

static knurl_result add_plane(knurl_scene *scene, const knurl_surface_desc *like) {
    static const double up[4] = {-0.70710678118654752, 0.0, 0.0,
                                 0.70710678118654752}; /* the plane's z is the wall's y */
    knurl_plane_desc plane;
    knurl_surface_desc surface = *like;
    knurl_plane_desc_init(&plane, sizeof plane);
    plane.half_extents[0] = 2.0;
    plane.half_extents[1] = 2.0;
    memcpy(surface.rotation, up, sizeof up);
    surface.plane = &plane;
    return knurl_scene_add_surface(scene, &surface, NULL);
}

knurl_result lab_wall_add(knurl_scene *scene, int32_t wall, const knurl_surface_desc *surface) {
    return wall == LAB_PLANE ? add_plane(scene, surface) : add_waves(scene, wall, surface);
}
