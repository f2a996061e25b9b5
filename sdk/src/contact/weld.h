/* Finds vertices at the same place, which uv seams and hard edges duplicate. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_WELD_H
#define KNURL_SRC_WELD_H

#include "base/heap.h"

#include <knurl/contact.h>

/* Of each vertex the first that stands exactly where it stands. welds: vertex_count entries of the caller's; where
 * `marked`, only vertices whose entry is not 0 are looked at. Errors: KNURL_ERROR_MEMORY. */
knurl_result knurl_mesh_weld(knurl_heap *heap, const knurl_mesh_desc *desc, int marked, uint32_t *welds);

/* Slots of an open hash table for so many entries: a power of two, at most half full. */
uint64_t knurl_table_slots(uint64_t entries);

#endif
