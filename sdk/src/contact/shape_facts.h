/* Facts about a plane or a mesh, most of them for reports. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_SHAPE_FACTS_H
#define KNURL_SRC_SHAPE_FACTS_H

#include "base/finite.h"

#include <stdint.h>

typedef struct knurl_shape_facts {
    uint32_t dropped;        /* triangles dropped because they have no area or are duplicates */
    uint32_t reversed_twins; /* triangles dropped because another has the same corners with opposite winding */
    uint32_t turned;         /* triangles turned over to face like the rest of their connected component */
    uint32_t mixed;          /* triangles that still face against the rest of their component */
    double seam;          /* m: edges closer than this touch, and a cast hits a face up to this far beyond its edges */
    uint32_t touching;    /* pairs of triangles that touch, except along a shared edge */
    uint32_t curved;      /* triangles that are felt curved */
    uint32_t bad_normals; /* triangles that are felt flat because their normals do not describe a surface */
    int32_t has_computed_normals;
    double bulge;              /* m: greatest distance of the felt surface from the triangles */
    uint32_t projection_seams; /* edges between triangles whose coordinates are projected differently */
    double collapsed;          /* share of the area whose uvs have no area */
    double uneven;             /* share of the area in which ridges are more than an octave off, or without uvs */
    double error;              /* m: largest distance of a plane from the vertices that describe it */
    double stretch[2][3];      /* min, mean, max over area of d(surface coordinate)/d(metre along x), and along y */
} knurl_shape_facts;

#endif
