/* Finds vertices at the same position, which uv seams and hard edges duplicate. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_WELD_H
#define KNURL_SRC_WELD_H

#include "base/heap.h"

#include <knurl/contact.h>

/* Finds for each vertex the first at exactly the same position. welds: vertex_count entries; if `marked`, only vertices
 * whose entry is not 0 are tested. Errors: KNURL_ERROR_MEMORY. */
knurl_result knurl_mesh_weld(knurl_heap *heap, const knurl_mesh_desc *desc, int marked, uint32_t *welds);

/* Slots of an open hash table for `entries` entries: a power of two, at most half full. */
uint64_t knurl_table_slots(uint64_t entries);

#endif
