/* Random rooms, described without the library: solids are intersections of half-spaces, so that a few products decide
 * if a point is outside of all of them. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_ROOMS_H
#define KNURL_TEST_ROOMS_H

#include "patch.h"
#include "support/geometry.h"
#include "support/poses.h"
#include "support/scenes.h"

#define ROOM_PI      3.14159265358979323846
#define ROOM_SOLIDS  72
#define SOLID_FACES  6
#define FACE_CORNERS 4

/** A flat face, counter-clockwise seen from outside. */
typedef struct face {
    double corners[FACE_CORNERS][3];
    double normal[3]; /**< unit, outwards */
    double offset;    /**< normal * x <= offset: inside */
    int count;        /**< of corners */
    int hidden;       /**< 1: between two solids; the library is not given it */
} face;

/** A convex solid. */
typedef struct solid {
    face faces[SOLID_FACES];
    int count;
    int moves; /**< 1: with the room's body */
} solid;

/** How a room is handed to the library. */
enum { ROOM_MESHES, ROOM_ONE_MESH, ROOM_PLANES, ROOM_MIXED, ROOM_FORMS };

typedef struct room {
    solid solids[ROOM_SOLIDS];
    int count;
    double low[3], high[3]; /**< bounds for a HIP, m */
} room;

/** A room's surfaces at rest, in the scene's order. */
#define LAID_MAX 128
typedef struct laid {
    pose poses[LAID_MAX];
    int moves[LAID_MAX]; /**< 1: with the solids that move */
    uint32_t count;
    uint32_t reversed; /**< 1 1 and more: one triangle of each mesh is reversed, chosen by this number */
} laid;

/** m: signed, of a convex solid: its distance inside, no more than that outside. */
static inline double solid_distance(const solid *s, const double p[3]) {
    double most = -HUGE_VAL;
    for (int i = 0; i < s->count; i++) {
        most = fmax(most, dot3(s->faces[i].normal, p) - s->faces[i].offset);
    }
    return most;
}

/** The same of the union of all; moved: m, of the body. */
static inline double room_distance(const room *r, const double p[3], const double moved[3]) {
    double least = HUGE_VAL;
    for (int i = 0; i < r->count; i++) {
        double own[3];
        add3(p, r->solids[i].moves ? -1.0 : 0.0, moved, own);
        least = fmin(least, solid_distance(&r->solids[i], own));
    }
    return least;
}

static inline void face_finish(face *f) {
    double edge[3], other[3];
    add3(f->corners[1], -1.0, f->corners[0], edge);
    add3(f->corners[2], -1.0, f->corners[0], other);
    cross3(edge, other, f->normal);
    const double size = length3(f->normal);
    for (int i = 0; i < 3; i++) {
        f->normal[i] /= size;
    }
    f->offset = dot3(f->normal, f->corners[0]);
}

/** A prism: a quad (counter-clockwise from above) from one height to another; turned about z, placed at (x, y). The
 * corners are floats, because the library gets floats. */
static inline void add_prism(room *r, const double quad[4][2], double low, double high, const double at[2],
                             double angle) {
    static const int sides[6][4] = {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
    solid *s = &r->solids[r->count++];
    double corners[8][3];
    assert_true(r->count <= ROOM_SOLIDS);
    for (int i = 0; i < 8; i++) {
        const double *q = quad[i % 4];
        corners[i][0] = (double)(float)(at[0] + cos(angle) * q[0] - sin(angle) * q[1]);
        corners[i][1] = (double)(float)(at[1] + sin(angle) * q[0] + cos(angle) * q[1]);
        corners[i][2] = (double)(float)(i < 4 ? low : high);
    }
    s->count = 6;
    s->moves = 0;
    for (int f = 0; f < 6; f++) {
        s->faces[f].count = 4;
        for (int k = 0; k < 4; k++) {
            memcpy(s->faces[f].corners[k], corners[sides[f][k]], sizeof corners[0]);
        }
        face_finish(&s->faces[f]);
    }
}

static inline void add_box(room *r, double x0, double x1, double y0, double y1, double z0, double z1) {
    const double quad[4][2] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
    const double origin[2] = {0.0, 0.0};
    add_prism(r, quad, z0, z1, origin, 0.0);
}

/** A wedge: a triangle in x and z (from its base up to the tip), along y. */
static inline void add_wedge(room *r, const double base[2], const double tip[2], double bottom, double half_y) {
    solid *s = &r->solids[r->count++];
    const double xs[3] = {base[0], base[1], tip[0]};
    const double zs[3] = {bottom, bottom, tip[1]};
    double c[6][3];
    assert_true(r->count <= ROOM_SOLIDS);
    for (int i = 0; i < 6; i++) {
        c[i][0] = (double)(float)xs[i % 3];
        c[i][1] = (double)(float)(i < 3 ? -half_y : half_y);
        c[i][2] = (double)(float)zs[i % 3];
    }
    static const int faces[5][4] = {{0, 1, 2, -1}, {3, 5, 4, -1}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}};
    s->count = 5;
    s->moves = 0;
    for (int f = 0; f < 5; f++) {
        s->faces[f].count = faces[f][3] < 0 ? 3 : 4;
        for (int k = 0; k < s->faces[f].count; k++) {
            memcpy(s->faces[f].corners[k], c[faces[f][k]], sizeof c[0]);
        }
        face_finish(&s->faces[f]);
    }
}

/* --- rooms --- */

/** A floor and walls about it; sunk: m that each reaches into the next, 0: flush. */
static inline void add_shell(room *r, double half, double height, double sunk) {
    const double thick = 0.03;
    add_box(r, -half - thick, half + thick, -half - thick, half + thick, -thick, 0.0);
    add_box(r, -half - thick, -half, -half - thick, half + thick, -sunk, height);
    add_box(r, half, half + thick, -half - thick, half + thick, -sunk, height);
    add_box(r, -half - sunk, half + sunk, -half - thick, -half, -sunk, height);
    add_box(r, -half - sunk, half + sunk, half, half + thick, -sunk, height);
    for (int i = 0; i < 3; i++) {
        r->low[i] = i < 2 ? -half - 0.01 : -0.01;
        r->high[i] = i < 2 ? half + 0.01 : 0.8 * height;
    }
}

/** Boxes and wedges on the floor, somewhere. */
static inline void furnish(room *r, uint64_t *seed, double half, double sunk) {
    for (int i = 0; i < 3; i++) {
        const double at[2] = {random_between(seed, -0.6, 0.6) * half, random_between(seed, -0.6, 0.6) * half};
        const double size[2] = {random_between(seed, 0.010, 0.015), random_between(seed, 0.010, 0.015)};
        const double high = random_between(seed, 0.002, 0.02);
        const double quad[4][2] = {{-size[0], -size[1]}, {size[0], -size[1]}, {size[0], size[1]}, {-size[0], size[1]}};
        const double angle = random_integer(seed, 0, 2) ? random_between(seed, -ROOM_PI, ROOM_PI) : 0.0;
        add_prism(r, quad, -sunk, high, at, angle);
    }
    if (random_integer(seed, 0, 1)) {
        const double x = random_between(seed, -0.5, 0.5) * half;
        const double base[2] = {x - random_between(seed, 0.012, 0.02), x + random_between(seed, 0.012, 0.02)};
        const double tip[2] = {x + random_between(seed, -0.005, 0.005), random_between(seed, 0.004, 0.015)};
        add_wedge(r, base, tip, -sunk, 0.02);
    }
}

/** Steps, flush with one another: up along x. */
static inline void add_steps(room *r, uint64_t *seed) {
    double height = 0.0;
    for (int i = 0; i < 5; i++) {
        const double x = -0.05 + 0.02 * i;
        height += pow(10.0, random_between(seed, -5.0, -2.2)); /* 10 um to 6 mm */
        add_box(r, x, x + 0.02, -0.05, 0.05, -0.03, height);
    }
    const double low[3] = {-0.045, -0.04, -0.01}, high[3] = {0.045, 0.04, height + 0.005};
    memcpy(r->low, low, sizeof low);
    memcpy(r->high, high, sizeof high);
}

/** Grooves along y: wedges side by side, and walls at their ends. */
static inline void add_grooves(room *r, uint64_t *seed) {
    double x = -0.05;
    for (int i = 0; i < 4; i++) {
        const double base[2] = {x, x + 0.025};
        const double tip[2] = {x + random_between(seed, 0.008, 0.017), random_between(seed, 0.003, 0.015)};
        add_wedge(r, base, tip, 0.0, 0.05);
        x += 0.025;
    }
    add_box(r, -0.08, 0.08, -0.08, 0.08, -0.03, 0.0);
    add_box(r, -0.08, 0.08, -0.09, -0.045, -0.03, 0.03);
    const double low[3] = {-0.045, -0.048, -0.006}, high[3] = {0.045, 0.04, 0.02};
    memcpy(r->low, low, sizeof low);
    memcpy(r->high, high, sizeof high);
}

static inline room random_room(uint64_t *seed) {
    room r;
    memset(&r, 0, sizeof r);
    const double sunk = random_integer(seed, 0, 1) ? 0.0 : random_between(seed, 0.001, 0.01);
    switch (random_integer(seed, 0, 3)) {
    case 0:
        add_steps(&r, seed);
        break;
    case 1:
        add_grooves(&r, seed);
        break;
    default:
        add_shell(&r, 0.05, 0.04, sunk);
        furnish(&r, seed, 0.05, sunk);
        break;
    }
    return r;
}

/** Cells of a terrain along each side, and their size, m. */
#define TERRAIN_CELLS 6
#define TERRAIN_CELL  0.012

/** The ground below one triangle of a terrain: only its top is a surface. */
static inline void add_column(room *r, const double top[3][3]) {
    static const int sides[5][4] = {{3, 4, 5, -1}, {0, 2, 1, -1}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
    solid *s = &r->solids[r->count++];
    assert_true(r->count <= ROOM_SOLIDS);
    s->count = 5;
    s->moves = 0;
    for (int f = 0; f < 5; f++) {
        s->faces[f].count = sides[f][3] < 0 ? 3 : 4;
        s->faces[f].hidden = f > 0;
        for (int k = 0; k < s->faces[f].count; k++) {
            const int c = sides[f][k];
            memcpy(s->faces[f].corners[k], top[c % 3], sizeof top[0]);
            s->faces[f].corners[k][2] = c < 3 ? -0.03 : top[c % 3][2];
        }
        face_finish(&s->faces[f]);
    }
}

/** A field of heights: slopes of up to 0.6. */
static inline room random_terrain(uint64_t *seed) {
    double points[TERRAIN_CELLS + 1][TERRAIN_CELLS + 1][3];
    room r;
    memset(&r, 0, sizeof r);
    const double half = 0.5 * TERRAIN_CELLS * TERRAIN_CELL, high = random_between(seed, 0.0005, 0.007);
    for (int i = 0; i <= TERRAIN_CELLS; i++) {
        for (int k = 0; k <= TERRAIN_CELLS; k++) {
            points[i][k][0] = (double)(float)(TERRAIN_CELL * i - half);
            points[i][k][1] = (double)(float)(TERRAIN_CELL * k - half);
            points[i][k][2] = (double)(float)random_between(seed, 0.0, high);
        }
    }
    for (int i = 0; i < TERRAIN_CELLS; i++) {
        for (int k = 0; k < TERRAIN_CELLS; k++) {
            const double *a = points[i][k], *b = points[i + 1][k], *c = points[i + 1][k + 1], *d = points[i][k + 1];
            double top[2][3][3];
            memcpy(top[0][0], a, sizeof top[0][0]);
            memcpy(top[0][1], b, sizeof top[0][1]);
            memcpy(top[0][2], c, sizeof top[0][2]);
            memcpy(top[1][0], a, sizeof top[1][0]);
            memcpy(top[1][1], c, sizeof top[1][1]);
            memcpy(top[1][2], d, sizeof top[1][2]);
            add_column(&r, (const double (*)[3])top[0]);
            add_column(&r, (const double (*)[3])top[1]);
        }
    }
    for (int i = 0; i < 3; i++) { /* a hand stays away from the terrain's edge */
        r.low[i] = i < 2 ? 0.011 - half : -0.007;
        r.high[i] = i < 2 ? half - 0.011 : high + 0.01;
    }
    return r;
}

/* --- as the library is given it --- */

/** A triangle, one of whose edges is split without splitting its neighbour's, with a frequency of `splits`. */
static inline void put_split(patch *t, uint64_t *seed, int splits, const double *a, const double *b, const double *c) {
    if (splits == 0) {
        add_triangle(t, a, b, c);
        return;
    }
    double middle[3];
    const double share = random_between(seed, 0.2, 0.8);
    for (int i = 0; i < 3; i++) {
        middle[i] = (double)(float)((1.0 - share) * a[i] + share * b[i]);
    }
    put_split(t, seed, splits - 1, b, c, middle);
    add_triangle(t, c, a, middle);
}

static inline void put_face(patch *t, uint64_t *seed, const face *f) {
    for (int k = 2; k < f->count; k++) {
        put_split(t, seed, (int)random_integer(seed, 0, 2), f->corners[0], f->corners[k - 1], f->corners[k]);
    }
}

static inline patch new_triangles(int solids) {
    patch t = {shape_new((uint32_t)(solids * SOLID_FACES * 2 * 9), (uint32_t)(solids * SOLID_FACES * 2 * 9), 0), 0};
    return t;
}

static inline void lay(laid *l, knurl_scene *scene, surface_parts *parts, int moves) {
    assert_true(l->count < LAID_MAX);
    memcpy(l->poses[l->count].position, parts->desc.position, sizeof parts->desc.position);
    memcpy(l->poses[l->count].quaternion, parts->desc.rotation, sizeof parts->desc.rotation);
    l->moves[l->count++] = moves;
    (void)add_surface(scene, parts);
}

static inline void put_mesh(laid *l, knurl_scene *scene, patch *t, const knurl_material_desc *material, int moves) {
    t->s.index_count = t->s.vertex_count = t->used;
    if (l->reversed) {
        uint32_t *corners = &t->s.indices[l->reversed % (t->used / 3) * 3];
        const uint32_t second = corners[1];
        corners[1] = corners[2];
        corners[2] = second;
    }
    surface_parts parts = surface_mesh(&t->s);
    parts.desc.axis[0] = 0.6;
    parts.desc.axis[1] = 0.64;
    parts.desc.axis[2] = 0.48;
    parts.material = *material;
    lay(l, scene, &parts, moves);
    shape_free(&t->s);
}

/** A rectangle as a separate plane; any other face as a mesh. */
static inline void put_plane(laid *l, knurl_scene *scene, uint64_t *seed, const face *f,
                             const knurl_material_desc *material, int moves) {
    double along[3], across[3];
    add3(f->corners[1], -1.0, f->corners[0], along);
    add3(f->corners[2], -1.0, f->corners[1], across);
    const double x = length3(along), y = length3(across);
    if (f->count != 4 || fabs(dot3(along, across)) > 1e-9 * x * y) {
        patch t = new_triangles(1);
        put_face(&t, seed, f);
        put_mesh(l, scene, &t, material, moves);
        return;
    }
    surface_parts parts = surface_plane();
    double m[3][3]; /* columns: x, y, normal */
    for (int i = 0; i < 3; i++) {
        m[i][0] = along[i] / x;
        m[i][2] = f->normal[i];
        parts.desc.position[i] = 0.5 * (f->corners[0][i] + f->corners[2][i]);
    }
    const double ex[3] = {m[0][0], m[1][0], m[2][0]};
    double ey[3];
    cross3(f->normal, ex, ey);
    double *q = parts.desc.rotation;
    const double trace = ex[0] + ey[1] + f->normal[2];
    /* of the four ways to a quaternion the one that divides by the most */
    const double squares[4] = {1.0 + ex[0] - ey[1] - f->normal[2], 1.0 - ex[0] + ey[1] - f->normal[2],
                               1.0 - ex[0] - ey[1] + f->normal[2], 1.0 + trace};
    int most = 0;
    for (int i = 1; i < 4; i++) {
        most = squares[i] > squares[most] ? i : most;
    }
    const double r[3][3] = {{ex[0], ey[0], f->normal[0]}, {ex[1], ey[1], f->normal[1]}, {ex[2], ey[2], f->normal[2]}};
    const double s = 0.5 / sqrt(squares[most]);
    if (most == 3) {
        q[0] = (r[2][1] - r[1][2]) * s;
        q[1] = (r[0][2] - r[2][0]) * s;
        q[2] = (r[1][0] - r[0][1]) * s;
        q[3] = squares[3] * s;
    } else {
        const int j = (most + 1) % 3, k = (most + 2) % 3;
        q[most] = squares[most] * s;
        q[j] = (r[j][most] + r[most][j]) * s;
        q[k] = (r[k][most] + r[most][k]) * s;
        q[3] = (r[k][j] - r[j][k]) * s;
    }
    parts.plane.half_extents[0] = 0.5 * x;
    parts.plane.half_extents[1] = 0.5 * y;
    parts.material = *material;
    lay(l, scene, &parts, moves);
}

/** All of a room's surfaces. */
static inline void put_room(laid *l, knurl_scene *scene, uint64_t *seed, const room *r, int form,
                            const knurl_material_desc *material) {
    patch all = new_triangles(r->count);
    for (int i = 0; i < r->count; i++) {
        const solid *s = &r->solids[i];
        const int any = form == ROOM_MIXED ? (int)random_integer(seed, ROOM_MESHES, ROOM_PLANES) : form;
        const int own = any == ROOM_ONE_MESH && s->moves != r->solids[0].moves ? ROOM_MESHES : any;
        patch t = new_triangles(1);
        for (int f = 0; f < s->count; f++) {
            if (s->faces[f].hidden) {
                continue;
            }
            if (own == ROOM_PLANES) {
                put_plane(l, scene, seed, &s->faces[f], material, s->moves);
            } else {
                put_face(own == ROOM_ONE_MESH ? &all : &t, seed, &s->faces[f]);
            }
        }
        if (own == ROOM_MESHES) {
            put_mesh(l, scene, &t, material, s->moves);
        } else {
            shape_free(&t.s);
        }
    }
    if (all.used > 0) {
        put_mesh(l, scene, &all, material, r->solids[0].moves);
    } else {
        shape_free(&all.s);
    }
}

#endif
