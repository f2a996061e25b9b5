/* Smooth meshes in joint contact. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_FELT_PARTS_H
#define KNURL_SRC_FELT_PARTS_H

#include <stdint.h>

/* The push on a proxy of those faces of a mesh that belong to one smooth surface. */
typedef struct knurl_felt_part {
    uint32_t triangle;
    double push[3]; /* m, shape's frame: of the displacement from the HIP to the proxy */
} knurl_felt_part;

/* Such parts of one mesh, the strongest first; 0: the mesh alone holds the HIP. */
typedef struct knurl_felt_parts {
    uint32_t count;
    knurl_felt_part list[3];
} knurl_felt_parts;

#endif
