/* A wavy sheet to scan at any tessellation, for the bench and the measurement of half cycles.
 * z = a sin(kx) cos(ky) with a = 1 mm (2 mm from trough to crest) and waves of 60 mm: slopes up to 0.105, principal
 * curvatures up to a k^2 = 11.0 /m (a radius of 91 mm). 0.12 x 0.08 m round the origin, front towards +z, uvs that grow
 * with x and y. SPDX-License-Identifier: MIT */
#ifndef KNURL_SAMPLES_SHEET_H
#define KNURL_SAMPLES_SHEET_H

#include <knurl/contact.h>

#define SHEET_HALF_X    0.06
#define SHEET_HALF_Y    0.04
#define SHEET_AMPLITUDE 0.001 /* m: half of trough to crest */
#define SHEET_WAVE      0.06  /* m */

typedef struct wavy_sheet {
    float *positions;
    float *uvs;
    uint32_t *indices;
    uint32_t columns, rows; /**< quads along x and y, two triangles each */
} wavy_sheet;

/** Makes a sheet of about `triangles` triangles (8 to 2^26), in nearly square cells. Returns 0, or 1 if memory runs
 * out. */
int wavy_sheet_make(uint32_t triangles, wavy_sheet *sheet);

/** Frees a sheet; a zeroed one is allowed. */
void wavy_sheet_free(wavy_sheet *sheet);

/** The mesh of a surface; the sheet keeps owning the arrays. */
knurl_mesh_desc wavy_sheet_desc(const wavy_sheet *sheet);

/** The smooth sheet's point at x, y and its unit normal. */
void wavy_sheet_point(double x, double y, double point[3], double normal[3]);

/** The distance (m) from a point to the sheet as it is tessellated, over the cells within `reach` (m) of it along x and
 * y: by brute force, apart from the library. For a point at most at a slope of 0.11 from above its nearest point, a
 * quarter of the distance is enough reach. */
double wavy_sheet_distance(const wavy_sheet *sheet, const double point[3], double reach);

#endif
