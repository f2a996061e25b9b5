/* What a smooth mesh adds to joint contact. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_FELT_PARTS_H
#define KNURL_SRC_FELT_PARTS_H

#include <stdint.h>

/* A smooth mesh's share of what holds a proxy together, by faces that belong to one smooth surface. */
typedef struct knurl_felt_part {
    uint32_t triangle;
    double push[3]; /* m, shape's frame: of the displacement from the HIP to the proxy */
} knurl_felt_part;

/* Such parts, that which pushes most first; 0: the contact is that of the mesh alone. */
typedef struct knurl_felt_parts {
    uint32_t count;
    knurl_felt_part list[3];
} knurl_felt_parts;

#endif
