/* Knurl: the shapes of surfaces: bounded planes and triangle meshes.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_CONTACT_H
#define KNURL_CONTACT_H

#include <knurl/base.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A rectangle in the surface's xy plane, centred on its origin, facing +z. */
typedef struct knurl_plane_desc {
    uint32_t struct_size;   /**< set by knurl_plane_desc_init() */
    uint32_t reserved;      /**< 0 */
    double half_extents[2]; /**< m along the surface's x and y, 1e-9 to KNURL_COORDINATE_MAX; default 0.05 */
} knurl_plane_desc;

/** A triangle mesh in the surface's own frame; seen from its front, a triangle's corners run counter-clockwise. All
 * arrays are the caller's and are copied. Triangles without area are dropped and counted. */
typedef struct knurl_mesh_desc {
    uint32_t struct_size;   /**< set by knurl_mesh_desc_init() */
    uint32_t vertex_count;  /**< vertices in each array, 3 to 2^28 */
    const float *positions; /**< x, y, z per vertex: m, within KNURL_COORDINATE_MAX. knurl_scene_check_surface() warns
                                 beyond 1e6 */
    const float *tangents;  /**< the surface's x direction: x, y, z, w per vertex (w is not used), each within
                               KNURL_COORDINATE_MAX; or null */
    const float *uvs; /**< surface coordinates u, v per vertex, each within KNURL_COORDINATE_MAX; or null. They also
                         give the x direction if there are no tangents */
    const uint32_t *indices; /**< three per triangle, each below vertex_count; or null for 0, 1, 2, ... */
    uint64_t index_count;    /**< a multiple of 3, at most 3 * 2^26; 0 if indices is null */
    const float *normals;    /**< x, y, z per vertex, outward, unit; or null: see KNURL_SMOOTH_ON. With normals, the
                                mesh is felt as the smooth surface that they describe: each triangle as a PN triangle
                                (Vlachos et al. 2001), perpendicular to the normals at its corners. An edge at which two
                                triangles have different normals (of vertices of their own) stays an edge. A triangle
                                stays flat if the surface differs from it by at most 0.1 degrees and 1 um, and if its
                                normals cannot be right: not of unit length, more than 60 degrees off its face, or so
                                that the surface folds (knurl_surface_info.bad_normals counts these) */
} knurl_mesh_desc;

/** Whether a mesh is felt as a smooth surface or as its triangles. */
enum {
    KNURL_SMOOTH_AUTO = 0, /**< as it looks: smooth with normals (knurl_mesh_desc.normals), else as its triangles */
    KNURL_SMOOTH_OFF = 1,  /**< as its triangles; normals are not used */
    KNURL_SMOOTH_ON = 2    /**< smooth: without normals, they are computed from the triangles; edges sharper than
                              KNURL_CREASE_ANGLE stay edges */
};

/** rad: the largest angle between triangles that computed normals smooth over, 43 degrees. Round bars of nine sides
 * or more are then round; fewer sides, chamfers of 45 degrees and boxes keep their edges. */
#define KNURL_CREASE_ANGLE 0.75

/** Fills in defaults; `size` is the caller's sizeof. [any thread] */
KNURL_API void knurl_plane_desc_init(knurl_plane_desc *desc, uint32_t size);

/** Fills in defaults; `size` is the caller's sizeof. [any thread] */
KNURL_API void knurl_mesh_desc_init(knurl_mesh_desc *desc, uint32_t size);

#ifdef __cplusplus
}
#endif
#endif
