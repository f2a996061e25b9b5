/* Tests whether a mesh is a flat sheet that faces one way, and collects its triangles. SPDX-License-Identifier: MIT */
#include "contact/sheet.h"

#include "base/vec3.h"
#include "contact/contact.h"
#include "contact/seeded_hash.h"
#include "contact/weld.h"

#include <string.h>

/* A sheet is flat if it lies within both of these of a plane: 1 um, a fiftieth of a good device's encoder resolution;
 * and 1e-5 of its size, which keeps slopes and directions within 1e-5 rad or so on a sheet of a few millimetres. The
 * second is stricter below 0.1 m. Single precision needs 1e-7 of the distance from the mesh's origin. */
#define FLAT_DISTANCE 1e-6
#define FLAT_SHARE    1e-5

/* Triangles, evenly spread over the list, that are tested first: most meshes that are not flat end here. */
#define SAMPLES 64

void knurl_sheet_place(const knurl_sheet *sheet, uint32_t vertex, double out[2]) {
    double p[3];
    knurl_sheet_position(sheet->desc, vertex, p);
    vec3_sub(p, sheet->origin, p);
    out[0] = vec3_dot(p, sheet->axes[0]);
    out[1] = vec3_dot(p, sheet->axes[1]);
}

/* Twice the area times the normal; 0 if a triangle has no area, by the same measure as has_area() of mesh_build.c. */
static int area_of(const knurl_mesh_desc *d, uint64_t triangle, double area[3]) {
    double corners[3][3];
    double edges[3][3];
    double longest = 0.0;
    for (uint32_t k = 0; k < 3; k++) {
        knurl_sheet_position(d, knurl_sheet_vertex(d, triangle, k), corners[k]);
    }
    for (int k = 0; k < 3; k++) {
        vec3_sub(corners[(k + 1) % 3], corners[k], edges[k]);
        longest = fmax(longest, vec3_dot(edges[k], edges[k]));
    }
    vec3_cross(edges[0], edges[1], area);
    return longest >= KNURL_EXTENT_MIN * KNURL_EXTENT_MIN && vec3_length(area) > 1e-6 * longest;
}

/* Vertices to fit a plane to: those in `list`, or all that are marked. */
typedef struct points {
    const knurl_mesh_desc *desc;
    const uint32_t *list;
    const uint32_t *marks;
    uint32_t count;
} points;

typedef struct fit {
    double origin[3];
    double normal[3];
    double size;       /* m: from the origin to the farthest vertex */
    double heights[2]; /* m: lowest and highest vertex above the plane through the origin */
} fit;

static int next_point(const points *p, uint32_t *i, const double from[3], double out[3]) {
    for (; *i < p->count; ++*i) {
        const uint32_t v = p->list ? p->list[*i] : *i;
        if (!p->marks || p->marks[v]) {
            knurl_sheet_position(p->desc, v, out);
            vec3_sub(out, from, out);
            ++*i;
            return 1;
        }
    }
    return 0;
}

/* Plane through the first vertex, the one farthest from it, and the one farthest from the line through both. If all
 * vertices are within d of some plane, they are within 8 d of this one (d at each of the three tilts it by no more). */
static void fit_plane(const points *p, fit *f) {
    static const double zero[3] = {0.0, 0.0, 0.0};
    double along[3] = {0.0, 0.0, 0.0};
    double offset[3];
    double farthest = 0.0;
    memset(f, 0, sizeof *f);
    uint32_t i = 0;
    (void)next_point(p, &i, zero, f->origin);
    for (i = 0; next_point(p, &i, f->origin, offset);) {
        if (vec3_length(offset) > f->size) {
            f->size = vec3_length(offset);
            vec3_copy(offset, along);
        }
    }
    for (i = 0; next_point(p, &i, f->origin, offset);) {
        double across[3];
        vec3_cross(along, offset, across);
        if (vec3_length(across) > farthest) {
            farthest = vec3_length(across);
            vec3_scale(1.0 / farthest, across, f->normal);
        }
    }
    for (i = 0; next_point(p, &i, f->origin, offset);) {
        const double height = vec3_dot(offset, f->normal);
        f->heights[0] = fmin(f->heights[0], height);
        f->heights[1] = fmax(f->heights[1], height);
    }
}

static int samples_are_curved(const knurl_mesh_desc *d) {
    const uint64_t triangles = knurl_sheet_triangles(d);
    const uint32_t samples = triangles < SAMPLES ? (uint32_t)triangles : SAMPLES;
    uint32_t list[3 * SAMPLES];
    points p = {d, list, NULL, 0};
    for (uint32_t i = 0; i < samples; i++) {
        const uint64_t triangle = i * triangles / samples;
        double area[3];
        for (uint32_t k = 0; k < 3 && area_of(d, triangle, area); k++) {
            list[p.count++] = knurl_sheet_vertex(d, triangle, k);
        }
    }
    fit f;
    fit_plane(&p, &f);
    return fmax(-f.heights[0], f.heights[1]) > 8.0 * FLAT_DISTANCE;
}

/* Finds the plane of all triangles with an area; it faces like the first of them. */
static void find_plane(const knurl_mesh_desc *d, knurl_sheet *sheet, const char **why) {
    double first[3] = {0.0, 0.0, 0.0};
    for (uint64_t i = 0; i < knurl_sheet_triangles(d); i++) {
        double area[3];
        if (!area_of(d, i, area)) {
            sheet->dropped++;
            continue;
        }
        if (sheet->count++ == 0) {
            vec3_copy(area, first);
        }
        for (uint32_t k = 0; k < 3; k++) {
            sheet->welds[knurl_sheet_vertex(d, i, k)] = 1; /* used */
        }
    }
    if (sheet->count == 0) {
        *why = "mesh: no triangle has an area";
        return;
    }
    const points p = {d, NULL, sheet->welds, d->vertex_count};
    fit f;
    fit_plane(&p, &f);
    sheet->limit = fmin(FLAT_DISTANCE, FLAT_SHARE * f.size);
    sheet->flatness = 0.5 * (f.heights[1] - f.heights[0]);
    if (!(sheet->flatness <= sheet->limit)) {
        *why = "mesh: not flat";
    }
    vec3_madd(f.origin, 0.5 * (f.heights[0] + f.heights[1]), f.normal, sheet->origin);
    vec3_scale(vec3_dot(first, f.normal) < 0.0 ? -1.0 : 1.0, f.normal, sheet->axes[2]);
    vec3_any_tangent(sheet->axes[2], sheet->axes[0]);
    vec3_cross(sheet->axes[2], sheet->axes[0], sheet->axes[1]);
}

/* Welded corners of a triangle, lowest first. */
static void sorted_corners(const knurl_sheet *sheet, uint64_t triangle, uint32_t out[3]) {
    for (uint32_t k = 0; k < 3; k++) {
        out[k] = sheet->welds[knurl_sheet_vertex(sheet->desc, triangle, k)];
    }
    for (int k = 0; k < 3; k++) {
        const int at = k % 2;
        if (out[at] > out[at + 1]) {
            const uint32_t high = out[at];
            out[at] = out[at + 1];
            out[at + 1] = high;
        }
    }
}

enum { FRONT = 1, BACK = 2 };

/* Slot of a triangle's corners in the table of those kept (number + 1, or 0), or the free slot to add them at. */
static uint64_t find_corners(const knurl_sheet *sheet, const knurl_seeded_hash *hash, const uint32_t *table,
                             uint64_t mask, const uint32_t corners[3]) {
    uint64_t slot = knurl_seeded_hash_of(hash, corners[0], corners[1], corners[2]) & mask;
    while (table[slot] != 0) {
        uint32_t there[3];
        sorted_corners(sheet, sheet->kept[table[slot] - 1], there);
        if (there[0] == corners[0] && there[1] == corners[1] && there[2] == corners[2]) {
            break;
        }
        slot = (slot + 1) & mask;
    }
    return slot;
}

/* Keeps one triangle of those with the same corners: the first that faces the front. */
static void keep_triangles(knurl_sheet *sheet, uint64_t seed, uint32_t *table, uint64_t mask, uint8_t *seen) {
    const knurl_mesh_desc *d = sheet->desc;
    knurl_seeded_hash hash;
    knurl_seeded_hash_init(&hash, seed);
    sheet->count = 0;
    for (uint64_t i = 0; i < knurl_sheet_triangles(d); i++) {
        double area[3];
        uint32_t corners[3];
        if (!area_of(d, i, area)) {
            continue;
        }
        const uint8_t facing = vec3_dot(area, sheet->axes[2]) > 0.0 ? FRONT : BACK;
        sorted_corners(sheet, i, corners);
        const uint64_t slot = find_corners(sheet, &hash, table, mask, corners);
        if (table[slot] == 0) {
            sheet->kept[sheet->count] = (uint32_t)i;
            seen[sheet->count] = facing;
            table[slot] = ++sheet->count;
        } else if (seen[table[slot] - 1] & facing) {
            sheet->dropped++;
        } else {
            sheet->twins++;
            seen[table[slot] - 1] = FRONT | BACK;
            sheet->kept[table[slot] - 1] = facing == FRONT ? (uint32_t)i : sheet->kept[table[slot] - 1];
        }
    }
}

static knurl_result leave_out_duplicates(knurl_heap *heap, knurl_sheet *sheet, const char **why) {
    const uint64_t slots = knurl_table_slots(sheet->count);
    uint32_t *table = knurl_heap_alloc(heap, slots, sizeof *table);
    uint8_t *seen = knurl_heap_alloc(heap, sheet->count, 1);
    sheet->kept = knurl_heap_alloc(heap, sheet->count, sizeof *sheet->kept);
    const knurl_result result = table && seen && sheet->kept ? KNURL_OK : KNURL_ERROR_MEMORY;
    if (!result) {
        keep_triangles(sheet, heap->seed, table, slots - 1, seen);
    }
    for (uint32_t i = 0; !result && i < sheet->count && !*why; i++) {
        if (sheet->twins > 0 && seen[i] != (FRONT | BACK)) {
            *why = "mesh: only some of its triangles have a reversed twin";
        } else if (seen[i] == BACK) {
            *why = "mesh: its triangles face both ways";
        }
    }
    knurl_heap_free(heap, table);
    knurl_heap_free(heap, seen);
    return result;
}

knurl_result knurl_sheet_make(knurl_heap *heap, const knurl_mesh_desc *desc, knurl_sheet *sheet, const char **why) {
    memset(sheet, 0, sizeof *sheet);
    sheet->desc = desc;
    if (samples_are_curved(desc)) {
        *why = "mesh: not flat";
        return KNURL_OK;
    }
    sheet->welds = knurl_heap_alloc(heap, desc->vertex_count, sizeof *sheet->welds);
    if (!sheet->welds) {
        return KNURL_ERROR_MEMORY;
    }
    find_plane(desc, sheet, why);
    if (*why) {
        return KNURL_OK;
    }
    const knurl_result result = knurl_mesh_weld(heap, desc, 1, sheet->welds);
    return result ? result : leave_out_duplicates(heap, sheet, why);
}

void knurl_sheet_release(knurl_heap *heap, knurl_sheet *sheet) {
    knurl_heap_free(heap, sheet->welds);
    knurl_heap_free(heap, sheet->kept);
}
