/* Everyday materials as tags, from assets/materials.json. SPDX-License-Identifier: MIT */
#ifndef KNURL_MATERIALS_H
#define KNURL_MATERIALS_H

#define MATERIAL_COUNT 29

typedef struct material {
    const char *name;
    const char *tag; /* JSON, in the nested form without its version */
} material;

extern const material materials[MATERIAL_COUNT]; /* by name */

const char *materials_text(void); /* a line for each */

#endif
