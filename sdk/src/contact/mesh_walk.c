/* The walk of a foot over a mesh. From an edge it looks at the triangle beyond, from a vertex at the fan round it, and
 * goes on only where it is strictly nearer: at an edge alone it would go wrong in concave corners, and it ends.
 * SPDX-License-Identifier: MIT */
#include "contact/mesh_walk.h"

#include "contact/corner.h"
#include "contact/mesh_query.h"

/* Steps of one walk. A stroke of 1 m/s crosses a few triangles a tick; an uncapped teleport over a fine mesh would take
 * thousands. */
#define MAX_STEPS 64

/* Vertices of very many triangles (the pole of a sphere, the hub of a fan) are looked at in part. */
#define MAX_FAN 256

static int is_nearer(const knurl_foot *a, const knurl_foot *b) {
    return a->distance2 < b->distance2 * (1.0 - 1e-12);
}

/* A corner of the triangle that a foot rests on: the only one at a vertex, one of two on an edge. */
static uint32_t held_corner(const knurl_foot *foot) {
    return foot->held & 1 ? 0 : foot->held & 2 ? 1 : 2;
}

static int at_vertex(const knurl_foot *foot) {
    return (foot->held & (foot->held - 1)) == 0;
}

/* The corner that faces the edge that a foot rests on. */
static uint32_t facing_corner(const knurl_foot *foot) {
    return foot->held == 3 ? 2 : foot->held == 5 ? 1 : 0;
}

static void vertex_of(const knurl_mesh *mesh, uint32_t corner, double out[3]) {
    const float *p = &mesh->positions[3 * (size_t)mesh->triangles[corner_slot(corner)]];
    out[0] = (double)p[0];
    out[1] = (double)p[1];
    out[2] = (double)p[2];
}

/* A triangle that touches a foot has something nearer only where its far corner lies towards p; then: has it? */
static int nearer_beyond(const knurl_mesh *mesh, uint32_t apex, const double p[3], const knurl_foot *from,
                         knurl_foot *to) {
    double corner[3];
    vertex_of(mesh, apex, corner);
    vec3_sub(corner, from->point, corner);
    if (!(vec3_dot(corner, from->offset) > 0.0)) {
        return 0;
    }
    knurl_foot_find(mesh, apex >> 2, p, to);
    return is_nearer(to, from);
}

/* Whether a corner's triangle touches a foot on an edge or a vertex: has all the corners that hold it. */
static int touches(const knurl_mesh *mesh, uint32_t corner, const knurl_foot *foot) {
    double own[3][3];
    knurl_mesh_corners(mesh, corner >> 2, own);
    for (int k = 0; k < 3; k++) {
        const double *held = foot->corners[k];
        int found = !(foot->held & 1u << k);
        for (int i = 0; i < 3; i++) {
            found |= own[i][0] == held[0] && own[i][1] == held[1] && own[i][2] == held[2];
        }
        if (!found) {
            return 0;
        }
    }
    return 1;
}

/* How well a foot carries on the surface that another is on: with p behind it (above 1 then), facing alike; else by how
 * near it is. An inner wall that p is just passing through is nothing to go on at: -HUGE_VAL. */
static double continuation(const knurl_foot *from, const knurl_foot *to, int32_t side) {
    const double along = vec3_dot(to->normal, to->offset) * side;
    if (along * along <= KNURL_ON_SURFACE * KNURL_ON_SURFACE * to->area2) {
        return -HUGE_VAL;
    }
    return along < 0.0 ? 2.0 + vec3_dot(to->normal, from->normal) / sqrt(to->area2 * from->area2) : -to->distance2;
}

static uint32_t knot_at(const knurl_mesh *mesh, const knurl_foot *foot, const uint32_t **corners) {
    const uint32_t vertex = mesh->triangles[3 * (size_t)foot->triangle + held_corner(foot)];
    const knurl_knot *knot = &mesh->knots[corner_knot_place(mesh, vertex)];
    *corners = &mesh->knot_corners[knot->first];
    return knot->count < MAX_FAN ? knot->count : MAX_FAN;
}

/* Where sheets branch, the surface goes on straight ahead: an inner wall below it does not take the foot over. */
static int step_at_knot(const knurl_mesh *mesh, const double p[3], int32_t side, const knurl_foot *from, knurl_foot *to,
                        int *capped) {
    const uint32_t *corners;
    const uint32_t count = knot_at(mesh, from, &corners);
    double best = -HUGE_VAL;
    int found = 0;
    for (uint32_t i = 0; i < count; i++) {
        knurl_foot other;
        knurl_foot_find(mesh, corners[i] >> 2, p, &other);
        if (!is_nearer(&other, from) || !touches(mesh, corners[i], from)) {
            continue;
        }
        const double score = continuation(from, &other, side);
        if (score > best) {
            best = score;
            *to = other;
            found = 1;
        }
    }
    *capped |= count == MAX_FAN;
    return found;
}

/* Swings round a vertex, both ways where the fan is open. */
static int step_round_vertex(const knurl_mesh *mesh, const double p[3], const knurl_foot *from, knurl_foot *to,
                             int *capped) {
    const uint32_t start = 4 * from->triangle + held_corner(from);
    const knurl_swing ways[2] = {{start, corner_next(start)}, {start, corner_last(start)}};
    uint32_t seen = 1;
    for (int way = 0; way < 2; way++) {
        knurl_swing s = ways[way];
        for (;;) {
            const uint32_t apex = corner_swing(mesh, &s);
            if ((apex & 3) == 3) {
                break; /* a rim */
            }
            if (s.corner == start) {
                return 0;
            }
            if (nearer_beyond(mesh, apex, p, from, to)) {
                return 1;
            }
            if (++seen == MAX_FAN) {
                *capped = 1;
                return 0;
            }
        }
    }
    return 0;
}

/* One step downhill; 0 at a local minimum. */
static int step(const knurl_mesh *mesh, const double p[3], int32_t side, const knurl_foot *from, knurl_foot *to,
                int *capped) {
    if (from->held == 7) {
        return 0;
    }
    if (at_vertex(from)) {
        const size_t slot = 3 * (size_t)from->triangle + held_corner(from);
        return mesh->across[slot] & KNURL_KNOT ? step_at_knot(mesh, p, side, from, to, capped)
                                               : step_round_vertex(mesh, p, from, to, capped);
    }
    const uint32_t apex = mesh->across[3 * (size_t)from->triangle + facing_corner(from)] & KNURL_CORNER;
    if ((apex & 3) == 3) {
        return apex == KNURL_SEVERAL && step_at_knot(mesh, p, side, from, to, capped);
    }
    return nearer_beyond(mesh, apex, p, from, to);
}

/* Sums over the triangles that touch a foot what their normals make of its offset. */
typedef struct facing {
    const knurl_mesh *mesh;
    const knurl_foot *foot;
    int front, back; /* whether any says so */
    int askew;       /* whether any looks more than 37 degrees off it: 0.64 is the square of the cosine */
    double weighted; /* by angle at a vertex, alike on an edge */
} facing;

static void look(facing *f, uint32_t corner, int weigh) {
    double c[3][3];
    double next[3], last[3], normal[3];
    knurl_mesh_corners(f->mesh, corner >> 2, c);
    const uint32_t k = corner & 3;
    const uint32_t k1 = k == 2 ? 0 : k + 1;
    vec3_sub(c[k1], c[k], next);
    vec3_sub(c[3 - k - k1], c[k], last);
    vec3_cross(next, last, normal);
    const double along = vec3_dot(f->foot->offset, normal);
    f->front |= along > 0.0;
    f->back |= along < 0.0;
    f->askew |= along * along < 0.64 * f->foot->distance2 * vec3_dot(normal, normal);
    if (weigh) {
        const double size = vec3_length(normal);
        f->weighted += along / size * (at_vertex(f->foot) ? atan2(size, vec3_dot(next, last)) : 1.0);
    }
}

/* Looks at all triangles that touch a foot on an edge or a vertex; returns whether it is on a rim. */
static int look_round(facing *f, int weigh) {
    const knurl_mesh *mesh = f->mesh;
    const uint32_t start = 4 * f->foot->triangle + held_corner(f->foot);
    const uint32_t apex = mesh->across[3 * (size_t)f->foot->triangle + facing_corner(f->foot)] & KNURL_CORNER;
    int rim = 0;
    if (at_vertex(f->foot) ? (mesh->across[corner_slot(start)] & KNURL_KNOT) != 0 : apex == KNURL_SEVERAL) {
        const uint32_t *corners;
        const uint32_t count = knot_at(mesh, f->foot, &corners);
        for (uint32_t i = 0; i < count; i++) {
            if (touches(mesh, corners[i], f->foot)) {
                look(f, corners[i], weigh);
                rim |= at_vertex(f->foot) &&
                       ((mesh->across[corner_slot(corner_next(corners[i]))] & KNURL_CORNER) == KNURL_RIM ||
                        (mesh->across[corner_slot(corner_last(corners[i]))] & KNURL_CORNER) == KNURL_RIM);
            }
        }
        return rim;
    }
    look(f, start, weigh);
    if (!at_vertex(f->foot)) {
        if (apex != KNURL_RIM) {
            look(f, apex, weigh);
        }
        return apex == KNURL_RIM;
    }
    const knurl_swing ways[2] = {{start, corner_next(start)}, {start, corner_last(start)}};
    uint32_t seen = 1;
    for (int way = 0; way < 2; way++) {
        knurl_swing s = ways[way];
        while ((corner_swing(mesh, &s) & 3) != 3) {
            if (s.corner == start || ++seen == MAX_FAN) {
                return 0;
            }
            look(f, s.corner, weigh);
        }
        rim = 1;
    }
    return rim;
}

/* Whether a foot stays back in a sharp concave corner: p is well off (37 degrees) the way that some face of the corner
 * looks. In a valley of a curved surface, whose facets meet at small angles, it hardly is. Not the foot's own face
 * alone: p goes straight away from a groove's wall. */
static int stays_back(const knurl_mesh *mesh, const knurl_foot *foot, int32_t side) {
    if (foot->held == 7 || vec3_dot(foot->offset, foot->normal) * side > 0.0) {
        return 0;
    }
    facing f = {mesh, foot, 0, 0, 0, 0.0};
    (void)look_round(&f, 0);
    return f.askew;
}

/* Whether the surface lies between a foot and p: then p has gone through a further wall. */
static int is_walled_off(const knurl_mesh *mesh, const double p[3], int32_t side, const knurl_foot *foot) {
    double from[3];
    uint32_t triangle;
    knurl_foot_leave(foot->point, p, from);
    return knurl_mesh_cross(mesh, from, p, side < 0, &triangle) == side;
}

/* A walk that was cut short, or that ended in a corner which p has left behind (in a groove's, one proxy a tick would
 * stay for ever while p goes on below the ridges), goes on at what is nearest of all, if the surface holds p there from
 * the same side: the far side of a thin wall faces the other way, and a further wall has p in front of it or shuts the
 * foot off. */
static void jump(const knurl_mesh *mesh, const double p[3], int32_t side, knurl_foot *foot) {
    knurl_contact nearest;
    knurl_foot other;
    int rim;
    if (!knurl_mesh_closest(mesh, p, sqrt(foot->distance2) * (1.0 - 1e-9), &nearest)) {
        return;
    }
    knurl_foot_find(mesh, nearest.triangle, p, &other);
    if (vec3_dot(other.offset, foot->offset) > 0.0 && knurl_foot_side(mesh, &other, &rim) * side < 0 &&
        !is_walled_off(mesh, p, side, foot)) {
        *foot = other;
    }
}

void knurl_foot_walk(const knurl_mesh *mesh, const double p[3], int32_t side, knurl_foot *foot) {
    knurl_foot feet[2];
    const knurl_foot *here = foot;
    int capped = 0;
    int steps = 0;
    while (steps < MAX_STEPS && step(mesh, p, side, here, &feet[steps & 1], &capped)) {
        here = &feet[steps++ & 1];
    }
    if (here != foot) {
        *foot = *here;
    }
    if (capped || steps == MAX_STEPS || stays_back(mesh, foot, side)) {
        jump(mesh, p, side, foot);
    }
}

/* Where the triangles round the foot do not agree, the angle-weighted normal decides: its dot product with the offset
 * has the right sign wherever on the mesh the nearest point lies (Baerentzen and Aanaes 2005); one face's has not. */
int knurl_foot_side(const knurl_mesh *mesh, const knurl_foot *foot, int *rim) {
    if (foot->held == 7) {
        const double along = vec3_dot(foot->offset, foot->normal);
        *rim = 0;
        return (along > 0.0) - (along < 0.0);
    }
    facing f = {mesh, foot, 0, 0, 0, 0.0};
    *rim = look_round(&f, 0);
    if (f.front && f.back) {
        (void)look_round(&f, 1);
        return f.weighted < 0.0 ? -1 : 1;
    }
    return f.front - f.back;
}
