/* Flat meshes drawn as characters: one cell each, '#': sheet. And a scene's values for contact with a mesh, to compare
 * a plane with. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_FLAT_H
#define KNURL_TEST_FLAT_H

#include "support/probe.h"

#include "base/vec3.h"
#include "contact/mesh_frame.h"
#include "contact/plane_from_mesh.h"

#define PI 3.14159265358979323846

/** m: a cell's edge; exact as a float. */
#define CELL (1.0 / 256.0)

/** The drawing's cells as quads, its last row at the bottom, its lower left corner at the origin, facing +z. All
 * vertices of the grid are there, used or not. uvs: u = x, v = y in units of 1/8 m. */
static inline shape flat_drawing(const char *const *rows, uint32_t row_count) {
    const uint32_t columns = (uint32_t)strlen(rows[0]);
    shape s = shape_new((columns + 1) * (row_count + 1), 6 * columns * row_count, 1);
    uint32_t at = 0;
    for (uint32_t v = 0; v < s.vertex_count; v++) {
        const double x = CELL * (v % (columns + 1));
        const double y = CELL * (double)(v / (columns + 1));
        shape_set(&s, v, x, y, 0.0);
        s.uvs[2 * v] = (float)(8.0 * x);
        s.uvs[2 * v + 1] = (float)(8.0 * y);
    }
    for (uint32_t i = 0; i < columns * row_count; i++) {
        const uint32_t row = i / columns;
        const uint32_t v = row * (columns + 1) + i % columns;
        if (rows[row_count - 1 - row][i % columns] == '#') {
            at = shape_quad(&s, at, v, v + 1, v + columns + 2, v + columns + 1);
        }
    }
    s.index_count = at;
    return s;
}

#define DRAWING(...)                                                                                                   \
    flat_drawing((const char *const[]){__VA_ARGS__}, (uint32_t)COUNT_OF(((const char *const[]){__VA_ARGS__})))

/** Triangles from a middle to each of `count` corners round it, radii in turn a and b. */
static inline shape flat_fan(uint32_t count, double a, double b) {
    shape s = shape_new(count + 1, 3 * count, 1);
    for (uint32_t i = 0; i < count; i++) {
        const double angle = 2.0 * PI * i / count;
        const double radius = i % 2 ? b : a;
        const uint32_t corners[3] = {count, i, (i + 1) % count};
        shape_set(&s, i, radius * cos(angle), radius * sin(angle), 0.0);
        memcpy(&s.indices[(size_t)3 * i], corners, sizeof corners);
    }
    for (uint32_t v = 0; v <= count; v++) {
        s.uvs[2 * v] = s.positions[3 * v];
        s.uvs[2 * v + 1] = s.positions[3 * v + 1];
    }
    return s;
}

/** One more triangle, at the end of the list. */
static inline void flat_add(shape *s, uint32_t a, uint32_t b, uint32_t c) {
    const uint32_t corners[3] = {a, b, c};
    uint32_t *more = realloc(s->indices, (s->index_count + 3) * sizeof(uint32_t));
    if (!more) {
        fail_msg("no memory");
        return;
    }
    s->indices = more;
    memcpy(&s->indices[s->index_count], corners, sizeof corners);
    s->index_count += 3;
}

/** Turned by a unit quaternion, then moved. */
static inline void flat_move(shape *s, const double quaternion[4], const double offset[3]) {
    double rotation[9];
    quat_to_matrix(quaternion, rotation);
    for (uint32_t v = 0; v < s->vertex_count; v++) {
        double p[3];
        shape_get(s, v, p);
        mat3_mul(rotation, p, p);
        shape_set(s, v, p[0] + offset[0], p[1] + offset[1], p[2] + offset[2]);
    }
}

/** The direction of x at a mesh's contact and its coordinate on the grating, as in a scene (without orientation). */
static inline void flat_mesh_frame(const knurl_mesh *mesh, const double *axis, const knurl_contact *c, double x[3],
                                   double coordinates[2]) {
    double y[3];
    double place[2] = {0.0, 0.0};
    if (axis) {
        vec3_copy(axis, x);
    } else {
        knurl_mesh_frame(mesh, c, x, y, place);
    }
    add3(x, -dot3(x, c->normal), c->normal, x);
    vec3_normalise(x);
    vec3_cross(c->normal, x, y);
    coordinates[0] = axis ? dot3(c->proxy, axis) : place[0];
    coordinates[1] = axis ? dot3(c->proxy, y) : place[1];
}

/** The area inside an outline, and its length; also of a rectangle without one. */
static inline double flat_area(const knurl_plane *plane, double *length) {
    double area = 0.0;
    *length = 4.0 * (plane->half_extents[0] + plane->half_extents[1]);
    if (!plane->outline) {
        return 4.0 * plane->half_extents[0] * plane->half_extents[1];
    }
    *length = 0.0;
    for (uint32_t i = 0; i < plane->edge_count; i++) {
        const knurl_edge *e = &plane->outline[i];
        area += 0.5 * (e->from[0] * e->to[1] - e->from[1] * e->to[0]);
        *length += hypot(e->to[0] - e->from[0], e->to[1] - e->from[1]);
    }
    return area;
}

/** m from a point of the plane to the nearest of its edges. */
static inline double flat_to_outline(const knurl_plane *plane, const double p[2]) {
    double nearest = fabs(fmax(fabs(p[0]) - plane->half_extents[0], fabs(p[1]) - plane->half_extents[1]));
    nearest = plane->outline ? HUGE_VAL : nearest;
    for (uint32_t i = 0; plane->outline && i < plane->edge_count; i++) {
        const knurl_edge *e = &plane->outline[i];
        const double along[2] = {e->to[0] - e->from[0], e->to[1] - e->from[1]};
        const double to[2] = {p[0] - e->from[0], p[1] - e->from[1]};
        const double share = (to[0] * along[0] + to[1] * along[1]) / (along[0] * along[0] + along[1] * along[1]);
        const double t = fmax(0.0, fmin(1.0, share));
        nearest = fmin(nearest, hypot(to[0] - t * along[0], to[1] - t * along[1]));
    }
    return nearest;
}

#endif
