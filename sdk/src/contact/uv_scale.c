/* The scale of a mesh's uvs, in metres, and how evenly they are laid out. SPDX-License-Identifier: MIT */
#include "contact/uv_scale.h"

#include "base/vec3.h"
#include "contact/mesh_frame.h"
#include "contact/projection.h"

#include <string.h>

/* Lengths are sorted into bins: 8 for each octave, from 2^-64 m on. */
#define PER_OCTAVE 8 /* a power of two */
#define BINS       (128 * PER_OCTAVE)
#define WINDOW     (2 * PER_OCTAVE) /* bins: an octave to either side of the scale */

/* A triangle whose uvs have an area: twice its own area, and |dP/du| and |dP/dv|. */
typedef struct uv_triangle {
    double area_twice;
    double lengths[2];
} uv_triangle;

/* The exponent and the first three bits of the mantissa, as they are stored: without a logarithm, whose last bit
 * differs from library to library. */
static int bin_of(double length) {
    uint64_t bits;
    memcpy(&bits, &length, sizeof bits);
    const int bin = (int)(bits >> 49) - PER_OCTAVE * 1022 + BINS / 2;
    return bin < 0 ? 0 : bin < BINS ? bin : BINS - 1;
}

/* Finds the WINDOW neighbouring bins that hold the most area; returns the last of them. */
static int find_window(const double area[BINS]) {
    double held = 0.0, most = -1.0;
    int best = 0;
    for (int i = 0; i < BINS; i++) {
        held += area[i] - (i >= WINDOW ? area[i - WINDOW] : 0.0);
        if (held > most * (1.0 + 1e-9)) { /* by more than rounding */
            most = held;
            best = i;
        }
    }
    return best;
}

/* Sums over the lengths of one kind. */
typedef struct length_sums {
    double areas[BINS];
    double inverse; /* of areas over lengths */
    double shortest, longest;
} length_sums;

static void add_length(double area_twice, double length, length_sums *sums) {
    sums->areas[bin_of(length)] += area_twice;
    sums->inverse += area_twice / length;
    sums->shortest = knurl_min(sums->shortest, length);
    sums->longest = knurl_max(sums->longest, length);
}

/* The mean lengths by area, over the two octaves of lengths that hold the most area. A mean over everything is
 * dominated by a few collapsed triangles, whose lengths are large. Of 64 real files with uvs, in the mean 82 % of the
 * area are then within an octave of the scale, and at least 36 %; by a median 79 and 0 %, by the mean of logarithms 73
 * and 0 %, by the mean 62 and 0 %. */
static void find_scales(const uv_triangle *list, uint32_t count, const length_sums sums[2], double scale[2]) {
    const int last[2] = {find_window(sums[0].areas), find_window(sums[1].areas)};
    double area[2] = {0.0, 0.0}, sum[2] = {0.0, 0.0};
    for (uint32_t i = 0; i < count; i++) {
        for (int k = 0; k < 2; k++) {
            const int bin = bin_of(list[i].lengths[k]);
            const int is_inside = bin <= last[k] && bin > last[k] - WINDOW;
            area[k] += is_inside ? list[i].area_twice : 0.0;
            sum[k] += is_inside ? list[i].area_twice * list[i].lengths[k] : 0.0;
        }
    }
    scale[0] = sum[0] / area[0];
    scale[1] = sum[1] / area[1];
}

/* Min, mean by area, and max of the scale over a length. */
static void set_stretch(const length_sums *sums, double area, double scale, double stretch[3]) {
    stretch[0] = scale / sums->longest;
    stretch[1] = scale * sums->inverse / area;
    stretch[2] = scale / sums->shortest;
}

/* Twice the area in which ridges are within an octave of the material's, in both directions. */
static double find_even(const uv_triangle *list, uint32_t count, const double scale[2]) {
    double even = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        const double *l = list[i].lengths;
        const int is_even =
            scale[0] <= 2.0 * l[0] && 2.0 * scale[0] >= l[0] && scale[1] <= 2.0 * l[1] && 2.0 * scale[1] >= l[1];
        even += is_even ? list[i].area_twice : 0.0;
    }
    return even;
}

static int projection_of(const knurl_mesh *mesh, uint32_t triangle) {
    double corners[3][3];
    knurl_mesh_corners(mesh, triangle, corners);
    return knurl_projection_side_of((const double (*)[3])corners);
}

/* Counts the edges at which the projection changes. */
static uint32_t count_seams(const knurl_mesh *mesh) {
    uint32_t seams = 0;
    for (uint32_t i = 0; i < 3 * mesh->triangle_count; i++) {
        const uint32_t beyond = (mesh->opposite[i] & KNURL_CORNER_MASK);
        seams +=
            (beyond & 3) != 3 && beyond >> 2 > i / 3 && projection_of(mesh, beyond >> 2) != projection_of(mesh, i / 3);
    }
    return seams;
}

knurl_result knurl_mesh_measure_uvs(knurl_heap *heap, knurl_mesh *mesh) {
    double area = 0.0, mapped = 0.0;
    uint32_t count = 0;
    for (int i = 0; i < 2; i++) {
        mesh->facts.stretch[i][0] = mesh->facts.stretch[i][1] = mesh->facts.stretch[i][2] = 1.0;
    }
    if (!mesh->uvs && !mesh->is_projected) {
        return KNURL_OK;
    }
    uv_triangle *list = knurl_heap_alloc(heap, mesh->triangle_count, sizeof *list);
    length_sums *sums = knurl_heap_alloc(heap, 2, sizeof *sums);
    if (!list || !sums) {
        knurl_heap_free(heap, list);
        knurl_heap_free(heap, sums);
        return KNURL_ERROR_MEMORY;
    }
    sums[0].shortest = sums[1].shortest = HUGE_VAL;
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        double du[3], dv[3];
        knurl_triangle t;
        knurl_mesh_triangle(mesh, i, &t);
        area += t.area_twice;
        if (knurl_mesh_uv_frame(mesh, i, du, dv)) {
            mapped += t.area_twice;
            list[count].area_twice = t.area_twice;
            list[count].lengths[0] = vec3_length(du);
            list[count].lengths[1] = vec3_length(dv);
            add_length(t.area_twice, list[count].lengths[0], &sums[0]);
            add_length(t.area_twice, list[count].lengths[1], &sums[1]);
            count++;
        }
    }
    if (mesh->is_projected) {
        mesh->uv_scale[0] = mesh->uv_scale[1] = 1.0;
    } else if (count > 0) {
        find_scales(list, count, sums, mesh->uv_scale);
    }
    for (int k = 0; k < 2 && count > 0; k++) {
        set_stretch(&sums[k], mapped, mesh->uv_scale[k], mesh->facts.stretch[k]);
    }
    mesh->facts.projection_seams = mesh->is_projected ? count_seams(mesh) : 0;
    mesh->facts.collapsed = 1.0 - mapped / area;
    mesh->facts.uneven = 1.0 - find_even(list, count, mesh->uv_scale) / area;
    knurl_heap_free(heap, list);
    knurl_heap_free(heap, sums);
    return KNURL_OK;
}

knurl_result knurl_mesh_set_projection(knurl_heap *heap, knurl_mesh *mesh) {
    mesh->is_projected = 1;
    return knurl_mesh_measure_uvs(heap, mesh);
}

/* Share of the area in which uvs must have one: with less, they are a palette's. */
#define USABLE_SHARE 0.5

/* Reads one triangle of a description: 0 if its uvs have no area. */
static int has_uv_area(const float *const uv[3]) {
    const double u1 = (double)uv[1][0] - (double)uv[0][0], v1 = (double)uv[1][1] - (double)uv[0][1];
    const double u2 = (double)uv[2][0] - (double)uv[0][0], v2 = (double)uv[2][1] - (double)uv[0][1];
    return knurl_uvs_have_area(u1, v1, u2, v2);
}

int knurl_uvs_are_usable(const knurl_mesh_desc *desc) {
    double area = 0.0, mapped = 0.0;
    const uint64_t corners = desc->indices ? desc->index_count : desc->vertex_count;
    for (uint64_t i = 0; i < corners; i += 3) {
        const float *uv[3];
        double p[3][3], normal[3];
        for (size_t k = 0; k < 3; k++) {
            const size_t v = desc->indices ? desc->indices[i + k] : i + k;
            uv[k] = &desc->uvs[2 * v];
            for (size_t axis = 0; axis < 3; axis++) {
                p[k][axis] = (double)desc->positions[3 * v + axis];
            }
        }
        vec3_sub(p[1], p[0], p[1]);
        vec3_sub(p[2], p[0], p[2]);
        vec3_cross(p[1], p[2], normal);
        const double size = vec3_length(normal);
        area += size;
        mapped += has_uv_area(uv) ? size : 0.0;
    }
    return mapped >= USABLE_SHARE * area;
}
