/* Finds the outline of a flat sheet: the edges without a reverse, with collinear ones joined, so that T-junctions
 * cancel too. Edges are in any order, each with the sheet on its left.
 * SPDX-License-Identifier: MIT */
#include "contact/outline.h"

#include "base/vec3.h"
#include "contact/edge_table.h"
#include "contact/outline_overlap.h"

#include <string.h>

/* Maximum number of edges before and after splitting them at corners that lie on them: each is compared with all. */
#define MAX_UNSPLIT 256
#define MAX_SPLIT   (4 * MAX_UNSPLIT)

#define NONE   UINT32_MAX       /* no edge */
#define BRANCH (UINT32_MAX - 1) /* several edges leave this vertex: nothing is straightened across it */

static const char *const overlapping = "mesh: its triangles overlap";
static const char *const too_many = "mesh: its outline has more than 64 edges";

typedef struct outline {
    uint32_t (*edges)[2];      /* by indices of places */
    uint32_t (*straighter)[2]; /* output of a round */
    double (*places)[2];
    uint32_t *leaving; /* per place: its edge, NONE or BRANCH */
    uint8_t *done;     /* per edge: 1 once straightened */
    uint32_t count;
    uint32_t made;
    uint32_t place_count;
    double tolerance; /* m: of this round */
    double error;     /* m: sum over all rounds */
    knurl_edge_table table;
} outline;

/* Directions from a place that pass within the tolerance of all places since (Reumann and Witkam's strip, kept as a
 * wedge: each vertex is tested once, and all stay within the tolerance). */
typedef struct wedge {
    double from[2];
    double low[2];
    double high[2];
    double reach;
    int open; /* 1: not narrowed yet */
} wedge;

static double cross2(const double a[2], const double b[2]) {
    return a[0] * b[1] - a[1] * b[0];
}

static wedge wedge_at(const double place[2]) {
    const wedge w = {{place[0], place[1]}, {0.0, 0.0}, {0.0, 0.0}, 0.0, 1};
    return w;
}

/* 1 if a straight line from the wedge's place to this one is within the tolerance; then narrows the wedge. */
static int wedge_take(wedge *w, const double place[2], double tolerance) {
    const double d[2] = {place[0] - w->from[0], place[1] - w->from[1]};
    const double reach = sqrt(d[0] * d[0] + d[1] * d[1]);
    if (!(reach > w->reach) || (!w->open && (cross2(w->low, d) < 0.0 || cross2(d, w->high) < 0.0))) {
        return 0;
    }
    w->reach = reach;
    if (reach > tolerance) {
        const double sine = tolerance / reach; /* used as a tangent: a little narrower than the tolerance allows */
        const double low[2] = {d[0] + sine * d[1], d[1] - sine * d[0]};
        const double high[2] = {d[0] - sine * d[1], d[1] + sine * d[0]};
        if (w->open || cross2(w->low, low) > 0.0) {
            memcpy(w->low, low, sizeof low);
        }
        if (w->open || cross2(w->high, high) < 0.0) {
            memcpy(w->high, high, sizeof high);
        }
        w->open = 0;
    }
    return 1;
}

/* Signed distance (m) of a place from the line through a and b. */
static double off_line(const double a[2], const double b[2], const double place[2]) {
    const double along[2] = {b[0] - a[0], b[1] - a[1]};
    const double to[2] = {place[0] - a[0], place[1] - a[1]};
    const double length = sqrt(along[0] * along[0] + along[1] * along[1]);
    return cross2(along, to) / length;
}

/* Replaces a run of edges by one; returns the largest distance from it to the vertices left out. */
static double replace_run(outline *o, uint32_t first, uint32_t last) {
    const uint32_t from = o->edges[first][0];
    const uint32_t to = o->edges[last][1];
    double error = 0.0;
    for (uint32_t edge = first; edge != last; edge = o->leaving[o->edges[edge][1]]) {
        error = fmax(error, fabs(off_line(o->places[from], o->places[to], o->places[o->edges[edge][1]])));
    }
    o->straighter[o->made][0] = from;
    o->straighter[o->made++][1] = to;
    return error;
}

/* Straightens from an edge to the next branch, or once round. Returns the error. */
static double straighten_chain(outline *o, uint32_t edge) {
    uint32_t first = edge;
    uint32_t last = edge;
    double error = 0.0;
    wedge w = wedge_at(o->places[o->edges[edge][0]]);
    while (edge < BRANCH && !o->done[edge]) {
        const double *to = o->places[o->edges[edge][1]];
        if (!wedge_take(&w, to, o->tolerance) && edge != first) {
            error = fmax(error, replace_run(o, first, last));
            first = edge;
            w = wedge_at(o->places[o->edges[edge][0]]);
            (void)wedge_take(&w, to, o->tolerance);
        }
        o->done[edge] = 1;
        last = edge;
        edge = o->leaving[o->edges[edge][1]];
    }
    return fmax(error, replace_run(o, first, last));
}

/* Edge of a closed loop that leaves its farthest place: a true corner, not one of many vertices along a side. */
static uint32_t corner_of_loop(const outline *o, uint32_t edge) {
    uint32_t found = edge;
    double farthest = -1.0;
    const uint32_t first = edge;
    do {
        const double *p = o->places[o->edges[edge][0]];
        const double distance2 = p[0] * p[0] + p[1] * p[1];
        if (distance2 > farthest) {
            farthest = distance2;
            found = edge;
        }
        edge = o->leaving[o->edges[edge][1]];
    } while (edge != first);
    return found;
}

static void straighten(outline *o, double limit) {
    double error = 0.0;
    memset(o->done, 0, o->count);
    memset(o->leaving, 0xff, o->place_count * sizeof *o->leaving);
    for (uint32_t i = 0; i < o->count; i++) {
        uint32_t *leaving = &o->leaving[o->edges[i][0]];
        *leaving = *leaving == NONE ? i : BRANCH;
    }
    o->made = 0;
    o->tolerance = 0.5 * fmax(0.0, limit - o->error); /* the sum over any number of rounds stays below the limit */
    for (uint32_t i = 0; i < o->count; i++) {
        if (o->leaving[o->edges[i][0]] == BRANCH) {
            error = fmax(error, straighten_chain(o, i));
        }
    }
    for (uint32_t i = 0; i < o->count; i++) {
        if (!o->done[i]) {
            error = fmax(error, straighten_chain(o, corner_of_loop(o, i)));
        }
    }
    uint32_t (*before)[2] = o->edges;
    o->edges = o->straighter;
    o->straighter = before;
    o->count = o->made;
    o->error += error;
}

/* Removes edges that have a reverse; 0 if an edge is there twice. */
static int cancel(outline *o) {
    uint64_t at = 0;
    knurl_edges_clear(&o->table, o->count);
    for (uint32_t i = 0; i < o->count; i++) {
        if (!knurl_edges_add(&o->table, o->edges[i][0], o->edges[i][1])) {
            return 0;
        }
    }
    o->count = 0;
    while (knurl_edges_next(&o->table, &at, o->edges[o->count])) {
        o->count++;
    }
    return 1;
}

/* Straightens and cancels in turn until nothing changes; 0 if the sheet overlaps itself. */
static int reduce(outline *o, double limit) {
    uint32_t before;
    do {
        straighten(o, limit);
        before = o->count;
        if (!cancel(o)) {
            return 0;
        }
    } while (o->count < before);
    return 1;
}

/* Splits edges at corners of others that lie on them, so that opposite edges cancel a part of them. Returns the number
 * of splits, or NONE if there is no room. */
static uint32_t split(outline *o, double limit) {
    const double tolerance = 0.5 * (limit - o->error);
    const uint32_t corners = o->count;
    double error = 0.0;
    for (uint32_t i = 0; i < o->count; i++) {
        for (uint32_t k = 0; k < corners; k++) { /* an edge leaves every corner, and splits add no corners */
            const uint32_t corner = o->edges[k][0];
            const double *a = o->places[o->edges[i][0]];
            const double *b = o->places[o->edges[i][1]];
            const double *p = o->places[corner];
            const double ahead = (p[0] - a[0]) * (b[0] - a[0]) + (p[1] - a[1]) * (b[1] - a[1]);
            const double whole = (b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]);
            const double off = fabs(off_line(a, b, p));
            if (corner != o->edges[i][0] && corner != o->edges[i][1] && ahead > 0.0 && ahead < whole &&
                off <= tolerance) {
                if (o->count == MAX_SPLIT) {
                    return NONE;
                }
                o->edges[o->count][0] = corner;
                o->edges[o->count++][1] = o->edges[i][1];
                o->edges[i][1] = corner;
                error = fmax(error, off);
            }
        }
    }
    o->error += error;
    return o->count - corners;
}

/* Collects the edges of all triangles, except those with a neighbour. */
static knurl_result collect(knurl_heap *heap, const knurl_sheet *sheet, outline *o, const char **why) {
    uint32_t *places = NULL; /* per vertex: its place + 1, or 0 */
    uint32_t edge[2];
    uint64_t at = 0;
    for (uint64_t i = 0; i < 3 * (uint64_t)sheet->count; i++) {
        const uint32_t triangle = sheet->kept[i / 3];
        const uint32_t from = sheet->welds[knurl_sheet_vertex(sheet->desc, triangle, (uint32_t)(i % 3))];
        const uint32_t to = sheet->welds[knurl_sheet_vertex(sheet->desc, triangle, (uint32_t)((i + 1) % 3))];
        if (!knurl_edges_add(&o->table, from, to)) {
            *why = overlapping;
            return KNURL_OK;
        }
    }
    uint32_t count = 0;
    while (knurl_edges_next(&o->table, &at, edge)) {
        count++;
    }
    const uint32_t room = count < MAX_SPLIT ? MAX_SPLIT : count;
    places = knurl_heap_alloc(heap, sheet->desc->vertex_count, sizeof *places);
    o->edges = knurl_heap_alloc(heap, room, sizeof *o->edges);
    o->straighter = knurl_heap_alloc(heap, room, sizeof *o->straighter);
    o->places = knurl_heap_alloc(heap, count, sizeof *o->places);
    o->leaving = knurl_heap_alloc(heap, count, sizeof *o->leaving);
    o->done = knurl_heap_alloc(heap, room, 1);
    const int enough = places && o->edges && o->straighter && o->places && o->leaving && o->done;
    for (at = 0; enough && knurl_edges_next(&o->table, &at, edge); o->count++) {
        for (int k = 0; k < 2; k++) { /* as many edges leave a vertex as reach it: no more places than edges */
            if (places[edge[k]] == 0) {
                knurl_sheet_place(sheet, edge[k], o->places[o->place_count]);
                places[edge[k]] = ++o->place_count;
            }
            o->edges[o->count][k] = places[edge[k]] - 1;
        }
    }
    knurl_heap_free(heap, places);
    return enough ? KNURL_OK : KNURL_ERROR_MEMORY;
}

/* Reduces the outline to the edges that a tick tests. */
static void simplify(outline *o, double limit, const char **why) {
    int sound = cancel(o) && reduce(o, limit);
    if (sound && o->count <= MAX_UNSPLIT) {
        const uint32_t splits = split(o, limit);
        if (splits == NONE) {
            *why = too_many;
            return;
        }
        sound = splits == 0 || (cancel(o) && reduce(o, limit));
    }
    if (!sound) {
        *why = overlapping;
    } else if (o->count > KNURL_OUTLINE_EDGES) {
        *why = too_many;
    } else if (o->count < 3) { /* straightened to nothing */
        *why = "mesh: its outline is smaller than a plane's tolerance";
    }
}

static knurl_result copy(knurl_heap *heap, const outline *o, knurl_plane *plane) {
    plane->outline = knurl_heap_alloc(heap, o->count, sizeof *plane->outline);
    if (!plane->outline) {
        return KNURL_ERROR_MEMORY;
    }
    for (uint32_t i = 0; i < o->count; i++) {
        memcpy(plane->outline[i].from, o->places[o->edges[i][0]], sizeof plane->outline[i].from);
        memcpy(plane->outline[i].to, o->places[o->edges[i][1]], sizeof plane->outline[i].to);
    }
    plane->edge_count = o->count;
    return KNURL_OK;
}

knurl_result knurl_sheet_outline(knurl_heap *heap, const knurl_sheet *sheet, knurl_plane *plane, double *error,
                                 const char **why) {
    outline o;
    memset(&o, 0, sizeof o);
    knurl_result result = knurl_edges_make(heap, 3 * (uint64_t)sheet->count, &o.table);
    result = result ? result : collect(heap, sheet, &o, why);
    if (!result && !*why) {
        simplify(&o, sheet->limit, why);
    }
    if (!result && !*why) {
        *error = o.error;
        result = copy(heap, &o, plane);
    }
    void *const scratch[] = {o.table.slots, o.edges, o.straighter, o.places, o.leaving, o.done};
    for (size_t i = 0; i < sizeof scratch / sizeof *scratch; i++) {
        knurl_heap_free(heap, scratch[i]);
    }
    if (!result && !*why && !knurl_outline_is_simple(plane, sheet->limit)) {
        *why = overlapping;
    }
    return result;
}
