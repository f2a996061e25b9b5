/* The reference for contact on meshes: the nearest point of all triangles and inside or outside, by a uniform grid.
 * Shares no code and no formula with the library: each triangle is laid into its own plane and measured there.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_ORACLE_H
#define KNURL_TEST_ORACLE_H

#include "support/geometry.h"

/** A triangle in its own plane: corners (0, 0), (b, 0), (c, d). */
typedef struct flat {
    double origin[3];
    double axes[3][3]; /**< along the first edge, across it, up */
    double b, c, d;
} flat;

typedef struct oracle {
    flat *flats;
    uint32_t count;
    double low[3];
    double cell;
    int64_t cells[3];
    uint32_t *starts; /**< of each cell: start of its triangles */
    uint32_t *members;
    uint32_t *stamps; /**< of each triangle: the last query that tested it */
    uint32_t query;
} oracle;

static inline void flat_set(flat *f, const double corners[3][3]) {
    double edge[3];
    add3(corners[1], -1.0, corners[0], edge);
    memcpy(f->origin, corners[0], sizeof f->origin);
    (void)normal3(corners, f->axes[2]);
    f->b = length3(edge);
    for (int axis = 0; axis < 3; axis++) {
        f->axes[0][axis] = edge[axis] / f->b;
    }
    cross3(f->axes[2], f->axes[0], f->axes[1]);
    add3(corners[2], -1.0, corners[0], edge);
    f->c = dot3(edge, f->axes[0]);
    f->d = dot3(edge, f->axes[1]);
}

/** Squared distance in the plane from (x, y) to a segment. */
static inline double flat_segment2(const double from[2], const double to[2], double x, double y) {
    const double ex = to[0] - from[0], ey = to[1] - from[1];
    const double along = ((x - from[0]) * ex + (y - from[1]) * ey) / (ex * ex + ey * ey);
    const double t = along < 0.0 ? 0.0 : along > 1.0 ? 1.0 : along;
    const double dx = from[0] + t * ex - x, dy = from[1] + t * ey - y;
    return dx * dx + dy * dy;
}

/** Squared distance of a point to one triangle, or to its plane if that is above `limit`. */
static inline double flat_distance2(const flat *f, const double p[3], double limit) {
    double offset[3];
    add3(p, -1.0, f->origin, offset);
    const double z = dot3(offset, f->axes[2]);
    if (z * z > limit) {
        return z * z;
    }
    const double x = dot3(offset, f->axes[0]), y = dot3(offset, f->axes[1]);
    const double corners[4][2] = {{0.0, 0.0}, {f->b, 0.0}, {f->c, f->d}, {0.0, 0.0}};
    int outside = 0;
    for (int k = 0; k < 3; k++) {
        const double ex = corners[k + 1][0] - corners[k][0], ey = corners[k + 1][1] - corners[k][1];
        outside |= ex * (y - corners[k][1]) - ey * (x - corners[k][0]) < 0.0;
    }
    double least = outside ? HUGE_VAL : 0.0;
    for (int k = 0; outside && k < 3; k++) {
        const double d2 = flat_segment2(corners[k], corners[k + 1], x, y);
        least = d2 < least ? d2 : least;
    }
    return least + z * z;
}

/** 1 if the line through p along z crosses a triangle above p. */
static inline int flat_above(const flat *f, const double p[3]) {
    const double nz = f->axes[2][2];
    double offset[3];
    double at[3];
    if (fabs(nz) < 1e-9) {
        return 0;
    }
    add3(p, -1.0, f->origin, offset);
    const double rise = -dot3(offset, f->axes[2]) / nz;
    memcpy(at, offset, sizeof at);
    at[2] += rise;
    const double x = dot3(at, f->axes[0]), y = dot3(at, f->axes[1]);
    return rise > 0.0 && y >= 0.0 && f->d * x - f->c * y >= 0.0 && (f->c - f->b) * y - f->d * (x - f->b) >= 0.0;
}

static inline int64_t oracle_place(const oracle *o, int axis, double value) {
    const double place = floor((value - o->low[axis]) / o->cell);
    return place < 0.0 ? 0 : place >= (double)o->cells[axis] ? o->cells[axis] - 1 : (int64_t)place;
}

static inline size_t oracle_cell(const oracle *o, const int64_t at[3]) {
    return (size_t)((at[2] * o->cells[1] + at[1]) * o->cells[0] + at[0]);
}

/** Steps through the cells of a box; 0 after the last. */
static inline int oracle_next(const int64_t low[3], const int64_t high[3], int64_t at[3]) {
    for (int axis = 0; axis < 3; axis++) {
        if (++at[axis] <= high[axis]) {
            return 1;
        }
        at[axis] = low[axis];
    }
    return 0;
}

/** Counts (members null) or enters the triangles of each cell. */
static inline void oracle_enter(oracle *o, const shape *s) {
    for (uint32_t i = 0; i < o->count; i++) {
        double corners[3][3];
        int64_t low[3], high[3], at[3];
        shape_corners(s, i, corners);
        for (int axis = 0; axis < 3; axis++) {
            const double a = corners[0][axis], b = corners[1][axis], c = corners[2][axis];
            low[axis] = at[axis] = oracle_place(o, axis, fmin(a, fmin(b, c)));
            high[axis] = oracle_place(o, axis, fmax(a, fmax(b, c)));
        }
        do {
            uint32_t *start = &o->starts[oracle_cell(o, at) + 1];
            if (o->members) {
                o->members[--*start] = i;
            } else {
                ++*start;
            }
        } while (oracle_next(low, high, at));
    }
}

static inline oracle oracle_make(const shape *s) {
    oracle o = {0};
    double high[3];
    o.count = s->index_count / 3;
    const size_t room = o.count > 0 ? o.count : 1;
    o.flats = calloc(room, sizeof *o.flats);
    o.stamps = calloc(room, sizeof *o.stamps);
    for (int axis = 0; axis < 3; axis++) {
        o.low[axis] = HUGE_VAL;
        high[axis] = -HUGE_VAL;
    }
    for (uint32_t i = 0; i < o.count; i++) {
        double corners[3][3];
        shape_corners(s, i, corners);
        flat_set(&o.flats[i], (const double (*)[3])corners);
        for (int k = 0; k < 9; k++) {
            o.low[k % 3] = fmin(o.low[k % 3], corners[k / 3][k % 3]);
            high[k % 3] = fmax(high[k % 3], corners[k / 3][k % 3]);
        }
    }
    const double size = fmax(high[0] - o.low[0], fmax(high[1] - o.low[1], high[2] - o.low[2]));
    o.cell = size / fmax(4.0, fmin(100.0, sqrt(o.count / 10.0))); /* some ten triangles in each that has any */
    size_t cells = 1;
    for (int axis = 0; axis < 3; axis++) {
        o.cells[axis] = 1 + (int64_t)((high[axis] - o.low[axis]) / o.cell);
        cells *= (size_t)o.cells[axis];
    }
    o.starts = calloc(cells + 2, sizeof *o.starts);
    oracle_enter(&o, s);
    for (size_t i = 0; i < cells; i++) {
        o.starts[i + 1] += o.starts[i];
    }
    o.members = calloc(o.starts[cells] + 1, sizeof *o.members);
    const uint32_t total = o.starts[cells];
    oracle_enter(&o, s); /* each start moves down its run: starts[i + 1] is then the start of cell i */
    memmove(o.starts, o.starts + 1, cells * sizeof *o.starts);
    o.starts[cells] = total;
    return o;
}

static inline void oracle_free(oracle *o) {
    free(o->flats);
    free(o->stamps);
    free(o->starts);
    free(o->members);
}

/** Squared distance from p to a cell. */
static inline double oracle_cell_distance2(const oracle *o, const int64_t at[3], const double p[3]) {
    double sum = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        const double below = o->low[axis] + o->cell * (double)at[axis] - p[axis];
        const double above = -below - o->cell;
        const double gap = (below > above ? below : above) - 1e-9 * o->cell;
        sum += gap > 0.0 ? gap * gap : 0.0;
    }
    return sum;
}

/** The least squared distance to the triangles of one cell, or best2. */
static inline double oracle_look(oracle *o, size_t cell, const double p[3], double best2) {
    for (uint32_t i = o->starts[cell]; i < o->starts[cell + 1]; i++) {
        if (o->stamps[o->members[i]] != o->query) {
            o->stamps[o->members[i]] = o->query;
            const double d2 = flat_distance2(&o->flats[o->members[i]], p, best2);
            best2 = d2 < best2 ? d2 : best2;
        }
    }
    return best2;
}

/** m to the nearest triangle: of all cells within a radius that grows until it includes the result. */
static inline double oracle_distance(oracle *o, const double p[3]) {
    int64_t low[3], high[3], at[3];
    for (int axis = 0; axis < 3; axis++) {
        at[axis] = oracle_place(o, axis, p[axis]);
    }
    o->query++;
    double best2 = oracle_look(o, oracle_cell(o, at), p, HUGE_VAL);
    for (double radius = best2 < HUGE_VAL ? sqrt(best2) : o->cell;; radius *= 2.0) {
        for (int axis = 0; axis < 3; axis++) {
            low[axis] = at[axis] = oracle_place(o, axis, p[axis] - radius);
            high[axis] = oracle_place(o, axis, p[axis] + radius);
        }
        do {
            const size_t cell = oracle_cell(o, at);
            if (o->starts[cell] < o->starts[cell + 1] && oracle_cell_distance2(o, at, p) < best2) {
                best2 = oracle_look(o, cell, p, best2);
            }
        } while (oracle_next(low, high, at));
        if (best2 <= radius * radius) {
            return sqrt(best2);
        }
    }
}

/** Inside a closed body: an odd number of triangles lie above. */
static inline int oracle_inside(oracle *o, const double p[3]) {
    int64_t at[3];
    int above = 0;
    for (int axis = 0; axis < 3; axis++) {
        at[axis] = oracle_place(o, axis, p[axis]);
    }
    for (o->query++; at[2] < o->cells[2]; at[2]++) {
        const size_t cell = oracle_cell(o, at);
        for (uint32_t i = o->starts[cell]; i < o->starts[cell + 1]; i++) {
            if (o->stamps[o->members[i]] != o->query) {
                o->stamps[o->members[i]] = o->query;
                above += flat_above(&o->flats[o->members[i]], p);
            }
        }
    }
    return above % 2;
}

/** The least distance from p to those triangles that touch a point of the mesh. */
static inline double oracle_distance_round(oracle *o, const double point[3], const double p[3]) {
    int64_t low[3], high[3], at[3];
    double best2 = HUGE_VAL;
    for (int axis = 0; axis < 3; axis++) {
        low[axis] = at[axis] = oracle_place(o, axis, point[axis] - 1e-7);
        high[axis] = oracle_place(o, axis, point[axis] + 1e-7);
    }
    do {
        const size_t cell = oracle_cell(o, at);
        for (uint32_t i = o->starts[cell]; i < o->starts[cell + 1]; i++) {
            const flat *f = &o->flats[o->members[i]];
            if (flat_distance2(f, point, HUGE_VAL) < 1e-20) {
                best2 = fmin(best2, flat_distance2(f, p, HUGE_VAL));
            }
        }
    } while (oracle_next(low, high, at));
    return sqrt(best2);
}

#endif
