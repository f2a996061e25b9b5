/* Flat meshes as planes with their true outline. SPDX-License-Identifier: MIT */
#include "contact/plane.h"

knurl_result knurl_plane_from_mesh(knurl_heap *heap, const knurl_mesh_desc *desc, const double axis[3],
                                   knurl_plane **plane, double position[3], double rotation[9], const char **why) {
    (void)heap;
    (void)desc;
    (void)axis;
    (void)position;
    (void)rotation;
    *plane = NULL;
    *why = "not looked at yet";
    return KNURL_OK;
}

void knurl_plane_destroy(knurl_heap *heap, knurl_plane *plane) {
    if (plane) {
        knurl_heap_free(heap, plane->outline);
        knurl_heap_free(heap, plane);
    }
}

uint64_t knurl_plane_bytes(const knurl_plane *plane) {
    return knurl_heap_size(plane) + knurl_heap_size(plane->outline);
}
