/* The wavy sheet. SPDX-License-Identifier: MIT */
#include "sheet.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double wave_number(void) {
    return 2.0 * acos(-1.0) / SHEET_WAVE;
}

void study_sheet_point(double x, double y, double point[3], double normal[3]) {
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

static void fill(study_sheet *s) {
    const uint32_t across = s->columns + 1;
    size_t corner = 0;
    for (uint32_t j = 0; j <= s->rows; j++) {
        for (uint32_t i = 0; i <= s->columns; i++) {
            const uint32_t v = j * across + i;
            const double u = (double)i / s->columns;
            const double w = (double)j / s->rows;
            double point[3];
            double normal[3];
            study_sheet_point(SHEET_HALF_X * (2.0 * u - 1.0), SHEET_HALF_Y * (2.0 * w - 1.0), point, normal);
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

int study_sheet_make(uint32_t triangles, study_sheet *sheet) {
    memset(sheet, 0, sizeof *sheet);
    sheet->rows = (uint32_t)sqrt(0.5 * triangles * SHEET_HALF_Y / SHEET_HALF_X);
    sheet->columns = (uint32_t)(0.5 * triangles / sheet->rows + 0.5);
    const size_t vertices = ((size_t)sheet->rows + 1) * (sheet->columns + 1);
    sheet->positions = calloc(vertices, 3 * sizeof *sheet->positions);
    sheet->uvs = calloc(vertices, 2 * sizeof *sheet->uvs);
    sheet->indices = calloc((size_t)sheet->rows * sheet->columns, 6 * sizeof *sheet->indices);
    if (!sheet->positions || !sheet->uvs || !sheet->indices) {
        study_sheet_free(sheet);
        return 1;
    }
    fill(sheet);
    return 0;
}

void study_sheet_free(study_sheet *sheet) {
    free(sheet->positions);
    free(sheet->uvs);
    free(sheet->indices);
    memset(sheet, 0, sizeof *sheet);
}

knurl_mesh_desc study_sheet_desc(const study_sheet *sheet) {
    knurl_mesh_desc desc;
    knurl_mesh_desc_init(&desc, sizeof desc);
    desc.vertex_count = (sheet->columns + 1) * (sheet->rows + 1);
    desc.positions = sheet->positions;
    desc.uvs = sheet->uvs;
    desc.indices = sheet->indices;
    desc.index_count = 6ULL * sheet->columns * sheet->rows;
    return desc;
}
