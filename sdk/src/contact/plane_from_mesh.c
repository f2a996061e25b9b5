/* Replaces flat meshes by planes with an outline. SPDX-License-Identifier: MIT */
#include "contact/plane_from_mesh.h"

#include "base/vec3.h"
#include "contact/outline.h"
#include "contact/sheet.h"
#include "contact/sheet_coordinates.h"

/* Moves the plane's origin to the middle of its outline's bounds. */
static void centre_on_bounds(knurl_plane *plane, double middle[2]) {
    double low[2] = {HUGE_VAL, HUGE_VAL};
    double high[2] = {-HUGE_VAL, -HUGE_VAL};
    for (uint32_t i = 0; i < plane->edge_count; i++) { /* loops: every corner is the start of an edge */
        for (int axis = 0; axis < 2; axis++) {
            low[axis] = fmin(low[axis], plane->outline[i].from[axis]);
            high[axis] = fmax(high[axis], plane->outline[i].from[axis]);
        }
    }
    for (int axis = 0; axis < 2; axis++) {
        middle[axis] = 0.5 * (low[axis] + high[axis]);
        plane->half_extents[axis] = 0.5 * (high[axis] - low[axis]);
    }
    for (uint32_t i = 0; i < plane->edge_count; i++) {
        knurl_edge *edge = &plane->outline[i];
        for (int axis = 0; axis < 2; axis++) {
            edge->from[axis] -= middle[axis];
            edge->to[axis] -= middle[axis];
        }
        const double rise = edge->to[1] - edge->from[1];
        edge->slope = rise != 0.0 ? (edge->to[0] - edge->from[0]) / rise : 0.0;
    }
    for (int i = 0; i < 2; i++) {
        plane->map[i][2] += plane->map[i][0] * middle[0] + plane->map[i][1] * middle[1];
    }
}

/* 1 if the outline is its bounding rectangle, within the limit; *error: m, largest deviation. */
static int is_rectangle(const knurl_plane *plane, double limit, double *error) {
    unsigned corners = 0;
    for (uint32_t i = 0; i < plane->edge_count; i++) {
        const double *p = plane->outline[i].from;
        for (int axis = 0; axis < 2; axis++) {
            *error = fmax(*error, fabs(fabs(p[axis]) - plane->half_extents[axis]));
        }
        corners |= 1u << ((p[0] > 0.0 ? 1 : 0) + (p[1] > 0.0 ? 2 : 0));
    }
    return plane->edge_count == 4 && corners == 15 && *error <= limit;
}

/* Sorts edges into bands, so that a tick tests only those near the HIP's y. */
static knurl_result make_bands(knurl_heap *heap, knurl_plane *plane) {
    plane->bands_per_metre = KNURL_OUTLINE_BANDS / (2.0 * plane->half_extents[1]);
    for (int pass = 0; pass < 2; pass++) { /* count, then fill in */
        uint16_t count = 0;
        for (int band = 0; band < KNURL_OUTLINE_BANDS; band++) {
            plane->bands[band] = count;
            for (uint32_t i = 0; i < plane->edge_count; i++) {
                const knurl_edge *e = &plane->outline[i];
                const int lowest = knurl_plane_band(plane, fmin(e->from[1], e->to[1]));
                const int highest = knurl_plane_band(plane, fmax(e->from[1], e->to[1]));
                if (e->from[1] != e->to[1] && lowest <= band && band <= highest) {
                    if (pass == 1) {
                        plane->members[count] = (uint8_t)i;
                    }
                    count++;
                }
            }
        }
        plane->bands[KNURL_OUTLINE_BANDS] = count;
        plane->members = plane->members ? plane->members : knurl_heap_alloc(heap, count, 1);
        if (!plane->members) {
            return KNURL_ERROR_MEMORY;
        }
    }
    return KNURL_OK;
}

/* 1 if the origin is on the plane and not close to an edge. */
static int origin_is_inside(const knurl_plane *plane) {
    const double origin[2] = {0.0, 0.0};
    const double clear = 0.05 * fmin(plane->half_extents[0], plane->half_extents[1]);
    for (uint32_t i = 0; i < plane->edge_count; i++) {
        const double *from = plane->outline[i].from;
        const double along[2] = {plane->outline[i].to[0] - from[0], plane->outline[i].to[1] - from[1]};
        const double share = -(from[0] * along[0] + from[1] * along[1]) / (along[0] * along[0] + along[1] * along[1]);
        const double t = fmax(0.0, fmin(1.0, share));
        const double nearest[2] = {from[0] + t * along[0], from[1] + t * along[1]};
        if (nearest[0] * nearest[0] + nearest[1] * nearest[1] < clear * clear) {
            return 0;
        }
    }
    return knurl_plane_covers(plane, origin);
}

/* Finds a point of the plane, for strokes to start at: the origin or, if a hole or a notch is there, the middle of the
 * largest triangle. */
static void find_inside(const knurl_sheet *sheet, const double middle[2], knurl_plane *plane) {
    double largest = 0.0;
    if (origin_is_inside(plane)) {
        return;
    }
    for (uint32_t i = 0; i < sheet->count; i++) {
        double p[3][2];
        for (uint32_t k = 0; k < 3; k++) {
            knurl_sheet_place(sheet, knurl_sheet_vertex(sheet->desc, sheet->kept[i], k), p[k]);
        }
        const double area = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
        if (area > largest) {
            largest = area;
            plane->inside[0] = (p[0][0] + p[1][0] + p[2][0]) / 3.0 - middle[0];
            plane->inside[1] = (p[0][1] + p[1][1] + p[2][1]) / 3.0 - middle[1];
        }
    }
}

/* Moves the plane from the sheet's frame to its own, and sets the counts. */
static knurl_result set_plane_frame(knurl_heap *heap, const knurl_sheet *sheet, double outline_error,
                                    knurl_plane *plane, double position[3], double rotation[9]) {
    double middle[2];
    double rectangle_error = 0.0;
    centre_on_bounds(plane, middle);
    plane->facts.error = fmax(sheet->flatness, outline_error);
    if (is_rectangle(plane, sheet->limit, &rectangle_error)) {
        plane->facts.error = fmax(sheet->flatness, outline_error + rectangle_error);
        knurl_heap_free(heap, plane->outline);
        plane->outline = NULL;
        plane->edge_count = 0;
    } else if (make_bands(heap, plane)) {
        return KNURL_ERROR_MEMORY;
    }
    knurl_plane_set_seam(plane);
    find_inside(sheet, middle, plane);
    plane->triangle_count = sheet->count;
    plane->facts.dropped = sheet->dropped;
    plane->facts.reversed_twins = sheet->twins;
    plane->double_sided = sheet->twins > 0;
    vec3_madd(sheet->origin, middle[0], sheet->axes[0], position);
    vec3_madd(position, middle[1], sheet->axes[1], position);
    for (int i = 0; i < 9; i++) { /* columns: the plane's axes */
        rotation[i] = sheet->axes[i % 3][i / 3];
    }
    return KNURL_OK;
}

knurl_result knurl_plane_from_mesh(knurl_heap *heap, const knurl_mesh_desc *desc, const double axis[3],
                                   knurl_plane **plane, double position[3], double rotation[9], const char **why) {
    knurl_sheet sheet;
    knurl_plane *made = NULL;
    const char *refused = NULL;
    double outline_error = 0.0;
    knurl_result result = knurl_sheet_make(heap, desc, &sheet, &refused);
    if (!result && !refused) {
        made = knurl_heap_alloc(heap, 1, sizeof *made);
        result = made ? KNURL_OK : KNURL_ERROR_MEMORY;
    }
    if (!result && !refused) {
        knurl_sheet_coordinates(&sheet, axis, made, &refused);
    }
    if (!result && !refused) {
        result = knurl_sheet_outline(heap, &sheet, made, &outline_error, &refused);
    }
    if (!result && !refused) {
        result = set_plane_frame(heap, &sheet, outline_error, made, position, rotation);
    }
    if (result || refused) {
        knurl_plane_destroy(heap, made);
        made = NULL;
    }
    knurl_sheet_release(heap, &sheet);
    if (!result) {
        *plane = made;
        *why = refused ? refused
                       : (made->outline ? "plane: a flat mesh with its outline" : "plane: a flat mesh, a rectangle");
    }
    return result;
}
