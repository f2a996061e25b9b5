/* The wavy sheet. SPDX-License-Identifier: MIT */
#include "sheet.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double wave_number(void) {
    return 2.0 * acos(-1.0) / SHEET_WAVE;
}

void wavy_sheet_point(double x, double y, double point[3], double normal[3]) {
    const double k = wave_number();
    const double slope_x = SHEET_AMPLITUDE * k * cos(k * x) * cos(k * y);
    const double slope_y = -SHEET_AMPLITUDE * k * sin(k * x) * sin(k * y);
    const double length = sqrt(1.0 + slope_x * slope_x + slope_y * slope_y);
    point[0] = x;
    point[1] = y;
    point[2] = SHEET_AMPLITUDE * sin(k * x) * cos(k * y);
    normal[0] = -slope_x / length;
    normal[1] = -slope_y / length;
    normal[2] = 1.0 / length;
}

static void fill(wavy_sheet *s) {
    const uint32_t across = s->columns + 1;
    size_t corner = 0;
    for (uint32_t j = 0; j <= s->rows; j++) {
        for (uint32_t i = 0; i <= s->columns; i++) {
            const uint32_t v = j * across + i;
            const double u = (double)i / s->columns;
            const double w = (double)j / s->rows;
            double point[3];
            double normal[3];
            wavy_sheet_point(SHEET_HALF_X * (2.0 * u - 1.0), SHEET_HALF_Y * (2.0 * w - 1.0), point, normal);
            for (size_t axis = 0; axis < 3; axis++) {
                s->positions[3 * (size_t)v + axis] = (float)point[axis];
            }
            s->uvs[2 * (size_t)v] = (float)u;
            s->uvs[2 * (size_t)v + 1] = (float)w;
            if (i < s->columns && j < s->rows) {
                const uint32_t quad[6] = {v, v + 1, v + across + 1, v, v + across + 1, v + across};
                memcpy(&s->indices[corner], quad, sizeof quad);
                corner += 6;
            }
        }
    }
}

int wavy_sheet_make(uint32_t triangles, wavy_sheet *sheet) {
    memset(sheet, 0, sizeof *sheet);
    sheet->rows = (uint32_t)sqrt(0.5 * triangles * SHEET_HALF_Y / SHEET_HALF_X);
    sheet->columns = (uint32_t)(0.5 * triangles / sheet->rows + 0.5);
    const size_t vertices = ((size_t)sheet->rows + 1) * (sheet->columns + 1);
    sheet->positions = calloc(vertices, 3 * sizeof *sheet->positions);
    sheet->uvs = calloc(vertices, 2 * sizeof *sheet->uvs);
    sheet->indices = calloc((size_t)sheet->rows * sheet->columns, 6 * sizeof *sheet->indices);
    if (!sheet->positions || !sheet->uvs || !sheet->indices) {
        wavy_sheet_free(sheet);
        return 1;
    }
    fill(sheet);
    return 0;
}

void wavy_sheet_free(wavy_sheet *sheet) {
    free(sheet->positions);
    free(sheet->uvs);
    free(sheet->indices);
    memset(sheet, 0, sizeof *sheet);
}

knurl_mesh_desc wavy_sheet_desc(const wavy_sheet *sheet) {
    knurl_mesh_desc desc;
    knurl_mesh_desc_init(&desc, sizeof desc);
    desc.vertex_count = (sheet->columns + 1) * (sheet->rows + 1);
    desc.positions = sheet->positions;
    desc.uvs = sheet->uvs;
    desc.indices = sheet->indices;
    desc.index_count = 6ULL * sheet->columns * sheet->rows;
    return desc;
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void minus(const double a[3], const double b[3], double out[3]) {
    for (int axis = 0; axis < 3; axis++) {
        out[axis] = a[axis] - b[axis];
    }
}

static double distance2_to_edge(const double p[3], const double a[3], const double b[3]) {
    double along[3];
    double offset[3];
    minus(b, a, along);
    minus(p, a, offset);
    const double t = fmax(0.0, fmin(1.0, dot(offset, along) / dot(along, along)));
    for (int axis = 0; axis < 3; axis++) {
        offset[axis] -= t * along[axis];
    }
    return dot(offset, offset);
}

/* The distance to the plane if the point's projection is inside all three edges, otherwise to the nearest edge. */
static double distance2_to_triangle(const double p[3], const double corners[3][3]) {
    double sides[3][3];
    double normal[3];
    double nearest = INFINITY;
    int inside = 1;
    for (int i = 0; i < 3; i++) {
        minus(corners[(i + 1) % 3], corners[i], sides[i]);
    }
    for (int k = 0; k < 3; k++) {
        normal[k] = sides[0][(k + 1) % 3] * sides[1][(k + 2) % 3] - sides[0][(k + 2) % 3] * sides[1][(k + 1) % 3];
    }
    double offset[3];
    for (int i = 0; i < 3; i++) {
        double inwards[3];
        for (int k = 0; k < 3; k++) {
            inwards[k] = normal[(k + 1) % 3] * sides[i][(k + 2) % 3] - normal[(k + 2) % 3] * sides[i][(k + 1) % 3];
        }
        minus(p, corners[i], offset);
        inside = inside && dot(offset, inwards) >= 0.0;
        nearest = fmin(nearest, distance2_to_edge(p, corners[i], corners[(i + 1) % 3]));
    }
    const double height = dot(offset, normal);
    return inside ? height * height / dot(normal, normal) : nearest;
}

/* The range of cells that [low, high] covers on a grid of `count` cells over [-half, half]. */
static void cells_within(double low, double high, double half, uint32_t count, uint32_t *first, uint32_t *last) {
    const double scale = count / (2.0 * half);
    *first = (uint32_t)fmax(0.0, floor((low + half) * scale));
    *last = (uint32_t)fmin(count - 1.0, fmax(0.0, floor((high + half) * scale)));
}

double wavy_sheet_distance(const wavy_sheet *sheet, const double point[3], double reach) {
    uint32_t columns[2];
    uint32_t rows[2];
    double nearest2 = INFINITY;
    cells_within(point[0] - reach, point[0] + reach, SHEET_HALF_X, sheet->columns, &columns[0], &columns[1]);
    cells_within(point[1] - reach, point[1] + reach, SHEET_HALF_Y, sheet->rows, &rows[0], &rows[1]);
    for (uint32_t j = rows[0]; j <= rows[1]; j++) {
        const size_t end = 6 * ((size_t)j * sheet->columns + columns[1] + 1);
        for (size_t first = 6 * ((size_t)j * sheet->columns + columns[0]); first < end; first += 3) {
            double corners[3][3];
            for (size_t i = 0; i < 9; i++) {
                corners[i / 3][i % 3] = (double)sheet->positions[3 * (size_t)sheet->indices[first + i / 3] + i % 3];
            }
            nearest2 = fmin(nearest2, distance2_to_triangle(point, (const double (*)[3])corners));
        }
    }
    return sqrt(nearest2);
}
