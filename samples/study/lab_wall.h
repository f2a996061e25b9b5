/* The laboratory's walls: a plane, and waves along the stroke, as low-poly triangles or felt smooth.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_STUDY_LAB_WALL_H
#define KNURL_STUDY_LAB_WALL_H

#include "lab.h"

/** A wall's height above y = 0 at x (m), and its unit normal in the plane of x and y. */
double lab_wall_at(int32_t wall, double x, double normal[3]);

/** Distance (m) of a point from a wall along the normal below it, negative inside: exact on the plane, within 1 nm on
 * the waves. */
double lab_wall_distance(int32_t wall, const double point[3], double normal[3]);

/** Adds it to a scene. surface: its material and axis are used. */
knurl_result lab_wall_add(knurl_scene *scene, int32_t wall, const knurl_surface_desc *surface);

#endif
