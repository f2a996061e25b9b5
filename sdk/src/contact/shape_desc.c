/* Defaults of shape descriptions. SPDX-License-Identifier: MIT */
#include "base/base.h"

#include <knurl/contact.h>

void knurl_plane_desc_init(knurl_plane_desc *desc, uint32_t size) {
    const knurl_plane_desc defaults = {.half_extents = {0.05, 0.05}};
    knurl_desc_write(&defaults, sizeof defaults, desc, size);
}

void knurl_mesh_desc_init(knurl_mesh_desc *desc, uint32_t size) {
    const knurl_mesh_desc defaults = {0};
    knurl_desc_write(&defaults, sizeof defaults, desc, size);
}
